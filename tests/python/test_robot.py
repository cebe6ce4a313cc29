# SPDX-License-Identifier: MIT
from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from conftest import Command
from diabolo import Recording, TipMotion, robot
from numpy.typing import NDArray

HEADER = "time,left_x,left_y,left_z,right_x,right_y,right_z\n"


@pytest.fixture(scope="module")
def maps() -> dict[str, robot.StickMap]:
    arms = {side: robot.StickArm(side) for side in ("left", "right")}
    return {side: robot.StickMap(arm, robot.SeedGrid.build(arm)) for side, arm in arms.items()}


def points_of(grid: robot.SeedGrid, count: int) -> NDArray[np.float64]:
    return np.random.default_rng(1).uniform(grid.lower, grid.upper, (count, 3))


def excursion(x: float, seconds: float = 2.0) -> str:
    """A plan in which the right tip goes forward by x and comes back."""
    time = np.linspace(0.0, seconds, 41)
    forward = 0.6 + 0.5 * x * (1.0 - np.cos(2.0 * np.pi * time / seconds))
    rows = [
        f"{t!r},0.6,0.55,1.2,{f!r},-0.55,1.2" for t, f in zip(time.tolist(), forward.tolist(), strict=True)
    ]
    return HEADER + "\n".join(rows) + "\n"


def test_the_flange_is_where_the_controller_says() -> None:
    arm = robot.StickArm("right")
    joints = np.array([[0.0] * 6, [-1.54, -1.83, -2.28, -0.59, 1.6, 0.023]])
    flange = arm.flange(joints)
    assert flange.shape == (2, 4, 4)
    np.testing.assert_allclose(flange[0, :3, 3], [-0.8172, -0.2329, 0.0628], atol=1e-12)
    np.testing.assert_allclose(flange[1, :3, 3], [-0.117025, -0.435893, 0.151821], atol=1e-6)
    tip = arm.base @ flange[1] @ np.append(arm.tip, 1.0)
    np.testing.assert_allclose(arm.tip_position(joints[1]), tip[:3], atol=1e-14)


def test_every_solution_has_the_pose_and_the_seed_chooses_one() -> None:
    arm = robot.StickArm("left")
    joints = np.array([0.4, -1.2, 1.1, -0.7, 1.3, 0.2])
    flange = arm.flange(joints)
    solutions = robot.ur5e_inverse(flange)
    assert solutions.shape == (8, 6)
    np.testing.assert_allclose(arm.flange(solutions), np.broadcast_to(flange, (8, 4, 4)), atol=1e-12)
    np.testing.assert_allclose(arm.inverse(flange, joints + 0.1), joints, atol=1e-9)
    with pytest.raises(ValueError, match="flange: its upper left 3 x 3 is no rotation"):
        robot.ur5e_inverse(2.0 * flange)
    flange[:3, 3] = 5.0
    assert robot.ur5e_inverse(flange).shape == (0, 6)
    with pytest.raises(ValueError, match="flange: out of the left arm's reach"):
        arm.inverse(flange, joints)


def test_the_jacobian_moves_the_tip() -> None:
    arm = robot.StickArm("right")
    joints = np.array([2.6, -1.5, -1.7, -1.5, 3.0, 0.1])
    step = 1e-6 * np.array([0.3, -0.2, 0.5, 0.1, -0.4, 0.2])
    moved = arm.tip_position(joints + step) - arm.tip_position(joints - step)
    predicted = arm.base[:3, :3] @ arm.jacobian(joints)[:3] @ (2.0 * step)
    np.testing.assert_allclose(moved, predicted, atol=1e-12)


def test_a_calibration_moves_the_tip_a_little() -> None:
    links = np.array(
        [
            [0, 0, 0.1625, 0, 0, 0],
            [0, 0, 0, np.pi / 2, 0, 0],
            [-0.425, 0, 0, 0, 0, 0],
            [-0.3922, 0, 0.1333, 0, 0, 0],
            [0, -0.0997, 0, np.pi / 2, 0, 0],
            [0, 0.0996, 0, -np.pi / 2, 0, 0],
        ]
    )
    joints = np.array([2.6, -1.5, -1.7, -1.5, 3.0, 0.1])
    nominal = robot.StickArm("right").tip_position(joints)
    np.testing.assert_allclose(
        robot.StickArm("right", calibration=links).tip_position(joints), nominal, atol=1e-14
    )
    links[2, 0] -= 1e-3
    gap = robot.StickArm("right", calibration=links).tip_position(joints) - nominal
    assert np.linalg.norm(gap) == pytest.approx(1e-3)
    with pytest.raises(ValueError, match=r"calibration: shape \(5, 6\); expected \(6, 6\)"):
        robot.StickArm("right", calibration=links[:5])


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_map_meets_the_tip_and_its_slopes_follow(maps: dict[str, robot.StickMap], side: str) -> None:
    solver = maps[side]
    points = points_of(solver.grid, 500).reshape(5, 100, 3)
    joints, faults = solver.solve(points)
    assert joints.shape == (5, 100, 6) and faults.shape == (5, 100)
    assert not faults.any()
    np.testing.assert_allclose(solver.arm.tip_position(joints), points, atol=1e-9)
    assert np.linalg.norm(solver.arm.tip_position(solver.grid.seed(points)) - points, axis=-1).mean() < 0.01
    inner = 0.9 * points + 0.1 * points.mean(axis=(0, 1))
    step = np.array([1e-6, 0.0, 0.0])
    change = (solver.solve(inner + step)[0] - solver.solve(inner - step)[0]) / 2e-6
    slopes = solver.slopes(inner)
    np.testing.assert_allclose(slopes[..., 0], change, atol=1e-5)
    along, slowest = solver.tip_speed(inner, [0.0, 0.0, 2.0]), solver.slowest_tip_speed(inner)
    np.testing.assert_allclose(along * np.abs(slopes[..., 2]).max(axis=-1), np.pi)
    np.testing.assert_allclose(slowest * np.linalg.norm(slopes, axis=-1).max(axis=-1), np.pi)


