# SPDX-License-Identifier: MIT
"""The paper's two UR5e: kinematics, joints of the stick's tip, limits, and whether a plan can be played."""

import numpy as np
from numpy.typing import NDArray

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
    "joints_of",
    "keep_limits",
    "load_tip_plan",
    "recorded_plan",
    "ur5e_inverse",
]


def joints_of(arm: StickArm, tips: NDArray[np.float64]) -> NDArray[np.float64]:
    """The joints of an arm whose stick's tip is at places [m], shape (N, 3): shape (N, 6) [rad].

    Raises ValueError with the first place that it does not reach."""
    joints, faults = StickMap(arm, SeedGrid.build(arm)).solve(tips)
    if (failed := np.flatnonzero(faults)).size:
        why = FAULTS[int(faults[failed[0]])]
        raise ValueError(f"{arm.side} tip {failed[0]} of {len(tips)}: {why}; expected all within reach")
    return np.asarray(joints)
