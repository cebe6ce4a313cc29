// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/put_back.hpp"
#include "diabolo/snap_taut.hpp"

namespace diabolo {

template <bool kElastic, class Scalar>
StringStepResult<Scalar> advance_on_string(const StringStep<Scalar>& step, const Mask<Scalar>& captured);

namespace detail {

/// How far the search for the string's pull has come.
template <class Scalar>
struct TautIterate {
  Vector3<Scalar> shift;                 ///< of the diabolo by the string over the step [m]
  StringPath<Scalar> path;               ///< at the last position
  Vector3<Scalar> gradient;              ///< of the path length there
  Vector3<Scalar> direction = gradient;  ///< discrete gradient over the step
  Scalar slope{0}, pull{0};

  [[gnu::always_inline]] inline TautIterate(const StringStep<Scalar>& step,
                                            const Vector3<Scalar>& shift_of_diabolo,
                                            const Vector3<Scalar>& free)
      : shift(shift_of_diabolo),
        path(free + shift_of_diabolo, step.end),
        gradient(step.plane(path.gradient())) {}

  /// Takes the lanes `where` from another iterate.
  void keep_where(const Mask<Scalar>& where, const TautIterate& other) {
    shift = select<Scalar>(where, other.shift, shift);
    path.keep_where(where, other.path);
    gradient = select<Scalar>(where, other.gradient, gradient);
    direction = select<Scalar>(where, other.direction, direction);
    slope = select(where, other.slope, slope);
    pull = select(where, other.pull, pull);
  }
};

/// The step from the instant on at which the string comes taut in the lanes `where`; the whole step in the
/// others.
template <bool kElastic, class Scalar>
[[gnu::noinline]] StringStepResult<Scalar> advance_from_catch(const StringStep<Scalar>& step,
                                                              const Mask<Scalar>& captured,
                                                              const Mask<Scalar>& where) {
  const Scalar fraction = taut_fraction(step, where);
  const Scalar t = fraction * step.dt;
  const Tips<Scalar> tips = step.tips_at(fraction);
  const Vector3<Scalar> position = step.free_position(t), arriving = step.free_velocity(t);
  const Vector3<Scalar> leaving = velocity_after_catch(step, position, arriving, tips);
  const Vector3<Scalar> velocity = select<Scalar>(where, leaving, arriving);
  const StringStep<Scalar> rest{position,           velocity,
                                step.acceleration,  tips,
                                step.end,           maximum(Scalar(step.dt - t), Scalar(1e-6 * step.dt)),
                                step.string_length, step.string_acceleration,
                                step.compliance,    step.damping_time,
                                step.plane};
  const Scalar passed_before = StringPath<Scalar>(position, tips).imbalance() -
                               StringPath<Scalar>(step.position, step.begin).imbalance();
  StringStepResult<Scalar> result = advance_on_string<kElastic>(rest, captured);
  result.passed += Scalar(0.5) * passed_before;
  const Vector3<Scalar> impulse = result.string_acceleration * rest.dt + (velocity - arriving);
  result.string_acceleration =
      select<Scalar>(where, impulse * Scalar(Scalar(1) / step.dt), result.string_acceleration);
  result.snapped_taut = where;
  return result;
}

}  // namespace detail

/// One step of a point mass on a massless string without friction, tips given: m a = m g - T grad(S), T >= 0,
/// with S the path length. Lanes outside `captured` fly freely.
///
/// The step is the energy-momentum method: T acts along the discrete gradient of S, so that with resting tips
/// it does no work; then the velocity loses what is left of the rate of S, which can only take energy away.
/// Second order in dt. A string that comes taut within the step is located, and its catch is inelastic
/// (restitution 0 along the string). An elastic string extends by `compliance` per tension/mass, less
/// `damping_time` times its rate.
///
/// `kElastic` false leaves the spring out; the result is the same, bit for bit, as with a compliance of zero.
template <bool kElastic, class Scalar>
StringStepResult<Scalar> advance_on_string(const StringStep<Scalar>& step, const Mask<Scalar>& captured) {
  const Scalar& length = step.string_length;
  const Scalar tolerance = Scalar(constraint_tolerance<Scalar>()) * length;
  const Scalar energy_tolerance = Scalar(30 * constraint_tolerance<Scalar>());  // [J/kg]
  const StringPath<Scalar> begin(step.position, step.begin);
  const Vector3<Scalar> free = step.free_position(step.dt);
  const Mask<Scalar> begins_slack = begin.length() < length - tolerance;

  // The string moves the diabolo by `shift` from where it would have come without it: a guess first.
  const Scalar half_square = Scalar(0.5) * step.dt * step.dt;
  const Scalar guess = select(captured && !begins_slack, half_square, Scalar(0));
  detail::TautIterate<Scalar> now(step, step.string_acceleration * guess, free);
  const Mask<Scalar> snaps = captured && begins_slack && (now.path.length() > length);
  if (any(snaps)) return detail::advance_from_catch<kElastic>(step, captured, snaps);
  const Mask<Scalar> may_pull = captured && !begins_slack;

  // The spring's extension counts with these weights at the end and at the beginning of the step.
  Scalar resolution{0}, end_weight{1}, begin_part{0}, spring{0};
  if constexpr (kElastic) {
    resolution = step.resolution(squared_norm(now.gradient));
    end_weight = Scalar(1) - Scalar(0.5) * resolution + step.damping_time / step.dt;
    begin_part = (Scalar(1) - end_weight) * (begin.length() - length);
    spring = step.compliance / half_square;
  }

  // Newton's method for shift = -direction * pull, pull = tension / mass * dt^2 / 2: the path is known at the
  // last position, its extension is wanted on the line through `free` along the new direction.
  Mask<Scalar> settled{false};
  for (int i = 0; i < 12; ++i) {
    detail::TautIterate<Scalar> next = now;
    if (i > 0) next = detail::TautIterate<Scalar>(step, now.shift, free);
    next.direction = step.plane(discrete_gradient(begin, next.path));
    next.slope = maximum(dot(next.gradient, next.direction), Scalar(1e-9));
    const Scalar extension = next.path.length() - length - dot(next.gradient, now.shift);
    if constexpr (kElastic)
      next.pull = (end_weight * extension + begin_part) / (end_weight * next.slope + spring);
    else
      next.pull = extension / next.slope;
    next.pull = select(may_pull, maximum(next.pull, Scalar(0)), Scalar(0));
    next.shift = next.direction * Scalar(-next.pull);
    const Scalar moved = squared_norm<Scalar>(next.shift - now.shift);
    if (i > 0) next.keep_where(settled, now);  // a lane does not depend on how long its neighbours take
    now = next;
    // What another iteration could still change is about moved * (moved + pull) / strand; the energy per mass
    // that the position and the direction are wrong by is about that times tension / mass, and pull * moved /
    // strand * travel.
    const Scalar strand = minimum(now.path.left_length, now.path.right_length);
    const Scalar pull_squared = now.pull * now.pull;
    const Scalar reach = Scalar(2) * (moved + pull_squared);
    const Scalar travel = squared_norm<Scalar>(free + now.shift - step.position);
    const Scalar position_limit = tolerance * strand, energy_limit = energy_tolerance * half_square * strand;
    settled = settled || ((moved * reach <= position_limit * position_limit) &&
                          (moved * pull_squared * (travel + reach) <= energy_limit * energy_limit));
    if (all(settled)) break;
  }

  const StringPath<Scalar>& path = now.path;
  const Vector3<Scalar>&gradient = now.gradient, &direction = now.direction;
  const Scalar &pull = now.pull, &slope = now.slope;
  const Mask<Scalar> taut = pull > Scalar(0);
  StringStepResult<Scalar> result;
  result.taut = taut;
  result.slack = length - path.length();
  result.gradient_squared = squared_norm(gradient);
  result.passed = Scalar(0.5) * (path.imbalance() - begin.imbalance());
  const Scalar inverse_dt = Scalar(1) / step.dt;
  // A diabolo that begins outside a rigid string is put back without being thrown.
  const Mask<Scalar> thrown = (begin.length() <= length + Scalar(10) * tolerance) || (resolution > Scalar(0));
  const Scalar impulse = select(taut && thrown, Scalar(Scalar(2) * inverse_dt * pull), Scalar(0));
  const Vector3<Scalar> arriving = step.free_velocity(step.dt);
  const Scalar rate_before =
      dot(gradient, arriving) + path.tip_rate(step.end.left_velocity, step.end.right_velocity);
  const Scalar rigidity = (Scalar(1) - resolution) / (result.gradient_squared + Scalar(1e-12));
  const Scalar removed = select(taut, Scalar((rate_before - slope * impulse) * rigidity), Scalar(0));
  const Vector3<Scalar> string_impulse = direction * impulse + gradient * removed;
  result.velocity = arriving - string_impulse;
  result.position = free + now.shift;
  result.string_acceleration = string_impulse * Scalar(-inverse_dt);
  // A rigid string that began too long by less than the tolerance would give that length back times its
  // tension.
  const Scalar surplus = (begin.length() - length) * impulse * inverse_dt;
  const Mask<Scalar> gains = (surplus > energy_tolerance) && (resolution == Scalar(0));
  if (any(gains)) {
    const Scalar kept = Scalar(1) - Scalar(2) * surplus / (squared_norm(result.velocity) + tiny<Scalar>());
    result.velocity = result.velocity * select(gains, positive_sqrt<Scalar>(kept), Scalar(1));
  }
  const Mask<Scalar> lost = may_pull && !settled;
  if (any(lost)) put_back(step, lost, result);
  return result;
}

}  // namespace diabolo
