// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/parameters.hpp"
#include "diabolo/string/spheroid.hpp"

namespace diabolo {

/// The cap of the pull velocity (the paper's min of v_pull and v_ellipse_origin + v_ellipse_edge), as a speed
/// along the inward normal: the speed of the spheroid's centre if it moves inwards, plus the speed at which
/// the semi-minor axis shrinks [m/s]. `normal` points outwards.
template <class Scalar>
Scalar pull_cap(const Spheroid<Scalar>& before, const Spheroid<Scalar>& after, const Vector3<Scalar>& normal,
                const Scalar& dt) {
  const Vector3<Scalar> origin_shift = after.center() - before.center();
  const Mask<Scalar> inwards = dot<Scalar>(origin_shift, normal) < Scalar(0);
  const Scalar origin = select(inwards, norm<Scalar>(origin_shift), Scalar(0));
  const Scalar edge = maximum(Scalar(before.semi_minor() - after.semi_minor()), Scalar(0));
  return (origin + edge) / dt;
}

/// Part of the displacement that put the diabolo back on the spheroid, as a velocity along the inward normal
/// and no longer than the cap; zero if it would push outwards. `displacement` [m] leads from the extrapolated
/// position to the new one; `normal` is the outward normal at the new position, `cap` the capping velocity
/// [m/s].
template <class Scalar>
Vector3<Scalar> capped_pull(const Vector3<Scalar>& displacement, const Vector3<Scalar>& normal,
                            const Vector3<Scalar>& cap, const Scalar& dt, const Scalar& pull_scale) {
  const Scalar inward = maximum(Scalar(-dot<Scalar>(displacement, normal) / dt * pull_scale), Scalar(0));
  const Mask<Scalar> capped = inward * inward > squared_norm(cap);
  return select<Scalar>(capped, cap, normal * Scalar(-inward));
}

/// Sharp spheroids (tips nearly a string length apart), the paper's rule: the pull acts only along the normal
/// of the plane through the tips that contains the world's x axis.
template <class Scalar>
Vector3<Scalar> pull_across_plane(const Vector3<Scalar>& pull, const Vector3<Scalar>& left,
                                  const Vector3<Scalar>& right) {
  const Vector3<Scalar> span = left - right;
  const Vector3<Scalar> across(Scalar(0), Scalar(-span.z()), span.y());  // x_world cross span
  return across * Scalar(dot<Scalar>(pull, across) / (squared_norm(across) + tiny<Scalar>()));
}

/// The published program's rule instead: the pull loses its component along (left - right) x z_world and
/// keeps its magnitude.
template <class Scalar>
Vector3<Scalar> pull_in_vertical_plane(const Vector3<Scalar>& pull, const Vector3<Scalar>& left,
                                       const Vector3<Scalar>& right) {
  const Vector3<Scalar> span = left - right;
  const Vector3<Scalar> sideways(span.y(), Scalar(-span.x()), Scalar(0));  // span cross z_world
  const Vector3<Scalar> kept =
      pull - sideways * Scalar(dot<Scalar>(pull, sideways) / (squared_norm(sideways) + tiny<Scalar>()));
  return kept * (norm<Scalar>(pull) / norm<Scalar>(kept));
}

}  // namespace diabolo
