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


class JointsError(ValueError):
    """Joints of a message that are of no use. kind: what is wrong with them, without names and numbers."""

    def __init__(self, kind: str, sentence: str) -> None:
        super().__init__(sentence)
        self.kind = kind


def angles_in(
    names: Sequence[str], positions: Sequence[float], wanted: Sequence[str], *, dropouts: bool = False
) -> list[float]:
    """The angles of the joints of the wanted names [rad], of those that a message tells of. With `dropouts`
    one that is not finite counts as not measured. Raises JointsError."""
    if len(positions) != len(names):
        raise JointsError(
            "joints", f"{len(positions)} positions of {len(names)} joints; expected one of each"
        )
    found = dict(zip(names, positions, strict=True))
    for name in wanted:
        if name not in found:
            raise JointsError("joints missing", f"no angle of {name}; expected {wanted[0]} to {wanted[-1]}")
        if names.count(name) > 1:
            raise JointsError("joints twice", f"{name} is named twice; expected each joint once")
        if not abs(found[name]) <= LARGEST_ANGLE and not (dropouts and not np.isfinite(found[name])):
            raise JointsError("angles", f"{name} is {found[name]:g}; expected rad, within 2 pi")
    return [float(found[name]) for name in wanted]


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
