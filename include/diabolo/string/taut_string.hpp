// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/string/keep_energy.hpp"
#include "diabolo/string/put_back.hpp"
#include "diabolo/string/snap_taut.hpp"

namespace diabolo {

template <bool kElastic, class Scalar>
StringStepResult<Scalar> advance_on_string(const StringStep<Scalar>& step, const Mask<Scalar>& captured);

namespace string_detail {

/// What the search for the string's pull begins with.
template <bool kElastic, class Scalar>
struct TautSearch {
  const StringStep<Scalar>& step;
  StringPath<Scalar> begin{step.position, step.begin};  ///< the string at the beginning of the step
  Vector3<Scalar> free = step.free_position(step.dt);   ///< where the diabolo would come without it [m]
  Mask<Scalar> slack = begin.length() < step.string_length - step.tolerance();  ///< at the beginning
  Scalar half_square = Scalar(0.5) * step.dt * step.dt;
  // The spring's extension counts with these weights at the end and at the beginning of the step.
  Scalar resolution{0}, end_weight{1}, begin_part{0}, spring{0};
  // What moves with the string pulls against the change of the diabolo's rate along it.
  Scalar inertia{0}, rate{0};

  /// `gradient` of the path length near the end of the step.
  [[gnu::always_inline]] inline void resolve_spring(const Vector3<Scalar>& gradient) {
    const Scalar square = squared_norm(gradient);
    resolution = step.resolution(square);
    end_weight = Scalar(1) - Scalar(0.5) * resolution + step.damping_time / step.dt;
    begin_part = (Scalar(1) - end_weight) * (begin.length() - step.string_length);
    spring = step.compliance / half_square;
    inertia = spring * step.beside(step.inertia, square);
    rate = dot(step.plane(begin.gradient()), step.velocity);
  }

  /// A diabolo that begins outside a rigid string is put back without being thrown.
  [[gnu::always_inline]] inline Mask<Scalar> thrown() const {
    return (begin.length() - step.string_length <= Scalar(10) * step.tolerance()) || (resolution > Scalar(0));
  }
};

/// How far the search has come. It is Newton's method for shift = -direction * pull, pull = tension / mass *
/// dt^2 / 2: the path is known at the last position, its extension is wanted on the line through `free` along
/// the new direction.
template <class Scalar>
struct TautIterate {
  Vector3<Scalar> shift;      ///< of the diabolo by the string over the step [m]
  StringPath<Scalar> path;    ///< at the last position
  Vector3<Scalar> gradient;   ///< of the path length there
  Vector3<Scalar> direction;  ///< discrete gradient over the step
  Scalar slope;               ///< of the path length along it
  Scalar pull;
  Mask<Scalar> settled;

  /// The path at the position that was moved by `guess`.
  [[gnu::always_inline]] inline TautIterate(const StringStep<Scalar>& step, const Vector3<Scalar>& free,
                                            const Vector3<Scalar>& guess)
      : shift(guess), path(free + guess, step.end), gradient(step.plane(path.gradient())) {}

  /// A step of Newton's method from there; no pull in the other lanes.
  template <bool kElastic>
  [[gnu::always_inline]] inline void improve(const TautSearch<kElastic, Scalar>& search,
                                             const Mask<Scalar>& may_pull) {
    const StringStep<Scalar>& step = search.step;
    const Vector3<Scalar> last = shift;
    direction = step.plane(discrete_gradient(search.begin, path));
    slope = dot(gradient, direction);
    const Scalar steep = maximum(slope, Scalar(1e-9));
    const Scalar extension = path.length() - step.string_length - dot(gradient, last);
    if constexpr (kElastic) {
      const Scalar sped_up =
          Scalar(0.5) * step.dt * (dot(gradient, step.free_velocity(step.dt)) - search.rate);
      pull = (search.end_weight * extension + search.begin_part + search.inertia * sped_up) /
             ((search.end_weight + search.inertia) * steep + search.spring);
    } else
      pull = extension / steep;
    pull = select(may_pull, maximum(pull, Scalar(0)), Scalar(0));
    shift = direction * Scalar(-pull);
    // What another iteration could still change is about moved * (moved + pull) / strand; the energy per mass
    // that the position and the direction are wrong by is about that times tension / mass, and pull * moved /
    // strand * travel.
    const Vector3<Scalar> here = constant(shift);
    const Scalar moved = squared_norm<Scalar>(here - constant(last));
    const Scalar strand = minimum(constant(path.left_length), constant(path.right_length));
    const Scalar pull_squared = constant(pull) * constant(pull);
    const Scalar reach = Scalar(2) * (moved + pull_squared);
    const Scalar travel = squared_norm<Scalar>(constant(search.free) + here - constant(step.position));
    const Scalar position_limit = step.tolerance() * strand;
    const Scalar energy_limit = energy_tolerance<Scalar>() * search.half_square * strand;
    settled = (moved * reach <= position_limit * position_limit) &&
              (moved * pull_squared * (travel + reach) <= energy_limit * energy_limit);
  }

