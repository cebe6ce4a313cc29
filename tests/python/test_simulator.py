# SPDX-License-Identifier: MIT
"""Any simulator beside reality: what it lacks is named, and what it gives is checked."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
import pytest
from diabolo.cli import main
from diabolo.report import report_html
from numpy.typing import NDArray

States = NDArray[np.float64]
SHIPPED = Path(__file__).parents[2] / "data" / "recordings"


def simulator(
    model: diabolo.Model | diabolo.Parameters,
) -> Callable[[States, diabolo.TipMotion, States], States]:
    def simulate(start: States, tips: diabolo.TipMotion, times: States) -> States:
        steps = int(np.ceil(times[-1] / 1e-3))
        play = diabolo.rollout(model, start, tips, begin=0.0, steps=steps)
        states = np.vstack([start, play.states])
        at = np.concatenate([[0.0], play.time])
        return np.column_stack([np.interp(times, at, column) for column in states.T])

    return simulate


@pytest.fixture(scope="module")
def take() -> diabolo.Recording:
    return diabolo.load_recording(SHIPPED / "puzzle_1.csv")


def verdicts(comparison: diabolo.Comparison) -> dict[str, str]:
    return {law.name: law.verdict for law in comparison.laws}


def test_what_a_simulator_lacks_is_named_and_taken_off_its_errors(take: diabolo.Recording) -> None:
    bare = diabolo.model_for("consistent", take)
    found = diabolo.compare_simulator(take, simulator(bare))
    assert verdicts(found)["string_friction"] == "lacks"
    [friction] = [law for law in found.laws if law.name == "string_friction"]
    [difference] = friction.difference
    assert difference.ci90 is not None
    assert difference.ci90.low < 0.17 < difference.ci90.high  # as was concealed
    fit = found.result.fit
    alone, better = fit.base_error_m[-1], fit.augmented_error_m[-1]
    assert alone is not None and better is not None and better < 0.3 * alone
    assert "friction" in found.sentence
    assert found.sentence.endswith("not compared: it could be told of the recordings alone.")
    assert found.real.result.fit.axle_heldout == "blocks"
    assert found.simulated.result.fit.axle_heldout is None  # it gave no axle


def test_a_simulator_as_reality_is_agrees(take: diabolo.Recording) -> None:
    real = diabolo.diagnose(take).model
    found = diabolo.compare_simulator(take, simulator(real))
    assert verdicts(found)["string_friction"] == "agrees"
    assert not {"lacks", "too_little", "too_much"} & set(verdicts(found).values())


def test_what_it_should_not_have_is_told(take: diabolo.Recording) -> None:
    bare = diabolo.model_for("consistent", take)
    draggy = diabolo.Model(bare.parameters, air=diabolo.Air(linear_drag=0.25))
    found = diabolo.compare_simulator(take, simulator(draggy))
    assert verdicts(found)["air_drag_linear"] in ("should_not_have", "too_much")


def test_what_would_explain_the_simulator_as_well_is_told(take: diabolo.Recording) -> None:
    """The take is too slow to tell laws of drag apart, and shows no directions of sticks."""
    bare = diabolo.model_for("consistent", take)
    softer = diabolo.StringElasticity(compliance=1 / 150, damping=5.0)
    soft = diabolo.Model(bare.parameters, string_elasticity=softer)
    found = diabolo.compare_simulator(take, simulator(soft))
    [spring] = [law for law in found.laws if law.name in ("string_elasticity", "stick_flex")]
    assert spring.verdict == "should_not_have"
    assert {spring.name, *spring.tied_with} == {"string_elasticity", "stick_flex"}
    drags = {"air_drag_quadratic": "the drag of the air", "air_drag_linear": "a drag that grows with speed"}
    [law] = [law for law in found.laws if law.name in drags]
    assert {law.name, *law.tied_with} == set(drags)
    [other] = law.tied_with
    assert f"{drags[law.name]} (or {drags[other]})" in found.sentence


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (lambda start, tips, times: np.zeros((len(times), 5)), "expected"),
        (lambda start, tips, times: np.zeros((len(times) + 1, 7)), "one for each time"),
        (lambda start, tips, times: np.full((len(times), 7), np.nan), "not finite"),
        (lambda start, tips, times: "far", "expected an array"),
        (lambda start, tips, times: None, "expected"),
    ],
)
def test_what_a_simulator_gives_is_checked(
    take: diabolo.Recording, given: Callable[..., Any], words: str
) -> None:
    with pytest.raises(ValueError, match="simulate") as raised:
        diabolo.compare_simulator(take, given, bank=["string_friction"])
    assert words in str(raised.value)


def test_its_own_errors_go_on(take: diabolo.Recording) -> None:
    def fails(*_: object) -> States:
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        diabolo.compare_simulator(take, fails, bank=["string_friction"])


def test_positions_alone_say_nothing_about_the_spin(take: diabolo.Recording) -> None:
    bare = simulator(diabolo.model_for("consistent", take))
    found = diabolo.compare_simulator(take, lambda *asked: bare(*asked)[:, :3])
    assert verdicts(found)["string_friction"] == "lacks"


def test_no_simulated_recording_is_an_error(take: diabolo.Recording) -> None:
    with pytest.raises(ValueError, match="simulated: none"):
        diabolo.compare_simulator(take, [])


def test_command_compares_files_and_writes_them(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    take, simulated, out = SHIPPED / "puzzle_1.csv", tmp_path / "sim.csv", tmp_path / "out"
    assert main(["simulate", str(simulated), "--on", str(take), "--model", "consistent"]) == 0
    simulated.with_suffix(".json").unlink()  # string and diabolo are then the recording's
    assert main(["diagnose", str(take), "--simulated", str(simulated), "--out", str(out)]) == 0
    assert "lacks" in capsys.readouterr().out
    names = {"comparison.json", "diagnosis.json", "model.json", "report.html", "simulator.json"}
    assert {path.name for path in out.iterdir()} == names
    comparison = json.loads((out / "comparison.json").read_text(encoding="utf-8"))
    assert comparison["schema"] == "diabolo.comparison/1"
    assert any(law["verdict"] == "lacks" for law in comparison["laws"])
    page = report_html(comparison["real"], comparison)
    assert "Your simulator beside reality" in page and comparison["sentence"][:40] in page


def test_motion_has_what_a_simulator_needs(tmp_path: Path) -> None:
    path = tmp_path / "motion.csv"
    assert main(["motion", str(SHIPPED / "swing.csv"), str(path), "--rate", "500"]) == 0
    take = diabolo.load_recording(SHIPPED / "swing.csv")
    table = np.genfromtxt(path, delimiter=",", names=True)
    told = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
    np.testing.assert_allclose(np.diff(table["time"]), 2e-3, atol=1e-9)
    tips = np.column_stack([table[f"left_{axis}"] for axis in "xyz"])
    at = np.rint((take.time[take.left_valid] - take.time[0]) * 500).astype(int).clip(max=len(tips) - 1)
    assert np.median(np.linalg.norm(tips[at] - take.left[take.left_valid], axis=1)) < 2e-3
    assert told["string_length"] == take.string_length
    assert len(told["starts"]) > 3
    first = told["starts"][0]
    row = int(np.argmin(abs(take.time - take.time[0] - first["time"])))
    np.testing.assert_allclose(first["position"], take.diabolo[row])


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--rate", "0"], "--rate"),
        (["--rate", "1e12"], "--rate"),
        (["--rate", "nan"], "--rate"),
    ],
)
def test_motion_refuses_a_rate(
    arguments: list[str], words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["motion", str(SHIPPED / "swing.csv"), str(tmp_path / "m.csv"), *arguments]) == 2
    assert words in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_what_is_too_short_to_be_played_says_so() -> None:
    short = diabolo.load_recording(SHIPPED / "swing.csv").cut(0, 60)
    found = diabolo.compare_simulator(short, lambda *_: np.zeros((0, 7)))
    assert found.sentence.startswith("Nothing can be compared: of the recordings, only 1 window")
    assert found.simulated.headline == "INSUFFICIENT_DATA"
