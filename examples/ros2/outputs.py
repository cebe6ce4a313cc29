# SPDX-License-Identifier: MIT
"""What the node publishes of the diabolo: pose, twist, tensions of the string and its state."""

from __future__ import annotations

from diabolo.rotations import played_orientation
from geometry_msgs.msg import PoseStamped, TwistStamped
from rclpy.node import Node
from sensor_msgs.msg import JointState
from session import QUALITY
from std_msgs.msg import Header, UInt8
from string_in_time import StringInTime
from tips import SIDES


class Outputs:
    """The messages are made once: that takes longer than to fill them. The pose goes first."""

    def __init__(self, node: Node) -> None:
        self._pose, self._twist = PoseStamped(), TwistStamped()
        self._tension, self._string_state = JointState(name=list(SIDES)), UInt8()
        self._publishers = [
            (node.create_publisher(type(message), f"diabolo/{name}", QUALITY), message, fill)
            for name, message, fill in (
                ("pose", self._pose, self._fill_pose),
                ("twist", self._twist, self._fill_twist),
                ("tension", self._tension, self._fill_tension),
                ("string_state", self._string_state, self._fill_string_state),
            )
        ]

    def publish(self, play: StringInTime, header: Header) -> None:
        self._pose.header = self._twist.header = self._tension.header = header
        for publisher, message, fill in self._publishers:
            fill(play)
            publisher.publish(message)

    def _fill_pose(self, play: StringInTime) -> None:
        place, turn = self._pose.pose.position, self._pose.pose.orientation
        place.x, place.y, place.z = play.state.position.tolist()
        turn.x, turn.y, turn.z, turn.w = played_orientation(play.state.axis, play.turned).tolist()

    def _fill_twist(self, play: StringInTime) -> None:
        linear, angular = self._twist.twist.linear, self._twist.twist.angular
        linear.x, linear.y, linear.z = play.state.velocity.tolist()
        angular.x, angular.y, angular.z = (-play.state.spin * play.state.axis).tolist()

    def _fill_tension(self, play: StringInTime) -> None:
        self._tension.effort = list(play.tensions)

    def _fill_string_state(self, play: StringInTime) -> None:
        self._string_state.data = int(play.state.string_state)
