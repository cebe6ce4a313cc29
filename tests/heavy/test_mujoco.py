# SPDX-License-Identifier: MIT
"""The diabolo inside MuJoCo, and the comparison with MuJoCo on the same job (agreement only, no times)."""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install mujoco==4.0.0")
pytestmark = pytest.mark.mujoco

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples" / "mujoco" / "diabolo_in_mujoco.py"
BENCHMARK = "benchmarks.speed.mujoco.compare"


@pytest.fixture(scope="module")
def example():
    spec = importlib.util.spec_from_file_location("diabolo_in_mujoco", EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def played(example):
    """What happened in each step of 2 ms, with the tips."""
    _, _, record = example.simulate(2e-3)
    times = 2e-3 * np.arange(1, len(record["force"]) + 1)
    left, right, *_ = example.play().at(times)
    strands = [np.linalg.norm(record["position"] - tip, axis=1) for tip in (left, right)]
    return {**record, "path": sum(strands)}


@pytest.fixture(scope="module")
def benchmark(tmp_path_factory):
    report = tmp_path_factory.mktemp("benchmark") / "report.json"
    done = subprocess.run(
        [sys.executable, "-m", BENCHMARK, "--short", "--json", str(report)],
        capture_output=True,
        text=True,
        cwd=ROOT,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("\n|---|") == 2
    return json.loads(report.read_text())


def test_example_runs_and_draws(tmp_path):
    picture = tmp_path / "diabolo.png"
    done = subprocess.run(
        [sys.executable, str(EXAMPLE), "--picture", str(picture)], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_what_its_own_tendon_lacks_is_named(tmp_path):
    """Friction and drag are at work in the recordings; MuJoCo's tendon knows neither and gives like a spring.
    Friction is named; of the drag it is not said that the two agree; no spring is named without the other."""
    report = tmp_path / "mujoco.html"
    takes = [str(ROOT / "data" / "recordings" / f"puzzle_{number}.csv") for number in (1, 2)]
    done = subprocess.run(
        [sys.executable, str(EXAMPLE.with_name("what_mujoco_lacks.py")), *takes, "--out", str(report)],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    lacks, rest = done.stdout.split(";")[0], done.stdout
    assert "lacks friction of the string on the axle" in lacks
    assert "drag" in lacks or "agree in the drag of the air cannot be told" in rest
    assert ("the bending of the sticks" in rest) == ("the string's stretch" in rest)
    ahead, errors = done.stdout.splitlines()[-1].split(" s ahead:")
    alone, better = (float(part.split()[0]) for part in errors.split("->"))
    assert float(ahead) == 1.0
    assert better < 0.4 * alone
    assert "Your simulator beside reality" in report.read_text(encoding="utf-8")


def test_body_follows_the_predictor_until_it_touches_the_floor(example):
    fine = example.predicted(1e-4)[:, :3]
    to_fine = []
    for dt in (4e-3, 2e-3, 1e-3):
        _, _, record = example.simulate(dt)
        plain = example.predicted(dt)
        body = record["position"][: len(plain)]
        # The predictor's iteration leaves 1e-10 of the string's length open in each step.
        assert np.linalg.norm(body - plain[:, :3], axis=1).max() < len(plain) * 1.45e-10 * 10
        # The spin answers to the string's speed over the axle's radius, which magnifies that.
        np.testing.assert_allclose(record["spin"][: len(plain)], plain[:, 6], rtol=2e-5)
        stride = round(dt / 1e-4)
        to_fine.append(np.linalg.norm(body - fine[stride - 1 :: stride], axis=1).max())
    assert to_fine[0] < 1e-4
    assert to_fine[0] > 3 * to_fine[1] > 9 * to_fine[2]  # second order


def test_floor_carries_the_diabolo_while_the_string_is_slack(played):
    lies = played["contact"] & (played["force"] < 1e-9)
    assert lies.sum() * 2e-3 > 0.5
    assert played["path"][lies].max() < 1.45
    assert played["path"][lies].min() < 1.45 - 0.05


def test_string_pulls_only_at_its_length_and_holds_after_the_floor(played):
    assert played["path"].max() < 1.45 + 1e-6
    pulls = (played["force"] > 1e-3) & ~played["contact"]
    assert played["path"][pulls].min() > 1.45 - 1e-6
    last = played["force"][-250:]  # half a second of swinging: the mean carries the weight
    assert 0.7 < last.mean() / (0.2845 * 9.80665) < 1.3


def test_reference_of_the_benchmark_and_library_agree(benchmark):
    beat, hop = (benchmark["references"][motion] for motion in ("beat", "hop"))
    assert beat["slack_time"] == 0.0
    assert hop["slack_time"] > 0.1
    assert hop["snap_speed"] > 0.5
    for checks in (beat, hop):
        assert checks["drift"] < 1e-9
        assert checks["change_from_coarser"] < 1e-9
        assert checks["library_at_10_us"] < 1e-8


def test_library_and_mujoco_come_to_the_reference(benchmark):
    rows = {(row["motion"], row["simulator"]): row for row in benchmark["rows"]}
    assert len(rows) == 8
    for motion in ("beat", "hop"):
        ours, mocap, driven, point = (
            rows[motion, name] for name in ("diabolo", "MuJoCo mocap", "MuJoCo driven", "MuJoCo point")
        )
        assert ours["errors"]["0.1"] < 1e-7
        assert ours["timestep"] >= driven["timestep"]
        for row in (driven, point):
            assert row["errors"]["0.1"] < 1e-4
            assert row["errors"]["1"] < row["errors"]["10"]
        # MuJoCo takes mocap bodies for resting: the error falls slowly or not at all.
        assert mocap["errors"]["1"] > 10 * driven["errors"]["1"]


def test_benchmark_says_what_it_lacks():
    done = subprocess.run(
        [sys.executable, "-m", BENCHMARK, "--compiler", "no-such-compiler"], capture_output=True, text=True
    )
    assert done.returncode == 2
    assert "no-such-compiler" in done.stderr
    assert len(done.stderr.splitlines()) == 1