def test_points_that_are_not_reached_have_a_code_and_no_joints(maps: dict[str, robot.StickMap]) -> None:
    joints, faults = maps["right"].solve([[0.6, -0.55, 1.2], [3.0, 0.0, 1.0]])
    assert list(faults) == [0, 1]
    assert robot.FAULTS[faults[1]] == "outside the box of the seed grid"
    assert np.isfinite(joints[0]).all() and np.isnan(joints[1]).all()
    assert np.isnan(maps["right"].tip_speed([3.0, 0.0, 1.0], [1.0, 0.0, 0.0]))
    with pytest.raises(ValueError, match=r"points: shape \(2,\); expected \(\.\.\., 3\)"):
        maps["right"].solve([1.0, 2.0])
    with pytest.raises(ValueError, match="points: nan at index 0"):
        maps["right"].solve([np.nan, 2.0, 1.0])


def test_a_grid_is_stored_and_loaded_bit_for_bit(maps: dict[str, robot.StickMap], tmp_path: Path) -> None:
    grid = maps["left"].grid
    grid.save(tmp_path / "left.csv")
    loaded = robot.SeedGrid.load(tmp_path / "left.csv")
    assert loaded.knots == [6, 7, 7]
    assert (loaded.joints == grid.joints).all()
    assert (loaded.lower == grid.lower).all() and (loaded.upper == grid.upper).all()
    (tmp_path / "broken.csv").write_text("x,y\n")
    with pytest.raises(ValueError, match=r"broken\.csv, line 1"):
        robot.SeedGrid.load(tmp_path / "broken.csv")
    with pytest.raises(ValueError, match="grid of the left arm"):
        robot.SeedGrid.build(robot.StickArm("left"), upper=[2.0, 1.0, 1.8])


def test_setpoints_keep_the_limits_on_the_same_curve() -> None:
    time = np.arange(0, 1.0, 0.002)
    clock = time**3 * (10 - 15 * time + 6 * time**2)
    path = np.sin(2 * np.pi * clock)[:, None] * np.linspace(0.1, 1.0, 12)
    setpoints, planned = robot.keep_limits(path, speed=2.0, acceleration=10.0, jerk=300.0)
    assert len(setpoints) > 1.5 * len(path)
    assert np.abs(np.diff(setpoints, axis=0)).max() / 0.002 <= 2.0 * (1 + 1e-9)
    assert np.abs(np.diff(setpoints, 2, axis=0)).max() / 0.002**2 <= 10.0 * (1 + 1e-9)
    assert np.abs(np.diff(setpoints, 3, axis=0)).max() / 0.002**3 <= 300.0 * (1 + 1e-6)
    assert (np.diff(planned) >= 0).all()
    expected = np.interp(planned, time, path[:, 11])
    np.testing.assert_allclose(setpoints[:, 11], expected, atol=1e-4)
    with pytest.raises(ValueError, match=r"joints: shape \(4, 6\); expected \(N, 12\)"):
        robot.keep_limits(np.zeros((4, 6)))
    with pytest.raises(ValueError, match="limits, jerk of joint 1"):
        robot.keep_limits(path, jerk=0.0)


def test_a_side_is_left_or_right() -> None:
    with pytest.raises(ValueError, match="side: 'up'; expected 'left' or 'right'"):
        robot.StickArm("up")
    with pytest.raises(ValueError, match="spacing"):
        robot.StickArm("left", spacing=-1.0)
    with pytest.raises(ValueError, match="calibration: not of numbers"):
        robot.StickArm("left", calibration="a")


