# SPDX-License-Identifier: MIT
"""Both tips at one instant, from poses or from the joints of two arms; and what is refused of messages."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from diabolo import robot
from diabolo.arms import SIDES
from diabolo.robot import StickArm
from diabolo.rollout import FARTHEST
from numpy.typing import NDArray
from turns import first_axis

JOINTS = [f"{side}_{joint}" for side in SIDES for joint in robot.JOINTS]
"""Names of the arms' joints, the left arm's first."""
MOST_WAITING = 1000
"""Tips of one side without one of the other."""


class MessageError(ValueError):
    """A message that is not used. kind: what is wrong with it, without its numbers."""

    def __init__(self, kind: str, sentence: str) -> None:
        super().__init__(f"{kind}: {sentence}")
        self.kind, self.sentence = kind, sentence


class Tip(NamedTuple):
    """In the world frame: place [m], and the stick's direction outwards, a unit vector; zero: not known."""

    place: NDArray[np.float64]
    direction: NDArray[np.float64]


class Tips(NamedTuple):
    left: Tip
    right: Tip


def stamp_of(message: Any) -> int:
    """When it was measured [ns]."""
    return int(message.header.stamp.sec) * 1_000_000_000 + int(message.header.stamp.nanosec)


def tip_of(topic: str, message: Any, frame: str) -> Tip:
    """Of a PoseStamped, body x along the stick. Raises MessageError."""
    if message.header.frame_id != frame:
        raise MessageError(f"{topic}, frame", f"{message.header.frame_id!r}; expected {frame!r}")
    place, turn = message.pose.position, message.pose.orientation
    x, y, z = place.x, place.y, place.z
    if not (abs(x) <= FARTHEST and abs(y) <= FARTHEST and abs(z) <= FARTHEST):
        raise MessageError(
            f"{topic}, position", f"({x:g}, {y:g}, {z:g}) m; expected numbers within {FARTHEST:g} m"
        )
    quaternion = turn.x, turn.y, turn.z, turn.w
    if not any(quaternion):
        return Tip(np.array([x, y, z]), np.zeros(3))
    length = math.hypot(*quaternion)
    if not abs(length - 1.0) < 1e-3:
        raise MessageError(
            f"{topic}, orientation", f"a quaternion of length {length:.4g}; expected 1, or all zeros"
        )
    return Tip(np.array([x, y, z]), first_axis(*(q / length for q in quaternion)))


class TipPairs:
    """Brings left and right tips of the same stamp together, in the order of their stamps."""

    def __init__(self) -> None:
        self._waiting: dict[str, dict[int, Tip]] = {side: {} for side in SIDES}

    def add(self, side: str, stamp: int, tip: Tip) -> Tips | None:
        """The pair that this tip completes, if any. Raises MessageError where too many have no partner."""
        mine, others = (self._waiting[one] for one in (side, "right" if side == "left" else "left"))
        if stamp not in others:
            mine[stamp] = tip
            if len(mine) > MOST_WAITING:
                del mine[next(iter(mine))]
                raise MessageError(f"{side}_tip, stamps", f"{MOST_WAITING} that the other tip has not")
            return None
        other = others[stamp]
        mine.clear()  # they are older, and their partners were lost
        for older in list(others):
            del others[older]
            if older == stamp:
                break
        return Tips(tip, other) if side == "left" else Tips(other, tip)


class JointTips:
    """Tips of two arms by the names of their joints."""

    def __init__(self, arms: Sequence[StickArm], names: Sequence[str]) -> None:
        """names: the six of the left arm, then those of the right one. Raises ValueError."""
        if len({*names}) != len(JOINTS):
            raise ValueError(f"joints: {len({*names})} names; expected {len(JOINTS)}, such as {JOINTS[0]}")
        self._arms, self._names = arms, list(names)

    def tips_of(self, message: Any) -> Tips:
        """Of a JointState. Raises MessageError."""
        given = dict(zip(message.name, message.position, strict=False))
        if missing := [name for name in self._names if name not in given]:
            raise MessageError("joint_states, joints missing", ", ".join(missing))
        joints = np.array([given[name] for name in self._names])
        if not np.isfinite(joints).all():
            raise MessageError("joint_states, position", f"{joints.tolist()} rad; expected finite numbers")
        return Tips(*map(self._tip, self._arms, joints.reshape(2, 6)))

    @staticmethod
    def _tip(arm: StickArm, joints: NDArray[np.float64]) -> Tip:
        turn = arm.base[:3, :3] @ arm.flange(joints)[:3, :3]
        return Tip(arm.tip_position(joints), turn @ (arm.tip / np.linalg.norm(arm.tip)))
