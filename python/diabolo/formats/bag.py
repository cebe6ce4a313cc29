# SPDX-License-Identifier: MIT
"""Bags of ROS: rosbag2 (folders, MCAP, SQLite) and rosbag1 are read, MCAP is written."""

from __future__ import annotations

import json
from array import array
from collections import defaultdict
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .._core import Calibration, DiaboloProperties, Recording, RecordingError, StickArm
from ..arms import JOINTS, SIDES, two_arms
from ..checks import shown
from ..files import whole_file
from .bodies import NO_FRAME, Body, Floats, unreadable
from .cdr import Alike, read_alike
from .joints import sticks, unknown_joints
from .mcap_end import whole
from .messages import JOINT_STATE, MOCAP4R2, NAMED_INSIDE, POINT, POSE, ROWS_OF

SCHEMA = "diabolo.recording/1"
TOPICS = {"left": "/left_tip", "right": "/right_tip", "diabolo": "/diabolo"}
"""Topics that save() writes."""
LAST_STAMP = 2**63 - 1
"""[ns]"""


@dataclass
class Rows:
    """What a bag has of one body: stamps of headers and of the log [ns], numbers as in messages.Row, one row
    behind the other, how many a row has, and the frame. Flat: a million small objects keep the garbage
    collector busy."""

    stamps: list[int] = field(default_factory=list)
    logged: list[int] = field(default_factory=list)
    numbers: array[float] = field(default_factory=lambda: array("d"))
    sizes: set[int] = field(default_factory=set)
    frames: set[str] = field(default_factory=set)

    def add(self, logged: int, header: Any, numbers: tuple[float, ...]) -> None:
        self.stamps.append(int(header.stamp.sec) * 10**9 + int(header.stamp.nanosec))
        self.logged.append(logged)
        self.numbers.extend(numbers)
        self.sizes.add(len(numbers))
        self.frames.add(NO_FRAME if len(numbers) == len(JOINTS) else header.frame_id)

    def add_all(self, logged: list[int], alike: Alike) -> None:
        self.stamps += alike.stamps.tolist()
        self.logged += logged
        self.numbers.frombytes(alike.numbers.tobytes())
        self.sizes.add(alike.numbers.shape[1])
        self.frames |= alike.frames


def read(
    path: Path, names: Collection[str] = (), arms: Sequence[StickArm] | None = None
) -> tuple[list[Body], Calibration | None, list[str]]:
    """The bodies of a bag, each a topic with poses or points, a frame of /tf, or the stick of an arm of whose
    joints it tells: those of these names, or all where one is not there. Then string and diabolo, of a bag
    that save() wrote, and what was left out."""
    with whole(path) as (readable, notes):
        found, joints = _rows(path, readable, names)
        if not found.keys() >= {*names}:
            found, joints = _rows(path, readable, ())
        setup = setup_of(path, readable)
        if joints and all("diabolo" in name.lower() and not _is_arm(rows) for name, rows in found.items()):
            topic, there = next(iter(joints.items()))
            raise RecordingError(f"{path}, {topic}: {unknown_joints(there)}")
        if not found:
            expected = ", ".join(sorted(ROWS_OF))
            raise RecordingError(f"{path}: no poses in it; expected messages of {expected}")
    holding = dict(zip(SIDES, two_arms(arms), strict=True))
    return [_body(path, name, rows, holding) for name, rows in found.items()], setup, notes


def _rows(path: Path, readable: Path, names: Collection[str]) -> tuple[dict[str, Rows], dict[str, list[str]]]:
    """What a bag has of the bodies of these names, or of all, and the names of joints by their topic."""
    from rosbags.highlevel import AnyReader

    wanted = {*names} | {name.rpartition(":")[0] for name in names}  # of an arm TOPIC:left or TOPIC:right
    found: defaultdict[str, Rows] = defaultdict(Rows)
    joints: dict[str, list[str]] = {}
    try:
        with AnyReader([readable], default_typestore=known_types()) as bag:
            known = [
                one
                for one in bag.connections
                if one.msgtype in ROWS_OF
                and (not names or one.topic in wanted or one.msgtype in NAMED_INSIDE)
            ]
            kept: defaultdict[tuple[str, str], tuple[list[int], list[bytes]]] = defaultdict(lambda: ([], []))
            for connection, logged, raw in bag.messages(connections=known) if known else ():
                times, messages = kept[connection.topic, connection.msgtype]
                times.append(logged)
                messages.append(raw)
            for (topic, kind), (times, messages) in kept.items():
                alike = read_alike(kind, messages) if bag.is2 else None
                if alike is not None:
                    found[topic].add_all(times, alike)
                    continue
                for logged, raw in zip(times, messages, strict=True):
                    message = bag.deserialize(raw, kind)
                    if kind == JOINT_STATE and len(message.position):
                        joints.setdefault(topic, message.name)
                    for name, header, numbers in ROWS_OF[kind](topic, message):
                        if not names or name in names:
                            found[name].add(logged, header, numbers)
    except RecordingError as error:
        raise RecordingError(f"{path}, {error}") from error
    except Exception as error:  # of files, archives, databases or messages: whatever a broken bag leads to
        raise unreadable(path, "a bag of ROS", error) from error
    return found, joints


