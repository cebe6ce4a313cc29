# SPDX-License-Identifier: MIT
"""Recordings of other programs: bags of ROS, C3D, Parquet, and exports of Vicon and Qualisys."""

import os
import sqlite3
import sys
from array import array
from collections.abc import Callable, Mapping
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from diabolo import (
    Calibration,
    DiaboloProperties,
    Recording,
    RecordingError,
    load_recording,
    save_recording,
)
from diabolo.cli import main
from diabolo.cli.diagnose import input_file
from diabolo.formats import qualisys, vicon
from diabolo.formats.bodies import Body, at_common_times
from diabolo.robot import StickArm
from diabolo.rotations import first_axes, played_orientation, quaternions
from numpy.typing import NDArray

SWING = Path(__file__).parents[2] / "data" / "recordings" / "swing.csv"


@pytest.fixture(scope="module")
def swing() -> Recording:
    return load_recording(SWING).cut(40, 420)


def same(
    one: Recording, other: Recording, *, times: float = 1.5e-9, places: float = 1e-9, turned: bool = True
) -> None:
    """Times, dropouts, places and directions of both, and how long they are."""
    assert len(one) == len(other)
    np.testing.assert_allclose(one.time - one.time[0], other.time - other.time[0], rtol=0.0, atol=times)
    for name in ("left", "right", "diabolo"):
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=0.0, atol=places)
        turns, others = getattr(one, f"{name}_orientation"), getattr(other, f"{name}_orientation")
        if turned and turns is not None:
            aligned = np.abs((turns * others).sum(axis=1))
            assert np.nanmin(aligned) > 1.0 - 1e-6
    assert one.rate == pytest.approx(other.rate)


