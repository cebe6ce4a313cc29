# SPDX-License-Identifier: MIT
"""The diabolo inside DART and Drake."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from diabolo import load_recording
from diabolo.cli import main

pytestmark = pytest.mark.hosts
MOTION = "motion.csv"
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def started(host: str, *arguments: object) -> subprocess.CompletedProcess[str]:
    program = [sys.executable, EXAMPLES / "hosts" / f"diabolo_in_{host}.py", *arguments]
    return subprocess.run([str(word) for word in program], capture_output=True, text=True)


def run(host: str, *arguments: object) -> str:
    done = started(host, *arguments)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("host", ["dart", "drake"])
def test_the_host_s_body_goes_where_the_predictor_goes(host: str, tmp_path: Path) -> None:
    picture = tmp_path / f"{host}.png"
    errors = [float(line.split(": ")[1].split()[0]) for line in run(host, "--picture", picture).splitlines()]
    assert len(errors) == 2
    assert max(errors) < 1e-6
    assert picture.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(("host", "library"), [("dart", "dartpy"), ("drake", "pydrake")])
def test_without_its_host_an_example_says_so(host: str, library: str) -> None:
    folder = EXAMPLES / "hosts"
    lines = (
        "import runpy, sys",
        f"sys.modules[{library!r}] = None",
        f"sys.path.insert(0, {str(folder)!r})",
        f"runpy.run_path({str(folder / f'diabolo_in_{host}.py')!r}, run_name='__main__')",
    )
    done = subprocess.run([sys.executable, "-c", "\n".join(lines)], capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr.startswith(f"diabolo_in_{host}.py: ") and done.stderr.count("\n") == 1
    assert done.stderr.endswith(f"expected it from: pip install 'diabolo[{host}]'\n")


def write_motion(told: dict[str, object]) -> None:
    """Of one second, with this JSON file beside it."""
    head = "time,left_x,left_y,left_z,right_x,right_y,right_z"
    rows = (f"{time},0,0.4,1.3,0,-0.4,1.3" for time in (0.0, 0.5, 1.0))
    Path(MOTION).write_text("\n".join([head, *rows, ""]))
    Path(MOTION).with_suffix(".json").write_text(json.dumps(told))


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--picture", "nowhere/a.png"], "there is no folder"),
        (["--picture", "a.wav"], "not supported"),
        (["--picture", "a.png", "motion.csv", "sim.csv"], "expected no MOTION.csv"),
        (["motion.csv"], "MOTION.csv without SIM.csv"),
        ([MOTION, MOTION], "motion.csv: this file is read; choose another name"),
        ([MOTION, "nowhere/sim.csv"], "nowhere/sim.csv: there is no folder"),
        (["none.csv", "sim.csv"], "none.json: No such file or directory; expected what"),
        ([MOTION, "sim.csv"], "motion.json: no field 'diabolo'; expected what"),
    ],
)
def test_what_cannot_be_drawn_or_played_is_told_in_a_sentence(
    arguments: list[str], sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    write_motion({})
    done = started("dart", *arguments)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1 and sentence in done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"motion.csv", "motion.json"}


@pytest.mark.parametrize("times", [[], [0.5, 0.1], [-0.1], [1.0], [9.0]])
def test_starts_outside_the_motion_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, times: list[float]
) -> None:
    monkeypatch.chdir(tmp_path)
    starts = [{"time": time, "position": [0, 0, 0.7], "velocity": [0, 0, 0], "spin": 60} for time in times]
    diabolo = {"mass": 0.2, "diameter": 0.127, "length": 0.143, "axle_radius": 0.0065}
    write_motion({"diabolo": diabolo, "string_length": 1.46, "starts": starts})
    done = started("dart", MOTION, "sim.csv")
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert f"motion.json: starts at {times} s; expected some, one after another, within" in done.stderr
    assert not Path("sim.csv").exists()


def test_two_hosts_play_a_recorded_motion_alike(tmp_path: Path) -> None:
    motion = tmp_path / "motion.csv"
    assert main(["motion", str(EXAMPLES.parent / "data" / "recordings" / "hold.csv"), str(motion)]) == 0
    for host in ("dart", "drake"):
        run(host, motion, tmp_path / f"{host}.csv")
    one, other = (load_recording(tmp_path / f"{host}.csv") for host in ("dart", "drake"))
    assert len(one) > 1000
    assert not [note for note in one.warnings() if "jitter" in note]  # as one start ends, the next begins
    np.testing.assert_allclose(one.diabolo, other.diabolo, rtol=0.0, atol=1e-9)