  /// Takes the lanes `where` from another iterate.
  void keep_where(const Mask<Scalar>& where, const TautIterate& other) {
    shift = select<Scalar>(where, other.shift, shift);
    path.keep_where(where, other.path);
    gradient = select<Scalar>(where, other.gradient, gradient);
    direction = select<Scalar>(where, other.direction, direction);
    slope = select(where, other.slope, slope);
    pull = select(where, other.pull, pull);
    settled = settled || where;
  }
};

/// Goes on with Newton's method until all lanes are settled. A lane does not depend on how long its
/// neighbours take.
template <bool kElastic, class Scalar>
[[gnu::always_inline]] inline void settle(const TautSearch<kElastic, Scalar>& search,
                                          const Mask<Scalar>& may_pull, TautIterate<Scalar>& now) {
  for (int i = 1; i < 12 && !all(now.settled); ++i) {
    TautIterate<Scalar> next(search.step, search.free, now.shift);
    next.improve(search, may_pull);
    next.keep_where(now.settled, now);
    now = next;
  }
}

/// Whether tension times what the path of a rigid string began too long by, as far as rounding lets it tell,
/// is energy that counts.
template <bool kElastic, class Scalar>
[[gnu::always_inline]] inline Mask<Scalar> may_gain(const TautSearch<kElastic, Scalar>& search,
                                                    const TautIterate<Scalar>& found) {
  const Scalar longer = constant(search.begin.length()) - constant(search.step.string_length) +
                        constant(path_rounding(search.step));
  return (longer * constant(found.pull) > energy_tolerance<Scalar>() * search.half_square) &&
         (search.resolution == Scalar(0));
}

/// The step that the search has found, into a new `result`.
template <bool kElastic, class Scalar>
[[gnu::always_inline]] inline void pull(const TautSearch<kElastic, Scalar>& search,
                                        const TautIterate<Scalar>& found, StringStepResult<Scalar>& result) {
  const StringStep<Scalar>& step = search.step;
  result.taut = found.pull > Scalar(0);
  result.slack = step.string_length - found.path.length();
  result.gradient_squared = squared_norm(found.gradient);
  result.passed = Scalar(0.5) * (found.path.imbalance() - search.begin.imbalance());
  const Scalar inverse_dt = Scalar(1) / step.dt;
  const Scalar impulse =
      select(result.taut && search.thrown(), Scalar(Scalar(2) * inverse_dt * found.pull), Scalar(0));
  const Vector3<Scalar> arriving = step.free_velocity(step.dt);
  const Scalar rate_before =
      dot(found.gradient, arriving) + found.path.tip_rate(step.end.left_velocity, step.end.right_velocity);
  const Scalar rigidity = (Scalar(1) - search.resolution) / (result.gradient_squared + Scalar(1e-12));
  const Scalar removed =
      select(result.taut, Scalar((rate_before - found.slope * impulse) * rigidity), Scalar(0));
  const Vector3<Scalar> string_impulse = found.direction * impulse + found.gradient * removed;
  result.velocity = arriving - string_impulse;
  result.position = search.free + found.shift;
  result.string_acceleration = string_impulse * Scalar(-inverse_dt);
  result.tension = maximum(Scalar(impulse + removed), Scalar(0)) * inverse_dt;
}

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
  const StringStep<Scalar> rest =
      step.rest(position, velocity, tips, maximum(Scalar(step.dt - t), Scalar(Scalar(1e-6) * step.dt)));
  const StringPath<Scalar> path(position, tips);
  const Scalar passed_before = path.imbalance() - StringPath<Scalar>(step.position, step.begin).imbalance();
  StringStepResult<Scalar> result = advance_on_string<kElastic>(rest, captured);
  result.passed += Scalar(0.5) * passed_before;
  const Vector3<Scalar> impulse = result.string_acceleration * rest.dt + (velocity - arriving);
  result.string_acceleration =
      select<Scalar>(where, impulse * Scalar(Scalar(1) / step.dt), result.string_acceleration);
  const Scalar caught = norm<Scalar>(velocity - arriving) / norm<Scalar>(path.gradient());
  result.tension = select(where, Scalar((result.tension * rest.dt + caught) / step.dt), result.tension);
  result.snapped_taut = where;
  return result;
}

/// The step of a diabolo whose string is slack at its beginning.
template <bool kElastic, class Scalar>
[[gnu::always_inline]] inline StringStepResult<Scalar> advance_slack(
    const TautSearch<kElastic, Scalar>& search, const Mask<Scalar>& captured) {
  const StringStep<Scalar>& step = search.step;
  const StringPath<Scalar> path(search.free, step.end);
  const Mask<Scalar> snaps = captured && (path.length() > step.string_length);
  if (any(snaps)) return advance_from_catch<kElastic>(step, captured, snaps);
  StringStepResult<Scalar> result;
  result.position = search.free;
  result.velocity = step.free_velocity(step.dt);
  result.string_acceleration = Vector3<Scalar>::Constant(Scalar(0));
  result.slack = step.string_length - path.length();
  result.gradient_squared = squared_norm<Scalar>(step.plane(path.gradient()));
  result.passed = Scalar(0.5) * (path.imbalance() - search.begin.imbalance());
  return result;
}

}  // namespace string_detail

