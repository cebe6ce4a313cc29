// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/paper/pull_velocity.hpp"
#include "diabolo/paper/step_factors.hpp"
#include "diabolo/paper/string_state.hpp"
#include "diabolo/string/string_step.hpp"

namespace diabolo {

namespace paper_detail {

template <class Scalar>
Vector3<Scalar> normal_at(const Spheroid<Scalar>& spheroid, const Vector3<Scalar>& point,
                          const Parameters<Scalar>& parameters) {
  return parameters.pull.normal_rule == NormalRule::kPublished ? spheroid.published_normal(point)
                                                               : spheroid.normal(point);
}

/// Where a diabolo outside the spheroid is put: onto it, less what an elastic string gives.
template <class Scalar>
Vector3<Scalar> put_on_spheroid(const StringStep<Scalar>& step, const Spheroid<Scalar>& spheroid,
                                const Vector3<Scalar>& position, const Parameters<Scalar>& parameters) {
  const Vector3<Scalar> target = step.plane.on(
      step.position, parameters.pull.projection == Projection::kRadial ? spheroid.radial_point(position)
                                                                       : spheroid.closest_point(position));
  const Vector3<Scalar> gradient = spheroid.path_gradient(target);
  const Scalar give =
      step.compliance /
      (step.compliance + Scalar(0.5) * step.dt * step.dt * squared_norm(gradient) + tiny<Scalar>());
  return target + (position - target) * give;
}

/// The velocity that a diabolo gets that was put from `position` to `put`.
template <class Scalar>
Vector3<Scalar> pull_velocity(const StringStep<Scalar>& step, const Spheroid<Scalar>& spheroid,
                              const Vector3<Scalar>& position, const Vector3<Scalar>& put,
                              const Vector3<Scalar>& normal, const Parameters<Scalar>& p) {
  const Tips<Scalar>& tips = step.end;
  const Spheroid<Scalar> before(step.begin.left, step.begin.right, step.string_length);
  const Vector3<Scalar> facing = normal_at(spheroid, position, p);
  const Vector3<Scalar> cap =
      facing * Scalar(-p.pull.cap_scale * pull_cap(before, spheroid, facing, step.dt));
  const Vector3<Scalar> pull = capped_pull<Scalar>(put - position, normal, cap, step.dt, p.pull.pull_scale);
  const Mask<Scalar> thin = spheroid.tip_distance() >= step.string_length - p.pull.thin_slack;
  const Vector3<Scalar> bounded = select<Scalar>(
      thin,
      p.pull.thin_rule == ThinRule::kPublished ? pull_in_vertical_plane<Scalar>(pull, tips.left, tips.right)
                                               : pull_across_plane<Scalar>(pull, tips.left, tips.right),
      pull);
  const Scalar share = p.pull.pull_scale_after_cap * factor_time(p, step.dt) / p.pull.reference_step;
  return step.plane(bounded) * share;
}

}  // namespace paper_detail

/// One step under the paper's and the published rules: free motion, the string's state, and outside the
/// spheroid back onto it, with a capped part of the way as velocity. `taut` are the lanes that were put back.
template <class Scalar>
StringStepResult<Scalar> advance_by_pull(StringStateOf<Scalar>& string_state, const StringStep<Scalar>& step,
                                         const Parameters<Scalar>& parameters) {
  const Scalar& dt = step.dt;
  Vector3<Scalar> position = step.position + step.velocity * dt;
  if (parameters.pull.integrator == Integrator::kParabolic)
    position += step.acceleration * (Scalar(0.5) * dt * dt);
  const Spheroid<Scalar> spheroid(step.end.left, step.end.right, step.string_length);
  string_state = parameters.pull.flight_rule == FlightRule::kPublished
                     ? published_string_state(string_state, position, spheroid, parameters)
                     : paper_string_state(string_state, position, spheroid, parameters);
  const Mask<Scalar> on_string = is(string_state, StringState::kOnString);
  StringStepResult<Scalar> result;
  result.position = position;
  result.velocity = step.free_velocity(dt) * dissipation(parameters, dt, on_string);
  result.string_acceleration = Vector3<Scalar>::Constant(Scalar(0));
  result.taut = on_string && !spheroid.contains(position) && !spheroid.overstretched();
  if (!any(result.taut)) return result;
  const Vector3<Scalar> put = paper_detail::put_on_spheroid(step, spheroid, position, parameters);
  const Vector3<Scalar> normal = paper_detail::normal_at(spheroid, put, parameters);
  const Vector3<Scalar> pull = paper_detail::pull_velocity(step, spheroid, position, put, normal, parameters);
  const Vector3<Scalar> moved = result.velocity + pull, outward = step.plane(normal);
  const Scalar outward_rate = maximum(dot<Scalar>(moved, outward), Scalar(0));
  const Vector3<Scalar> inward =
      moved - outward * Scalar(outward_rate / (squared_norm(outward) + tiny<Scalar>()));
  result.position = select<Scalar>(result.taut, put, position);
  result.velocity = select<Scalar>(result.taut, inward, result.velocity);
  result.string_acceleration =
      select<Scalar>(result.taut, pull, result.string_acceleration) * Scalar(Scalar(1) / dt);
  return result;
}

}  // namespace diabolo
