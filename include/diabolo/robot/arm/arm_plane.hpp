// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "diabolo/robot/arm/joints.hpp"

namespace diabolo {

/// Closer than this to a singularity, a solution says so: of the sines of q5 and q3, and [m] of the distance
/// between the wrist and the plane through the base axis that the arm would have to turn through.
inline constexpr double kSingular = 1e-6;

/// How far beyond its reach, relatively, an arm still counts as stretched out: rounding. With a larger slack
/// the solutions near the edge are starting points for an arm that is a little different.
template <class Scalar>
constexpr double reach_tolerance() {
  return sizeof(ValueOf<Scalar>) >= sizeof(double) ? 1e-9 : 1e-5;
}

/// Angles of a two-link arm in a plane, for a target [m] in the frame of its first joint: `bend` of the
/// second joint and `lift` of the first, for the positive bend and, after it, for the negative one.
template <class Scalar>
struct TwoLinks {
  std::array<Scalar, 2> lift, bend;
  Scalar sine_of_bend;  ///< of the positive one
};

/// Nothing where the target is out of reach by more than `slack` of the cosine; within that, the bend of a
/// target as far inside. After K. P. Hawkins, "Analytic inverse kinematics for the
/// Universal Robots UR-5/UR-10 arms" (2013), with atan2 in the place of every arc cosine.
template <class Scalar>
std::optional<TwoLinks<Scalar>> reach_with_two_links(double first, double second, const Scalar& x,
                                                     const Scalar& y,
                                                     double slack = reach_tolerance<Scalar>()) {
  using std::atan2;
  Scalar cosine = (x * x + y * y - Scalar(first * first + second * second)) / Scalar(2 * first * second);
  const double beyond = std::abs(plain(cosine)) - 1.0;
  if (!(beyond <= slack)) return std::nullopt;
  if (beyond > 0) cosine = Scalar(plain(cosine) > 0 ? 2 : -2) - cosine;
  const Scalar sine = positive_sqrt<Scalar>((Scalar(1) - cosine) * (Scalar(1) + cosine));
  const Scalar direction = atan2(y, x), along = Scalar(first) + Scalar(second) * cosine;
  TwoLinks<Scalar> result;
  result.sine_of_bend = sine;
  for (std::size_t elbow = 0; elbow < 2; ++elbow) {
    const Scalar signed_sine = elbow == 0 ? sine : Scalar(-sine);
    result.bend[elbow] = atan2(signed_sine, cosine);
    result.lift[elbow] = direction - atan2(Scalar(second) * signed_sine, along);
  }
  return result;
}

/// Turns of the first joint [rad] that bring a point [m, base frame] into the plane at the distance `d4`
/// beside the arm; `along` is the point's distance from the base axis in that plane, for the positive one
/// and, after it, for the negative one.
template <class Scalar>
struct ShoulderTurns {
  std::array<Scalar, 2> turn, along;
};

/// Nothing where the point is nearer to the base axis than the plane by more than `slack` of its square.
template <class Scalar>
std::optional<ShoulderTurns<Scalar>> turn_shoulder(const Scalar& x, const Scalar& y, const Scalar& beside,
                                                   double slack = reach_tolerance<Scalar>()) {
  using std::atan2;
  const Scalar square = x * x + y * y - beside * beside;
  const double scale = plain(beside) * plain(beside);
  if (!(plain(square) >= -slack * scale)) return std::nullopt;
  const Scalar along = positive_sqrt<Scalar>(absolute(square));
  ShoulderTurns<Scalar> result;
  for (std::size_t shoulder = 0; shoulder < 2; ++shoulder) {
    const Scalar signed_along = shoulder == 0 ? along : Scalar(-along);
    result.along[shoulder] = signed_along;
    result.turn[shoulder] = atan2(signed_along * y + beside * x, signed_along * x - beside * y);
  }
  return result;
}

}  // namespace diabolo
