// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "diabolo/robot/arm/arm_plane.hpp"
#include "diabolo/robot/arm/ur5e.hpp"

namespace diabolo {

/// Below this sine of q5, rounding alone would decide on q6.
template <class Scalar>
inline constexpr double kWristFree = sizeof(ValueOf<Scalar>) >= sizeof(double) ? 1e-9 : 1e-5;

/// One way to reach a pose.
template <class Scalar>
struct InverseSolution {
  Joints<Scalar> joints;           ///< [rad], each but q2 and q4 within (-pi, pi]
  int branch = 0;                  ///< 4 * shoulder + 2 * wrist + elbow, each 0 or 1: the signs of the roots
  bool shoulder_singular = false;  ///< the wrist stands above the base: q1 is lost
  bool wrist_singular = false;     ///< q4 and q6 turn about parallel axes: q6 was chosen
  bool elbow_singular = false;     ///< the arm is stretched out or folded
};

/// All ways to reach a pose, at most eight.
template <class Scalar>
struct InverseSolutions {
  std::array<InverseSolution<Scalar>, 8> all;
  int count = 0;  ///< zero: out of reach, or `fault`
  PoseFault fault = PoseFault::kNone;

  const InverseSolution<Scalar>* begin() const { return all.data(); }
  const InverseSolution<Scalar>* end() const { return all.data() + count; }
};

/// Every joint vector whose flange has the given pose (frame of the base) on an arm of those lengths. Where
/// the wrist is singular q6 is `q6_when_free`, or where the elbow does not reach so what brings it nearest to
/// the shoulder, or farthest. Never throws and gives no NaN: see `count` and `fault`. A larger `slack` (see
/// reach_tolerance) adds what almost reaches: seeds for refine_pose.
template <class Scalar>
InverseSolutions<Scalar> inverse(const Pose<Scalar>& flange, const Scalar& q6_when_free = Scalar(0),
                                 const Ur5eLengths& lengths = {}, double slack = reach_tolerance<Scalar>()) {
  using std::atan2;
  using std::cos;
  using std::sin;
  InverseSolutions<Scalar> result;
  result.fault = check_pose(flange);
  if (result.fault != PoseFault::kNone || !is_finite(q6_when_free)) return result;
  const Vector3<Scalar> x6 = flange.rotation.col(0), y6 = flange.rotation.col(1), z6 = flange.rotation.col(2);
  const Vector3<Scalar> wrist = flange.position - z6 * Scalar(lengths.d6);
  const std::optional<ShoulderTurns<Scalar>> shoulders =
      turn_shoulder<Scalar>(wrist.x(), wrist.y(), Scalar(lengths.d4), slack);
  if (!shoulders) return result;
  for (int shoulder = 0; shoulder < 2; ++shoulder) {
    const Scalar q1 = shoulders->turn[static_cast<std::size_t>(shoulder)];
    const Scalar c1 = cos(q1),
                 s1 = sin(q1);  // e_r = (c1, s1, 0) lies in the arm's plane, e_n = (s1, -c1, 0) across
    const Scalar a = x6.x() * s1 - x6.y() * c1, b = y6.y() * c1 - y6.x() * s1;  // c6 s5 and s6 s5
    const Scalar c5 = z6.x() * s1 - z6.y() * c1;
    const Scalar sine5 = positive_sqrt<Scalar>(a * a + b * b);
    const bool free6 = plain(sine5) < kWristFree<Scalar>;
    for (int turned = 0; turned < 2; ++turned) {
      const Scalar sign(turned == 0 ? 1 : -1);
      const Scalar s5 = sign * sine5;
      Scalar q6, pitch;  // pitch: q2 + q3 + q4
      std::optional<TwoLinks<Scalar>> links;
      const auto turn = [&](const Scalar& to) {
        q6 = to;
        const Scalar c6 = cos(q6), s6 = sin(q6);
        const Vector3<Scalar> x5 = x6 * c6 - y6 * s6, z4 = x6 * Scalar(-s6) - y6 * c6;
        const Vector3<Scalar> x4 = x5 * c5 - z6 * s5, elbow_to = wrist - z4 * Scalar(lengths.d5);
        pitch = atan2(x4.z(), x4.x() * c1 + x4.y() * s1);
        links = reach_with_two_links<Scalar>(lengths.a2, lengths.a3, elbow_to.x() * c1 + elbow_to.y() * s1,
                                             elbow_to.z() - Scalar(lengths.d1), slack);
      };
      turn(free6 ? q6_when_free : atan2(sign * b, sign * a));
      if (free6 && !links) {  // z4 along the way from the shoulder to the wrist, or against it
        const Vector3<Scalar> way = wrist - Vector3<Scalar>(Scalar(0), Scalar(0), Scalar(lengths.d1));
        const Scalar x = dot<Scalar>(x6, way), y = dot<Scalar>(y6, way);
        turn(atan2(-x, -y));
        if (!links) turn(atan2(x, y));
      }
      if (!links) continue;
      for (int elbow = 0; elbow < 2; ++elbow) {
        const std::size_t e = static_cast<std::size_t>(elbow);
        InverseSolution<Scalar>& solution = result.all[static_cast<std::size_t>(result.count++)];
        solution.joints << q1, links->lift[e], links->bend[e], pitch - links->lift[e] - links->bend[e],
            atan2(s5, c5), q6;
        solution.branch = 4 * shoulder + 2 * turned + elbow;
        solution.shoulder_singular = plain(absolute(shoulders->along[0])) < kSingular;
        solution.wrist_singular = plain(sine5) < kSingular;
        solution.elbow_singular = plain(links->sine_of_bend) < kSingular;
      }
    }
  }
  return result;
}

/// Of the solutions, each turned into the ranges, the one whose largest joint difference from the seed is
/// smallest; nothing where none lies within.
template <class Scalar>
std::optional<InverseSolution<Scalar>> nearest_solution(const InverseSolutions<Scalar>& solutions,
                                                        const Joints<Scalar>& seed,
                                                        const JointRanges& ranges = kUr5eRanges) {
  std::optional<InverseSolution<Scalar>> best;
  double smallest = std::numeric_limits<double>::infinity();
  for (InverseSolution<Scalar> solution : solutions) {
    if (!unwrap(solution.joints, seed, ranges)) continue;
    double largest = 0;
    for (int i = 0; i < kJointCount; ++i)
      largest = std::max(largest, std::abs(plain(solution.joints[i]) - plain(seed[i])));
    if (!(largest < smallest)) continue;
    smallest = largest;
    best = solution;
  }
  return best;
}

}  // namespace diabolo
