# SPDX-License-Identifier: MIT
"""Turns of the string around the axle that come and go."""

from __future__ import annotations

import copy
import pickle

import diabolo
import numpy as np
import pytest
from diabolo import FiniteAxle, Model, Parameters, Predictor, State, StringFriction, motions

DT = 1e-3


def circled(angle: float) -> np.ndarray:
    """The right tip on a circle around a place below the left one; the angle from straight up to the left."""
    return np.array([0.0, 0.4 * np.sin(angle), 0.2 + 0.4 * np.cos(angle)])


def test_a_circling_tip_winds_a_turn_on() -> None:
    left, rate = np.array([0.0, 0.15, 1.1]), 8.0 * np.pi
    predictor = Predictor(
        Parameters(follow_turns=True),
        string_friction=StringFriction(coefficient=0.25, spin_gain=4.0),
        finite_axle=FiniteAxle(radius=0.0073),
    )
    state = State([0.0, 0.03, 0.25])
    told = []
    for i in range(250):
        begin, end = (circled(-0.4 + rate * k * DT) for k in (i, i + 1))
        status = predictor.step(state, left, begin, left, end, dt=DT)
        if status.turned:
            told.append((status.turned, status.turned_at))
    assert len(told) == 1
    assert told[0][0] == 1.0
    assert 0.0 < told[0][1] < DT
    assert 1.0 < state.turns < 2.0


def test_turns_are_part_of_a_state() -> None:
    state = State([0.0, 0.0, 0.0], turns=1.0)
    state.spin = 5.0
    assert state.turns == 1.0
    for other in (copy.copy(state), copy.deepcopy(state), pickle.loads(pickle.dumps(state))):
        assert other.turns == 1.0
    state.turns = -0.4
    assert state.turns == -0.4
    with pytest.raises(ValueError, match=r"turns: nan; expected -10 to 10"):
        State([0.0, 0.0, 0.0], turns=np.nan)
    with pytest.raises(ValueError, match=r"turns: inf; expected -10 to 10"):
        state.turns = np.inf


def test_the_rule_is_off_by_default_and_refuses_the_papers_string() -> None:
    assert Parameters().follow_turns is False
    with pytest.raises(ValueError, match="follow_turns: true under the string law 'pull_velocity'"):
        Parameters.paper(follow_turns=True)


def test_a_model_file_keeps_the_rule_and_the_wraps(tmp_path) -> None:  # type: ignore[no-untyped-def]
    model = Model(Parameters(wraps=1.0, follow_turns=True))
    model.save(tmp_path / "model.json")
    read = Model.load(tmp_path / "model.json")
    assert read.parameters == model.parameters
    assert "follow_turns" not in Model(Parameters(wraps=1.0)).to_json()


@pytest.mark.parametrize("figure", ["wind_up", "one_turn_low"])
def test_a_figure_on_one_turn_speeds_the_diabolo_up(figure: str) -> None:
    model = Model(
        Parameters(wraps=1.0, follow_turns=True, spin_coupling=0.0),
        string_friction=StringFriction(coefficient=0.25, spin_gain=3.8),
        finite_axle=FiniteAxle(radius=0.0073),
    )
    tips = motions.MOTIONS[figure](3.0)
    assert tips.end - tips.begin >= 3.0
    left, right, _, _ = tips.at(0.0)
    start = diabolo.hang_at_rest(model, left, right, 20.0)
    played = diabolo.rollout(model, start.to_array(), tips, dt=DT, string_state=start.string_state)
    assert played.states[-1, 6] > 25.0


def test_cycles_of_a_figure_follow_each_other() -> None:
    one, three = motions.cycles_of("wind_up", 1), motions.cycles_of("wind_up", 3)
    assert three.end - three.begin == pytest.approx(3.0 * (one.end - one.begin))
    with pytest.raises(ValueError, match="cycles: 0; expected a whole number from 1"):
        motions.cycles_of("wind_up", 0)
    with pytest.raises(ValueError, match="'somersault': expected one of"):
        motions.cycles_of("somersault", 1)
