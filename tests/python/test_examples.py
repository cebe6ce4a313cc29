# SPDX-License-Identifier: MIT
"""Every example runs without a warning, prints what its text promises, and draws where it can."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "examples"
EXAMPLES, ROS2 = sorted((FOLDER / "python").glob("[0-9]*.py")), FOLDER / "ros2"


def run(example: Path, folder: Path, **environment: str) -> str:
    done = subprocess.run(
        [sys.executable, "-W", "error", example],
        cwd=folder,
        env={**os.environ, "MPLBACKEND": "Agg", **environment},
        capture_output=True,
        text=True,
        timeout=240,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


Drawn = Callable[[Path], tuple[str, Path]]


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> Drawn:
    """Runs an example, once for all tests that ask: what it printed, and its folder."""

    @cache
    def run_once(example: Path) -> tuple[str, Path]:
        folder = tmp_path_factory.mktemp(example.stem)
        return run(example, folder), folder

    return run_once


def numbers(pattern: str, text: str) -> list[float]:
    match = re.search(pattern, text)
    assert match is not None, text
    return [float(number) for number in match.groups()]


def written(example: Path) -> set[str]:
    """Files beside the picture."""
    return {f"{example.stem}.json"} if "clone" in example.stem else set()


def test_there_are_examples() -> None:
    assert [example.name[:2] for example in EXAMPLES] == ["01", "02", "03", "04", "06", "08", "09"]


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_draws(example: Path, drawn: Drawn) -> None:
    pytest.importorskip("matplotlib")
    output, folder = drawn(example)
    picture = f"{example.stem}.png"
    assert output.splitlines()[-1] == f"picture: {picture}"
    assert {path.name for path in folder.iterdir()} == {picture, *written(example)}
    assert (folder / picture).read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_does_without_matplotlib(example: Path, tmp_path: Path) -> None:
    blocked = tmp_path / "blocked"
    blocked.mkdir()
    (blocked / "matplotlib.py").write_text("raise ModuleNotFoundError(name='matplotlib')\n")
    output = run(example, tmp_path, PYTHONPATH=f"{blocked}:{os.environ.get('PYTHONPATH', '')}")
    assert output.splitlines()[-1] == "(pip install matplotlib to see a picture)"
    assert {path.name for path in tmp_path.iterdir()} == {"blocked", *written(example)}


def test_the_fall_takes_as_long_as_it_must(drawn: Drawn) -> None:
    output, _ = drawn(EXAMPLES[0])
    (caught,) = numbers(r"caught after ([\d.]+) s", output)
    (fall,) = numbers(r"takes ([\d.]+) s", output)
    assert abs(caught - fall) <= 1.1e-3  # one step


def test_calm_hands_take_as_long_as_for_a_pendulum(drawn: Drawn) -> None:
    output, _ = drawn(EXAMPLES[1])
    (calmest,) = numbers(r"the calmest ones take ([\d.]+) s", output)
    (pendulum,) = numbers(r"of them: ([\d.]+) s", output)
    assert calmest == pytest.approx(pendulum, abs=0.03)


def test_the_replay_beats_the_baseline(drawn: Drawn) -> None:
    output, _ = drawn(EXAMPLES[2])
    (error,) = numbers(r"mean error is ([\d.]+) cm", output)
    (lowest,) = numbers(r"would be ([\d.]+) cm", output)
    assert error < 0.5 * lowest


def test_the_iteration_converges(drawn: Drawn) -> None:
    output, _ = drawn(EXAMPLES[3])
    misses = [float(miss) for miss in re.findall(r"off by +([\d.]+) mm", output)]
    assert len(misses) == 5 and misses[0] > 10.0 and misses[2] < 0.1 and misses[4] == 0.0


def test_what_was_found_helps_on_another_recording(drawn: Drawn) -> None:
    output, _ = drawn(EXAMPLES[4])
    (friction,) = numbers(r"string_friction, coefficient: ([\d.]+)", output)
    assert friction == pytest.approx(0.3, abs=0.03)
    (before,) = numbers(r"consistent: .*?([\d.]+) after 0.5 s", output)
    (after,) = numbers(r"diagnosed: .*?([\d.]+) after 0.5 s", output)
    assert after < 0.3 * before


def test_a_clone_plays_nearly_as_well_as_its_teacher(drawn: Drawn) -> None:
    output, _ = drawn(EXAMPLES[5])
    teacher, clone = (
        numbers(rf"{name}: gains ([\d.]+) .*drops (\d+)", output) for name in ("teacher", "clone")
    )
    assert clone[0] > 0.9 * teacher[0]
    assert clone[1] <= teacher[1] + 10  # of 200


@pytest.mark.parametrize("program", ["diabolo_node", "latency", "play", "record"])
@pytest.mark.parametrize("missing", ["rclpy", "geometry_msgs", "sensor_msgs", "std_msgs"])
def test_without_ros_its_programs_end_with_a_sentence(program: str, missing: str, tmp_path: Path) -> None:
    for name in ("rclpy", "geometry_msgs", "sensor_msgs", "std_msgs"):
        module = tmp_path / name
        module.mkdir()
        fault = f"raise ModuleNotFoundError('No module named {name}')\n" if name == missing else ""
        (module / "__init__.py").write_text(fault)
        (module / "msg.py").write_text("")
    done = subprocess.run(
        [sys.executable, ROS2 / f"{program}.py", "--help"],
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=60,
    )
    sentence = (
        f"{program}: No module named {missing}; expected ROS 2, by pip install -r tools/ros2-requirements.txt"
    )
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"{sentence}\n")
