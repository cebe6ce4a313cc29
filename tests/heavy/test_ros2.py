# SPDX-License-Identifier: MIT
"""The node of ROS 2 in a process of its own; this one is its peer, over DDS on the loopback."""

from __future__ import annotations

import math
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from diabolo import Model, Predictor, TipMotion, hang_at_rest, load_recording
from diabolo.cli import main

rclpy = pytest.importorskip("rclpy", reason="ROS 2 is not installed: make ros2")

pytestmark = [
    pytest.mark.ros2,
    pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning"),  # of a library of rclpy's
]
ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples" / "ros2"
SWING = ROOT / "data" / "recordings" / "swing.csv"
sys.path.insert(0, str(EXAMPLES))
FIRST = 100_000_000_000  # stamp [ns]
RATE = 500.0


@pytest.fixture(scope="module", autouse=True)
def ros() -> Iterator[None]:
    domain = str(random.SystemRandom().randrange(1, 100))
    print("ROS_DOMAIN_ID", domain)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_DOMAIN_ID", domain)
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        patch.setenv("FASTDDS_DEFAULT_PROFILES_FILE", str(EXAMPLES / "loopback.xml"))
        rclpy.init()
        yield
        rclpy.try_shutdown()


@contextmanager
def running(program: str, *arguments: object, log: Path | None = None) -> Iterator[subprocess.Popen[bytes]]:
    """A program of the examples; what it says goes to a log, and is shown where a test fails."""
    command = [sys.executable, str(EXAMPLES / program), *map(str, arguments)]
    with log.open("w+") if log else tempfile.TemporaryFile("w+") as said:
        process = subprocess.Popen(command, stdout=said, stderr=said)
        try:
            yield process
        finally:
            process.kill()
            process.wait()
            said.seek(0)
            print(f"{program}, status {process.returncode}:\n{said.read()}")


def node(log: Path | None = None, **parameters: object):
    given = [word for name, value in parameters.items() for word in ("-p", f"{name}:={value}")]
    return running("diabolo_node.py", *(["--ros-args", *given] if given else []), log=log)


def end(process: subprocess.Popen[bytes], by: int = signal.SIGTERM) -> int:
    process.send_signal(by)
    return process.wait(20)


@contextmanager
def meter() -> Iterator[object]:
    from latency import Meter
    from session import executor_of

    peer = Meter()
    try:
        with executor_of(peer):
            yield peer
    finally:
        peer.destroy_node()


def meet(peer: object) -> None:
    """Wait for the node: a player waits for whom it plays to, and not for who hears the poses."""
    wait_for(lambda: peer.count_publishers("diabolo/pose") > 0, lambda: time.sleep(0.02))


def hear(peer: object, stamp: int = 1) -> None:
    """Wait for a pose of this stamp [ns] or a later one."""
    wait_for(lambda: peer.last >= stamp, lambda: peer.executor.spin_once(0.02))


def swing(seconds: float) -> tuple[TipMotion, np.ndarray]:
    """A motion of the tips, and its times."""
    import latency

    times = np.arange(int(seconds * RATE)) / RATE
    return latency.swing(times), times


def played(peer: object, motion: TipMotion, times: np.ndarray) -> None:
    """Sent by the peer, and all of it is answered as the plain predictor says."""
    from senders import TipSender

    peer.measure(TipSender(peer, motion, times), times, FIRST)
    assert peer.lost == 0
    left, right = motion.at(times)[:2]
    np.testing.assert_allclose(places(peer.poses), predicted(left, right)[:, :3], rtol=0.0, atol=1e-9)


def predicted(left: np.ndarray, right: np.ndarray, spin: float = 100.0) -> np.ndarray:
    """States of the plain predictor below tips that come at RATE, from rest, (N, 7)."""
    model = Model.consistent()
    predictor, state = Predictor(model), hang_at_rest(model, left[0], right[0], spin)
    path = [state.to_array()]
    for i in range(1, len(left)):
        predictor.step(state, left[i - 1], right[i - 1], left[i], right[i], 1.0 / RATE)
        path.append(state.to_array())
    return np.array(path)


def places(poses: dict) -> np.ndarray:
    points = [poses[stamp].pose.position for stamp in sorted(poses)]
    return np.array([[p.x, p.y, p.z] for p in points])


