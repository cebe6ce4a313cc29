// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/robot/arm/ease_posture.hpp"
#include "diabolo/robot/arm/stick_map.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// The box that the paper's arm plays in, by the authors' table: over the height, in front of its base, and
/// 5 cm farther towards the other arm than away from it.
inline GridBox paper_box(const StickArm& arm) {
  const Vector3<double> base = arm.base.position;
  const double left_end = arm.side == Side::kRight ? 0.475 : 0.425;
  GridBox box;
  box.lower = {base.x() + 0.425, base.y() + left_end - 0.9, arm.level - 0.5};
  box.upper = {base.x() + 0.775, base.y() + left_end, arm.level + 0.5};
  return box;
}

/// What a grid's postures cost: the elbow stays bent, so that no joint must race near the edge of reach.
inline constexpr PostureCost kGridCost{1.0, 0.2, 1.0, 3.0, 0.8};

/// Makes a seed grid: from the box's middle outwards, each key point from its neighbour's joints, the posture
/// as near to the arm's goal as reach allows. The same arm and box give the same grid. Throws
/// std::invalid_argument that names the arm and the point which cannot be reached, at a key point or between.
class SeedGridBuilder {
 public:
  static constexpr std::size_t kMostKnots = 50000;  ///< the paper's grid has 294

  SeedGridBuilder(const StickArm& arm, const GridBox& box, const PostureCost& cost = kGridCost)
      : arm_(arm), box_(box), cost_(cost) {}

  IkSeedGrid build() const {
    const std::array<int, 3>& n = box_.knots;
    for (const int count : n)
      if (count < 2 || count > 1000)
        throw std::invalid_argument("grid: " + std::to_string(count) +
                                    " key points; must be within [2, 1000]");
    if (box_.size() > kMostKnots)
      throw std::invalid_argument("grid: " + std::to_string(box_.size()) + " key points; expected " +
                                  std::to_string(kMostKnots) + " at most");
    std::vector<Joints<double>> joints(box_.size());
    std::vector<bool> known(box_.size());
    std::deque<std::array<int, 3>> front{{n[0] / 2, n[1] / 2, n[2] / 2}};
    const auto place = [&](const std::array<int, 3>& knot) { return box_.place(knot[0], knot[1], knot[2]); };
    joints[place(front.front())] = eased(box_.knot(n[0] / 2, n[1] / 2, n[2] / 2), std::nullopt);
    known[place(front.front())] = true;
    for (; !front.empty(); front.pop_front()) {
      const std::array<int, 3> from = front.front();
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          std::array<int, 3> to = from;
          to[axis] += step;
          if (to[axis] < 0 || to[axis] >= n[axis] || known[place(to)]) continue;
          known[place(to)] = true;
          joints[place(to)] = eased(box_.knot(to[0], to[1], to[2]), joints[place(from)]);
          front.push_back(to);
        }
    }
    IkSeedGrid grid(box_, std::move(joints));
    check_between(StickMap(arm_, grid));
    return grid;
  }

 private:
  [[noreturn]] void fail(const Vector3<double>& point, const std::string& why) const {
    throw std::invalid_argument(std::string("grid of the ") + name_of(arm_.side) + " arm: (" +
                                shown(point.x()) + ", " + shown(point.y()) + ", " + shown(point.z()) +
                                ") m: " + why);
  }

  /// From the joints of a neighbour, or from the closed form in the arm's ranges.
  Joints<double> eased(const Vector3<double>& point, std::optional<Joints<double>> seed) const {
    const Vector3<double> target = arm_.to_base(point);
    if (!seed) {
      Joints<double> middle;
      for (int i = 0; i < kJointCount; ++i) {
        const std::size_t k = static_cast<std::size_t>(i);
        middle[i] = 0.5 * (arm_.ranges.lower[k] + arm_.ranges.upper[k]);
      }
      for (StickSolution<double> solution : stick_inverse(target, arm_.tip, arm_.goal(point), arm_.lengths))
        if (!seed && unwrap(solution.joints, middle, arm_.ranges)) seed = solution.joints;
      if (!seed) fail(point, "the posture does not reach it within the joint ranges");
      // The pitch must be the goal's own turn, not one a whole turn off.
      (*seed)[3] = arm_.goal(point).pitch - (*seed)[1] - (*seed)[2];
    }
    const Refined<double> eased = ease_posture(arm_.chain, target, arm_.tip, arm_.goal(point), *seed, cost_);
    if (!eased.converged) fail(point, "out of reach");
    if (!arm_.ranges.contain(eased.joints)) fail(point, "a joint leaves its range");
    return eased.joints;
  }

  /// Looks four times as finely as the key points lie.
  void check_between(const StickMap& map) const {
    constexpr int kFiner = 4;
    GridBox fine = box_;
    for (int& count : fine.knots) count = (count - 1) * kFiner + 1;
    for (int x = 0; x < fine.knots[0]; ++x)
      for (int y = 0; y < fine.knots[1]; ++y)
        for (int z = 0; z < fine.knots[2]; ++z) {
          const StickFault fault = map.at(fine.knot(x, y, z)).fault;
          if (fault != StickFault::kNone) fail(fine.knot(x, y, z), text_of(fault));
        }
  }

  StickArm arm_;
  GridBox box_;
  PostureCost cost_;
};

inline IkSeedGrid build_seed_grid(const StickArm& arm, const GridBox& box,
                                  const PostureCost& cost = kGridCost) {
  return SeedGridBuilder(arm, box, cost).build();
}

}  // namespace diabolo
