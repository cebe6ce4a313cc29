# SPDX-License-Identifier: MIT
"""What a diagnosis says of the library's own plays, whose string lies around no axle: nothing is missing from
those of the base, and what a model adds is named with its number."""

from __future__ import annotations

from pathlib import Path

import diabolo
import numpy as np
import pytest
from diabolo import Diagnosis, Model, Recording, diagnose, load_recording
from diabolo.cli import main
from numpy.typing import NDArray

SEED = 20261129


def play(folder: Path, motion: str, model: Model | None = None, duration: float = 10.0) -> Recording:
    """A built-in motion, as `diabolo simulate` writes it."""
    out = folder / f"{motion}.csv"
    with_model = []
    if model is not None:
        path = folder / "model.json"
        path.write_text(model.to_json(), encoding="utf-8")
        with_model = ["--model", str(path)]
    assert main(["simulate", str(out), "--motion", motion, "--duration", str(duration), *with_model]) == 0
    return load_recording(out)


def seen_by_a_camera(recording: Recording, deviation: float, rng: np.random.Generator) -> Recording:
    """With white noise on every track [m]; the spin is seen as it was."""

    def noisy(positions: NDArray[np.float64]) -> NDArray[np.float64]:
        return positions + deviation * rng.standard_normal(positions.shape)

    return Recording(
        name=recording.name,
        time=recording.time,
        left=noisy(recording.left),
        right=noisy(recording.right),
        diabolo=noisy(recording.diabolo),
        diabolo_orientation=recording.diabolo_orientation,
        rate=recording.rate,
        properties=recording.properties,
        string_length=recording.string_length,
    )


@pytest.mark.parametrize("motion", ["hold", "beat", "swing", "swing_and_beat", "throw", "wind_up"])
def test_nothing_is_missing_from_a_play_of_the_base(motion: str, tmp_path: Path) -> None:
    answer = diagnose([play(tmp_path, motion)])
    assert answer.headline == "NOTHING_MISSING", answer.sentence
    assert answer.effects == []
    assert "makes the difference" not in answer.sentence


def friction_of(answer: Diagnosis) -> tuple[float, float, float]:
    assert answer.headline == "NAMED", answer.sentence
    assert [effect.name for effect in answer.effects] == ["string_friction"], answer.sentence
    found = answer.effects[0].parameters[0]
    assert found.ci90 is not None
    return found.ci90.low, found.value, found.ci90.high


@pytest.mark.parametrize("thin", [True, False])
def test_friction_of_a_simulated_play_is_named_alone(thin: bool, tmp_path: Path) -> None:
    rubs = Model(name="rubs")
    rubs.string_friction = diabolo.StringFriction(coefficient=0.25, spin_gain=3.0)
    if not thin:
        rubs.finite_axle = diabolo.FiniteAxle(radius=0.0072)
    recording = play(tmp_path, "swing_and_beat", rubs, duration=20.0)
    assert friction_of(diagnose([recording]))[1] == pytest.approx(0.25, abs=0.003)
    rng = np.random.default_rng(SEED)
    low, value, high = friction_of(diagnose([seen_by_a_camera(recording, 4e-4, rng)]))
    assert value == pytest.approx(0.25, abs=0.02)
    assert high - low < 0.03