def test_check_says_that_a_plan_can_be_played(command: Command, tmp_path: Path) -> None:
    plan = tmp_path / "plan.csv"
    plan.write_text(excursion(0.1))
    result = command("robot", "check", str(plan), "--json", str(tmp_path / "found.json"))
    assert result.returncode == 0, result.stderr
    assert "can be played" in result.stdout and "as fast as planned" in result.stdout
    assert "s of motion and 0.20 s to start and to stop\nleast clearance: 0." in result.stdout
    found = json.loads((tmp_path / "found.json").read_text())
    assert found["schema"] == "diabolo.robot_check/1"
    assert found["playable"] is True and found["slowed"] is False and found["troubles"] == []
    assert found["least_clearance_m"] > 0.3
    plan.write_text(excursion(0.15, seconds=0.4))
    hurried = command("robot", "check", str(plan), "--json", str(tmp_path / "found.json"))
    assert hurried.returncode == 3
    assert json.loads((tmp_path / "found.json").read_text())["slowed"] is True
    assert "can be played, but slower" in hurried.stdout
    assert "times slower on the whole" in hurried.stdout


def test_check_says_where_a_plan_cannot_be_played_and_why(command: Command, tmp_path: Path) -> None:
    plan = tmp_path / "plan.csv"
    plan.write_text(excursion(0.3))
    result = command("robot", "check", str(plan), "--json", "-")
    assert result.returncode == 1, result.stderr
    found = json.loads(result.stdout)
    assert found["playable"] is False and found["slowed"] is None and found["as_played_s"] is None
    (trouble,) = found["troubles"]
    assert trouble["who"] == "right arm"
    assert trouble["why"] == "outside the box of the seed grid"
    assert 0.0 < trouble["from_s"] < 1.0 < trouble["to_s"] < 2.0
    text = command("robot", "check", str(plan))
    assert "cannot be played" in text.stdout and "right arm" in text.stdout
    moved = command("robot", "check", str(plan), "--shift", "-0.15", "0", "0")
    assert "can be played" in moved.stdout


@pytest.mark.parametrize(
    ("content", "arguments", "complaint"),
    [
        ("time,left_x\n", [], "line 1"),
        (HEADER + "0,0,0,0,0,0,0\n", [], "a plan has two or more"),
        (excursion(0.1), ["--spacing", "0"], "spacing: 0 m; must be > 0"),
        (excursion(0.1), ["--speed", "-1"], "limits, speed of joint 1"),
        (excursion(0.1), ["--shift", "nan", "0", "0"], "--shift"),
        (excursion(0.1), ["--shift", "0", "1e300", "0"], "expected numbers within 100 m"),
        (excursion(0.1), ["--json", "nowhere/x.json"], "there is no folder"),
    ],
)
def test_check_says_what_is_wrong(
    command: Command, tmp_path: Path, content: str, arguments: list[str], complaint: str
) -> None:
    plan = tmp_path / "plan.csv"
    plan.write_text(content)
    result = command("robot", "check", str(plan), *arguments)
    assert result.returncode == 2
    assert complaint in result.stderr
    assert result.stderr.count("\n") == 1


def test_grid_tells_how_fast_the_tip_may_go(command: Command, tmp_path: Path) -> None:
    result = command("robot", "grid", "right", "--out", str(tmp_path / "right.csv"))
    assert result.returncode == 0, result.stderr
    assert "speed of the tip at pi rad/s" in result.stdout
    assert robot.SeedGrid.load(tmp_path / "right.csv").knots == [6, 7, 7]


def test_check_plan_takes_a_motion(maps: dict[str, robot.StickMap]) -> None:
    rest = np.tile([0.6, 0.55, 1.2], (2, 1))
    motion = TipMotion([0.0, 1.0], rest, rest * [1.0, -1.0, 1.0], "spline")
    found = robot.check_plan(maps["left"], maps["right"], motion)
    assert found["playable"] and found["as_played_s"] == pytest.approx(found["as_planned_s"])


def test_check_reads_recordings_with_dropouts(command: Command, tmp_path: Path) -> None:
    time = np.arange(241) / 120.0
    tip = np.column_stack([0.6 + 0.05 * np.sin(3.0 * time), 0.0 * time + 0.55, 0.0 * time + 1.2])
    left, right = tip.copy(), tip * [1.0, -1.0, 1.0]
    left[100:105] = np.nan
    Recording(time, left, right, 0.0 * tip, 120.0, name="played").save(tmp_path / "played.csv")
    result = command("robot", "check", str(tmp_path / "played.csv"))
    assert result.returncode == 0, result.stderr
    assert "can be played" in result.stdout


def test_a_recording_is_smoothed_before_it_is_planned() -> None:
    time = np.arange(361) / 120.0
    tip = np.column_stack([0.6 + 0.05 * np.sin(3.0 * time), 0.0 * time + 0.55, 0.0 * time + 1.2])
    noisy = tip + np.random.default_rng(3).normal(0.0, 2e-4, tip.shape)
    recording = Recording(time, noisy, noisy * [1.0, -1.0, 1.0], 0.0 * tip, 120.0)
    smooth = robot.recorded_plan(recording).at(time)[0]
    raw = TipMotion.of_recording(recording).at(time)[0]
    assert np.abs(np.diff(raw, 3, axis=0)).max() > 5.0 * np.abs(np.diff(smooth, 3, axis=0)).max()
    np.testing.assert_allclose(smooth[20:-20], tip[20:-20], atol=5e-4)
