# SPDX-License-Identifier: MIT
"""A residual force: learnt from recordings, in models, and in rollouts."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
import pytest
from conftest import make_recording
from diabolo import Model, ResidualForce, TipMotion

OWN_LAW: dict[str, Any] = {  # of no name: a drag that grows with the pull
    "name": "own",
    "acts": "against",
    "formula": "k * tanh(speed / 0.2) * (1 + 0.2 * pull) * taut",
    "numbers": [{"name": "k", "unit": "m/s^2", "usual": 0.3, "minimum": -10, "maximum": 10, "value": 0.5}],
}


def part(weight: float) -> dict[str, list[float]]:
    return {"weights": [weight] * 25, "low": [-2.0] * 8, "high": [2.0] * 8}


def force(weight: float = 0.1) -> ResidualForce:
    return ResidualForce(largest=1.0, power=2.0, on_string=part(weight), off_string=part(-weight))


def test_it_copies_pickles_and_reads_back(tmp_path: Path) -> None:
    learnt = force()
    assert learnt and not ResidualForce() and learnt != ResidualForce()
    assert ResidualForce(**learnt.to_dict()) == learnt and eval(repr(learnt)) == learnt
    assert copy.deepcopy(learnt) == learnt and pickle.loads(pickle.dumps(learnt)) == learnt
    model = Model(residual_force=learnt)
    assert Model(**model.to_dict()) == model and pickle.loads(pickle.dumps(model)) == model
    model.save(tmp_path / "m.json")
    assert Model.load(tmp_path / "m.json").residual_force == learnt
    assert not Model(residual_force=None).residual_force


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"largest": 50.0}, '"largest" is 50'),
        ({"on_string": {"weights": [0.0]}}, "on_string"),
        ({"on_string": part(0.1) | {"high": [-3.0] * 8}}, 'no number below that of "low"'),
        ({"size": 1.0}, 'unknown field "size"'),
    ],
)
def test_what_is_no_residual_is_told(change: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match="residual_force") as caught:
        ResidualForce(**(force().to_dict() | change))
    assert told in str(caught.value)


def test_it_acts_alike_in_rollouts_of_one_and_of_many() -> None:
    tips = TipMotion([0.0, 1.0], [[0.0, 0.3, 1.0], [0.1, 0.3, 1.1]], [[0.0, -0.3, 1.0], [0.1, -0.3, 0.9]])
    states = np.array([[0.0, 0.1 * i, 0.4, 0.0, 0.0, 0.0, 50.0] for i in range(5)])
    model = Model(residual_force=force())
    many = np.asarray(diabolo.rollout(model, states, tips, dt=1e-3, steps=900).states)
    one = np.asarray(diabolo.rollout(model, states[3], tips, dt=1e-3, steps=900).states)
    without = np.asarray(diabolo.rollout(Model(), states, tips, dt=1e-3, steps=900).states)
    assert np.array_equal(many[3].reshape(-1), one.reshape(-1))
    assert np.abs(many - without).max() > 1e-3
    with pytest.raises(ValueError, match="another residual"):
        diabolo.rollout([model, Model(), model, model, model], states, tips, dt=1e-3, steps=10)


def median_error(take: diabolo.Recording, model: Model) -> float:
    (row,) = diabolo.evaluate(take, model, horizons=[0.5], starts_every=0.2).horizons
    assert row.score.model is not None
    return row.score.model.median


def takes_of(model: Model) -> list[diabolo.Recording]:
    played = (("swing", 14.0, 90.0), ("swing", 12.0, 110.0), ("beat", 8.0, 120.0), ("swing", 6.0, 100.0))
    return [
        make_recording(motion, seconds, spin, f"{motion}_{spin:g}", model=model, noise=1e-4)
        for motion, seconds, spin in played
    ]


def test_it_halves_the_error_of_a_law_without_a_name_on_a_take_held_out() -> None:
    *learnt_from, held_out = takes_of(Model(formula_laws=[OWN_LAW]))
    fit = diabolo.fit_residual(learnt_from)
    assert fit.stands and fit.error < 0.5 * fit.base_error
    assert fit.gain_ci95 is not None and fit.gain_ci95[0] > 1e-3
    assert median_error(held_out, fit.model) < 0.5 * median_error(held_out, Model.consistent())


def test_it_stands_back_where_nothing_is_missing() -> None:
    fit = diabolo.fit_residual(takes_of(Model()))
    assert not fit.stands and fit.model == Model.consistent()


def test_bad_input_is_told() -> None:
    take = make_recording(seconds=2.0)
    for given, told in (([], "recordings"), ([take, take], "hold the same")):
        with pytest.raises(ValueError, match=told):
            diabolo.fit_residual(given)
    with pytest.raises(ValueError, match="threads"):
        diabolo.fit_residual(take, threads=-1)
    with pytest.raises(ValueError, match="base"):
        diabolo.fit_residual(take, "custom")
