# SPDX-License-Identifier: MIT
"""Joint states of two UR5e, as poses of the sticks that they hold."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from .._core import RecordingError, StickArm
from ..arms import JOINTS, SIDES, JointsError, angles_in, stick_frame
from ..checks import shown
from ..rotations import quaternions
from .bodies import Floats

Angles = tuple[float, ...]


def angles_of(topic: str, message: Any) -> Iterator[tuple[str, Angles]]:
    """Of each arm that a JointState tells of, the name of its stick and the six angles [rad].

    Joints are named left_shoulder_pan_joint to right_wrist_3_joint; on a topic whose name tells the side,
    shoulder_pan_joint will do. The sticks are named TOPIC:left and TOPIC:right. Other joints are left alone,
    and so are messages without positions, such as our own node's of tensions.

    Raises:
        RecordingError: an arm's six joints are not there once each, with an angle that a UR5e can have.
    """
    if not len(message.position):
        return
    told = [side for side in SIDES if side in topic.lower()]
    for side in SIDES:
        names = [f"{side}_{joint}" for joint in JOINTS]
        if told == [side] and not {*message.name} & {*names}:
            names = [*JOINTS]
        if {*message.name} & {*names}:
            yield f"{topic}:{side}", _angles(topic, message, names)


def _angles(topic: str, message: Any, names: list[str]) -> Angles:
    """Of the joints of these names; raises RecordingError where they are not there once each."""
    try:
        return tuple(angles_in(message.name, message.position, names, dropouts=True))
    except JointsError as odd:
        raise RecordingError(f"{topic}: {odd}") from None


def unknown_joints(names: list[str]) -> str:
    """What is wrong with joints of which none is an arm's."""
    there = ", ".join(map(shown, names[:6])) or "none"
    return f"joints {there}; expected left_{JOINTS[0]} to right_{JOINTS[-1]}"


def sticks(arm: StickArm, angles: Floats) -> tuple[Floats, Floats]:
    """Tips [m, world], shape (n, 3), and sticks to world as x, y, z, w, shape (n, 4), of joints [rad], shape
    (n, 6). A row that is not finite is NaN."""
    seen = np.isfinite(angles).all(axis=1)
    tips, turns = np.full((len(angles), 3), np.nan), np.full((len(angles), 4), np.nan)
    tips[seen] = arm.tip_position(angles[seen])
    turns[seen] = quaternions(arm.base[:3, :3] @ arm.flange(angles[seen])[:, :3, :3] @ stick_frame(arm))
    return tips, turns
