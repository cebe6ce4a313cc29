// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/robot/motion/stick_plan.hpp"

namespace diabolo {

/// A plan made ready for the loop: made beside it, since that takes memory and time.
class LoadedPlan {
 public:
  /// Throws std::invalid_argument where the plan is none, or a setpoint is not finite.
  explicit LoadedPlan(const StickPlan& plan)
      : before_(plan.before.empty() ? 0 : plan.before.size() - 1), path_(points(plan)) {}

  /// Of a time in ticks since the plan's first setpoint [rad]; from the last one on the arms rest.
  PairJoints at(double ticks) const { return path_.at((static_cast<double>(before_) + ticks) * kTick); }

 private:
  static std::vector<PairJoints> points(const StickPlan& plan) {
    if (!plan.ok() || plan.setpoints.empty())
      throw std::invalid_argument("plan: there is none; see StickPlan::fault");
    std::vector<PairJoints> all = plan.before;
    if (!all.empty()) all.pop_back();  // it is the first setpoint
    all.insert(all.end(), plan.setpoints.begin(), plan.setpoints.end());
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!all[i].allFinite())
        throw std::invalid_argument("plan, setpoint " + std::to_string(i) + ": an angle is not finite");
    while (all.size() < 4) all.push_back(all.back());
    return all;
  }

  std::size_t before_;
  JointPath path_;
};

}  // namespace diabolo
