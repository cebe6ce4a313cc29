# SPDX-License-Identifier: MIT
from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest
from diabolo import Parameters, Predictor, Spheroid, State, StickFlex, StringElasticity, StringState

LEFT, RIGHT = np.array([0.0, 0.3, 0.0]), np.array([0.0, -0.3, 0.0])
REST = (LEFT, RIGHT, LEFT, RIGHT)
G = 9.80665


def test_states_are_built_and_changed() -> None:
    state = State([0.0, 1.0, 2.0], velocity=[3.0, 4.0, 5.0], spin=6.0, string_state="flying")
    np.testing.assert_array_equal(state.to_array(), np.arange(7.0))
    assert state.string_state is StringState.FLYING
    other = copy.deepcopy(state)
    other.position = np.zeros(3)
    other.string_state = StringState.LOOSE
    other.spin = -1.0
    assert (state.spin, state.string_state) == (6.0, StringState.FLYING)
    assert repr(other) == (
        "State(position=[0.0, 0.0, 0.0], velocity=[3.0, 4.0, 5.0], spin=-1.0, string_state='loose')"
    )
    assert eval(repr(other), {"State": State}).to_array().tolist() == other.to_array().tolist()


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"position": [0.0, 0.0]}, r"position: shape \(2,\); expected \(3,\)"),
        ({"position": [0.0, 0.0, np.inf]}, "position: inf at index 2"),
        ({"position": np.zeros(3), "velocity": np.zeros((1, 3))}, r"velocity: shape \(1, 3\)"),
        ({"position": np.zeros(3), "spin": np.nan}, "spin: nan rad/s"),
        ({"position": np.zeros(3), "string_state": "gone"}, "string_state: 'gone'; expected 'on_string'"),
        ({"position": np.zeros(3), "string_state": 3}, "string_state: 3; expected"),
        ({"position": np.zeros(3), "string_state": 2**70}, "string_state: 1180591620717411303424; expected"),
    ],
)
def test_bad_states_are_refused(arguments: dict[str, object], text: str) -> None:
    with pytest.raises(ValueError, match=text):
        State(**arguments)  # type: ignore[arg-type]


def test_a_loose_diabolo_falls_freely() -> None:
    state = State([0.0, 0.0, -0.1], velocity=[0.0, 0.5, 1.0], spin=50.0)
    predictor = Predictor(Parameters())
    for _ in range(100):
        predictor.step(state, *REST, dt=1e-3)
    np.testing.assert_allclose(state.position, [0.0, 0.05, -0.1 + 0.1 - 0.5 * G * 0.01], atol=1e-12)
    np.testing.assert_allclose(state.velocity, [0.0, 0.5, 1.0 - G * 0.1], atol=1e-12)
    assert state.spin == 50.0


def test_the_string_comes_taut_once_and_holds() -> None:
    state = State([0.0, 0.05, -0.5])
    predictor = Predictor(Parameters())
    snaps = [predictor.step(state, *REST, dt=1e-3).snapped_taut for _ in range(1000)]
    assert snaps.count(True) == 1
    assert state.string_state == StringState.ON_STRING
    assert abs(Spheroid(LEFT, RIGHT, 1.45).path_length(state.position) - 1.45) < 1e-9


def test_a_hanging_diabolo_is_held_by_its_weight() -> None:
    spheroid = Spheroid(LEFT, RIGHT, 1.45)
    state = State(spheroid.center - [0.0, 0.0, spheroid.semi_minor], string_state="on_string")
    predictor = Predictor(Parameters())
    for _ in range(100):
        predictor.step(state, *REST, dt=1e-3)
    np.testing.assert_allclose(state.position[2], -spheroid.semi_minor, atol=1e-9)
    np.testing.assert_allclose(state.string_acceleration, [0.0, 0.0, G], atol=1e-6)


def test_an_elastic_string_gives_by_weight_times_compliance() -> None:
    spring = StringElasticity(compliance=1e-3, damping=20.0)
    spheroid = Spheroid(LEFT, RIGHT, 1.45)
    predictor = Predictor(Parameters(), string_elasticity=spring)
    state = State(spheroid.center - [0.0, 0.0, spheroid.semi_minor], string_state="on_string")
    for _ in range(5000):
        predictor.step(state, *REST, dt=1e-3)
    stretch = spheroid.path_length(state.position) - 1.45
    tension = predictor.parameters.mass * G / np.linalg.norm(spheroid.path_gradient(state.position))
    np.testing.assert_allclose(stretch, 1e-3 * tension, rtol=1e-6)


