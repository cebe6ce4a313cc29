# SPDX-License-Identifier: MIT
"""A node of ROS 2: it hears the stick tips, and says where the diabolo is (docs/hosts.md).

    python examples/ros2/diabolo_node.py --ros-args -p model:=model.json -p string_length:=1.4

It steps by the stamps of what it hears, and by no clock: the same messages give the same play.
"""

from __future__ import annotations

import sys
from functools import partial

import needs_ros  # noqa: F401
from diabolo.robot import StickArm
from geometry_msgs.msg import PoseStamped
from outputs import Outputs
from rclpy.node import Node
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState
from session import QUALITY, listen, model_of, parser_of, run
from std_msgs.msg import Header
from string_in_time import StringInTime
from tips import JOINTS, SIDES, JointTips, Refusals, TipPairs, Tips, stamp_of, tip_of

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
        """Raises ValueError about a parameter."""
        super().__init__("diabolo")
        self.declare_parameters("", list(DEFAULTS.items()))
        self.declare_parameter("start", Parameter.Type.DOUBLE_ARRAY)
        self._refuse_unknown()
        given = {name: self.get_parameter(name).value for name in DEFAULTS}
        self._frame, self.refusals = given["frame"], Refusals(self.get_logger().warning)
        model = model_of(given["model"], given["string_length"])
        self._play = StringInTime(model, self.refusals.add, self._start(), given["spin"], given["dt"])
        self._outputs = Outputs(self)
        self._listen(given)

    def _refuse_unknown(self) -> None:
        """A misspelt parameter would be ignored."""
        for name in self._parameter_overrides:
            if not self.has_parameter(name):
                raise ValueError(f"parameter {name!r}; expected {', '.join(DEFAULTS)} or start")

    def _start(self) -> list[float] | None:
        """Position, velocity and spin, where it is not to hang at rest."""
        start = self.get_parameter_or("start").value
        return None if start is None else list(start)

    def _listen(self, given: dict) -> None:
        if given["source"] == "tips":
            self._pairs = TipPairs()
            for side in SIDES:
                hear = partial(self._hear_tip, side)
                self.create_subscription(PoseStamped, f"{side}_tip", hear, QUALITY)
        elif given["source"] == "joints":
            mounts = {name: given[name] for name in ("height", "spacing", "forward")}
            self._arms = JointTips([StickArm(side, **mounts) for side in SIDES], given["joints"])
            self.create_subscription(JointState, "joint_states", self._hear_joints, QUALITY)
        else:
            raise ValueError(f"source: {given['source']!r}; expected tips or joints")

    def _hear_tip(self, side: str, message: PoseStamped) -> None:
        with self.refusals.catching():
            tip = tip_of(f"{side}_tip", message, self._frame)
            if tips := self._pairs.add(side, stamp_of(message), tip):
                self._advance(tips, message)

    def _hear_joints(self, message: JointState) -> None:
        with self.refusals.catching():
            self._advance(self._arms.tips_of(message), message)

    def _advance(self, tips: Tips, message: PoseStamped | JointState) -> None:
        """To the tips, which a message has completed."""
        self._play.advance(stamp_of(message), tips)
        self._outputs.publish(self._play, Header(stamp=message.header.stamp, frame_id=self._frame))


def work(arguments: list[str]) -> None:
    parser_of(__doc__).parse_args(arguments)
    node = DiaboloNode()
    listen(node)
    node.refusals.report()


if __name__ == "__main__":
    sys.exit(run(work))
