# SPDX-License-Identifier: MIT
"""What is read of messages of ROS, by their type."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from .joints import angles_of

POSE, POINT = "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PointStamped"
POSE_WITH_COVARIANCE = "geometry_msgs/msg/PoseWithCovarianceStamped"
JOINT_STATE, RIGID_BODIES = "sensor_msgs/msg/JointState", "mocap4r2_msgs/msg/RigidBodies"
TRANSFORM, TRANSFORMS = "geometry_msgs/msg/TransformStamped", "tf2_msgs/msg/TFMessage"

MOCAP4R2 = {
    RIGID_BODIES: "std_msgs/Header header\nuint32 frame_number\nmocap4r2_msgs/RigidBody[] rigidbodies\n",
    "mocap4r2_msgs/msg/RigidBody": "string rigid_body_name\nmocap4r2_msgs/Marker[] markers\n"
    "geometry_msgs/Pose pose\n",
    "mocap4r2_msgs/msg/Marker": "int8 id_type\nint32 marker_index\nstring marker_name\n"
    "geometry_msgs/Point translation\n",
}
"""Fields of messages that ROS does not bring, for bags that do not say them (SQLite of ROS 2 Humble)."""

Row = tuple[str, Any, tuple[float, ...]]
"""Name of a body, header, and numbers: its place [m], and its orientation x, y, z, w where it has one, or the
six angles of an arm [rad]."""


def _pose(place: Any, turn: Any) -> tuple[float, ...]:
    return place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w


def _of_pose(topic: str, message: Any) -> Iterator[Row]:
    yield topic, message.header, _pose(message.pose.position, message.pose.orientation)


def _of_pose_with_covariance(topic: str, message: Any) -> Iterator[Row]:
    pose = message.pose.pose
    yield topic, message.header, _pose(pose.position, pose.orientation)


def _of_point(topic: str, message: Any) -> Iterator[Row]:
    point = message.point
    yield topic, message.header, (point.x, point.y, point.z)


def _of_transform(_: str, message: Any) -> Iterator[Row]:
    moved = message.transform
    yield message.child_frame_id, message.header, _pose(moved.translation, moved.rotation)


def _of_transforms(topic: str, message: Any) -> Iterator[Row]:
    for one in message.transforms:
        yield from _of_transform(topic, one)


def _of_rigid_bodies(_: str, message: Any) -> Iterator[Row]:
    for body in message.rigidbodies:
        yield body.rigid_body_name, message.header, _pose(body.pose.position, body.pose.orientation)


def _of_joints(topic: str, message: Any) -> Iterator[Row]:
    for name, angles in angles_of(topic, message):
        yield name, message.header, angles


ROWS_OF: dict[str, Callable[[str, Any], Iterator[Row]]] = {
    POSE: _of_pose,
    POINT: _of_point,
    POSE_WITH_COVARIANCE: _of_pose_with_covariance,
    "nav_msgs/msg/Odometry": _of_pose_with_covariance,
    TRANSFORM: _of_transform,
    TRANSFORMS: _of_transforms,
    RIGID_BODIES: _of_rigid_bodies,
    JOINT_STATE: _of_joints,
}
NAMED_INSIDE = (TRANSFORM, TRANSFORMS, RIGID_BODIES)
"""Types of messages that name their bodies, whatever the topic."""