@pytest.mark.parametrize("suffix", [".mcap", ".parquet", ".csv"])
def test_what_is_written_is_read_again(swing: Recording, tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"swing{suffix}"
    save_recording(swing, path)
    again = load_recording(path)
    same(swing, again)
    np.testing.assert_allclose(again.time, swing.time, rtol=0.0, atol=1e-9)
    assert not [note for note in again.warnings() if "taken for" in note]
    assert again.string_length == swing.string_length
    assert again.properties.mass == swing.properties.mass
    assert not np.isfinite(again.diabolo).all() and np.isfinite(again.diabolo).any()  # with its dropouts


def write_bag(
    folder: Path,
    recording: Recording,
    topics: dict[str, str],
    shift: Mapping[str, int | NDArray[np.int64]],
    stamped: Callable[[int], int] = int,
    mcap: bool = False,
) -> None:
    """A folder of rosbag2 whose bodies have stamps of their own, which `stamped` makes of ns."""
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    types = store.types
    plugin = StoragePlugin.MCAP if mcap else StoragePlugin.SQLITE3
    with Writer(folder, version=9, storage_plugin=plugin) as writer:
        for role, topic in topics.items():
            connection = writer.add_connection(topic, "geometry_msgs/msg/PoseStamped", typestore=store)
            places, turns = getattr(recording, role), getattr(recording, f"{role}_orientation")
            late = np.broadcast_to(shift.get(role, 0), len(recording)).tolist()
            for i in np.flatnonzero(np.isfinite(places[:, 0])):
                stamp = stamped(1_700_000_000 * 10**9 + round(recording.time[i] * 1e9) + late[i])
                message = types["geometry_msgs/msg/PoseStamped"](
                    types["std_msgs/msg/Header"](
                        types["builtin_interfaces/msg/Time"](stamp // 10**9, stamp % 10**9), "world"
                    ),
                    types["geometry_msgs/msg/Pose"](
                        types["geometry_msgs/msg/Point"](*places[i].tolist()),
                        types["geometry_msgs/msg/Quaternion"](*turns[i].tolist()),
                    ),
                )
                data = store.serialize_cdr(message, "geometry_msgs/msg/PoseStamped")
                writer.write(connection, stamp, data)


TOPICS = {"left": "/mocap/hand_a", "right": "/mocap/hand_b", "diabolo": "/mocap/top"}
GIVEN = ",".join(f"{role}={name}" for role, name in TOPICS.items())


def test_a_bag_of_rosbag2_is_read_by_its_topics(swing: Recording, tmp_path: Path) -> None:
    bag = tmp_path / "bag"
    write_bag(bag, swing, TOPICS, {})
    with pytest.raises(
        RecordingError, match=r"no rigid body for the left stick: .*the file has \"/mocap/hand"
    ):
        load_recording(bag)
    found = load_recording(bag, topics=TOPICS)
    same(swing, found, places=1e-6)
    told = " ".join(found.warnings())
    assert "stamps of a clock" in told and "the string's length (1.46 m) and the diabolo (0.2845 kg)" in told
    part = load_recording(next(bag.glob("*.db3")), topics=TOPICS)
    same(found, part, places=0.0)
    for topics in ({**TOPICS, "left": "/nobody"}, dict.fromkeys(TOPICS, "/nobody")):
        with pytest.raises(RecordingError, match=r"no body '/nobody' for left; the file has '/mocap/hand_a'"):
            load_recording(bag, topics=topics)


@pytest.mark.parametrize("suffix", [".mcap", ".parquet", ".csv"])
def test_what_was_assumed_stays_told(swing: Recording, tmp_path: Path, suffix: str) -> None:
    write_bag(tmp_path / "bag", swing, TOPICS, {})
    found = load_recording(tmp_path / "bag", topics=TOPICS)
    for path in (tmp_path / f"once{suffix}", tmp_path / f"twice{suffix}"):
        save_recording(found, path)
        found = load_recording(path)
        assert found.assumed == ["string_length", "diabolo"]
        assert len([one for one in found.warnings() if "assumed" in one]) == 1
    measured = Calibration.plain().of(DiaboloProperties.green(), 1.3)
    save_recording(load_recording(tmp_path / "bag", measured, topics=TOPICS), path)
    found = load_recording(path)
    assert (found.assumed, found.string_length, found.properties.mass) == ([], 1.3, 0.1415)


@pytest.mark.parametrize(
    "stamped",
    [
        lambda ns: ns // 10**3,
        lambda ns: ns // 10**6,
        lambda ns: ns - ns % 10**9 + ns % 10**9 // 10**3,  # us in the field of ns
    ],
)
def test_stamps_in_other_units_are_refused_with_their_topic(
    swing: Recording, tmp_path: Path, stamped: Callable[[int], int]
) -> None:
    write_bag(tmp_path / "bag", swing, TOPICS, {}, stamped)
    with pytest.raises(
        RecordingError,
        match=r"/mocap/hand_a: \S+ samples a second by its stamps; expected 10000 at most",
    ):
        load_recording(tmp_path / "bag", topics=TOPICS)


def test_bodies_with_stamps_of_their_own_are_interpolated_to_the_diabolo(
    swing: Recording, tmp_path: Path
) -> None:
    bag = tmp_path / "bag"
    write_bag(bag, swing, TOPICS, {"left": 1_000_000, "right": -700_000})
    found = load_recording(bag, topics=GIVEN)
    inside = slice(2, -2)
    late = np.array([np.interp(swing.time - 0.001, swing.time, column) for column in swing.left.T]).T
    seen = np.isfinite(swing.diabolo[:, 0])
    np.testing.assert_allclose(found.left[inside], late[seen][inside], atol=3e-4)
    assert len(found) == int(seen.sum())


@pytest.mark.parametrize("together", [True, False])
def test_the_rate_of_a_bag_is_told_by_its_stamps_though_they_jitter(
    swing: Recording, tmp_path: Path, together: bool
) -> None:
    rng = np.random.default_rng(2532)
    late = rng.normal(0.0, 0.08e9 / swing.rate, (3, len(swing))).astype(np.int64)
    shift = {role: late[0 if together else k] for k, role in enumerate(TOPICS)}
    write_bag(tmp_path / "bag", swing, TOPICS, shift)
    found = load_recording(tmp_path / "bag", topics=TOPICS)
    assert found.rate == pytest.approx(swing.rate, rel=1e-3)
    assert any("each row is moved to its even time" in note for note in found.warnings())
    at = np.arange(len(swing)) if together else np.flatnonzero(np.isfinite(swing.diabolo[:, 0]))
    np.testing.assert_allclose(np.diff(found.time) * found.rate, np.diff(at), atol=0.15)  # gaps jitter, too
    np.testing.assert_allclose(found.diabolo, swing.diabolo[at], rtol=0.0, atol=1e-6)
    step = np.nanmax(np.linalg.norm(np.diff(swing.left, axis=0), axis=1))
    apart = np.nanmax(np.linalg.norm(found.left - swing.left[at], axis=1))
    assert apart < (1e-6 if together else 0.5 * step)  # both are late by less than a quarter of a step


MARKED = {
    "mocap4r2_msgs/msg/Marker": "int8 USE_NAME=0\nint8 USE_INDEX=1\nint8 USE_BOTH=2\nint8 id_type\n"
    "int32 marker_index\nstring marker_name\ngeometry_msgs/Point translation",
    "mocap4r2_msgs/msg/RigidBody": "string rigid_body_name\nMarker[] markers\ngeometry_msgs/Pose pose",
    "mocap4r2_msgs/msg/RigidBodies": "std_msgs/Header header\nuint32 frame_number\nRigidBody[] rigidbodies",
}
"""What mocap4r2_msgs has in its files."""


@pytest.mark.parametrize("kind", ["mcap", "sqlite without definitions", "rosbag1"])
def test_rigid_bodies_of_mocap4r2_are_read(swing: Recording, tmp_path: Path, kind: str) -> None:
    from rosbags import rosbag1, rosbag2
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC if kind == "rosbag1" else Stores.ROS2_HUMBLE)
    for name, text in MARKED.items():
        store.register(get_types_from_msg(text, name))
    types, numbered = store.types, (0,) if kind == "rosbag1" else ()
    messages = []
    for i, time in enumerate(swing.time):
        stamp = 1_700_000_000 * 10**9 + round(time * 1e9)
        clock = types["builtin_interfaces/msg/Time"](stamp // 10**9, stamp % 10**9)
        bodies = []
        for name in ("left", "right", "diabolo"):
            place, turn = getattr(swing, name)[i], getattr(swing, f"{name}_orientation")[i]
            point = types["geometry_msgs/msg/Point"](*place.tolist())
            pose = types["geometry_msgs/msg/Pose"](
                point, types["geometry_msgs/msg/Quaternion"](*turn.tolist())
            )
            marker = types["mocap4r2_msgs/msg/Marker"](2, 7, f"{name}_1", point)
            bodies.append(types["mocap4r2_msgs/msg/RigidBody"](name, [marker], pose))
        header = types["std_msgs/msg/Header"](*numbered, clock, "map")
        messages.append((stamp, types["mocap4r2_msgs/msg/RigidBodies"](header, i, bodies)))
    kept = "mocap4r2_msgs/msg/RigidBodies"
    if kind == "rosbag1":
        with rosbag1.Writer(tmp_path / "take.bag") as writer:
            connection = writer.add_connection("/rigid_bodies", kept, typestore=store)
            for stamp, message in messages:
                writer.write(connection, stamp, store.serialize_ros1(message, kept))
        path = tmp_path / "take.bag"
    else:
        path = tmp_path / "take"
        plugin = rosbag2.StoragePlugin.MCAP if kind == "mcap" else rosbag2.StoragePlugin.SQLITE3
        with rosbag2.Writer(path, version=8, storage_plugin=plugin) as writer:
            connection = writer.add_connection("/rigid_bodies", kept, typestore=store)
            for stamp, message in messages:
                writer.write(connection, stamp, store.serialize_cdr(message, kept))
    for database in tmp_path.glob("*/*.db3"):  # as ROS 2 Humble writes it
        with closing(sqlite3.connect(database)) as changed:
            changed.execute("UPDATE schema SET schema_version = 3")
            changed.execute("DROP TABLE message_definitions")
            changed.commit()
    same(swing, load_recording(path), places=1e-6)


def test_what_a_bag_says_twice_is_read_once(swing: Recording, tmp_path: Path) -> None:
    from diabolo.formats.bag import Rows, _body

    numbers = np.repeat([0.0, 1.0, 1.0, 2.0], 3)
    rows = Rows([1, 2, 2, 3], [1, 2, 3, 4], array("d", numbers), {3}, {"world"})
    body = _body(Path("bag"), "left", rows, {})
    assert body.stamps.tolist() == [1, 2, 3] and body.position[:, 0].tolist() == [0.0, 1.0, 2.0]
    rows.numbers[6] = 1.5  # else than what was said
    with pytest.raises(RecordingError, match="stamp 2 ns does not come after the one before"):
        at_common_times(Path("bag"), [_body(Path("bag"), "left", rows, {})], {})


def test_stamps_of_no_clock_are_refused(tmp_path: Path) -> None:
    from diabolo.formats.bag import Rows, _body

    with pytest.raises(RecordingError, match=f"bag, left: stamp {2**63} ns; expected one within"):
        _body(Path("bag"), "left", Rows([0], [2**63], array("d", [0.0] * 3), {3}, {"world"}), {})


def as_recorded(path: Path, out: Path, late: Callable[[int], int] = lambda _: 0) -> None:
    """A bag as a recorder writes it: a chunk every few messages. late: what the log times are off [ns]."""
    from mcap.reader import make_reader
    from mcap.writer import CompressionType, Writer

    with path.open("rb") as file, out.open("wb") as kept:
        writer = Writer(kept, chunk_size=4096, compression=CompressionType.NONE)
        writer.start(profile="ros2")
        channels: dict[str, int] = {}
        for k, (schema, channel, message) in enumerate(make_reader(file).iter_messages()):
            if channel.topic not in channels:
                assert schema is not None
                kind = writer.register_schema(schema.name, schema.encoding, schema.data)
                channels[channel.topic] = writer.register_channel(channel.topic, "cdr", kind)
            logged = message.log_time + late(k)
            writer.add_message(channels[channel.topic], logged, message.data, logged)
        writer.finish()


def warned_of_a_cut(found: Recording) -> bool:
    return len([one for one in found.warnings() if "cut off" in one]) == 1


@pytest.mark.parametrize("late", [lambda _: 0, lambda k: -200_000 if k % 97 == 96 else 0])
def test_a_bag_that_is_cut_off_is_read_up_to_there(
    swing: Recording, tmp_path: Path, late: Callable[[int], int]
) -> None:
    save_recording(swing, tmp_path / "swing.mcap")
    as_recorded(tmp_path / "swing.mcap", tmp_path / "take.mcap", late)
    content = (tmp_path / "take.mcap").read_bytes()
    for share in (0.5, 0.6, 0.7):
        (tmp_path / "cut.mcap").write_bytes(content[: int(share * len(content))])
        found = load_recording(tmp_path / "cut.mcap")
        assert 0.3 * len(swing) < len(found) < len(swing)
        same(swing.cut(0, len(found) - 2), found.cut(0, len(found) - 2))  # the last row may lack a body
        assert warned_of_a_cut(found)
    for few in (content[:8], content[:16], content[:300]):
        (tmp_path / "cut.mcap").write_bytes(few)
        refused_as_cut(tmp_path / "cut.mcap")


def refused_as_cut(bag: Path) -> None:
    with pytest.raises(RecordingError) as refused:
        load_recording(bag)
    said = "the file is cut off within its first chunk of messages; expected one at least"
    assert str(refused.value) == f"{bag}: {said}"


def test_a_bag_of_one_chunk_that_is_cut_in_its_middle_says_so(swing: Recording, tmp_path: Path) -> None:
    save_recording(swing, tmp_path / "take.mcap")
    content = (tmp_path / "take.mcap").read_bytes()
    (tmp_path / "cut.mcap").write_bytes(content[: len(content) // 2])
    refused_as_cut(tmp_path / "cut.mcap")


@pytest.mark.parametrize("recorded", [False, True])
def test_a_bag_that_lacks_no_more_than_its_end_is_read_whole(
    swing: Recording, tmp_path: Path, recorded: bool
) -> None:
    save_recording(swing, tmp_path / "take.mcap")
    if recorded:
        as_recorded(tmp_path / "take.mcap", tmp_path / "take.mcap.new")
        (tmp_path / "take.mcap.new").rename(tmp_path / "take.mcap")
    content = (tmp_path / "take.mcap").read_bytes()
    for cut in (content[:-1], content[:-8], content[:-30], content[:-200], content + b"\n"):
        (tmp_path / "cut.mcap").write_bytes(cut)
        found = load_recording(tmp_path / "cut.mcap")
        same(swing, found)
        assert warned_of_a_cut(found)
        assert found.assumed == (["string_length", "diabolo"] if recorded else [])


def test_rows_and_set_up_of_a_bag_are_written_in_the_order_of_time(swing: Recording, tmp_path: Path) -> None:
    from mcap.records import Message, Metadata
    from mcap.stream_reader import StreamReader

    save_recording(swing, tmp_path / "take.mcap")
    with (tmp_path / "take.mcap").open("rb") as file:
        written = [one for one in StreamReader(file).records if isinstance(one, Message | Metadata)]
    assert isinstance(written[0], Metadata)  # so that a bag that is cut off has it
    stamps = [one.log_time for one in written[1:]]
    assert len(stamps) > 2 * len(swing) and stamps == sorted(stamps)


def test_a_folder_with_a_bag_that_is_cut_off_is_read_up_to_there(swing: Recording, tmp_path: Path) -> None:
    bag = tmp_path / "bag"
    write_bag(bag, swing, TOPICS, {}, mcap=True)
    [file] = bag.glob("*.mcap")
    file.write_bytes(file.read_bytes()[:-20])
    found = load_recording(bag, topics=TOPICS)
    same(swing, found, places=1e-6)
    assert warned_of_a_cut(found)


def test_what_is_no_file_beside_a_bag_is_left_alone(swing: Recording, tmp_path: Path) -> None:
    bag = tmp_path / "bag"
    write_bag(bag, swing, TOPICS, {}, mcap=True)
    os.mkfifo(bag / "pipe.mcap")  # nobody writes into it
    (bag / "folder.mcap").mkdir()
    (bag / "nowhere.mcap").symlink_to(tmp_path / "nothing")
    same(swing, load_recording(bag, topics=TOPICS), places=1e-6)


@pytest.mark.parametrize("cut", [0, 500])
def test_a_chunk_that_is_damaged_is_refused(swing: Recording, tmp_path: Path, cut: int) -> None:
    path = tmp_path / "take.mcap"
    save_recording(swing, tmp_path / "swing.mcap")
    as_recorded(tmp_path / "swing.mcap", path)
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content[: len(content) - cut])
    with pytest.raises(
        RecordingError, match=r"take\.mcap: cannot be read as a bag of ROS \(.*(crc|checksum)"
    ):
        load_recording(path)


@pytest.mark.parametrize("suffix", [".MCAP", ".Db3", ".PARQUET"])
def test_suffixes_may_be_in_capitals(swing: Recording, tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"TAKE{suffix}"
    if suffix == ".Db3":
        write_bag(tmp_path / "bag", swing, TOPICS, {})
        next((tmp_path / "bag").glob("*.db3")).rename(path)
    else:
        save_recording(swing, tmp_path / f"take{suffix.lower()}")
        for one in tmp_path.glob("take.*"):
            one.rename(path if one.suffix == suffix.lower() else path.with_suffix(one.suffix))
    found = load_recording(path, topics=TOPICS if suffix == ".Db3" else None)
    same(swing, found, places=1e-6)
    assert found.name == "TAKE" and len(found.assumed) == (2 if suffix == ".Db3" else 0)
    if suffix == ".MCAP":
        path.write_bytes(path.read_bytes()[:-1])
        assert warned_of_a_cut(load_recording(path))


def test_what_a_calibration_assumes_is_taken_of_the_bag(swing: Recording, tmp_path: Path) -> None:
    path = tmp_path / "take.mcap"
    made = Recording(
        swing.time,
        swing.left,
        swing.right,
        swing.diabolo,
        swing.rate,
        properties=DiaboloProperties.green(),
        string_length=1.3,
    )
    save_recording(made, path)
    plain = Calibration.plain()
    for given, length, mass in (
        (plain, 1.3, 0.1415),
        (plain.of(DiaboloProperties.red(), 1.4, ["diabolo"]), 1.4, 0.1415),
        (plain.of(DiaboloProperties.red(), 1.4, []), 1.4, 0.2845),
    ):
        given.save(tmp_path / "c.json")
        found = load_recording(path, Calibration.load(tmp_path / "c.json"))
        assert (found.string_length, found.properties.mass, found.assumed) == (length, mass, [])


@pytest.mark.parametrize(
    ("was", "now", "complaint"),
    [
        (b'"mass": 0.2', b'"mass": 0.3', "are not what their checksum says"),  # the set-up
        (b"/left_tip\3\0\0\0cdr", b"/left_tep\3\0\0\0cdr", "are not what their checksum says"),  # the summary
        (b"zstd", b"zst\0", "cannot be read as a bag of ROS"),  # a chunk
    ],
)
def test_a_bag_that_is_damaged_ends_in_one_sentence(
    swing: Recording,
    tmp_path: Path,
    was: bytes,
    now: bytes,
    complaint: str,
    capsys: pytest.CaptureFixture[str],
) -> None:
    path = tmp_path / "take.mcap"
    save_recording(swing, path)
    content = path.read_bytes()
    assert was in content
    path.write_bytes(now.join(content.rsplit(was, 1)))
    assert main(["info", str(path)]) == 2
    error = capsys.readouterr().err
    assert complaint in error and "take.mcap" in error and error.count("\n") == 1


def test_points_of_c3d_are_tips_without_directions(swing: Recording, tmp_path: Path) -> None:
    ezc3d = pytest.importorskip("ezc3d")
    file = ezc3d.c3d()
    file["parameters"]["POINT"]["RATE"]["value"] = [swing.rate]
    file["parameters"]["POINT"]["LABELS"]["value"] = ("left_tip", "right_tip", "diabolo")
    file["parameters"]["POINT"]["UNITS"]["value"] = ("mm",)
    points = np.ones((4, 3, len(swing)))
    for k, name in enumerate(("left", "right", "diabolo")):
        points[:3, k] = getattr(swing, name).T * 1e3
    file["data"]["points"] = points
    file.write(str(tmp_path / "swing.c3d"))
    found = load_recording(tmp_path / "swing.c3d")
    (tmp_path / "cut.c3d").write_bytes((tmp_path / "swing.c3d").read_bytes()[:-600])
    with pytest.raises(RecordingError, match=r"cut.c3d: \d+ bytes; expected \d+, as its header says"):
        load_recording(tmp_path / "cut.c3d")
    same(swing, found, times=1e-6, places=1e-6, turned=False)
    assert found.diabolo_orientation is None


@pytest.mark.parametrize("axis", [[1, 0, 0], [-1, 0, 0], [0, 0, 1], [0.6, -0.64, 0.48]])
def test_a_turned_axle_keeps_its_direction(axis: list[float]) -> None:
    turns = np.array([played_orientation(axis, angle) for angle in np.linspace(-10.0, 10.0, 21)])
    np.testing.assert_allclose(np.linalg.norm(turns, axis=1), 1.0)
    np.testing.assert_allclose(first_axes(turns), np.tile(axis, (21, 1)), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(first_axes(turns[0]), axis, rtol=0.0, atol=1e-12)


def test_rotations_become_quaternions() -> None:
    rng = np.random.default_rng(25)
    wanted = rng.normal(size=(200, 4))
    wanted /= np.linalg.norm(wanted, axis=1, keepdims=True)
    wanted[:4] = np.eye(4)
    found = quaternions(matrices_of(wanted))
    np.testing.assert_allclose(np.abs((found * wanted).sum(axis=1)), 1.0, atol=1e-12)
    assert np.isnan(quaternions(np.zeros((1, 3, 3)))).all()


def matrices_of(q: NDArray[np.float64]) -> NDArray[np.float64]:
    x, y, z, w = q.T
    return np.moveaxis(
        np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        ),
        -1,
        0,
    )


def write_qualisys(path: Path, recording: Recording) -> None:
    names = ("left", "right", "diabolo")
    lines = [
        f"NO_OF_FRAMES\t{len(recording)}",
        f"FREQUENCY\t{recording.rate:g}",
        "DATA_INCLUDED\t6D",
        "BODY_NAMES\t" + "\t".join(names),
    ]
    own = ["X", "Y", "Z", "Roll", "Pitch", "Yaw", "Residual", *(f"Rot[{k}]" for k in range(9))]
    head: list[str] = []
    for name in names:
        head += [f"{name} X", *own[1:], ""]
    lines.append("\t".join(head))
    table = []
    for name in names:
        places = np.nan_to_num(getattr(recording, name) * 1e3)
        turns = np.nan_to_num(matrices_of(getattr(recording, f"{name}_orientation")))
        gone = (places == 0.0).all(axis=1)
        rest = np.zeros((len(recording), 4))
        rest[gone, 3] = -1.0
        table.append((places, rest, turns.swapaxes(1, 2).reshape(-1, 9)))
    for i in range(len(recording)):
        lines.append(
            "\t".join("\t".join(f"{x:.6f}" for part in body for x in part[i]) + "\t" for body in table)
        )
    path.write_text("\n".join(lines) + "\n")


def write_vicon(path: Path, recording: Recording) -> None:
    names = ("left", "right", "diabolo")
    bodies = ",," + ",,,,,,".join(f"{name}:{name}" for name in names) + ",,,,,"
    lines = ["Objects", f"{recording.rate:g}", bodies]
    lines.append("Frame,Sub Frame," + ",".join("RX,RY,RZ,TX,TY,TZ" for _ in names))
    lines.append(",," + ",".join("rad,rad,rad,mm,mm,mm" for _ in names))
    for i in range(len(recording)):
        cells = [str(i + 1), "0"]
        for name in names:
            turn, place = getattr(recording, f"{name}_orientation")[i], getattr(recording, name)[i] * 1e3
            if not np.isfinite(place[0]):
                cells += [""] * 6
                continue
            turn = turn if turn[3] >= 0.0 else -turn
            size = np.linalg.norm(turn[:3])
            vector = turn[:3] * (2.0 * np.arctan2(size, turn[3]) / size if size > 0.0 else 2.0)
            cells += [f"{x:.9f}" for x in (*vector, *place)]
        lines.append(",".join(cells))
    path.write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize(("name", "write"), [("take.tsv", write_qualisys), ("take.csv", write_vicon)])
def test_exports_of_other_motion_capture_are_read(
    swing: Recording, tmp_path: Path, name: str, write: Callable[[Path, Recording], None]
) -> None:
    write(tmp_path / name, swing)
    same(swing, load_recording(tmp_path / name), times=1e-6, places=1e-6)


def test_the_commands_take_them(swing: Recording, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bag, tidy = tmp_path / "take.mcap", tmp_path / "take.csv"
    assert main(["convert", str(SWING), str(bag)]) == 0
    assert main(["info", str(bag)]) == 0
    assert "bag" in capsys.readouterr().out
    assert main(["convert", str(bag), str(tidy)]) == 0
    same(load_recording(SWING), load_recording(tidy))
    assert main(["convert", f"{bag}:40-420", str(tidy)]) == 0
    same(swing, load_recording(tidy))
    assert main(["convert", f"{tidy}:0-9", str(tidy)]) == 2
    assert "take.csv: this file is read; choose another name" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "content", "complaint"),
    [
        (
            "take.mcap",
            b"no bag",
            "cannot be read as a bag of ROS (it begins with b'no bag'; expected the mark",
        ),
        ("take.mcap", b"", "cannot be read as a bag of ROS (it is empty; expected the mark of MCAP)"),
        ("take.db3", b"no bag", "cannot be read as a bag of ROS"),
        ("take.bag", b"", "cannot be read as a bag of ROS"),
        ("take.c3d", b"no c3d", "cannot be read as C3D"),
        ("take.parquet", b"PAR1", "cannot be read as Parquet"),
        ("take.tsv", b"NO_OF_FRAMES\t2\nFREQUENCY\t100\n", "no BODY_NAMES"),
        ("take.tsv", b"NO_OF_FRAMES\t2\nBODY_NAMES\ta\nX\n", "no FREQUENCY"),
        ("take.tsv", b"NO_OF_FRAMES\t2\nFREQUENCY\t100\nBODY_NAMES\ta\nX\tY\n1\t2\n", "columns of 0 bodies"),
        ("take.csv", b"Objects\n100\n", "line 2: found 'the end'; expected Objects, rate, names"),
        ("take.csv", b"Objects\nfast\na\nRX\nrad\n1\n", "line 2: found 'fast'; expected the rate"),
        ("take.csv", b"Objects\n100\n,,a\nF,S,RX,RY,RZ\n,,rad\n1,0,0,0,0\n", "3 cells'; expected 5 units"),
        ("take.csv", b"Objects\n100\n,,a\nF,S,RX,RY,RZ\n,,rad,,\n1,0,0,0,0\n", "expected a column TX of a"),
        (
            "take.csv",
            b"Objects\n100\n,,\nF,S,RX\n,,rad\n1,0,0\n",
            "line 3: found ',,'; expected the name of a",
        ),
    ],
)
def test_a_broken_file_ends_in_one_sentence(
    tmp_path: Path, name: str, content: bytes, complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / name).write_bytes(content)
    assert main(["info", str(tmp_path / name)]) == 2
    error = capsys.readouterr().err
    assert complaint in error and name in error and error.count("\n") == 1


@pytest.mark.parametrize(
    ("call", "complaint"),
    [
        (lambda folder: load_recording(folder), "a directory; expected a file, or a bag"),
        (lambda _: load_recording(SWING, topics=GIVEN), "topics are given; expected them of bags"),
        (
            lambda _: load_recording(SWING, arms=[StickArm("left"), StickArm("right")]),
            "arms are given; expected them of bags only",
        ),
        (lambda _: load_recording(SWING, topics="left"), "topics 'left'; expected left=NAME,right=NAME"),
        (lambda _: load_recording(SWING, topics={"middle": "a"}), "topics: found 'middle'; expected left"),
        (lambda _: load_recording(SWING, topics={"left": 5}), "topics: left: 5; expected a name"),
        (lambda _: load_recording(5), "path: 5; expected the name of a file"),  # type: ignore[arg-type]
        (lambda _: load_recording("a\0.mcap"), r"path: 'a\\x00.mcap'; expected the name of a file"),
        (lambda _: load_recording("a" * 5000), "path: 'aaa.*; expected the name of a file"),
        (lambda _: save_recording(load_recording(SWING), None), "path: None; expected the name of a file"),
        (lambda _: save_recording(load_recording(SWING), "a\0.csv"), "path: .*; expected the name of a file"),
        (lambda _: load_recording(SWING, up=5), "up: 5; expected the name of an axis"),
        (lambda _: load_recording(SWING, calibration=5), "calibration: 5; expected a Calibration"),
        (
            lambda folder: save_recording(load_recording(SWING), folder / "a.txt"),
            "expected a name that ends in",
        ),
        (
            lambda folder: save_recording(load_recording(SWING), folder / f"{'a' * 300}.mcap"),
            "a.mcap: cannot be written (File name too long",
        ),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path: Path, call: Callable[[Path], Any], complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint.replace("(", r"\(")):
        call(tmp_path)


def test_a_library_that_is_not_there_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "rerun", None)
    monkeypatch.setattr("diabolo.cli.arguments.load_recording", None)  # it is said before the work
    assert main(["convert", str(SWING), str(tmp_path / "a.rrd")]) == 2
    assert capsys.readouterr().err == (
        "diabolo: writing a.rrd: needs rerun (pip install '.[rerun]' in the project's root)\n"
    )


@pytest.mark.parametrize("option", [["--up", "y"], ["--arms", "0.7", "1.1", "0"]])
def test_a_built_in_motion_reads_no_recording(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], option: list[str]
) -> None:
    assert main(["simulate", str(tmp_path / "a.csv"), "--motion", "swing", *option]) == 2
    assert f"{option[0]}: it says how a recording is read; --motion reads none" in capsys.readouterr().err


def test_stamps_that_go_back_are_refused_with_the_body() -> None:
    body = Body("left", np.array([0, 2, 1]), np.zeros((3, 3)))
    with pytest.raises(RecordingError, match="left: stamp 1 ns does not come after the one before"):
        at_common_times(Path("bag"), [body], {})


def test_bodies_of_other_rates_are_interpolated_and_others_left_alone() -> None:
    fast, slow = np.arange(0, 101, 10) * 10**6, np.arange(0, 101, 20) * 10**6
    ramp = np.linspace(0.0, 1.0, len(slow))[:, None] * np.ones(3)
    bodies = [
        Body("left", slow, ramp),
        Body("right", slow, ramp),
        Body("diabolo", fast, np.ones((len(fast), 3))),
        Body("odom", np.array([5, 5]), np.zeros((2, 3))),
    ]
    time, tracks, of_a_clock = at_common_times(Path("bag"), bodies, {})
    assert not of_a_clock and [name for name, _, _ in tracks] == ["left", "right", "diabolo"]
    np.testing.assert_allclose(time, fast * 1e-9)
    np.testing.assert_allclose(tracks[0][1][:, 0], np.linspace(0.0, 1.0, len(fast)), atol=1e-12)


def test_bodies_of_several_frames_are_refused() -> None:
    one, other = (Body(name, np.arange(3), np.zeros((3, 3)), None, name) for name in ("left", "right"))
    with pytest.raises(RecordingError, match="left is in the frame 'left', right in 'right'"):
        at_common_times(Path("bag"), [one, other], {})


def test_dropouts_of_all_three_stay_dropouts(swing: Recording, tmp_path: Path) -> None:
    rng = np.random.default_rng(2531)
    places = [getattr(swing, name).copy() for name in ("left", "right", "diabolo")]
    for one in places:
        one[rng.random(len(swing)) < 0.1] = np.nan
    holed = Recording(swing.time, *places, swing.rate)
    save_recording(holed, tmp_path / "holed.mcap")
    again = load_recording(tmp_path / "holed.mcap")
    seen = np.isfinite(np.hstack(places)).any(axis=1)  # of a row with nothing in it nothing is written
    for name, one in zip(("left", "right", "diabolo"), places, strict=True):
        np.testing.assert_array_equal(getattr(again, name), one[seen])


def test_two_bodies_of_one_name_are_refused(tmp_path: Path) -> None:
    head = ["Objects", "100", ",,left,,,,,,left", "Frame,Sub Frame," + ",".join(["RX,RY,RZ,TX,TY,TZ"] * 2)]
    rows = [",," + ",".join(["rad,rad,rad,mm,mm,mm"] * 2), *(f"{k},0" + ",1" * 12 for k in range(3))]
    (tmp_path / "a.csv").write_text("\n".join([*head, *rows]) + "\n")
    with pytest.raises(RecordingError, match="two bodies are named 'left'"):
        load_recording(tmp_path / "a.csv")


def test_a_name_in_bytes_that_are_no_text_is_read(swing: Recording, tmp_path: Path) -> None:
    path = os.fsencode(tmp_path) + b"/b\xe9.mcap"
    save_recording(swing, path)
    again = load_recording(path)
    same(swing, again)
    assert again.name == "b\ufffd"


@pytest.mark.parametrize("arguments", [["info", "a\0.csv"], ["convert", "a.csv", "b\0.csv"]])
def test_a_name_that_no_file_can_have_is_told(
    capsys: pytest.CaptureFixture[str], arguments: list[str]
) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(arguments)
    error = capsys.readouterr().err
    assert "\\x00.csv': a zero byte in it; expected text" in error and error.count("\n") == 1


@pytest.mark.parametrize("name", [b"pl\xe9.csv", b"pl\xe9.parquet", b"pl\xe9.c3d", b"none\xe9.mcap"])
def test_other_names_in_bytes_that_are_no_text_are_refused(
    swing: Recording, tmp_path: Path, name: bytes
) -> None:
    path = os.fsencode(tmp_path) + b"/" + name
    if name.startswith(b"pl"):
        with open(path, "wb") as file:
            file.write(b"time\n")
    with pytest.raises(RecordingError, match=r"\\udce9.*not UTF-8; expected a name that is"):
        load_recording(path)
    if name.endswith((b".csv", b".parquet")):
        with pytest.raises(RecordingError, match=r"\\udce9.*not UTF-8; expected a name that is"):
            save_recording(swing, path)


def test_what_is_read_is_not_written_over(swing: Recording, tmp_path: Path) -> None:
    bag = tmp_path / "bag"
    write_bag(bag, swing, TOPICS, {})
    [kept] = bag.glob("*.db3")
    before = kept.read_bytes()
    assert main(["convert", str(bag), str(bag / "take.mcap"), "--topics", GIVEN]) == 2
    assert kept.read_bytes() == before and not (bag / "take.mcap").exists()
    assert len(input_file(bag).sha256) == 64


def test_a_table_without_numbers_says_so(tmp_path: Path) -> None:
    import pyarrow
    import pyarrow.parquet

    pyarrow.parquet.write_table(
        pyarrow.table({"time": ["0.0"], "left_x": ["1.0"]}), tmp_path / "take.parquet"
    )
    with pytest.raises(RecordingError, match=r"take\.parquet: no column of numbers; it has 'time', 'left_x'"):
        load_recording(tmp_path / "take.parquet")


@pytest.mark.parametrize("unit", ["us", "ns"])
def test_a_column_of_date_and_time_is_counted_from_the_first_row(
    swing: Recording, tmp_path: Path, unit: str
) -> None:
    import pyarrow
    import pyarrow.parquet

    path = tmp_path / "take.parquet"
    save_recording(swing, path)
    table = pyarrow.parquet.read_table(path)
    ticks = np.rint((1.7e9 + table["time"].to_numpy()) * {"us": 1e6, "ns": 1e9}[unit]).astype(np.int64)
    stamps = pyarrow.array(ticks).cast(pyarrow.timestamp(unit, "UTC"))
    pyarrow.parquet.write_table(table.set_column(0, "zeit", stamps), path)
    same(swing, load_recording(path, columns="time=zeit"), times=5e-7)
    with pytest.raises(RecordingError, match="column 'zeit' has stamps of date and time; expected no unit"):
        load_recording(path, columns="time=zeit[ms]")


def test_points_stay_points(swing: Recording, tmp_path: Path) -> None:
    bare = Recording(swing.time, swing.left, swing.right, swing.diabolo, swing.rate)
    save_recording(bare, tmp_path / "bare.mcap")
    again = load_recording(tmp_path / "bare.mcap")
    assert again.diabolo_orientation is None and again.left_orientation is None
    same(bare, again)


def test_messages_of_all_kinds_are_read(tmp_path: Path) -> None:
    from diabolo.formats.cdr import FLOATS, read_alike
    from diabolo.formats.messages import ROWS_OF
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    types = store.types
    header = types["std_msgs/msg/Header"](types["builtin_interfaces/msg/Time"](1, 2), "world")
    point, vector = (types[f"geometry_msgs/msg/{name}"](1.0, 2.0, 3.0) for name in ("Point", "Vector3"))
    turn = types["geometry_msgs/msg/Quaternion"](0.0, 0.6, 0.0, 0.8)
    pose, moved = (
        types["geometry_msgs/msg/Pose"](point, turn),
        types["geometry_msgs/msg/Transform"](vector, turn),
    )
    twist = types["geometry_msgs/msg/Twist"](vector, vector)
    many = np.zeros(36)
    covered = types["geometry_msgs/msg/PoseWithCovariance"](pose, many)
    stamped = types["geometry_msgs/msg/TransformStamped"](header, "top", moved)
    messages = {
        "geometry_msgs/msg/PoseStamped": types["geometry_msgs/msg/PoseStamped"](header, pose),
        "geometry_msgs/msg/PointStamped": types["geometry_msgs/msg/PointStamped"](header, point),
        "geometry_msgs/msg/PoseWithCovarianceStamped": types["geometry_msgs/msg/PoseWithCovarianceStamped"](
            header, covered
        ),
        "nav_msgs/msg/Odometry": types["nav_msgs/msg/Odometry"](
            header, "top", covered, types["geometry_msgs/msg/TwistWithCovariance"](twist, many)
        ),
        "geometry_msgs/msg/TransformStamped": stamped,
        "tf2_msgs/msg/TFMessage": types["tf2_msgs/msg/TFMessage"]([stamped]),
    }
    for kind, message in messages.items():
        [(name, head, numbers)] = ROWS_OF[kind]("topic", message)
        raw = bytes(store.serialize_cdr(message, kind))
        if (alike := read_alike(kind, [raw, raw])) is not None:
            assert alike.stamps.tolist() == [10**9 + 2] * 2 and alike.frames == {"world"}
            np.testing.assert_array_equal(alike.numbers, [numbers] * 2)
            assert read_alike(kind, [raw, raw[:-8]]) is None and read_alike(kind, [b"\0\0" + raw[2:]]) is None
        assert (alike is None) == (kind not in FLOATS)
        assert name == ("top" if kind.split("/")[-1] in ("TransformStamped", "TFMessage") else "topic")
        assert head.frame_id == "world"
        assert numbers == ((1.0, 2.0, 3.0) if "Point" in kind else (1.0, 2.0, 3.0, 0.0, 0.6, 0.0, 0.8))


LIKE = '{"mass": 0.2, "diameter": 0.1, "length": 0.1, "axle_radius": 0.006}'


@pytest.mark.parametrize(
    ("metadata", "complaint"),
    [
        ([{}], "no 'setup'"),
        ([{"setup": "[1]"}], r"setup: \[1\]; expected an object"),
        ([{"setup": f'{{"diabolo": {LIKE}}}'}], "no 'string_length'"),
        ([{"setup": f'{{"diabolo": {LIKE}, "string_length": 1.4}}'}] * 2, "2 records of them; expected one"),
        (
            [{"setup": f'{{"diabolo": {LIKE}, "string_length": 1.4, "assumed": ["mass"]}}'}],
            'setup: assumed: "mass"; expected "string_length" or "diabolo", each once',
        ),
    ],
)
def test_metadata_that_lack_what_they_promise_say_so(
    tmp_path: Path, metadata: list[dict[str, str]], complaint: str
) -> None:
    from diabolo.formats.bag import SCHEMA, setup_of
    from mcap.writer import Writer

    with open(tmp_path / "take.mcap", "wb") as file:
        writer = Writer(file)
        writer.start()
        for one in metadata:
            writer.add_metadata(SCHEMA, one)
        writer.finish()
    with pytest.raises(RecordingError, match=rf"cannot be read as a bag with metadata of .* \({complaint}\)"):
        setup_of(tmp_path / "take.mcap", tmp_path / "take.mcap")


def test_a_bag_without_poses_says_so(tmp_path: Path) -> None:
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/talk", "std_msgs/msg/String", typestore=store)
        text = store.types["std_msgs/msg/String"]("hello")
        writer.write(connection, 1, store.serialize_cdr(text, "std_msgs/msg/String"))
    with pytest.raises(RecordingError, match="no poses in it; expected messages of geometry_msgs"):
        load_recording(tmp_path / "bag")


def test_a_quarter_turn_of_qualisys_is_one_to_the_left(tmp_path: Path) -> None:
    own = "X\tY\tZ\tRoll\tPitch\tYaw\tResidual\t" + "\t".join(f"Rot[{k}]" for k in range(9))
    lines = ["NO_OF_FRAMES\t2", "FREQUENCY\t100", "BODY_NAMES\tleft", own]
    row = "1000\t0\t0\t0\t0\t90\t0.1\t0\t1\t0\t-1\t0\t0\t0\t0\t1"  # the columns of the matrix, in turn
    (tmp_path / "a.tsv").write_text("\n".join([*lines, row, row]) + "\n\n")
    [body], _ = qualisys.read(tmp_path / "a.tsv")
    np.testing.assert_allclose(body.position[0], [1.0, 0.0, 0.0])
    np.testing.assert_allclose(body.orientation[0], [0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)], atol=1e-12)


def test_vicon_may_give_degrees_or_a_quaternion_and_skip_frames(tmp_path: Path) -> None:
    degrees = ["Objects", "100", ",,a:a", "Frame,Sub Frame,RX,RY,RZ,TX,TY,TZ", ",,deg,deg,deg,mm,mm,mm"]
    quaternion = ["Objects", "100", ",,a:a", "Frame,Sub Frame,RX,RY,RZ,RW,TX,TY,TZ", ",,,,,,cm,cm,cm"]
    for head, row in ((degrees, "0,0,0,90,100,0,0"), (quaternion, "0,0,0,0.70710678,0.70710678,10,0,0")):
        rows = [f"{frame},{row}" for frame in (1, 2, 5)]
        (tmp_path / "a.csv").write_text("\n".join([*head, *rows]) + "\n")
        [body], _ = vicon.read(tmp_path / "a.csv")
        np.testing.assert_allclose(np.diff(body.stamps), [10_000_000, 30_000_000])
        np.testing.assert_allclose(body.position[0], [0.1, 0.0, 0.0])
        np.testing.assert_allclose(body.orientation[0], [0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)], atol=1e-7)


