# SPDX-License-Identifier: MIT
"""Laws by formulas: in Python, in models and in a diagnosis."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import diabolo
import numpy as np
import pytest
from diabolo import FormulaLaws, Model, TipMotion, cli

ROOT = Path(__file__).resolve().parents[2]
DRAG: dict[str, Any] = {
    "name": "own_drag",
    "acts": "against",
    "formula": "k * speed^2",
    "numbers": [{"name": "k", "unit": "1/m", "usual": 0.1, "minimum": 0, "value": 0.2}],
}


def test_laws_copy_pickle_and_read_back(tmp_path: Path) -> None:
    laws = FormulaLaws([DRAG])
    assert len(laws) == 1 and FormulaLaws(laws) == laws and FormulaLaws(laws.to_list()) == laws
    assert copy.deepcopy(laws) == laws and pickle.loads(pickle.dumps(laws)) == laws
    file = tmp_path / "own.laws.json"
    file.write_text(laws.to_json())
    assert FormulaLaws.load(file) == laws
    model = Model(formula_laws=[DRAG])
    assert Model(**model.to_dict()) == model and pickle.loads(pickle.dumps(model)) == model
    model.save(tmp_path / "m.json")
    assert Model.load(tmp_path / "m.json").formula_laws == laws
    assert "speed" in FormulaLaws.variables()


def test_a_law_by_a_formula_acts_as_that_of_the_library_in_rollouts_of_one_and_of_many() -> None:
    tips = TipMotion([0.0, 1.0], [[0.0, 0.3, 1.0], [0.1, 0.3, 1.1]], [[0.0, -0.3, 1.0], [0.1, -0.3, 0.9]])
    states = np.array([[0.0, 0.1 * i, 0.4, 0.0, 0.0, 0.0, 50.0] for i in range(5)])
    own = diabolo.rollout(Model(formula_laws=[DRAG]), states, tips, dt=1e-3, steps=900)
    ours = diabolo.rollout(Model(air=diabolo.Air(quadratic_drag=0.2)), states, tips, dt=1e-3, steps=900)
    one = diabolo.rollout(Model(formula_laws=[DRAG]), states[3], tips, dt=1e-3, steps=900)
    a, b, c = (np.asarray(r.states) for r in (own, ours, one))
    assert np.abs(a[..., :3] - b[..., :3]).max() < 5e-4
    assert np.array_equal(a[3].reshape(-1), c.reshape(-1))


def test_what_is_wrong_with_a_law_of_a_model_is_said() -> None:
    model = Model(formula_laws=[DRAG])
    assert model.formula_laws.to_list()[0]["name"] == "own_drag"
    assert Model(formula_laws=cast(Any, (DRAG,))).formula_laws == model.formula_laws
    with pytest.raises(ValueError, match="wind"):
        Model(formula_laws=[{**DRAG, "formula": "k * wind^2"}])
    with pytest.raises(TypeError, match="formula_laws: 5; expected FormulaLaws, a list of laws or None"):
        Model(formula_laws=cast(Any, 5))


def test_effects_of_a_model_are_set_as_they_are_given() -> None:
    model = Model()
    model.formula_laws = cast(Any, [DRAG])
    assert model.formula_laws == Model(formula_laws=[DRAG]).formula_laws
    with pytest.raises(ValueError, match="wind"):
        model.formula_laws = cast(Any, [{**DRAG, "formula": "k * wind^2"}])
    for name, kind in (
        ("formula_laws", "FormulaLaws, a list of laws or None"),
        ("residual_force", "ResidualForce or None"),
        ("magnus_lift", "MagnusLift or None"),
    ):
        with pytest.raises(TypeError, match=f"^{name}: 5; expected {kind}$"):
            setattr(model, name, 5)
        setattr(model, name, None)
    assert model == Model()


@pytest.mark.parametrize("given", [None, 5, "laws.json", {"name": "k"}, [object()], [b"law"], [float("nan")]])
def test_what_is_no_list_of_laws_is_refused(given: Any) -> None:
    expected = "expected FormulaLaws, or a list of laws that are made of texts and finite numbers"
    with pytest.raises(TypeError, match=f"^laws: .*; {expected}$"):
        FormulaLaws(given)


def test_a_list_of_laws_that_holds_itself_is_refused() -> None:
    endless: list[Any] = []
    endless.append(endless)
    with pytest.raises(TypeError, match=r"^laws: \[\[\.\.\.\]\]; expected FormulaLaws, or a list of laws"):
        FormulaLaws(endless)


def test_a_constant_law_of_the_friction_does_what_the_coefficient_does() -> None:
    law = {
        "name": "rough",
        "acts": "friction",
        "formula": "k",
        "numbers": [{"name": "k", "unit": "1", "value": 0.1}],
    }
    tips = diabolo.motions.swing_and_beat(1.0)
    start = [0.0, 0.0, 0.7, 0.0, 0.0, 0.0, 80.0]

    def end(coefficient: float, **laws: Any) -> np.ndarray[Any, Any]:
        friction = diabolo.StringFriction(coefficient=coefficient, spin_gain=3.0)
        model = Model(string_friction=friction, **laws)
        return np.asarray(diabolo.rollout(model, start, tips, dt=1e-3, steps=900).states[-1])

    none = FormulaLaws([{**law, "numbers": [{"name": "k", "unit": "1", "value": 1e-12}]}])
    np.testing.assert_allclose(end(0.1, formula_laws=[law]), end(0.2, formula_laws=none), atol=1e-7)
    assert np.abs(end(0.1, formula_laws=[law]) - end(0.1))[6] > 0.1


def test_a_law_of_time_goes_by_the_clock_of_a_part_in_rollouts_and_in_gradients(
    played: diabolo.Recording,
) -> None:
    gust = {
        "name": "gust",
        "acts": "left",
        "formula": "k * sin(9 * t)",
        "numbers": [{"name": "k", "unit": "m/s^2", "value": 2}],
    }
    start = np.array([0.0, 0.05, 0.3, 0.1, 0.0, 0.0, 100.0])
    model, part = Model(formula_laws=[gust]), TipMotion.of_recording(played.cut(150, 300))
    unheard = TipMotion(part.times, part.left, part.right, "spline", *part.directions_at(part.times))

    def end(tips: TipMotion) -> np.ndarray:
        return np.asarray(diabolo.rollout(model, start, tips, steps=500, record_every=500).states)[-1]

    found = diabolo.rollout_gradient(model, start, part, ["mass"], steps=500).state
    np.testing.assert_allclose(found, end(part), atol=1e-9)
    assert np.abs(found - end(unheard))[:3].max() > 1e-3


def test_the_shipped_example_reads() -> None:
    assert FormulaLaws.load(ROOT / "examples/laws/creep.laws.json").to_list()[0]["name"] == "creep"


def test_the_command_asks_about_the_laws_of_several_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = [tmp_path / f"{name}.laws.json" for name in ("first", "second")]
    for file in files:
        file.write_text(FormulaLaws([DRAG | {"name": file.name.split(".")[0]}]).to_json())
    asked: list[str] = []

    def stop(takes: Any, base: Any, *, laws: list[dict[str, Any]], **others: Any) -> None:
        asked.extend(law["name"] for law in laws)
        raise ValueError("enough")

    monkeypatch.setattr(cli.diagnose, "run_diagnosis", stop)
    take = ROOT / "data/recordings/swing.csv"
    assert cli.main(["diagnose", str(take), "--law", str(files[0]), "--law", str(files[1])]) == 2
    assert asked == ["first", "second"]


def test_the_command_says_of_each_own_law_whether_it_is_claimed() -> None:
    creep = SimpleNamespace(name="creep", claimed=True, reason="significant, and large enough to matter")
    drag = SimpleNamespace(name="own_drag", claimed=False, reason="not significant")
    limit = SimpleNamespace(name="own_drag", parameter="k", limit95=0.25, unit="1/s")
    result = SimpleNamespace(ladder=[creep, drag], upper_limits=[limit])
    names = ["own_drag", "creep", "untried"]
    assert [cli.diagnose.own_law_text(name, cast(Any, result)) for name in names] == [
        "your law own_drag: not claimed, not significant; k below 0.25 1/s",
        "your law creep: claimed, with the numbers above",
        "your law untried: not tested",
    ]


@pytest.mark.parametrize(
    ("laws", "sentence"),
    [
        (3, "laws: 3; expected FormulaLaws, a list of laws, or the name of their file"),
        ([3], 'laws: "laws[0]" is 3; expected an object'),
        ([DRAG | {"formula": "k *"}], 'laws: law "own_drag": formula "k *", character 4: it ends; expected'),
        ([DRAG | {"formula": "speed"}], 'laws: law "own_drag": number "k" is not in the formula'),
        ([DRAG, DRAG], 'laws: law "own_drag": the name is there twice'),
        ([DRAG | {"name": "wind"}], 'law "wind": the name is taken by one of the library'),
        ("nothing.json", "laws: nothing.json: "),
    ],
)
def test_what_is_no_law_is_told_in_a_sentence(laws: Any, sentence: str) -> None:
    take = ROOT / "data/recordings/swing.csv"
    with pytest.raises(ValueError) as error:
        diabolo.diagnose(take, laws=laws)
    assert str(error.value).startswith(sentence) and "\n" not in str(error.value)
