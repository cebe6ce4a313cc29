# SPDX-License-Identifier: MIT
"""Runs the plant's program, and draws again where the diabolo was missed early."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from . import camera_steps, draw

ATTEMPTS = 5 * draw.TRIES
SHORTEST_SHARE = 0.95  # of the length that was drawn
LONGEST_RUN = 120.0  # of the plant's program [s]


class RefusedError(ValueError):
    """The program does not know what a scenario asks for."""


def check_program(program: Path) -> None:
    """Raises ValueError where it is not there, or is another program."""
    if not os.access(program, os.X_OK) or program.is_dir():
        raise ValueError(
            f"{program}: the plant's program is not there; make test-plant builds it, --plant names it"
        )
    try:
        told = subprocess.run([program.absolute(), "--help"], capture_output=True, text=True, timeout=10.0)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ValueError(f"{program}: cannot be run ({error}); expected the plant's program") from error
    if told.returncode != 0 or "--key" not in told.stdout:
        raise ValueError(f"{program}: another program; expected the plant's, which make test-plant builds")


def run(program: Path, scenario: dict[str, Any], out: Path) -> dict[str, Any] | None:
    """Writes a recording; returns what the plant says is true of it, or None where the play failed."""
    with tempfile.TemporaryDirectory() as folder:
        asked, key = Path(folder) / "scenario.json", Path(folder) / "key.json"
        asked.write_text(json.dumps(scenario), encoding="utf-8")
        command = [str(argument) for argument in (program.absolute(), asked, "--out", out, "--key", key)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST_RUN)
        except subprocess.TimeoutExpired:
            return None
        if done.returncode == 2 and ("unknown" in done.stderr or "structure" in done.stderr):
            raise RefusedError(" ".join(done.stderr.replace(str(asked), "scenario").split()))
        if done.returncode != 0:
            return None
        return dict(json.loads(key.read_text(encoding="utf-8"))["effects"])


def knows_chain(program: Path) -> bool:
    """Whether the program has the second plant."""
    scenario = draw.draw(draw.Plan(1, 1, "null", "chain")).scenario | {"duration": 0.1}
    with tempfile.TemporaryDirectory() as folder:
        try:
            return run(program, scenario, Path(folder) / "take.csv") is not None
        except RefusedError:
            return False


def make_case(program: Path, plan: draw.Plan, out: Path) -> dict[str, Any]:
    """Writes the recording of a case; returns its key."""
    for attempt in range(ATTEMPTS):
        drawn = draw.draw(plan, attempt)
        truth = run(program, drawn.scenario, out)
        if truth is None:
            continue
        recording = camera_steps.Tidy.read(out)
        frames = drawn.scenario["duration"] * drawn.scenario["camera"]["rate"]
        if len(recording.columns["time"]) < SHORTEST_SHARE * frames:
            continue
        camera_steps.apply(drawn.content.steps, recording)
        recording.write(out)
        for step in drawn.content.steps:
            if step["step"] in drawn.content.names:
                truth[step["step"]] = {k: v for k, v in step.items() if k in ("factor", "seconds", "bursts")}
        return {**drawn.key(truth), "attempts": attempt + 1}
    raise ValueError(f"{plan.name}: the plant missed the diabolo in all of {ATTEMPTS} attempts")