/// One step of a point mass on a massless string without friction, tips given: m a = m g - T grad(S), T >= 0,
/// with S the path length. Lanes outside `captured` fly freely.
///
/// The step is the energy-momentum method: T acts along the discrete gradient of S, so that with resting tips
/// it does no work; then the velocity loses what is left of the rate of S, which can only take energy away.
/// Second order in dt. A string that comes taut within the step is located; its catch is inelastic but
/// for `restitution`. An elastic string extends by `compliance` per tension/mass, less
/// `damping_time` times its rate; what it moves has `inertia`.
///
/// `kElastic` false leaves the spring out; the result is the same, bit for bit, as with a compliance of zero.
template <bool kElastic, class Scalar>
StringStepResult<Scalar> advance_on_string(const StringStep<Scalar>& step, const Mask<Scalar>& captured) {
  string_detail::TautSearch<kElastic, Scalar> search{step};
  const Mask<Scalar> may_pull = captured && !search.slack;
  if (!any(may_pull)) return string_detail::advance_slack<kElastic>(search, captured);
  // The string moves the diabolo by `shift` from where it would have come without it: a guess first.
  string_detail::TautIterate<Scalar> now(
      step, search.free, step.string_acceleration * select(may_pull, search.half_square, Scalar(0)));
  const Mask<Scalar> snaps = captured && search.slack && (now.path.length() > step.string_length);
  if (any(snaps)) return string_detail::advance_from_catch<kElastic>(step, captured, snaps);
  if constexpr (kElastic) search.resolve_spring(now.gradient);
  now.improve(search, may_pull);
  string_detail::settle(search, may_pull, now);
  StringStepResult<Scalar> result;
  string_detail::pull(search, now, result);
  const Mask<Scalar> gains = search.thrown() && string_detail::may_gain(search, now);
  if (any(gains))
    keep_energy<Scalar>(step, search.begin, now.path, now.pull * Scalar(step.dt / search.half_square), gains,
                        result.velocity);
  const Mask<Scalar> lost = may_pull && !now.settled;
  if (any(lost)) put_back(step, lost, result);
  return result;
}

/// The same, bit for bit, for the usual step of captured lanes: the string is taut from beginning to end,
/// its pull is found, and its energy is beyond doubt. False, and no result,
/// where that is not so.
template <bool kElastic, class Scalar>
[[gnu::always_inline]] inline bool advance_at_once(const StringStep<Scalar>& step,
                                                   StringStepResult<Scalar>& result) {
  string_detail::TautSearch<kElastic, Scalar> search{step};
  if (any(search.slack) || (!kElastic && !all(search.thrown()))) return false;
  string_detail::TautIterate<Scalar> found(step, search.free, step.string_acceleration * search.half_square);
  if constexpr (kElastic) search.resolve_spring(found.gradient);
  found.improve(search, Mask<Scalar>(true));
  if constexpr (ScalarTraits<Scalar>::kLanes > 1)  // nearly always one number is settled, not all lanes are
    string_detail::settle(search, Mask<Scalar>(true), found);
  if (!all(found.settled) || any(string_detail::may_gain(search, found)) || !all(found.pull > Scalar(0)))
    return false;
  string_detail::pull(search, found, result);
  return true;
}

}  // namespace diabolo