def test_at_500_hz_nothing_is_lost_and_the_poses_are_the_predictor_s() -> None:
    with node(), meter() as peer:
        played(peer, *swing(10.0))
        print("median delay [ms]:", 1e3 * np.median(peer.delays))
        assert np.quantile(peer.delays, 0.1) < 0.2  # others may keep the machine busy


@pytest.mark.parametrize("by", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_amidst_play_ends_it_cleanly(by: int, tmp_path: Path) -> None:
    with node(tmp_path / "log") as process, meter() as peer:
        meet(peer)
        with running("play.py", SWING, "--rate", RATE) as player:
            hear(peer)
            assert player.poll() is None
            assert end(process, by) == 0
    assert (tmp_path / "log").read_text() == ""


def test_a_killed_peer_is_survived(tmp_path: Path) -> None:
    with node(tmp_path / "log") as process, meter() as peer:
        meet(peer)
        with running("play.py", SWING) as killed:
            hear(peer)
            assert killed.poll() is None
        played(peer, *swing(2.0))
        assert end(process) == 0
    assert "stamps jump: -" in (tmp_path / "log").read_text()


def wait_for(done: Callable[[], bool], idle: Callable[[], object], seconds: float = 60.0) -> None:
    limit = time.monotonic() + seconds
    while not done():
        assert time.monotonic() < limit, "nothing happened"
        idle()


def test_bad_poses_are_warned_of_once_and_change_nothing(tmp_path: Path) -> None:
    from geometry_msgs.msg import PoseStamped
    from senders import TipSender, header_of, wait_until_heard, wait_until_taken
    from session import QUALITY

    motion, times = swing(1.0)
    bad = [PoseStamped(header=header_of(FIRST, frame)) for frame in ("world", "map", "world", "world")]
    bad[0].pose.position.x = float("nan")
    bad[2].pose.orientation.w = 0.5
    bad[3].header = header_of(60 * FIRST, "world")  # a good one for the node, which waits for the other tip
    bag, said = tmp_path / "take.mcap", tmp_path / "recorded"
    with (
        node(tmp_path / "log") as process,
        running("record.py", bag, log=said) as recorder,
        meter() as peer,
    ):
        output = peer.create_publisher(PoseStamped, "left_tip", QUALITY)
        wait_until_heard([output], 2)
        for message in bad * 5:
            output.publish(message)
        wait_until_taken([output])
        played(peer, motion, times)
        late = TipSender(peer, motion, times)
        wait_until_heard(late.outputs, 2)
        last = FIRST + round(1e9 * times[-1])
        for i in range(3):
            late.send(i, last - 10_000_000 * i)
        late.send(3, last + 2_000_000)
        hear(peer, last + 2_000_000)
        wait_until_taken(late.outputs)
        assert end(process) == 0
        assert end(recorder) == 0, said.read_text()
    bad_kinds = ["left_tip, position", "left_tip, frame", "left_tip, orientation"]
    warned_of((tmp_path / "log").read_text(), *bad_kinds, "late stamps")
    warned_of(said.read_text(), *bad_kinds, "left_tip, stamp")
    assert bag.exists()


def warned_of(log: str, *kinds: str) -> None:
    """Each once, and how often at the end."""
    for kind in kinds:
        said = [line for line in log.splitlines() if kind in line]
        assert len(said) == 2, log
        assert said[1].endswith(" times in all")


def test_joints_of_two_arms_move_the_tips(tmp_path: Path) -> None:
    from diabolo.robot import StickArm
    from senders import JointSender, header_of, wait_until_heard
    from sensor_msgs.msg import JointState

    times = np.arange(500) / RATE
    beat = 0.05 * (1.0 - np.cos(2.0 * np.pi * times))
    left = np.stack([np.full_like(times, 0.6), np.full_like(times, 0.45), 1.2 + beat], axis=1)
    right = left * [1.0, -1.0, 1.0]
    with node(tmp_path / "log", source="joints") as process, meter() as peer:
        sender = JointSender(peer, TipMotion(times, left, right), times)
        wait_until_heard(sender.outputs)
        sender.outputs[0].publish(
            JointState(header=header_of(FIRST), name=["left_shoulder_pan_joint"], position=[0.0])
        )
        peer.measure(sender, times, FIRST)
        assert peer.lost == 0
        assert end(process) == 0
    joints = np.split(np.array(sender.rows), 2, axis=1)
    tips = [StickArm(side).tip_position(row) for side, row in zip(("left", "right"), joints, strict=True)]
    np.testing.assert_allclose(tips, [left, right], rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(places(peer.poses), predicted(*tips)[:, :3], rtol=0.0, atol=1e-9)
    assert (tmp_path / "log").read_text().count("joints missing: no angle of left_shoulder_lift_joint") == 1


@pytest.mark.parametrize(
    ("count", "angles", "sentence"),
    [
        (12, [0.1] * 11, "joints: 11 positions of 12 joints; expected one of each"),
        (13, [0.1] * 13, "joints twice: left_shoulder_pan_joint is named twice; expected each joint once"),
        (12, [0.1, 90.0] + [0.1] * 10, "left_shoulder_lift_joint is 90; expected rad"),
        (12, [0.1, math.nan] + [0.1] * 10, "left_shoulder_lift_joint is nan; expected rad"),
    ],
)
def test_joints_that_are_not_one_angle_each_are_refused(
    count: int, angles: list[float], sentence: str
) -> None:
    from diabolo.robot import StickArm
    from sensor_msgs.msg import JointState
    from tips import JOINTS, SIDES, JointTips, MessageError

    arms = JointTips([StickArm(side) for side in SIDES], JOINTS)
    with pytest.raises(MessageError, match=sentence):
        arms.tips_of(JointState(name=[*JOINTS, *JOINTS][:count], position=angles))


def test_tips_are_paired_by_their_stamps_whatever_is_lost() -> None:
    from tips import Tip, TipPairs

    seed = random.SystemRandom().randrange(10**6)
    print("seed", seed)
    rng = random.Random(seed)
    stamps = {side: [i for i in range(500) if rng.random() < 0.8] for side in ("left", "right")}
    wanted = sorted({*stamps["left"]} & {*stamps["right"]})
    pairs, found = TipPairs(), []
    while sides := [side for side, left in stamps.items() if left]:
        side = rng.choice(sides)
        stamp = stamps[side].pop(0)
        if tips := pairs.add(side, stamp, Tip(np.full(3, stamp), np.full(3, len(side)))):
            assert [tip.place[0] for tip in tips] == [stamp, stamp]
            assert [tip.direction[0] for tip in tips] == [4, 5]  # left, right
            found.append(stamp)
    assert found == wanted


def meet_recorder(peer: object, log: Path) -> None:
    """Wait until a recorder hears the node: it warns of poses two hours after the first one, and keeps
    none of them. The first one is played again."""
    from senders import TipSender, wait_until_heard

    sender, late = TipSender(peer, *swing(0.2)), FIRST + 2 * 3600 * 10**9
    wait_until_heard(sender.outputs, 2)
    sender.send(0, FIRST)

    def play_late() -> None:
        nonlocal late
        late += 20_000_000
        sender.send(0, late)
        peer.executor.spin_once(0.02)

    wait_for(lambda: "diabolo/pose, stamp" in log.read_text(), play_late)


def heard(folder: Path, name: str, file: Path, seconds: float) -> Path:
    """A bag of what a node and a player say, recorded until SIGINT. seconds: as long as the file plays."""
    bag, options = folder / name, ("--listeners", 2, "--start", FIRST // 10**9)
    with node(), meter() as peer:
        played(peer, *swing(0.2))  # node and peer have found each other: what is answered is heard
        with running("record.py", bag, log=folder / "log") as recorder:
            meet_recorder(peer, folder / "log")
            with running("play.py", file, *options, log=folder / "played") as player:
                hear(peer, FIRST + round(1e9 * (seconds - 0.5 / RATE)))
                assert player.wait(60) == 0
            time.sleep(1.0)  # the recorder, too, has heard it by then
            assert end(recorder, signal.SIGINT) == 0
    return bag


def test_a_recorded_bag_replays_to_the_same_play(tmp_path: Path) -> None:
    motion, times = swing(3.0)
    left, right = motion.at(times)[:2]
    plan = tmp_path / "plan.csv"
    columns = ",".join(["time", *(f"{side}_{axis}" for side in ("left", "right") for axis in "xyz")])
    np.savetxt(plan, np.column_stack([times, left, right]), "%.17g", ",", header=columns, comments="")
    first = load_recording(heard(tmp_path, "first.mcap", plan, times[-1]))
    again = load_recording(heard(tmp_path, "again.mcap", tmp_path / "first.mcap", times[-1]))
    states = predicted(left, right)
    middle = 0.5 * (states[1:, 6] + states[:-1, 6])
    for take in (first, again):
        assert len(take) == len(times)
        np.testing.assert_allclose(take.left, left, rtol=0.0, atol=1e-9)
        seen = take.diabolo_valid
        assert seen.mean() > 0.95
        np.testing.assert_allclose(take.diabolo[seen], states[seen, :3], rtol=0.0, atol=1e-9)
        spin = take.spin()[:-1]
        known = np.isfinite(spin)
        assert known.mean() > 0.9
        np.testing.assert_allclose(spin[known], middle[known], rtol=0.0, atol=1e-3)
    topics = "left=/left_tip,right=/right_tip,diabolo=/diabolo"
    command = [sys.executable, "-m", "diabolo", "diagnose", str(tmp_path / "first.mcap"), "--topics", topics]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr


def test_a_played_plan_is_drawn_beside_its_bag(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    assert main(["plan", "throw_and_catch", "--out", str(tmp_path / "throw.csv")]) == 0
    plan = tmp_path / "throw.csv"
    bag = heard(tmp_path, "take.mcap", plan, 2.37)
    command = [sys.executable, str(EXAMPLES / "draw.py"), str(bag), str(plan), str(tmp_path / "ros2.png")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    off = float(done.stdout.split(": ")[1].split(" mm")[0])
    assert off < 50.0  # the tips go straight between two rows of the plan
    assert load_recording(bag).diabolo[:, 2].max() > 1.8  # thrown
    assert (tmp_path / "ros2.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("program", "arguments", "sentence"),
    [
        ("draw.py", f"{SWING} none.csv ros2.png", "none.csv: there is no such file"),
        ("draw.py", f"{SWING} {SWING} {SWING}", "swing.csv"),
        ("diabolo_node.py", "--ros-args -p source:=eyes", "source: 'eyes'; expected tips or joints"),
        ("diabolo_node.py", "--ros-args -p dt:=0.0", "dt: 0 s; expected 1e-5 to 0.02"),
        ("diabolo_node.py", "--ros-args -p spin:=.nan", "spin: nan rad/s"),
        ("diabolo_node.py", "--ros-args -p start:=[1.0]", "start: [1.0]; expected"),
        ("diabolo_node.py", "--ros-args -p model:=none.json", "model none.json: no such file"),
        ("diabolo_node.py", "--ros-args -p string_length:=-1.0", "string_length: -1 m; must be"),
        ("diabolo_node.py", "--ros-args -p string_length:=long", "string_length"),
        (
            "diabolo_node.py",
            "--ros-args -p source:=joints -p joints:=[a]",
            "joints: 1 names; expected",
        ),
        ("diabolo_node.py", "--ros-args -p bogus:=1", "parameter 'bogus'; expected model, string_length"),
        ("diabolo_node.py", "--ros-args --bogus", "--ros-args: ['--bogus']; expected"),
        ("diabolo_node.py", "--model m.json", "unrecognized arguments: --model"),
        ("diabolo_node.py", "--ros-args -p spin:=50", "'spin' to '50' of type 'INTEGER', expecting"),
        ("play.py", "none.csv", "none.csv"),
        ("play.py", f"{SWING} --rate 0", "--rate 0: 0 samples; expected"),
        ("play.py", f"{SWING} --rate nan", "--rate nan"),
        ("play.py", f"{SWING} --start -1", "--start -1; expected"),
        ("play.py", f"{SWING} --joints", "expected all within reach"),
        ("play.py", f"{SWING} --listeners -3", "--listeners -3; expected 0 or more"),
        ("record.py", "take.csv", "take.csv: expected a name that ends in .mcap"),
        ("record.py", "nowhere/take.mcap", "there is no folder"),
        ("record.py", "take.mcap --seconds nan", "--seconds nan; expected"),
        ("record.py", "take.mcap --seconds 0.1", "left_tip: 0 messages were heard; expected two or more"),
        ("latency.py", "--rate 0", "--seconds 60 --rate 0; expected 0.1 to 3600 s"),
        ("latency.py", "--rate 2 --seconds 0.6", "--seconds 0.6 --rate 2: 1 samples; expected two or more"),
    ],
)
def test_bad_input_is_one_sentence(program: str, arguments: str, sentence: str, tmp_path: Path) -> None:
    command = [sys.executable, str(EXAMPLES / program), *arguments.split()]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, timeout=60)
    assert done.returncode == 2, done.stderr
    assert sentence in done.stderr
    assert "Traceback" not in done.stderr
    assert len(done.stderr.splitlines()) == 1
    assert not list(tmp_path.iterdir())
