// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/robot/arm/build_seed_grid.hpp"
#include "diabolo/robot/motion/stick_plan.hpp"

/// What plans for the paper's two arms on such mounts.
inline diabolo::StickPlanner planner_on(const diabolo::Mounts& mounts) {
  const auto map = [&](diabolo::Side side) {
    const diabolo::StickArm arm = diabolo::paper_arm(side, mounts);
    return diabolo::StickMap(arm, diabolo::build_seed_grid(arm, diabolo::paper_box(arm)));
  };
  return {map(diabolo::Side::kLeft), map(diabolo::Side::kRight), diabolo::JointLimits::uniform()};
}

/// That of the paper's mounts, made once.
inline const diabolo::StickPlanner& planner() {
  static const diabolo::StickPlanner made = planner_on({});
  return made;
}
