# SPDX-License-Identifier: MIT
"""Makes a case on the plant, and draws again where the diabolo was missed early."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

from .. import plant
from . import camera_steps, draw

ATTEMPTS = 5 * draw.TRIES
LONGEST_RUN = 120.0  # of the program, beyond which it is drawn again [s]
SHORTEST_SHARE = 0.95  # of the length that was drawn


def play(program: Path, scenario: dict[str, Any], out: Path) -> dict[str, Any] | None:
    """What is at work in the recording that it writes; None where the play failed. Raises plant.RefusedError
    where the program does not know what the scenario asks for."""
    try:
        return plant.play(program, scenario, out, longest=LONGEST_RUN)
    except plant.FailedError:
        return None
    except plant.RefusedError as refused:
        if "unknown" in str(refused) or "structure" in str(refused):
            raise
        return None


def knows_chain(program: Path) -> bool:
    """Whether the program has the second plant."""
    scenario = draw.draw(draw.Plan(1, 1, "null", "chain")).scenario | {"duration": 0.1}
    with tempfile.TemporaryDirectory() as folder:
        try:
            return play(program, scenario, Path(folder) / "take.csv") is not None
        except plant.RefusedError:
            return False


def make(program: Path, plan: draw.Plan, out: Path) -> dict[str, Any]:
    """Writes the recording of a case; returns its key."""
    for attempt in range(ATTEMPTS):
        drawn = draw.draw(plan, attempt)
        truth = play(program, drawn.scenario, out)
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
