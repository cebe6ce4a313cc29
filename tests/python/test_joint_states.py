# SPDX-License-Identifier: MIT
"""Joint states of two arms in a bag, read as the sticks that they hold."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from diabolo import Recording, RecordingError, load_recording, robot
from diabolo.cli import main
from diabolo.robot import JOINTS
from numpy.typing import NDArray

pytest.importorskip("rosbags")

SIDES = ("left", "right")
WHERE = {"height": 0.75, "spacing": 1.05, "forward": -0.1}
MOUNTS = [robot.StickArm(side, **WHERE) for side in SIDES]
NAMES = {side: [f"{side}_{joint}" for joint in JOINTS] for side in SIDES}

Joints = Mapping[str, NDArray[np.float64]]


@pytest.fixture(scope="module")
def played() -> tuple[Recording, Joints]:
    """Tips that two arms can reach, with a diabolo under them, and the joints that the planner finds."""
    t = np.arange(400) / 200.0
    tips, joints = {}, {}
    for arm, way in zip(MOUNTS, (1.0, -1.0), strict=True):
        up = 0.05 * np.sin(5.0 * t) * way
        tips[arm.side] = np.stack(
            [0.4 + 0.03 * np.sin(3.0 * t), np.full_like(t, 0.3 * way), 1.25 + up], axis=1
        )
        joints[arm.side], faults = robot.StickMap(arm, robot.SeedGrid.build(arm)).solve(tips[arm.side])
        assert not faults.any()
    below = 0.5 * (tips["left"] + tips["right"]) - [0.0, 0.0, 0.66]
    return Recording(t, tips["left"], tips["right"], below, 200.0), joints


def write(
    folder: Path, recording: Recording, topics: Mapping[str, tuple[list[str], NDArray[np.float64]]]
) -> None:
    """A bag with the diabolo on /mocap/diabolo, and of each topic the names of joints and their angles."""
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    types = store.types
    point, state = "geometry_msgs/msg/PointStamped", "sensor_msgs/msg/JointState"
    with Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        top = writer.add_connection("/mocap/diabolo", point, typestore=store)
        arms = {topic: writer.add_connection(topic, state, typestore=store) for topic in topics}
        for i, time in enumerate(recording.time):
            stamp = round(time * 1e9) + 10**9
            clock = types["builtin_interfaces/msg/Time"](stamp // 10**9, stamp % 10**9)
            place = types["geometry_msgs/msg/Point"](*recording.diabolo[i].tolist())
            message = types[point](types["std_msgs/msg/Header"](clock, "world"), place)
            writer.write(top, stamp, store.serialize_cdr(message, point))
            for topic, (names, angles) in topics.items():
                header = types["std_msgs/msg/Header"](clock, "base_link")
                message = types[state](header, names, angles[i].copy(), np.zeros(0), np.zeros(0))
                writer.write(arms[topic], stamp, store.serialize_cdr(message, state))


def together(joints: Joints) -> tuple[list[str], NDArray[np.float64]]:
    """Both arms' in one message, in the order of the alphabet and with a gripper's, as ROS 2 merges them."""
    names = [*NAMES["left"], *NAMES["right"], "left_finger_joint"]
    angles = np.hstack([joints["left"], joints["right"], np.zeros((len(joints["left"]), 1))])
    order = np.argsort(names)
    return [names[k] for k in order], angles[:, order]


def test_tips_come_back_from_the_joints(played: tuple[Recording, Joints], tmp_path: Path) -> None:
    recording, joints = played
    own = {f"/{side}/joint_states": ([*JOINTS], joints[side]) for side in SIDES}
    bags = {"one": {"/joint_states": together(joints)}, "two": own}
    for name, topics in bags.items():
        write(tmp_path / name, recording, topics)
        found = load_recording(tmp_path / name, arms=MOUNTS)
        for side, arm in zip(SIDES, MOUNTS, strict=True):
            tips = getattr(found, side)
            np.testing.assert_allclose(tips, getattr(recording, side), rtol=0.0, atol=1e-9)
            x, y, z, w = getattr(found, f"{side}_orientation").T
            along = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)], axis=1)
            flange = arm.flange(joints[side])[:, :3, 3] @ arm.base[:3, :3].T + arm.base[:3, 3]
            stick = (tips - flange) / np.linalg.norm(tips - flange, axis=1, keepdims=True)
            np.testing.assert_allclose(along, stick, atol=1e-9)
        np.testing.assert_allclose(found.diabolo, recording.diabolo, rtol=0.0, atol=1e-12)


def test_topics_choose_the_arm_and_its_mounts_are_an_option(
    played: tuple[Recording, Joints], tmp_path: Path
) -> None:
    recording, joints = played
    wanted = {side: (NAMES[side], joints[side]) for side in SIDES}
    aims = {side: (NAMES[side], np.zeros((len(recording), 6))) for side in SIDES}
    topics = {
        f"/{kind}/{side}": each[side] for kind, each in (("is", wanted), ("aim", aims)) for side in SIDES
    }
    write(tmp_path / "bag", recording, topics)
    bag, tidy = str(tmp_path / "bag"), str(tmp_path / "take.csv")
    with pytest.raises(RecordingError, match="/aim/left:left"):  # which of two is not said
        load_recording(bag)
    given = "left=/is/left:left,right=/is/right:right,diabolo=/mocap/diabolo"
    assert main(["convert", bag, tidy, "--topics", given, "--arms", *map(str, WHERE.values())]) == 0
    np.testing.assert_allclose(load_recording(tidy).left, recording.left, rtol=0.0, atol=1e-9)


def test_joints_of_others_are_left_alone(played: tuple[Recording, Joints], tmp_path: Path) -> None:
    recording, joints = played
    topics = {"/gripper": (["left_finger"], np.zeros((len(recording), 1)))}
    topics |= {"/broken": (["left_elbow_joint"], np.zeros((len(recording), 1)))}
    topics |= {f"/{side}/joints": ([*JOINTS], joints[side]) for side in SIDES}
    write(tmp_path / "bag", recording, topics)
    given = {side: f"/{side}/joints:{side}" for side in SIDES} | {"diabolo": "/mocap/diabolo"}
    found = load_recording(tmp_path / "bag", topics=given, arms=MOUNTS)
    np.testing.assert_allclose(found.left, recording.left, rtol=0.0, atol=1e-9)
    with pytest.raises(RecordingError, match="/broken: no angle of left_shoulder_pan_joint"):
        load_recording(tmp_path / "bag", arms=MOUNTS)  # which of them is not said


def test_joints_of_arms_that_hold_a_diabolo_may_be_on_topics_with_its_name(
    played: tuple[Recording, Joints], tmp_path: Path
) -> None:
    recording, joints = played
    topics = {f"/diabolo/{side}/joints": ([*JOINTS], joints[side]) for side in SIDES}
    write(tmp_path / "bag", recording, topics)
    given = {side: f"/diabolo/{side}/joints:{side}" for side in SIDES} | {"diabolo": "/mocap/diabolo"}
    found = load_recording(tmp_path / "bag", topics=given, arms=MOUNTS)
    np.testing.assert_allclose(found.left, recording.left, rtol=0.0, atol=1e-9)


def test_joint_states_without_positions_are_left_alone(
    played: tuple[Recording, Joints], tmp_path: Path
) -> None:
    recording, joints = played
    tension = (["left", "right"], np.zeros((len(recording), 0)))
    write(tmp_path / "bag", recording, {"/diabolo/tension": tension, "/joint_states": together(joints)})
    np.testing.assert_allclose(
        load_recording(tmp_path / "bag", arms=MOUNTS).left, recording.left, rtol=0.0, atol=1e-9
    )
    fingers = (["finger"], np.zeros((len(recording), 1)))
    write(tmp_path / "other", recording, {"/diabolo/tension": tension, "/gripper": fingers})
    with pytest.raises(RecordingError, match="/gripper: joints 'finger'; expected left_shoulder_pan"):
        load_recording(tmp_path / "other")


def test_degrees_are_refused(played: tuple[Recording, Joints], tmp_path: Path) -> None:
    recording, joints = played
    names, angles = together(joints)
    write(tmp_path / "bag", recording, {"/joint_states": (names, np.degrees(angles))})
    with pytest.raises(RecordingError, match=r"/joint_states: left_.* is .*; expected rad, within 2 pi"):
        load_recording(tmp_path / "bag", arms=MOUNTS)


def test_what_is_not_finite_is_a_dropout(played: tuple[Recording, Joints], tmp_path: Path) -> None:
    recording, joints = played
    names, angles = together(joints)
    angles = angles.copy()
    angles[7, names.index("left_elbow_joint")] = np.nan
    write(tmp_path / "bag", recording, {"/joint_states": (names, angles)})
    found = load_recording(tmp_path / "bag", arms=MOUNTS)
    assert np.flatnonzero(np.isnan(found.left[:, 0])).tolist() == [7]
    assert np.isfinite(found.right).all()


@pytest.mark.parametrize(
    ("names", "complaint"),
    [
        (
            [*NAMES["left"], *NAMES["right"][:5], "right_tool", "finger"],
            "/joint_states: no angle of right_wrist_3_joint; expected right_shoulder_pan_joint to",
        ),
        (
            [f"{side}_{k}" for side in SIDES for k in range(6)],
            "/joint_states: joints 'left_0', 'left_1', .*; expected left_shoulder_pan_joint to right_wrist_3",
        ),
        ([*NAMES["left"], *NAMES["right"]], "/joint_states: 13 positions of 12 joints; expected one of each"),
        (
            [*NAMES["left"], *NAMES["right"], "right_elbow_joint"],
            "/joint_states: right_elbow_joint is named twice; expected each joint once",
        ),
        ([], "/joint_states: joints none; expected"),
    ],
)
def test_joints_that_are_missing_or_unknown_are_named(
    played: tuple[Recording, Joints], tmp_path: Path, names: list[str], complaint: str
) -> None:
    recording, joints = played
    write(tmp_path / "bag", recording, {"/joint_states": (names, together(joints)[1])})
    with pytest.raises(RecordingError, match=complaint):
        load_recording(tmp_path / "bag")


@pytest.mark.parametrize(
    ("arms", "complaint"),
    [
        (MOUNTS[::-1], r"arms: \['right', 'left'\]; expected one of the left"),
        (MOUNTS[0], r"arms: <StickArm .*; expected one|arms: \['left'\]; expected one of the left"),
        ("left", "arms: 'left'; expected two StickArm"),
    ],
)
def test_arms_are_two(tmp_path: Path, arms: object, complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint):
        load_recording(tmp_path / "bag", arms=arms)  # type: ignore[arg-type]


def test_mounts_that_cannot_be_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["info", str(tmp_path / "bag"), "--arms", "0.7", "-1", "0"]) == 2
    assert "spacing: -1" in capsys.readouterr().err
