# SPDX-License-Identifier: MIT
"""Both tips at one instant, from poses or from the joints of two arms; and what is refused of messages."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np
from diabolo import robot
from diabolo.arms import SIDES, JointsError, angles_in
from diabolo.robot import StickArm
from diabolo.rollout import FARTHEST
from diabolo.rotations import first_axes
from numpy.typing import NDArray

JOINTS = [f"{side}_{joint}" for side in SIDES for joint in robot.JOINTS]
"""Names of the arms' joints, the left arm's first."""
MOST_WAITING = 1000
"""Tips of one side without one of the other."""


class MessageError(ValueError):
    """A message that is not used. kind: what is wrong with it, without its numbers."""

    def __init__(self, kind: str, sentence: str) -> None:
        super().__init__(f"{kind}: {sentence}")
        self.kind, self.sentence = kind, sentence


class Refusals:
    """Warns of each kind of message that is not used once, not five hundred times a second."""

    def __init__(self, warn: Callable[[str], object]) -> None:
        self._warn, self._counts = warn, Counter[str]()

    def add(self, kind: str, sentence: str) -> None:
        self._counts[kind] += 1
        if self._counts[kind] == 1:
            self._warn(f"{kind}: {sentence}")

    @contextmanager
    def catching(self) -> Iterator[None]:
        """Add what is refused within."""
        try:
            yield
        except MessageError as refused:
            self.add(refused.kind, refused.sentence)

    def report(self) -> None:
        """How often each kind was there."""
        for kind, count in self._counts.items():
            if count > 1:
                self._warn(f"{kind}: {count} times in all")


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
    return Tip(np.array([x, y, z]), first_axes(np.array(quaternion) / length))


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
        if not len(names) == len({*names}) == len(JOINTS):
            raise ValueError(
                f"joints: {len(names)} names; expected {len(JOINTS)}, each once, such as {JOINTS[0]}"
            )
        self._arms, self._names = arms, list(names)

    def tips_of(self, message: Any) -> Tips:
        """Of a JointState. Raises MessageError."""
        try:
            joints = angles_in(message.name, message.position, self._names)
        except JointsError as odd:
            raise MessageError(f"joint_states, {odd.kind}", str(odd)) from None
        return Tips(*map(self._tip, self._arms, np.reshape(joints, (2, 6))))

    @staticmethod
    def _tip(arm: StickArm, joints: NDArray[np.float64]) -> Tip:
        turn = arm.base[:3, :3] @ arm.flange(joints)[:3, :3]
        return Tip(arm.tip_position(joints), turn @ (arm.tip / np.linalg.norm(arm.tip)))
