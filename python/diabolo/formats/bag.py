# SPDX-License-Identifier: MIT
"""Bags of ROS: rosbag2 (folders, MCAP, SQLite) and rosbag1 are read, MCAP is written."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from .._core import Calibration, DiaboloProperties, Recording, RecordingError
from ..files import whole_file
from .bodies import Body

SCHEMA = "diabolo.recording/1"
POSE = "geometry_msgs/msg/PoseStamped"
TOPICS = {"left": "/left_tip", "right": "/right_tip", "diabolo": "/diabolo"}
"""Of what is written."""
Row = tuple[str, int, tuple[float, ...]]
"""Name of a body, stamp [ns], and its place [m], of a body with its orientation x, y, z, w behind it."""


def read(path: Path) -> tuple[list[Body], list[str], Calibration]:
    """The bodies of a bag, each a topic with poses or points, or a frame of /tf."""
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    rows: dict[str, tuple[list[int], list[tuple[float, ...]]]] = {}
    try:
        with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as bag:
            known = [one for one in bag.connections if one.msgtype in ROWS_OF]
            for connection, logged, raw in bag.messages(connections=known):
                message = bag.deserialize(raw, connection.msgtype)
                for name, stamp, numbers in ROWS_OF[connection.msgtype](connection.topic, message):
                    stamps, values = rows.setdefault(name, ([], []))
                    stamps.append(stamp or logged)
                    values.append(numbers)
    except Exception as error:  # of files, archives, databases or messages: whatever a broken bag leads to
        why = " ".join(str(error).split())[:200]
        raise RecordingError(f"{path}: cannot be read as a bag of ROS ({why})") from error
    found = [_body(path, name, *columns) for name, columns in rows.items()]
    if not found:
        raise RecordingError(f"{path}: no poses in it; expected messages of {', '.join(sorted(ROWS_OF))}")
    calibration, notes = _setup(path)
    first = min(int(body.stamps[0]) for body in found)
    if first > 10**18:
        notes.append(
            f"the times are stamps of a clock, from {first * 1e-9:.3f} s on: they are counted from there"
        )
    return found, notes, calibration


def save(recording: Recording, path: Path) -> None:
    """Write the tips and the diabolo as poses of ROS 2, each a topic (TOPICS), in the frame "world". Dropouts
    are left out; a track without orientations has those of the frame."""
    from mcap.writer import Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    make, stamp_of, header_of, point_of, turn_of, pose_of = (
        store.types[name]
        for name in (
            POSE,
            "builtin_interfaces/msg/Time",
            "std_msgs/msg/Header",
            "geometry_msgs/msg/Point",
            "geometry_msgs/msg/Quaternion",
            "geometry_msgs/msg/Pose",
        )
    )
    definition, _ = store.generate_msgdef(POSE)
    tracks = {
        "left": (recording.left, recording.left_orientation),
        "right": (recording.right, recording.right_orientation),
        "diabolo": (recording.diabolo, recording.diabolo_orientation),
    }
    stamps = np.rint(recording.time * 1e9).astype(np.int64)
    stamps -= min(0, int(stamps[0]))
    with whole_file(path) as temporary, temporary.open("wb") as file:
        writer = Writer(file)
        writer.start(profile="ros2", library="diabolo")
        schema = writer.register_schema(POSE, "ros2msg", definition.encode())
        for role, (places, turns) in tracks.items():
            channel = writer.register_channel(TOPICS[role], "cdr", schema)
            for i in np.flatnonzero(np.isfinite(places[:, 0])):
                turn = turns[i] if turns is not None and np.isfinite(turns[i, 0]) else (0.0, 0.0, 0.0, 1.0)
                stamp = int(stamps[i])
                message = make(
                    header_of(stamp_of(stamp // 10**9, stamp % 10**9), "world"),
                    pose_of(point_of(*map(float, places[i])), turn_of(*map(float, turn))),
                )
                data = bytes(store.serialize_cdr(message, POSE))
                writer.add_message(channel, log_time=stamp, data=data, publish_time=stamp)
        writer.add_metadata(SCHEMA, {"setup": json.dumps(_setup_of(recording, tracks))})
        writer.finish()


def _setup_of(recording: Recording, tracks: dict[str, Any]) -> dict[str, Any]:
    """What poses do not say of a recording."""
    names = ("mass", "diameter", "length", "axle_radius")
    return {
        "diabolo": {name: getattr(recording.properties, name) for name in names},
        "string_length": recording.string_length,
        "points": [role for role, (_, turns) in tracks.items() if turns is None],
    }


def _setup(path: Path) -> tuple[Calibration, list[str]]:
    """String and diabolo, where save() has written them; and what was taken for granted."""
    plain = Calibration.plain()
    if path.suffix == ".mcap":
        from mcap.reader import make_reader

        with path.open("rb") as file:
            for one in make_reader(file).iter_metadata():
                if one.name == SCHEMA:
                    try:
                        kept = json.loads(one.metadata["setup"])
                        return plain.of(DiaboloProperties(**kept["diabolo"]), kept["string_length"]), []
                    except (KeyError, TypeError, ValueError) as error:
                        raise RecordingError(f"{path}, metadata {SCHEMA}: {error}") from error
    return plain, [
        "nothing in it says how long the string is and what the diabolo is like: a string of 1.46 m and the "
        "paper's red diabolo are taken for granted (--calibration)"
    ]


def _body(path: Path, name: str, stamps: list[int], values: list[tuple[float, ...]]) -> Body:
    if len({len(one) for one in values}) > 1:
        raise RecordingError(f"{path}, {name}: points and poses on one topic; expected one kind of message")
    order = np.argsort(np.array(stamps, np.int64), kind="stable")
    numbers = np.array(values, float)[order]
    numbers[~np.isfinite(numbers).all(axis=1)] = np.nan
    turns = numbers[:, 3:] if numbers.shape[1] == 7 else None
    return Body(name, np.array(stamps, np.int64)[order], numbers[:, :3], turns)


def _stamp(header: Any) -> int:
    """[ns]; 0 where nobody set it."""
    return int(header.stamp.sec) * 10**9 + int(header.stamp.nanosec)


def _place(point: Any) -> tuple[float, ...]:
    return point.x, point.y, point.z


def _whole(place: Any, turn: Any) -> tuple[float, ...]:
    return place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w


def _of_pose(topic: str, message: Any) -> Iterator[Row]:
    yield topic, _stamp(message.header), _whole(message.pose.position, message.pose.orientation)


def _of_nested_pose(topic: str, message: Any) -> Iterator[Row]:
    pose = message.pose.pose
    yield topic, _stamp(message.header), _whole(pose.position, pose.orientation)


def _of_point(topic: str, message: Any) -> Iterator[Row]:
    yield topic, _stamp(message.header), _place(message.point)


def _of_transform(_: str, message: Any) -> Iterator[Row]:
    moved = message.transform
    yield message.child_frame_id, _stamp(message.header), _whole(moved.translation, moved.rotation)


def _of_transforms(topic: str, message: Any) -> Iterator[Row]:
    for one in message.transforms:
        yield from _of_transform(topic, one)


def _of_rigid_bodies(_: str, message: Any) -> Iterator[Row]:
    for body in message.rigidbodies:
        pose = body.pose
        yield body.rigid_body_name, _stamp(message.header), _whole(pose.position, pose.orientation)


ROWS_OF: dict[str, Callable[[str, Any], Iterator[Row]]] = {
    POSE: _of_pose,
    "geometry_msgs/msg/PoseWithCovarianceStamped": _of_nested_pose,
    "nav_msgs/msg/Odometry": _of_nested_pose,
    "geometry_msgs/msg/PointStamped": _of_point,
    "geometry_msgs/msg/TransformStamped": _of_transform,
    "tf2_msgs/msg/TFMessage": _of_transforms,
    "mocap4r2_msgs/msg/RigidBodies": _of_rigid_bodies,
}
"""What is read of messages, by their type."""
