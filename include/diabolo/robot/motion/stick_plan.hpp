// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/robot/arm/stick_map.hpp"
#include "diabolo/robot/motion/keep_limits.hpp"
#include "diabolo/robot/motion/tip_ticks.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Why there is no plan.
enum class PlanFault {
  kNone,
  kTip,     ///< an arm cannot bring its tip there: see `side`, `tip_fault` and `at`
  kLimits,  ///< no stretch or blend that is allowed keeps the joints' limits
};

/// Setpoints of both arms, one tick apart, that end at rest.
struct StickPlan {
  std::vector<PairJoints> setpoints;  ///< [rad]; the first is where the plan joins what ran before
  std::vector<PairJoints> before;     ///< the setpoints up to the first one, oldest first
  double as_planned = 0;              ///< [s] that the player's motion takes
  double as_played = 0;               ///< [s] that the arms take for it
  double worst_factor = 1;            ///< how many times slower than planned it runs where it is slowest
  double worst_at = 0;                ///< [s] of planned time since the first setpoint
  PlanFault fault = PlanFault::kNone;
  Side side = Side::kLeft;                   ///< of a tip that is not reached
  StickFault tip_fault = StickFault::kNone;  ///< why
  double at = 0;                             ///< [s] since the first setpoint: when

  /// Of a tick since the first setpoint; from the last one on the arms rest.
  const PairJoints& setpoint(std::size_t tick) const {
    return setpoints[std::min(tick, setpoints.size() - 1)];
  }
  bool ok() const { return fault == PlanFault::kNone; }
};

/// How motions are joined.
struct BlendOptions {
  double lead = 0.08;       ///< [s] for the clock to slow down in before the blend begins
  double blend = 0.2;       ///< [s] that the tips take from the old motion to the new one, at first try
  double rest = 0.2;        ///< [s] in which a motion comes to rest at its end, or starts
  int tries = 4;            ///< each with twice the blend before
  double most_factor = 20;  ///< slower than that is not playing
};

/// Turns motions of the stick tips into joint motions of the two arms within the limits.
class StickPlanner {
 public:
  /// Throws std::invalid_argument where a limit is not above zero.
  StickPlanner(StickMap left, StickMap right, const JointLimits& limits, const BlendOptions& options = {})
      : left_(std::move(left)), right_(std::move(right)), limits_(limits), options_(options) {
    check_limits(limits_);
    for (const auto& [name, value] :
         {std::pair{"lead", options.lead}, std::pair{"blend", options.blend}, std::pair{"rest", options.rest},
          std::pair{"most_factor", options.most_factor}})
      if (!(value > 0) || !std::isfinite(value))
        throw std::invalid_argument(std::string(name) + ": " + shown(value) + "; must be finite and > 0");
  }

  const StickMap& left() const { return left_; }
  const StickMap& right() const { return right_; }
  const JointLimits& limits() const { return limits_; }
  const BlendOptions& options() const { return options_; }

  /// A motion played from rest at its first pose to rest at its last. Throws std::invalid_argument as
  /// tips_to_rest() does.
  StickPlan start(const TipMotion<double>& motion) const {
    const std::vector<TipPair> tips = tips_to_rest(motion, motion.begin(), options_.rest, true);
    StickPlan plan;
    std::vector<PairJoints> points(tips.size());
    for (std::size_t i = 0; i < tips.size(); ++i)
      if (!solve(tips[i], i, points[i], plan)) return plan;
    while (points.size() < 4) points.push_back(points.back());
    limit(JointPath(std::move(points)), 0, plan);
    return plan;
  }

  /// A motion taken up at its time `from` [s] while `running` is at a tick: from there on the arms go over to
  /// it, tips and joints with continuous acceleration. Where that cannot be done, see the fault, and let
  /// `running` go on; it ends at rest. Throws std::invalid_argument as tips_to_rest() does.
  StickPlan replace(const StickPlan& running, std::size_t tick, const TipMotion<double>& next,
                    double from) const {
    const std::vector<TipPair> tips = tips_to_rest(next, from, options_.rest, false);
    StickPlan plan;
    double blend = options_.blend;
    for (int i = 0; i < options_.tries; ++i, blend *= 2) {
      plan = joined(running, tick, tips, blend);
      if (plan.fault != PlanFault::kLimits) break;
    }
    return plan;
  }

