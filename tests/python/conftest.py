# SPDX-License-Identifier: MIT
"""Recordings to test with: made here, since the real ones are found by DIABOLO_RECORDINGS only."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import diabolo
import hypothesis
import numpy as np
import pytest
from diabolo import motions
from numpy.typing import NDArray

# Without a deadline, since the machine may be busy; a failure prints how to repeat it.
hypothesis.settings.register_profile("diabolo", deadline=None, max_examples=50, print_blob=True)
hypothesis.settings.load_profile("diabolo")

# A shell that runs the tests in the background has them ignore Ctrl-C, which some of them are about.
signal.signal(signal.SIGINT, signal.default_int_handler)

RATE = 120.0


def make_recording(
    motion: str = "swing",
    seconds: float = 4.0,
    spin: float = 100.0,
    name: str = "played",
    model: diabolo.Model | diabolo.Parameters | None = None,
    noise: float = 0.0,
) -> diabolo.Recording:
    """What a model, by default the library's own, makes of a built-in motion, as a camera at 120 Hz would
    record it, with so much noise of the diabolo's place [m]."""
    tips = motions.MOTIONS[motion](seconds)
    steps_per_sample = 8  # close to the evaluation's step of 1 ms
    samples = int(seconds * RATE)
    left, right, _, _ = tips.at(np.arange(samples + 1) / RATE)
    spheroid = diabolo.Spheroid(left[0], right[0], 1.45)
    initial = np.concatenate([spheroid.center - [0.0, 0.0, spheroid.semi_minor], np.zeros(3), [spin]])
    result = diabolo.rollout(
        diabolo.Parameters() if model is None else model,
        initial,
        tips,
        dt=1.0 / (RATE * steps_per_sample),
        steps=samples * steps_per_sample,
        record_every=steps_per_sample,
        string_state="on_string",
    )
    states = np.vstack([initial, result.states])
    angle = np.concatenate([[0.0], np.cumsum(states[:-1, 6])]) / RATE
    zero = np.zeros_like(angle)
    return diabolo.Recording(
        np.arange(samples + 1) / RATE,
        left,
        right,
        states[:, :3] + noise * np.random.default_rng(round(spin)).normal(size=(samples + 1, 3)),
        RATE,
        diabolo_orientation=np.stack([-np.sin(angle / 2), zero, zero, np.cos(angle / 2)], axis=1),
        name=name,
        properties=diabolo.DiaboloProperties.red(),
        string_length=1.45,
    )


@pytest.fixture(scope="session")
def played() -> diabolo.Recording:
    return make_recording()


@pytest.fixture(scope="session")
def real_recordings() -> Path:
    """The folder of the authors' recordings; skips the test where there is none."""
    folder = os.environ.get("DIABOLO_RECORDINGS")
    if not folder:
        pytest.skip("the real recordings are not here (DIABOLO_RECORDINGS)")
    return Path(folder)


def rotation(quaternion: NDArray[np.float64]) -> NDArray[np.float64]:
    """The matrix of a unit quaternion x, y, z, w."""
    x, y, z, w = quaternion
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + 2.0 * w * skew + 2.0 * skew @ skew


def product(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """The quaternion that turns by `b`, then by `a`."""
    vector = a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3])
    return np.array([*vector, a[3] * b[3] - a[:3] @ b[:3]])


def motive_text(recording: diabolo.Recording) -> str:
    """The recording as Motive would have exported it, by the published calibration."""
    parts = json.loads(diabolo.Calibration.published().to_json())
    to_raw = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])  # turns by +90 degrees about z
    axis = np.array(parts["diabolo"]["axis"])
    forwards = np.array([0.0, 1.0, 0.0])  # world x in the capture frame
    upright = np.array([*np.cross(axis, forwards), 1.0 + axis @ forwards])
    upright /= np.linalg.norm(upright)
    points = {
        "stick_left": (recording.left, np.array(parts["left"]["point"])),
        "stick_right": (recording.right, np.array(parts["right"]["point"])),
        "diabolo_red": (recording.diabolo, np.array(parts["diabolo"]["point"])),
    }
    spin = np.nan_to_num(recording.spin())
    angles = -np.concatenate([[0.0], np.cumsum(spin[:-1])]) / recording.rate  # about world x
    rows = []
    for index, time in enumerate(recording.time):
        cells = [str(index), f"{time:.6f}"]
        for name, (track, offset) in points.items():
            raw = to_raw @ (track[index] - np.array(parts["world"]["offset"]))
            turn = np.array([0.0, 0.0, 0.0, 1.0])
            if name == "diabolo_red":
                half = 0.5 * angles[index]
                turn = product(np.array([*(np.sin(half) * forwards), np.cos(half)]), upright)
            values = [*turn, *(raw - rotation(turn) @ offset)]
            cells += [f"{value:.9f}" if np.isfinite(value) else "" for value in values]
            if not np.isfinite(raw).all():
                cells[-7:] = [""] * 7
        rows.append(",".join(cells))
    names = [name for name in points for _ in range(7)]
    kinds = (["Rotation"] * 4 + ["Position"] * 3) * 3
    axes = ["X", "Y", "Z", "W", "X", "Y", "Z"] * 3
    header = [
        "Format Version,1.22,Take Name,made up,Capture Frame Rate,120.000000,Export Frame Rate,120.000000,"
        f"Capture Start Time,now,Total Frames in Take,{len(rows)},Total Exported Frames,{len(rows)},"
        "Rotation Type,Quaternion,Length Units,Meters,Coordinate Space,Global",
        "",
        ",".join(["", "", *["Rigid Body"] * 21]),
        ",".join(["", "", *names]),
        ",".join(["", "", *[f'"{name}-id"' for name in names]]),
        ",".join(["", "", *kinds]),
        ",".join(["Frame", "Time (Seconds)", *axes]),
    ]
    return "\n".join([*header, *rows]) + "\n"


@pytest.fixture
def motive_file(tmp_path: Path, played: diabolo.Recording) -> Path:
    path = tmp_path / "take.csv"
    path.write_text(motive_text(played))
    return path


Command = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture
def command(tmp_path: Path) -> Command:
    """Runs `python -m diabolo` in an empty folder, warnings being errors."""

    def run(*arguments: str | Path, env: dict[str, str] | None = None) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-W", "error", "-m", "diabolo", *map(str, arguments)],
            cwd=tmp_path,
            env={**os.environ, **(env or {})},
            capture_output=True,
            text=True,
            timeout=120,
        )

    return run