def known_types() -> Any:
    """Of the library, with those of MOCAP4R2."""
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    for name, text in MOCAP4R2.items():
        store.register(get_types_from_msg(text, name))
    return store


def _is_arm(rows: Rows) -> bool:
    return rows.sizes == {len(JOINTS)}


def setup_of(path: Path, readable: Path) -> Calibration | None:
    """String and diabolo of a bag that save() wrote; None of others."""
    if readable.suffix != ".mcap":
        return None
    from mcap.reader import make_reader

    try:
        with readable.open("rb") as file:
            kept = [one.metadata for one in make_reader(file).iter_metadata() if one.name == SCHEMA]
        if not kept:
            return None
        if len(kept) > 1:
            raise ValueError(f"{len(kept)} records of them; expected one")
        setup = json.loads(kept[0]["setup"])
        if not isinstance(setup, dict):
            raise ValueError(f"setup: {shown(setup)}; expected an object")
        diabolo, assumed = DiaboloProperties(**setup["diabolo"]), setup.get("assumed", [])
        return Calibration.plain().of(diabolo, setup["string_length"], assumed)
    except Exception as error:  # of the library, or of somebody's own metadata
        raise unreadable(path, f"a bag with metadata of {SCHEMA}", error) from error


def save(recording: Recording, path: Path) -> None:
    """Write the tips and the diabolo, each a topic (TOPICS) in the frame "world": poses of ROS 2, or points
    where no orientations are known. Dropouts are left out. An orientation that is not known is all zeros."""
    from mcap.writer import Writer

    store = known_types()
    stamps = np.rint(recording.time * 1e9).astype(np.int64)
    stamps -= min(0, int(stamps[0]))
    for role in TOPICS:
        if np.isfinite(getattr(recording, role)[:, 0]).sum() < 2:
            raise RecordingError(f"{path}: {role} is seen less than twice; expected two samples or more")
    with whole_file(path) as temporary, temporary.open("wb") as file:
        writer = Writer(file, enable_data_crcs=True)
        writer.start(profile="ros2", library="diabolo")
        schemas = {
            kind: writer.register_schema(kind, "ros2msg", store.generate_msgdef(kind)[0].encode())
            for kind in (POSE, POINT)
        }
        writer.add_metadata(SCHEMA, {"setup": json.dumps(_setup(recording))})
        tracks = []
        for role, topic in TOPICS.items():
            places, turns = getattr(recording, role), getattr(recording, f"{role}_orientation")
            kind = POINT if turns is None else POSE
            tracks.append((writer.register_channel(topic, "cdr", schemas[kind]), kind, places, turns))
        for i, stamp in enumerate(stamps.tolist()):
            for channel, kind, places, turns in tracks:
                if not np.isfinite(places[i, 0]):
                    continue
                turn = None if turns is None else np.nan_to_num(turns[i])
                data = bytes(store.serialize_cdr(_message(store.types, stamp, places[i], turn), kind))
                writer.add_message(channel, stamp, data, stamp)
        writer.finish()


def _message(types: Any, stamp: int, place: Floats, turn: Floats | None) -> Any:
    """A PoseStamped, or a PointStamped where there is no orientation."""
    time = types["builtin_interfaces/msg/Time"](stamp // 10**9, stamp % 10**9)
    header = types["std_msgs/msg/Header"](time, "world")
    point = types["geometry_msgs/msg/Point"](*place.tolist())
    if turn is None:
        return types[POINT](header, point)
    turned = types["geometry_msgs/msg/Quaternion"](*turn.tolist())
    return types[POSE](header, types["geometry_msgs/msg/Pose"](point, turned))


def _setup(recording: Recording) -> dict[str, Any]:
    """What poses do not say of a recording."""
    names = ("mass", "diameter", "length", "axle_radius")
    told = {
        "diabolo": {name: getattr(recording.properties, name) for name in names},
        "string_length": recording.string_length,
    }
    return told | ({"assumed": recording.assumed} if recording.assumed else {})


def _body(path: Path, name: str, rows: Rows, arms: dict[str, StickArm]) -> Body:
    if len(rows.sizes) > 1 or len(rows.frames) > 1:
        raise RecordingError(f"{path}, {name}: points and poses, or several frames; expected one kind")
    told = rows.stamps if any(rows.stamps) else rows.logged
    if max(told) > LAST_STAMP:
        raise RecordingError(f"{path}, {name}: stamp {max(told)} ns; expected one within {LAST_STAMP}")
    stamps, numbers = np.array(told, np.int64), np.array(rows.numbers).reshape(len(told), -1)
    order = np.argsort(stamps, kind="stable")
    stamps, numbers = stamps[order], numbers[order]
    once = np.append(True, (np.diff(stamps) != 0) | (numbers[1:] != numbers[:-1]).any(axis=1))
    stamps, numbers = stamps[once], numbers[once]  # /tf says again what it said
    if numbers.shape[1] == len(JOINTS):
        return Body(name, stamps, *sticks(arms[name.rpartition(":")[2]], numbers), NO_FRAME)
    places, turns = numbers[:, :3], numbers[:, 3:] if numbers.shape[1] == 7 else None
    places[~np.isfinite(places).all(axis=1)] = np.nan
    if turns is not None:
        turns[~np.isfinite(turns).all(axis=1) | (turns == 0.0).all(axis=1)] = np.nan
    return Body(name, stamps, places, turns, min(rows.frames))
