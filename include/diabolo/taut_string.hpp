// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/string_path.hpp"

namespace diabolo {

/// Projection onto a plane through the origin, or onto nothing.
template <class Scalar>
struct PlaneProjector {
  bool active = false;
  Vector3<Scalar> normal = Vector3<Scalar>::Constant(Scalar(0));
  Vector3<Scalar> operator()(const Vector3<Scalar>& v) const {
    return active ? Vector3<Scalar>(v - normal * Scalar(v.dot(normal))) : v;
  }
};

/// What one step of a diabolo on a massless string needs.
template <class Scalar>
struct StringStep {
  Vector3<Scalar> position, velocity;  ///< of the diabolo at the beginning [m], [m/s]
  Vector3<Scalar> acceleration;        ///< of everything but the string: gravity and effects [m/s^2]
  Tips<Scalar> begin, end;             ///< tips at the beginning and at the end
  Scalar dt;                           ///< [s]
  Scalar string_length;                ///< [m]
  Scalar compliance{0};                ///< of the string times the diabolo's mass: extension per tension/mass [s^2]
  Scalar damping_time{0};              ///< string damping over its stiffness [s]
  PlaneProjector<Scalar> plane;
};

/// Its outcome.
template <class Scalar>
struct StringStepResult {
  Vector3<Scalar> position, velocity;
  Scalar tension;              ///< mean over the step, per mass [m/s^2]; 0 when slack
  Scalar slack;                ///< L - path length at the end [m]
  Scalar gradient_norm;        ///< |gradient of the path length| near the end
  Mask<Scalar> taut, snapped_taut;
};

namespace detail {

/// Share of a step that resolves a spring: 0 for a rigid string, 1 where the oscillation of the spring is resolved.
/// It turns the spring's law from its value at the end of the step (stiff, rigid in the limit) into its mean over the
/// step (second order, keeps the energy), and the inelastic catch of a rigid string into none.
template <class Scalar>
Scalar resolved_share(const StringStep<Scalar>& step, const Scalar& gradient_squared) {
  return minimum(Scalar(1), Scalar(Scalar(4) * step.compliance /
                                   (step.dt * step.dt * gradient_squared + tiny<Scalar>())));
}

/// Free motion over a part of the step.
template <class Scalar>
Vector3<Scalar> free_position(const StringStep<Scalar>& step, const Scalar& t) {
  return step.position + (step.velocity + step.acceleration * (Scalar(0.5) * t)) * t;
}

/// Tips in the middle of a step, at a fraction of it.
template <class Scalar>
Tips<Scalar> between(const Tips<Scalar>& a, const Tips<Scalar>& b, const Scalar& fraction) {
  return {a.left + (b.left - a.left) * fraction, a.right + (b.right - a.right) * fraction,
          a.left_velocity + (b.left_velocity - a.left_velocity) * fraction,
          a.right_velocity + (b.right_velocity - a.right_velocity) * fraction};
}

/// Removes a share of the rate of the path length from the velocity: the inelastic impulse of the string.
template <class Scalar>
Vector3<Scalar> without_path_rate(const Vector3<Scalar>& velocity, const Vector3<Scalar>& gradient, const Scalar& rate) {
  return velocity - gradient * (rate / (Scalar(gradient.dot(gradient)) + Scalar(1e-12)));
}

/// Moves the beginning of the step to where free motion makes the string taut, with the impulse of the catch there;
/// lanes outside `where` stay. Newton's method within a bracket; its last step carries the derivatives.
template <class Scalar>
[[gnu::noinline]] void start_when_taut(StringStep<Scalar>& step, const Mask<Scalar>& where) {
  Scalar low{0}, high{1}, fraction{1};
  const Scalar tolerance = Scalar(constraint_tolerance<Scalar>()) * step.string_length;
  for (int i = 0; i < 60; ++i) {
    const Scalar t = fraction * step.dt;
    const Tips<Scalar> tips = between(step.begin, step.end, fraction);
    const StringPath<Scalar> path(free_position(step, t), tips.left, tips.right);
    const Scalar extension = path.length() - step.string_length;
    const Vector3<Scalar> travel = (step.velocity + step.acceleration * t) * step.dt;
    const Scalar slope = path.rate(travel, step.end.left - step.begin.left, step.end.right - step.begin.right);
    low = select(extension < Scalar(0), fraction, low);
    high = select(extension < Scalar(0), high, fraction);
    const Scalar newton = fraction - extension / select(slope == Scalar(0), Scalar(1), slope);
    const Mask<Scalar> useful = (newton >= low) && (newton <= high);
    const Mask<Scalar> settled = absolute<Scalar>(extension) <= Scalar(0.01) * tolerance;
    fraction = select(useful || settled, newton, Scalar(Scalar(0.5) * (low + high)));
    if (all(settled || !where)) break;
  }
  fraction = select(where, fraction, Scalar(0));
  const Scalar t = fraction * step.dt;
  const Vector3<Scalar> arriving = step.velocity + step.acceleration * t;
  step.position = free_position(step, t);
  step.begin = between(step.begin, step.end, fraction);
  step.dt = step.dt - t;
  const StringPath<Scalar> path(step.position, step.begin.left, step.begin.right);
  const Vector3<Scalar> gradient = step.plane(path.gradient());
  const Scalar rate = path.rate(arriving, step.begin.left_velocity, step.begin.right_velocity);
  const Scalar inelastic = Scalar(1) - resolved_share<Scalar>(step, gradient.dot(gradient));
  const Vector3<Scalar> leaving = without_path_rate<Scalar>(arriving, gradient, maximum(rate, Scalar(0)) * inelastic);
  step.velocity = select<Scalar>(where, leaving, arriving);
}

/// Where the iteration of the taut step finds nothing (violent tips, spheroids thinner than the step's motion): the
/// diabolo goes back along the line to where it was, or to the tips' midpoint where that is outside, until the string
/// fits; its speed is limited to what its energy allows.
template <class Scalar>
[[gnu::noinline]] void put_back(const StringStep<Scalar>& step, const Mask<Scalar>& where,
                                StringStepResult<Scalar>& result) {
  const Vector3<Scalar>&left = step.end.left, &right = step.end.right;
  const Vector3<Scalar> outside = free_position(step, step.dt);
  const Vector3<Scalar> middle = Scalar(0.5) * (left + right);
  const Vector3<Scalar> anchor_in_plane = step.plane.active ? Vector3<Scalar>(step.position + step.plane(middle - step.position)) : middle;
  const Mask<Scalar> was_inside = StringPath<Scalar>(step.position, left, right).length() <= step.string_length;
  const Vector3<Scalar> anchor = select<Scalar>(was_inside, step.position, anchor_in_plane);
  Scalar low{0}, high{1};
  for (int i = 0; i < 60; ++i) {
    const Scalar middle_fraction = Scalar(0.5) * (low + high);
    const StringPath<Scalar> path(anchor + (outside - anchor) * middle_fraction, left, right);
    const Mask<Scalar> fits = path.length() <= step.string_length;
    low = select(fits, middle_fraction, low);
    high = select(fits, high, middle_fraction);
  }
  const Vector3<Scalar> position = anchor + (outside - anchor) * low;
  const StringPath<Scalar> path(position, left, right);
  const Vector3<Scalar> gradient = step.plane(path.gradient());
  const Vector3<Scalar> arriving = step.velocity + step.acceleration * step.dt;
  const Scalar rate = path.rate(arriving, step.end.left_velocity, step.end.right_velocity);
  Vector3<Scalar> velocity = without_path_rate<Scalar>(arriving, gradient, rate);
  const Scalar allowed = arriving.dot(arriving) + Scalar(2) * Scalar(step.acceleration.dot(position - outside));
  const Scalar excess = positive_sqrt<Scalar>(allowed / (Scalar(velocity.dot(velocity)) + tiny<Scalar>()));
  velocity = velocity * select(was_inside, minimum(excess, Scalar(1)), Scalar(1));
  result.position = select<Scalar>(where, position, result.position);
  result.velocity = select<Scalar>(where, velocity, result.velocity);
  result.slack = select(where, Scalar(step.string_length - path.length()), result.slack);
  result.gradient_norm = select(where, norm<Scalar>(gradient), result.gradient_norm);
}

}  // namespace detail

/// One step of a point mass on a massless string without friction, tips given: m a = m g - T grad(S), T >= 0, S = path
/// length. Lanes outside `captured` fly freely.
///
/// The step is the energy-momentum method: T acts along the discrete gradient of S, so that with resting tips it does no
/// work; then the velocity loses what is left of the rate of S, which can only take energy away. Second order in dt.
/// A string that comes taut within the step is located, and the catch is inelastic (restitution 0 along the string).
/// An elastic string extends by `compliance` per tension/mass, plus `damping_time` times its rate.
template <class Scalar>
StringStepResult<Scalar> advance_on_string(StringStep<Scalar> step, const Mask<Scalar>& captured) {
  const Scalar tolerance = Scalar(constraint_tolerance<Scalar>()) * step.string_length;
  StringPath<Scalar> begin(step.position, step.begin.left, step.begin.right);
  Vector3<Scalar> free = detail::free_position(step, step.dt);
  StringPath<Scalar> path(free, step.end.left, step.end.right);
  const Mask<Scalar> snaps = captured && (begin.length() < step.string_length - tolerance) &&
                             (path.length() > step.string_length);
  if (any(snaps)) {
    detail::start_when_taut(step, snaps);
    begin = StringPath<Scalar>(step.position, step.begin.left, step.begin.right);
    free = detail::free_position(step, step.dt);
    path = StringPath<Scalar>(free, step.end.left, step.end.right);
  }

  // The spring's extension counts with these weights at the end and at the beginning of the step.
  Vector3<Scalar> gradient = step.plane(path.gradient());
  const Scalar resolved = detail::resolved_share<Scalar>(step, gradient.dot(gradient));
  const Scalar damping = step.damping_time / maximum(step.dt, tiny<Scalar>());
  const Scalar end_weight = Scalar(1) - Scalar(0.5) * resolved + damping;
  const Scalar begin_part = (Scalar(1) - end_weight) * (begin.length() - step.string_length);
  const Scalar spring = Scalar(2) * step.compliance / maximum(Scalar(step.dt * step.dt), tiny<Scalar>());

  Scalar residual = end_weight * (path.length() - step.string_length) + begin_part;
  const Mask<Scalar> taut = captured && (residual > Scalar(0));
  StringStepResult<Scalar> result;
  result.velocity = step.velocity + step.acceleration * step.dt;
  result.position = free;
  result.tension = Scalar(0);
  result.taut = taut;
  result.snapped_taut = snaps;
  if (any(taut)) {
    Vector3<Scalar> direction = step.plane(discrete_gradient(begin, path));
    Scalar pull{0};  // tension / mass * dt^2 / 2
    Mask<Scalar> settled{false};
    for (int i = 0; i < 12; ++i) {
      const Scalar slope = end_weight * Scalar(gradient.dot(direction)) + spring;
      // The residual belongs to the last position; the direction has turned since.
      const Scalar turned = Scalar(gradient.dot(free - direction * pull - result.position));
      const Scalar error = residual + end_weight * turned;
      pull += error / maximum(slope, Scalar(1e-9));
      const Vector3<Scalar> position = free - direction * pull;
      settled = absolute<Scalar>(error) <= Scalar(100) * tolerance;
      settled = settled || !taut;
      result.position = select<Scalar>(taut, position, free);
      if (all(settled)) break;
      path = StringPath<Scalar>(result.position, step.end.left, step.end.right);
      gradient = step.plane(path.gradient());
      direction = step.plane(discrete_gradient(begin, path));
      residual = end_weight * (path.length() - step.string_length) + begin_part - spring * pull;
    }
    const Scalar impulse = Scalar(2) * pull / maximum(step.dt, tiny<Scalar>());
    // A diabolo that begins outside a rigid string is put back without being thrown.
    const Mask<Scalar> thrown = (begin.length() <= step.string_length + Scalar(10) * tolerance) || (resolved > Scalar(0));
    const Vector3<Scalar> pulled = result.velocity - direction * select(thrown, impulse, Scalar(0));
    const Scalar rate = path.rate(pulled, step.end.left_velocity, step.end.right_velocity);
    const Vector3<Scalar> along =
        detail::without_path_rate<Scalar>(pulled, gradient, rate * (Scalar(1) - resolved));
    result.velocity = select<Scalar>(taut, along, result.velocity);
    result.tension = select(taut, Scalar(impulse / maximum(step.dt, tiny<Scalar>())), Scalar(0));
    result.slack = step.string_length - path.length();
    result.gradient_norm = norm<Scalar>(gradient);
    const Mask<Scalar> lost = taut && (!settled || !(pull >= Scalar(0)));
    if (any(lost)) detail::put_back(step, lost, result);
  } else {
    result.slack = step.string_length - path.length();
    result.gradient_norm = norm<Scalar>(gradient);
  }
  return result;
}

}  // namespace diabolo