def test_velocities_default_to_those_of_straight_tips() -> None:
    left, right = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
    moved = (LEFT, RIGHT, LEFT + 1e-3 * left, RIGHT + 1e-3 * right)
    states = [State([0.0, 0.0, -0.66], string_state="on_string") for _ in range(3)]
    predictor = Predictor(Parameters())
    predictor.step(states[0], *moved, dt=1e-3)
    predictor.step(states[1], *moved, dt=1e-3, velocities=(left, right, left, right))
    predictor.step(states[2], *moved, dt=1e-3, velocities=np.zeros((4, 3)))
    np.testing.assert_allclose(states[0].to_array(), states[1].to_array(), atol=1e-14)
    assert np.abs(states[0].velocity - states[2].velocity).max() > 1e-3


def test_a_stick_that_points_along_its_strand_does_not_bend() -> None:
    start = np.array([0.0, 0.0, -Spheroid(LEFT, RIGHT, 1.45).semi_minor])
    strands = [(tip - start) / np.linalg.norm(tip - start) for tip in (LEFT, RIGHT)]
    rigid, pointed, unknown = (State(start, string_state="on_string") for _ in range(3))
    flexible = Predictor(Parameters(), stick_flex=StickFlex(compliance=1e-2))
    Predictor(Parameters()).step(rigid, *REST, dt=1e-3)
    flexible.step(pointed, *REST, dt=1e-3, directions=(*strands, *strands))
    flexible.step(unknown, *REST, dt=1e-3)
    np.testing.assert_allclose(pointed.to_array(), rigid.to_array(), atol=1e-12)
    assert np.abs(unknown.velocity - rigid.velocity).max() > 1e-3


def test_bad_steps_are_refused_and_change_nothing() -> None:
    predictor, state = Predictor(Parameters()), State([0.0, 0.0, -0.5])
    before = state.to_array()
    with pytest.raises(ValueError, match=r"dt: 0\.000000 s; must be positive"):
        predictor.step(state, *REST, dt=0.0)
    with pytest.raises(ValueError, match=r"left1: shape \(2,\); expected \(3,\)"):
        predictor.step(state, LEFT, RIGHT, [0.0, 0.0], RIGHT, dt=1e-3)
    with pytest.raises(ValueError, match=r"velocities\[2\]: shape \(1,\)"):
        predictor.step(state, *REST, dt=1e-3, velocities=(LEFT, LEFT, [0.0], LEFT))
    with pytest.raises(ValueError, match=r"directions\[1\]: norm 2\.0+; expected a unit vector, or zero"):
        predictor.step(state, *REST, dt=1e-3, directions=(LEFT * 0, [2.0, 0.0, 0.0], LEFT, LEFT))
    with pytest.raises(FloatingPointError, match="no longer finite"):
        predictor.step(state, *REST, dt=1e300)
    np.testing.assert_array_equal(state.to_array(), before)


def test_a_predictor_keeps_its_own_parameters() -> None:
    parameters = Parameters(mass=0.2)
    predictor = Predictor(parameters)
    parameters.mass = 0.3
    assert predictor.parameters.mass == 0.2


def test_states_and_predictors_can_be_pickled() -> None:
    predictor = Predictor(Parameters(), string_elasticity=StringElasticity.of_stiffness(600.0))
    state = State((0.1, 0.0, -0.6), (0.0, 0.3, 0.0), 50.0, "on_string")
    tips = ((0.0, 0.3, 0.0), (0.0, -0.3, 0.0)) * 2
    predictor.step(state, *tips, dt=1e-3)
    other = pickle.loads(pickle.dumps(state))
    assert repr(other) == repr(state)
    np.testing.assert_array_equal(other.string_acceleration, state.string_acceleration)
    predictor.step(state, *tips, dt=1e-3)
    pickle.loads(pickle.dumps(predictor)).step(other, *tips, dt=1e-3)
    np.testing.assert_array_equal(other.to_array(), state.to_array())
