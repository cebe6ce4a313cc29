// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/player/limits.hpp"
#include "diabolo/recording/text.hpp"
#include "diabolo/robot/clearance.hpp"
#include "diabolo/robot/stick_plan.hpp"

namespace diabolo {

/// What two arms ask of a path of the tips, for TipLimits::others: both tips in the boxes of the seed grids
/// and within reach, speed, acceleration and jerk of every joint within its limits, so that check_plan()
/// plays the path as planned, and the arms apart. Looks at the path every kInterval.
class RobotLimits {
 public:
  static constexpr double kInterval = 3.0 * kTick;  ///< at most [s]

  /// `least_clearance` [m] must stay between the arms. Of the joints' limits `share` may be used up. Throws
  /// std::invalid_argument where one is out of its range.
  explicit RobotLimits(StickPlanner planner, double least_clearance = 0.10, double share = 0.97)
      : planner_(std::make_shared<const StickPlanner>(std::move(planner))),
        least_clearance_(least_clearance),
        share_(share) {
    if (!std::isfinite(least_clearance))
      throw std::invalid_argument("least_clearance: " + shown(least_clearance) + " m; must be finite");
    if (!(share > 0.0 && share <= 1.0))
      throw std::invalid_argument("share: " + shown(share) + "; must be above 0, at most 1");
  }

  /// Eleven limits: of each arm its box, reach and joints; the clearance.
  std::vector<LimitUse> operator()(const TipPath<double>& path) const {
    const Look look = looked_at(path);
    std::vector<LimitUse> uses;
    for (const bool left : {true, false}) {
      const StickMap& map = left ? planner_->left() : planner_->right();
      const std::string arm = std::string(name_of(map.arm().side)) + " arm";
      LimitUse box = least_possible(arm + "'s box, outside", 0.0, "m");
      LimitUse reach = least_possible(arm + ", time out of reach", 0.0, "s");
      reach.value = 0.0;
      for (std::size_t i = 0; i < look.times.size(); ++i) {
        const Vector3<double> tip = left ? look.tips[i].left : look.tips[i].right;
        raise(box, outside(map.grid().box(), tip), look.times[i]);
        const StickFault fault = left ? look.left[i] : look.right[i];
        if (fault != StickFault::kOutOfReach && fault != StickFault::kWindow) continue;
        if (reach.value == 0.0) reach.time = look.times[i];
        reach.value += look.interval;
      }
      box.excess = box.value;
      if (reach.value > 0.0) reach.excess = reach.value / (path.end() - path.begin());
      uses.push_back(box);
      uses.push_back(reach);
      add_joints(look, arm, left ? 0 : kJointCount, uses);
    }
    LimitUse apart = least_possible("clearance of the arms", -least_clearance_, "m");
    for (std::size_t i = 0; i < look.times.size(); ++i)
      if (look.reached(i))
        raise(apart, -clearance(planner_->left().arm(), planner_->right().arm(), look.joints[i]).distance,
              look.times[i]);
    apart.excess = apart.value - apart.limit;
    apart.value = -apart.value;
    apart.limit = -apart.limit;
    uses.push_back(apart);
    return uses;
  }

 private:
  struct Look {
    double interval;  ///< [s]
    std::vector<double> times;
    std::vector<Tips<double>> tips;
    std::vector<PairJoints> joints;
    std::vector<StickFault> left, right;
    bool reached(std::size_t i) const {
      return left[i] == StickFault::kNone && right[i] == StickFault::kNone;
    }
  };

  Look looked_at(const TipPath<double>& path) const {
    const double length = path.end() - path.begin();
    const int count = std::max(4, static_cast<int>(std::ceil(length / kInterval - 1e-9)));
    Look look{length / count, {}, {}, {}, {}, {}};
    std::size_t hint = 0;
    for (int i = 0; i <= count; ++i) {
      look.times.push_back(path.begin() + look.interval * i);
      look.tips.push_back(path.at(look.times.back(), hint));
      const StickMap::Point left = planner_->left().at(look.tips.back().left),
                            right = planner_->right().at(look.tips.back().right);
      PairJoints joints;
      joints << left.joints, right.joints;
      look.joints.push_back(joints);
      look.left.push_back(left.fault);
      look.right.push_back(right.fault);
    }
    return look;
  }

  /// Speed, acceleration and jerk by differences, each of the joint that is nearest to its limit.
  void add_joints(const Look& look, const std::string& arm, int first, std::vector<LimitUse>& uses) const {
    const JointLimits& limits = planner_->limits();
    const std::array<std::pair<const char*, const char*>, 3> kinds{
        {{" joints' speed", "rad/s"}, {" joints' acceleration", "rad/s^2"}, {" joints' jerk", "rad/s^3"}}};
    const std::array<const std::array<double, kJointCount>*, 3> most{&limits.speed, &limits.acceleration,
                                                                     &limits.jerk};
    std::vector<PairJoints> differences = look.joints;
    for (std::size_t order = 0; order < 3; ++order) {
      for (std::size_t i = 0; i + 1 < differences.size(); ++i)
        differences[i] = (differences[i + 1] - differences[i]) / look.interval;
      differences.pop_back();
      LimitUse use = least_possible(arm + kinds[order].first, 0.0, kinds[order].second);
      use.excess = -1.0;
      for (std::size_t i = 0; i < differences.size(); ++i) {
        bool reached = true;
        for (std::size_t k = i; k <= i + order + 1; ++k) reached = reached && look.reached(k);
        if (!reached) continue;
        for (int k = 0; k < kJointCount; ++k) {
          const double limit = share_ * (*most[order])[static_cast<std::size_t>(k)],
                       value = std::abs(differences[i][first + k]);
          if (value / limit - 1.0 < use.excess) continue;
          use.value = value;
          use.limit = limit;
          use.excess = value / limit - 1.0;
          use.time = look.times[i] + 0.5 * static_cast<double>(order + 1) * look.interval;
        }
      }
      uses.push_back(use);
    }
  }

  static LimitUse least_possible(std::string name, double limit, const char* unit) {
    return {std::move(name), -TipLimits::kNone, limit, unit, 0.0, -1.0};
  }
  static void raise(LimitUse& use, double value, double time) {
    if (value > use.value) use.value = value, use.time = time;
  }
  /// How far a point is outside a box [m]; inside, less than zero.
  static double outside(const GridBox& box, const Vector3<double>& point) {
    return std::max((box.lower - point).maxCoeff(), (point - box.upper).maxCoeff());
  }

  std::shared_ptr<const StickPlanner> planner_;
  double least_clearance_, share_;
};

}  // namespace diabolo
