# SPDX-License-Identifier: MIT
"""A node of ROS 2: it hears the stick tips, and says where the diabolo is (docs/hosts.md).

    python examples/ros2/diabolo_node.py --ros-args -p model:=model.json -p string_length:=1.4

It steps by the stamps of what it hears, and by no clock: the same messages give the same play.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from diabolo.robot import StickArm
from geometry_msgs.msg import PoseStamped
from outputs import Outputs
from rclpy.node import Node
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState
from session import QUALITY, listen, model_of, run
from std_msgs.msg import Header
from string_in_time import StringInTime
from tips import JOINTS, SIDES, JointTips, MessageError, TipPairs, Tips, stamp_of, tip_of

DEFAULTS = {
    "model": "consistent",  # or published, paper, a model file
    "string_length": 0.0,  # [m]; 0: the model's
    "source": "tips",  # or joints
    "frame": "world",
    "spin": 100.0,  # at the start [rad/s], where the diabolo hangs at rest
    "dt": 2e-3,  # the longest step [s]
    "joints": JOINTS,
    "height": 0.70,  # of the arms' bases [m]
    "spacing": 1.10,  # between them [m]
    "forward": 0.0,  # their x [m]
}


class DiaboloNode(Node):
    def __init__(self) -> None:
        super().__init__("diabolo")
        self.declare_parameters("", list(DEFAULTS.items()))
        self.declare_parameter("start", Parameter.Type.DOUBLE_ARRAY)
        given = {name: self.get_parameter(name).value for name in DEFAULTS}
        self._frame, self._refused = given["frame"], Counter[str]()
        self._play = StringInTime(
            model_of(given["model"], given["string_length"]),
            self._warn,
            self._start(),
            given["spin"],
            given["dt"],
        )
        self._listen(given)
        self._outputs = Outputs(self)

    def _start(self) -> np.ndarray | None:
        """Position, velocity and spin, where the diabolo does not hang at rest."""
        start = self.get_parameter_or("start").value
        if start is not None and (len(start) != 7 or not np.isfinite(start).all()):
            raise ValueError(f"start: {list(start)}; expected seven numbers: position, velocity, spin")
        return None if start is None else np.array(start)

    def _listen(self, given: dict) -> None:
        if given["source"] == "tips":
            self._pairs = TipPairs()
            for side in SIDES:
                self.create_subscription(
                    PoseStamped,
                    f"{side}_tip",
                    lambda message, side=side: self._hear_tip(side, message),
                    QUALITY,
                )
        elif given["source"] == "joints":
            mounts = {name: given[name] for name in ("height", "spacing", "forward")}
            self._arms = JointTips([StickArm(side, **mounts) for side in SIDES], given["joints"])
            self.create_subscription(JointState, "joint_states", self._hear_joints, QUALITY)
        else:
            raise ValueError(f"source: {given['source']!r}; expected tips or joints")

    def _hear_tip(self, side: str, message: PoseStamped) -> None:
        with self._refusing():
            tip = tip_of(f"{side}_tip", message, self._frame)
            for stamp, tips in self._pairs.add(side, stamp_of(message), tip):
                self._advance(stamp, tips, message.header)

    def _hear_joints(self, message: JointState) -> None:
        with self._refusing():
            self._advance(stamp_of(message), self._arms.tips_of(message), message.header)

    def _advance(self, stamp: int, tips: Tips, header: Header) -> None:
        self._play.advance(stamp, tips)
        header.frame_id = self._frame
        self._outputs.publish(self._play, header)

    @contextmanager
    def _refusing(self) -> Iterator[None]:
        try:
            yield
        except MessageError as refused:
            self._warn(refused.kind, str(refused))

    def _warn(self, kind: str, sentence: str) -> None:
        """Each kind once, else it would be five hundred times a second; the count at the end."""
        self._refused[kind] += 1
        if self._refused[kind] == 1:
            self.get_logger().warning(sentence)

    def report(self) -> None:
        """How often it happened, what was warned of once."""
        for kind, count in self._refused.items():
            if count > 1:
                self.get_logger().warning(f"{kind}: {count} times in all")


def work(_: list[str]) -> None:
    node = DiaboloNode()
    listen(node)
    node.report()


if __name__ == "__main__":
    sys.exit(run(work))
