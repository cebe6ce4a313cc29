# SPDX-License-Identifier: MIT
"""Publishes a motion of the tips, as their poses or as the joints of two arms, each at its time."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence

import numpy as np
from builtin_interfaces.msg import Time
from diabolo import TipMotion
from diabolo.robot import StickArm, joints_of
from diabolo.rotations import played_orientation
from geometry_msgs.msg import PoseStamped
from numpy.typing import NDArray
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from sensor_msgs.msg import JointState
from session import QUALITY
from std_msgs.msg import Header
from tips import JOINTS, SIDES

Floats = NDArray[np.float64]


def _turn_to(stick: Floats) -> list[float]:
    """Zeros where it is not known."""
    return played_orientation(stick, 0.0).tolist() if stick.any() else [0.0] * 4


class TipSender:
    """Publishes poses on left_tip and right_tip, body x along the stick."""

    def __init__(self, node: Node, motion: TipMotion, times: Floats, frame: str = "world") -> None:
        """times: when the motion is looked at [s]."""
        self.outputs = [node.create_publisher(PoseStamped, f"{side}_tip", QUALITY) for side in SIDES]
        self._frame, self._message = frame, PoseStamped()
        self._places = [places.tolist() for places in motion.at(times)[:2]]
        self._turns = [[_turn_to(stick) for stick in sticks] for sticks in motion.directions_at(times)]

    def send(self, index: int, stamp: int) -> None:
        """Both tips at a time, with a stamp [ns]."""
        self._message.header = header_of(stamp, self._frame)
        place, turn = self._message.pose.position, self._message.pose.orientation
        for output, places, turns in zip(self.outputs, self._places, self._turns, strict=True):
            place.x, place.y, place.z = places[index]
            turn.x, turn.y, turn.z, turn.w = turns[index]
            output.publish(self._message)


class JointSender:
    """Publishes both arms' joints on joint_states."""

    def __init__(self, node: Node, motion: TipMotion, times: Floats) -> None:
        """times: when the motion is looked at [s]. Raises ValueError where an arm does not reach a tip."""
        tips = motion.at(times)[:2]
        sides = [joints_of(StickArm(side), its) for side, its in zip(SIDES, tips, strict=True)]
        self.outputs = [node.create_publisher(JointState, "joint_states", QUALITY)]
        self.rows = np.hstack(sides).tolist()

    def send(self, index: int, stamp: int) -> None:
        """All joints at a time, with a stamp [ns]."""
        self.outputs[0].publish(JointState(header=header_of(stamp), name=JOINTS, position=self.rows[index]))


def header_of(stamp: int, frame: str = "") -> Header:
    """The header of a message that was measured at a stamp [ns]."""
    return Header(stamp=Time(sec=stamp // 10**9, nanosec=stamp % 10**9), frame_id=frame)


def wait_until_heard(outputs: Sequence[Publisher], listeners: int = 1, seconds: float = 60.0) -> None:
    """Wait until so many listen to each. Raises ValueError where they do not within that time."""
    end = time.monotonic() + seconds
    for output in outputs:
        while (found := output.get_subscription_count()) < listeners:
            if time.monotonic() > end:
                raise ValueError(
                    f"{output.topic_name}: {found} listeners after {seconds:g} s; expected {listeners}"
                )
            time.sleep(0.02)


def in_time(times: Sequence[float], idle: Callable[[float], object] = time.sleep) -> Iterator[int]:
    """The index of each time [s], when it has come. idle: is given the seconds until then."""
    begin = time.monotonic()
    for index, due in enumerate(times):
        while (left := begin + due - time.monotonic()) > 0.0:
            idle(left)
        yield index


def wait_until_taken(outputs: Sequence[Publisher], seconds: float = 2.0) -> None:
    """Wait until all that was published has come to those who listen, at most so long."""
    for output in outputs:
        output.wait_for_all_acked(Duration(seconds=seconds))
