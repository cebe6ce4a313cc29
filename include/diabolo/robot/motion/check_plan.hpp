// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/robot/arm/clearance.hpp"
#include "diabolo/robot/motion/stick_plan.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A stretch of a plan that cannot be played.
struct PlanTrouble {
  double from = 0, to = 0;                        ///< [s] of the motion's own time
  std::string who;                                ///< "left arm", "right arm", "both arms"
  std::string why;                                ///< one clause
  Vector3<double> tip = Vector3<double>::Zero();  ///< the first place [m, world]; of both arms the left one's
};

/// Whether two arms can play a motion of the tips, from rest to rest.
struct PlanCheck {
  std::vector<PlanTrouble> troubles;  ///< none: it can be played
  double as_planned = 0;              ///< [s], with the time to start and to stop
  double as_played = 0;               ///< [s] within the joints' limits; zero where a tip is not reached
  double worst_factor = 1;            ///< how many times slower it is played where it is slowest
  double worst_at = 0;                ///< [s] of the motion's own time, about
  double least_clearance = 0;         ///< [m] between the arms, sticks included
  std::string nearest_parts;          ///< "stick and stick"
  bool playable() const { return troubles.empty(); }
};

/// Looks at every tick of the motion. `least_clearance` [m] is what must stay between the arms. Throws
/// std::invalid_argument where that is not finite, or the motion is too short to start and stop in, or too
/// long.
inline PlanCheck check_plan(const StickPlanner& planner, const TipMotion<double>& motion,
                            double least_clearance = 0.10) {
  if (!std::isfinite(least_clearance))
    throw std::invalid_argument("least_clearance: " + shown(least_clearance) + " m; must be finite");
  check_duration(motion);
  PlanCheck check;
  const auto trouble = [&check](double time, const std::string& who, const std::string& why,
                                const Vector3<double>& tip) {
    for (PlanTrouble& known : check.troubles)
      if (known.who == who && known.why == why && time - known.to < 1.5 * kTick) {
        known.to = time;
        return;
      }
    check.troubles.push_back({time, time, who, why, tip});
  };
  std::size_t hint = 0;
  const long ticks = std::lround(std::ceil((motion.end() - motion.begin()) / kTick));
  for (long i = 0; i <= ticks; ++i) {
    const double time = std::min(motion.begin() + static_cast<double>(i) * kTick, motion.end());
    const Tips<double> tips = motion.at(time, hint);
    for (const auto& [map, tip] :
         {std::pair{&planner.left(), &tips.left}, std::pair{&planner.right(), &tips.right}}) {
      const StickFault fault = map->at(*tip).fault;
      if (fault != StickFault::kNone)
        trouble(time, std::string(name_of(map->arm().side)) + " arm", text_of(fault), *tip);
    }
  }
  if (!check.playable()) return check;
  const StickPlan plan = planner.start(motion);
  check.as_planned = plan.as_planned;
  check.as_played = plan.as_played;
  check.worst_factor = plan.worst_factor;
  const double rest = planner.options().rest;
  const RestClock clock{motion.begin(), motion.end(), rest, rest};
  check.worst_at = clock.at(plan.worst_at);
  const double at = clock.at(plan.at);
  if (plan.fault == PlanFault::kLimits)
    trouble(at, "both arms", "the limits of the joints ask for too slow a play", motion.at(at).left);
  if (plan.fault == PlanFault::kTip) {  // between the ticks above, where it starts up or comes to rest
    const Tips<double> tips = motion.at(at);
    trouble(at, std::string(name_of(plan.side)) + " arm", text_of(plan.tip_fault),
            plan.side == Side::kLeft ? tips.left : tips.right);
  }
  if (plan.setpoints.empty()) return check;
  const StickArm &left = planner.left().arm(), &right = planner.right().arm();
  check.least_clearance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < plan.setpoints.size(); ++i) {
    const Clearance found = clearance(left, right, plan.setpoints[i]);
    if (found.distance < check.least_clearance) {
      check.least_clearance = found.distance;
      check.nearest_parts = std::string(kArmParts[found.left]) + " and " + kArmParts[found.right];
    }
    // Ticks of play are told in the motion's time, in proportion: near enough to find the place.
    if (found.distance < least_clearance)
      trouble(motion.begin() + (motion.end() - motion.begin()) * static_cast<double>(i) /
                                   static_cast<double>(plan.setpoints.size()),
              "both arms", "they come too close to each other",
              left.tip_at(plan.setpoints[i].head<kJointCount>()));
  }
  return check;
}

}  // namespace diabolo
