# SPDX-License-Identifier: MIT
"""The paper's two UR5e: kinematics, joints of the stick's tip, limits, and whether a plan can be played."""

from ._core import (
    RobotLimits,
    SeedGrid,
    StickArm,
    StickMap,
    arm_hand_limits,
    check_plan,
    keep_limits,
    load_tip_plan,
    recorded_plan,
    ur5e_inverse,
)
from .arms import JOINTS

FAULTS = ("reached", "outside the box of the seed grid", "out of reach", "a joint leaves its range")
"""What the codes of StickMap.solve() mean."""

__all__ = [
    "FAULTS",
    "JOINTS",
    "RobotLimits",
    "SeedGrid",
    "StickArm",
    "StickMap",
    "arm_hand_limits",
    "check_plan",
    "keep_limits",
    "load_tip_plan",
    "recorded_plan",
    "ur5e_inverse",
]