def test_each_column_of_vicon_has_its_own_unit(tmp_path: Path) -> None:
    lines = ["Objects", "100", ",,a:a", "Frame,Sub Frame,RX,RY,RZ,TX,TY,TZ", ",,deg,rad,deg,mm,m,cm"]
    (tmp_path / "a.csv").write_text(
        "\n".join([*lines, "1,0,0,0,90,100,0.2,30", "2,0,0,0,90,100,0.2,30"]) + "\n"
    )
    [body], _ = vicon.read(tmp_path / "a.csv")
    np.testing.assert_allclose(body.position[0], [0.1, 0.2, 0.3])
    np.testing.assert_allclose(body.orientation[0], [0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)], atol=1e-7)


NEXUS = """\
Devices
1000
,,Force Plate 1 - Force,,
Frame,Sub Frame,Fx,Fy,Fz
,,N,N,N
1,0,0.1,0.2,broken

Segments
100
,,Play:left,,,,,,Play:top
Frame,Sub Frame,RX,RY,RZ,TX,TY,TZ,RX,RY,RZ,TX,TY,TZ
,,rad,rad,rad,mm,mm,mm,rad,rad,rad,mm,mm,mm
1,0,0,0,0,100,0,0,0,0,0,500,0,0
2,0,0,0,0,200,0,0,0,0,0,500,0,0

Model Outputs
100
,,Play:Elbow,,,Play:middle,,
Frame,Sub Frame,X,Y,Z,X,Y,Z
,,deg,deg,deg,mm,mm,mm
1,0,1,2,3,10,20,30
2,0,1,2,3,10,20,30

Trajectories
200
,,Play:right,,,,,,A:top,,,*11,,
Frame,Sub Frame,X,Y,Z,X',Y',Z',X,Y,Z,X,Y,Z
,,cm,cm,cm,cm/s,cm/s,cm/s,mm,mm,mm,mm,mm,mm
1,0,10,20,30,0,0,0,1,2,3,,,
2,0,,,,,,,1,2,3,,,
3,0,10,20,50,0,0,0,1,2,3,,,
"""


