// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/plan/limits.hpp"
#include "diabolo/robot/arm/clearance.hpp"
#include "diabolo/robot/motion/stick_plan.hpp"
#include "diabolo/text/shown.hpp"

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

  const StickPlanner& planner() const { return *planner_; }
  double least_clearance() const { return least_clearance_; }  ///< [m]
  double share() const { return share_; }

  /// Eleven limits: of each arm its box, reach and joints; the clearance.
  std::vector<LimitUse> operator()(const TipPath<double>& path) const {
    const Ticks ticks(path, ticks_of(path));
    std::vector<Look> looks;
    for (std::size_t i = 0; i <= ticks.count; ++i) looks.push_back(look(path, ticks.at(i)));
    std::vector<LimitUse> uses = named(path);
    for (std::size_t k = 0; k < uses.size(); ++k) {
      const Kind kind = kind_of(k);
      double out_of_reach = 0.0;
      for (std::size_t i = 0; i + width(kind) <= looks.size(); ++i) {
        const Value found = value(k, &looks[i], ticks.interval);
        if (kind == Kind::kReach) {
          if (found.excess == kUnseen) continue;
          if (out_of_reach == 0.0) uses[k].time = ticks.at(i);
          out_of_reach += ticks.interval;
        } else if (found.excess > uses[k].excess) {
          put(found, ticks, i, kind, uses[k]);
        }
      }
      if (out_of_reach > 0.0)
        uses[k].value = out_of_reach, uses[k].excess = out_of_reach / (path.end() - path.begin());
      if (uses[k].excess == kUnseen) uses[k].excess = -1.0;
    }
    return uses;
  }

  /// The same of a path with another one beside it, of which `uses` are, each looked at where those say that
  /// it is reached; the time out of reach stays as it is.
  std::vector<LimitUse> near(const TipPath<double>& path, const TipPath<double>& beside,
                             std::vector<LimitUse> uses) const {
    const Ticks was(beside, ticks_of(beside)), ticks(path, was.count);
    for (std::size_t k = 0; k < uses.size(); ++k) {
      const Kind kind = kind_of(k);
      if (kind == Kind::kReach) continue;
      const double place = (uses[k].time - was.begin) / was.interval - 0.5 * double_of(width(kind) - 1);
      const auto i = static_cast<std::size_t>(
          std::clamp(std::round(place), 0.0, double_of(ticks.count + 1 - width(kind))));
      std::array<Look, 4> looks;
      for (std::size_t n = 0; n < width(kind); ++n) looks[n] = look(path, ticks.at(i + n));
      const Value found = value(k, looks.data(), ticks.interval);
      if (found.excess != kUnseen) put(found, ticks, i, kind, uses[k]);
    }
    return uses;
  }

 private:
  enum class Kind { kBox, kReach, kSpeed, kAcceleration, kJerk, kClearance };
  static constexpr std::size_t kPerArm = 5;

  /// The limit number `k`: five of the left arm, five of the right one, and the clearance.
  static Kind kind_of(std::size_t k) {
    return k == 2 * kPerArm ? Kind::kClearance : static_cast<Kind>(k % kPerArm);
  }
  /// Instants that it takes to see how much is used up of a limit: a derivative takes its order more than
  /// one.
  static std::size_t width(Kind kind) {
    return kind == Kind::kSpeed ? 2 : kind == Kind::kAcceleration ? 3 : kind == Kind::kJerk ? 4 : 1;
  }
  static double double_of(std::size_t n) { return static_cast<double>(n); }

  struct Ticks {
    double begin, interval;  ///< [s]
    std::size_t count;       ///< of intervals
    Ticks(const TipPath<double>& path, std::size_t count_of)
        : begin(path.begin()), interval((path.end() - begin) / double_of(count_of)), count(count_of) {}
    double at(std::size_t i) const { return begin + interval * double_of(i); }
  };

  static std::size_t ticks_of(const TipPath<double>& path) {
    const double length = path.end() - path.begin();
    return std::max<std::size_t>(4, static_cast<std::size_t>(std::ceil(length / kInterval - 1e-9)));
  }

  /// Both arms at an instant.
  struct Look {
    Tips<double> tips;
    PairJoints joints;
    StickFault left, right;
    bool reached() const { return left == StickFault::kNone && right == StickFault::kNone; }
  };

  Look look(const TipPath<double>& path, double time) const {
    Look result;
    result.tips = path.at(time);
    const StickMap::Point left = planner_->left().at(result.tips.left),
                          right = planner_->right().at(result.tips.right);
    result.joints << left.joints, right.joints;
    result.left = left.fault;
    result.right = right.fault;
    return result;
  }

  static constexpr double kUnseen = -std::numeric_limits<double>::infinity();
  struct Value {
    double value = 0.0, limit = 0.0, excess = kUnseen;
  };

  /// How much of a limit is used up at the instants from `at` on; kUnseen where it cannot be told.
  Value value(std::size_t k, const Look* at, double interval) const {
    const bool left = k < kPerArm;
    switch (const Kind kind = kind_of(k)) {
      case Kind::kBox: {
        const GridBox& box = (left ? planner_->left() : planner_->right()).grid().box();
        const Vector3<double> tip = left ? at->tips.left : at->tips.right;
        const double outside = std::max((box.lower - tip).maxCoeff(), (tip - box.upper).maxCoeff());
        return {outside, 0.0, outside};
      }
      case Kind::kReach: {
        const StickFault fault = left ? at->left : at->right;
        const bool out = fault == StickFault::kOutOfReach || fault == StickFault::kRange;
        return out ? Value{0.0, 0.0, 1.0} : Value{};
      }
      case Kind::kClearance: {
        if (!at->reached()) return {};
        const double apart = clearance(planner_->left().arm(), planner_->right().arm(), at->joints).distance;
        return {apart, least_clearance_, least_clearance_ - apart};
      }
      default:
        return joints_value(kind, left ? 0 : kJointCount, at, interval);
    }
  }

  /// Speed, acceleration or jerk by differences, of the joint that is nearest to its limit.
  Value joints_value(Kind kind, int first, const Look* at, double interval) const {
    const JointLimits& limits = planner_->limits();
    for (std::size_t n = 0; n < width(kind); ++n)
      if (!at[n].reached()) return {};
    Joints<double> rate;
    const auto joints = [&](int n) { return at[n].joints.segment<kJointCount>(first); };
    if (kind == Kind::kSpeed) rate = (joints(1) - joints(0)) / interval;
    if (kind == Kind::kAcceleration) rate = (joints(2) - 2.0 * joints(1) + joints(0)) / (interval * interval);
    if (kind == Kind::kJerk)
      rate = (joints(3) - joints(0) - 3.0 * (joints(2) - joints(1))) / (interval * interval * interval);
    const auto& most = kind == Kind::kSpeed          ? limits.speed
                       : kind == Kind::kAcceleration ? limits.acceleration
                                                     : limits.jerk;
    Value result;
    for (int i = 0; i < kJointCount; ++i) {
      const double limit = share_ * most[static_cast<std::size_t>(i)], size = std::abs(rate[i]);
      if (size / limit - 1.0 >= result.excess) result = {size, limit, size / limit - 1.0};
    }
    return result;
  }

  static void put(const Value& found, const Ticks& ticks, std::size_t i, Kind kind, LimitUse& use) {
    use.value = found.value;
    use.limit = found.limit;
    use.excess = found.excess;
    use.time = ticks.at(i) + 0.5 * double_of(width(kind) - 1) * ticks.interval;
  }

  /// Nothing used up yet.
  std::vector<LimitUse> named(const TipPath<double>& path) const {
    std::vector<LimitUse> uses;
    for (const StickMap* map : {&planner_->left(), &planner_->right()}) {
      const std::string arm = std::string(name_of(map->arm().side)) + " arm";
      for (const auto& [what, unit] : {std::pair{"'s box, outside", "m"},
                                       {", time out of reach", "s"},
                                       {" joints' speed", "rad/s"},
                                       {" joints' acceleration", "rad/s^2"},
                                       {" joints' jerk", "rad/s^3"}})
        uses.push_back({arm + what, 0.0, 0.0, unit, path.begin(), kUnseen});
    }
    uses.push_back({"clearance of the arms", 0.0, least_clearance_, "m", path.begin(), kUnseen});
    return uses;
  }

  std::shared_ptr<const StickPlanner> planner_;
  double least_clearance_, share_;
};

}  // namespace diabolo