 private:
  static constexpr std::size_t kBefore = 16;  // setpoints; what lies farther back bends the spline no more

  bool solve(const TipPair& tips, std::size_t i, PairJoints& joints, StickPlan& plan) const {
    const StickMap::Point left = left_.at(tips.left), right = right_.at(tips.right);
    joints << left.joints, right.joints;
    if (left.fault == StickFault::kNone && right.fault == StickFault::kNone) return true;
    plan.fault = PlanFault::kTip;
    plan.side = left.fault != StickFault::kNone ? Side::kLeft : Side::kRight;
    plan.tip_fault = plan.side == Side::kLeft ? left.fault : right.fault;
    plan.at = static_cast<double>(i) * kTick;
    return false;
  }

  StickPlan joined(const StickPlan& running, std::size_t tick, const std::vector<TipPair>& tips,
                   double blend) const {
    StickPlan plan;
    plan.before.resize(kBefore);
    for (std::size_t i = 0; i < kBefore; ++i) {
      const std::size_t back = kBefore - 1 - i;
      const std::size_t older = back > tick ? back - tick : 0;  // setpoints before the running plan's first
      plan.before[i] = older == 0 ? running.setpoint(tick - back)
                       : older < running.before.size()
                           ? running.before[running.before.size() - 1 - older]
                           : (running.before.empty() ? running.setpoints : running.before).front();
    }
    std::vector<PairJoints> points = plan.before;
    const std::size_t ticks =
        std::max(tips.size(), static_cast<std::size_t>(std::ceil((options_.lead + blend) / kTick)) + 1);
    for (std::size_t i = 1; i < ticks; ++i) {
      const double share = smooth_step((static_cast<double>(i) * kTick - options_.lead) / blend);
      const TipPair& target = tips[std::min(i, tips.size() - 1)];
      PairJoints joints;
      if (share >= 1) {
        if (!solve(target, i, joints, plan)) return plan;
      } else {
        const PairJoints& old = running.setpoint(tick + i);
        const TipPair old_tips{left_.arm().tip_at(old.head<kJointCount>()),
                               right_.arm().tip_at(old.tail<kJointCount>())};
        const TipPair mixed{old_tips.left + share * (target.left - old_tips.left),
                            old_tips.right + share * (target.right - old_tips.right)};
        PairJoints mapped;
        if (!solve(mixed, i, joints, plan) || !solve(old_tips, i, mapped, plan)) return plan;
        joints += (1 - share) * (old - mapped);  // what the running setpoints' own interpolation left
      }
      points.push_back(joints);
    }
    limit(JointPath(std::move(points)), kBefore - 1, plan);
    return plan;
  }

  /// Fills the plan from a path whose first `before` points have been played.
  void limit(const JointPath& path, std::size_t before, StickPlan& plan) const {
    const double offset = static_cast<double>(before) * kTick;
    const LimitedMotion motion = keep_limits(path, limits_, offset);
    for (std::size_t tick = before; static_cast<double>(tick) * kTick < path.length(); ++tick) {
      const double planned = static_cast<double>(tick) * kTick;
      const double factor = motion.stretch.factor(planned);
      if (factor <= plan.worst_factor) continue;
      plan.worst_factor = factor;
      plan.worst_at = planned - offset;
    }
    plan.as_planned = path.length() - offset;
    plan.as_played = motion.stretch.duration() - offset;
    plan.setpoints.assign(motion.setpoints.begin() + static_cast<std::ptrdiff_t>(before),
                          motion.setpoints.end());
    if (motion.within && plan.worst_factor <= options_.most_factor) return;
    plan.fault = PlanFault::kLimits;
    plan.at = motion.excess_at - offset;
  }

  StickMap left_, right_;
  JointLimits limits_;
  BlendOptions options_;
};

}  // namespace diabolo