def test_sections_of_vicon_stand_in_one_file(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(NEXUS)
    found = {body.name: body for body in vicon.read(tmp_path / "a.csv")[0]}
    assert found.keys() == {"left", "Play:top", "middle", "right", "A:top", "*11"}
    np.testing.assert_allclose(found["left"].position, [[0.1, 0.0, 0.0], [0.2, 0.0, 0.0]])
    np.testing.assert_allclose(found["left"].orientation, [[0.0, 0.0, 0.0, 1.0]] * 2)
    np.testing.assert_allclose(found["middle"].position, [[0.01, 0.02, 0.03]] * 2)
    np.testing.assert_allclose(found["right"].position, [[0.1, 0.2, 0.3], [np.nan] * 3, [0.1, 0.2, 0.5]])
    assert found["right"].orientation is None and np.isnan(found["*11"].position).all()
    assert found["right"].stamps.tolist() == [5_000_000, 10_000_000, 15_000_000]
    (tmp_path / "b.csv").write_text(NEXUS[: NEXUS.index("Segments")])
    with pytest.raises(RecordingError, match=r"b.csv: no bodies or points; expected some in Objects, Segm"):
        load_recording(tmp_path / "b.csv")


@pytest.mark.parametrize(
    ("was", "now", "complaint"),
    [
        ("2,0,0,0,0,200", "2,0,0,0,0,twenty", "line 14, cell 6: found 'twenty'; expected a number"),
        (",,cm,cm,cm", ",,N,N,N", "line 28: found 'N'; expected mm or cm or m below X of Play:right"),
        ("Trajectories\n200", "Trajectories\n", "line 25: found ''; expected the rate"),
        ("2,0,0,0,0,200", "2,0,inf,0,0,0", "line 14, cell 3: found 'inf'; expected a number within 1e\\+12"),
        ("2,0,0,0,0,200", "2,0,1_0,0,0,0", "line 14, cell 3: found '1_0'; expected a number within 1e\\+12"),
        ("2,0,0,0,0,200", "2,0,٣,0,0,0", "line 14, cell 3: found '٣'; expected a number within 1e\\+12"),
        ("\n2,0,,,", "\n1e12,0,,,", "row 2: time 5e\\+09 s; expected one within 1e\\+09 s"),
        ("3,0,10,20", "1,0,10,20", "right: stamp 5000000 ns does not come after the one before"),
        ("Model Outputs\n100", "Model Outputs\n0", "0 frames per second; expected 0.001 to 1e6"),
    ],
)
def test_a_section_of_vicon_that_is_broken_is_told_with_its_line(
    tmp_path: Path, was: str, now: str, complaint: str
) -> None:
    assert was in NEXUS
    (tmp_path / "a.csv").write_text(NEXUS.replace(was, now))
    with pytest.raises(RecordingError, match=complaint):
        load_recording(tmp_path / "a.csv", topics={"left": "left", "right": "right", "diabolo": "Play:top"})


def test_a_point_cannot_have_a_tip_elsewhere() -> None:
    from diabolo._core import recording_of_bodies

    place = np.ones((3, 3))
    bodies = [(name, place, None) for name in ("stick_left", "stick_right", "diabolo_red")]
    with pytest.raises(
        RecordingError, match='"stick_left" has no orientation, but the calibration has a point'
    ):
        recording_of_bodies("file", np.arange(3.0), bodies, [], Calibration.published(), None)
