# SPDX-License-Identifier: MIT
"""The two arms of a cell: names of their joints, and how they hold their sticks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._core import StickArm
from .checks import is_several, shown

SIDES = ("left", "right")
JOINTS = (
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "elbow_joint",
    "wrist_1_joint",
    "wrist_2_joint",
    "wrist_3_joint",
)
"""Of a UR5e, base to last wrist, as its ROS driver names them; those of a cell begin with left_ or right_."""
LARGEST_ANGLE = 6.4
"""Of a joint [rad]: a full turn either way, and a little."""


def two_arms(arms: Sequence[StickArm] | None) -> list[StickArm]:
    """The left and the right one; None: the paper's. Raises ValueError about any others."""
    if arms is None:
        return [StickArm(side) for side in SIDES]
    several: list[Any] = list(arms) if is_several(arms) else [arms]
    if any(not isinstance(arm, StickArm) for arm in several):
        raise ValueError(f"arms: {shown(arms)}; expected two StickArm")
    if (sides := [arm.side for arm in several]) != [*SIDES]:
        raise ValueError(f"arms: {sides}; expected one of the left and one of the right")
    return several


def stick_frame(arm: StickArm) -> NDArray[np.float64]:
    """Stick to flange, a rotation of the shape (3, 3): x points out along the stick, from the flange to the
    tip."""
    return along(arm.tip)


def along(vector: NDArray[np.float64]) -> NDArray[np.float64]:
    """A rotation of the shape (3, 3) whose x axis is along a vector, which is not zero."""
    x = vector / np.linalg.norm(vector)
    z = np.cross(x, np.eye(3)[np.argmin(np.abs(x))])
    z /= np.linalg.norm(z)
    return np.column_stack([x, np.cross(z, x), z])
