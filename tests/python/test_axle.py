# SPDX-License-Identifier: MIT
"""The axle in Python: a rigid diabolo, and hands that level it."""

from __future__ import annotations

import copy
import pickle

import diabolo
import numpy as np
import pytest
from diabolo import Groove, GyroscopicTilt, LevelHands, Model, Parameters, Predictor, State

LEFT, RIGHT = [0.55, 0.3, 1.25], [0.55, -0.3, 1.25]
RIGID = Model(
    Parameters(spin_coupling=0.0),
    gyroscopic_tilt=GyroscopicTilt(gain=3.4, inertia_ratio=1.2),
    groove=Groove(profile_radius=0.004, half_width=0.005),
)


def test_a_state_carries_the_tumble_of_its_axle() -> None:
    state = State([0, 0, 1], axis=[1, 0, 0], tumble=[0.0, 0.5, -0.2])
    assert state.tumble.tolist() == [0.0, 0.5, -0.2]
    for other in (copy.copy(state), copy.deepcopy(state), pickle.loads(pickle.dumps(state))):
        assert other.tumble.tolist() == state.tumble.tolist()
    state.axis = [0.0, 1.0, 0.0]  # what is now along the axle is spin
    assert state.tumble.tolist() == [0.0, 0.0, -0.2]
    with pytest.raises(ValueError, match=r"tumble: .* rad/s about the axis; expected"):
        State([0, 0, 1], tumble=[1.0, 0.0, 0.0])
    with pytest.raises(ValueError, match="tumble"):
        state.tumble = [0.0, np.nan, 0.0]


def test_a_rigid_axle_nutes_in_flight() -> None:
    state = State([0, 0, 50], spin=90.0, string_state="flying", tumble=[0.0, 1.0, 0.0])
    predictor = Predictor(RIGID)
    axes = []
    for _ in range(200):
        predictor.step(state, LEFT, RIGHT, LEFT, RIGHT, 1e-3)
        axes.append(state.axis)
    momentum = 1.2 * state.tumble - 90.0 * state.axis
    assert momentum == pytest.approx(
        1.2 * np.array([0.0, 1.0, 0.0]) - 90.0 * np.array([1.0, 0.0, 0.0]), abs=1e-9
    )
    assert np.ptp(np.array(axes)[:, 1:], axis=0).min() > 0.01


def test_a_rollout_tells_what_the_axle_does() -> None:
    tips = diabolo.TipMotion([0.0], [LEFT], [RIGHT])
    start = [0.55, 0.0, 0.6, 0.0, 0.0, 0.0, 60.0]
    axis = [[1.0, 0.0, 0.0], [np.cos(0.2), 0.0, np.sin(0.2)]]
    told = diabolo.rollout(RIGID, start, tips, steps=300, axis=axis, record_every=100, axle=True)
    assert told.axis is not None and told.tumble is not None and told.turns is not None
    assert (told.axis.shape, told.tumble.shape, told.turns.shape) == ((2, 3, 3), (2, 3, 3), (2, 3))
    assert np.linalg.norm(told.axis, axis=-1) == pytest.approx(np.ones((2, 3)))
    assert np.abs(told.axis[1, -1] - axis[1]).max() > 0.01  # the flank yaws it
    state = State(start[:3], spin=60.0, axis=axis[1])
    predictor = Predictor(RIGID)
    for _ in range(300):
        predictor.step(state, LEFT, RIGHT, LEFT, RIGHT, 1e-3)
    assert told.axis[1, -1] == pytest.approx(state.axis, abs=1e-9)
    assert told.tumble[1, -1] == pytest.approx(state.tumble, abs=1e-9)
    alone = diabolo.rollout(RIGID, start, tips, steps=300, record_every=100, axle=True)
    assert alone.axis is not None and alone.axis.shape == (3, 3)
    assert diabolo.rollout(RIGID, start, tips, steps=10).axis is None


def test_a_played_recording_lies_as_its_axle() -> None:
    time = np.arange(50) / 200.0
    tilt = 0.3 * time
    axis = np.column_stack([np.cos(tilt), np.zeros(50), np.sin(tilt)])
    states = np.tile([0.0, 0.0, 0.6, 0.0, 0.0, 0.0, 70.0], (50, 1))
    tips = np.tile(LEFT, (50, 1)), np.tile(RIGHT, (50, 1))
    properties = diabolo.played_properties(Parameters())
    take = diabolo.played_recording("tilted", time, *tips, states, 200.0, properties, 1.45, axis)
    x, y, z, w = np.asarray(take.diabolo_orientation).T
    seen = np.column_stack([1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)])
    assert seen == pytest.approx(axis, abs=1e-9)
    assert diabolo.start_state(take, 20).spin == pytest.approx(70.0, abs=0.1)
    with pytest.raises(ValueError, match="axis: norm 2 in row 0; expected unit vectors"):
        diabolo.played_recording("tilted", time, *tips, states, 200.0, properties, 1.45, 2.0 * axis)


def test_hands_level_an_axle() -> None:
    hands = LevelHands(RIGID, LEFT, RIGHT, 60.0)
    assert hands.gains.shape == (2, 3)
    state = diabolo.hang_at_rest(RIGID, LEFT, RIGHT, 60.0)
    state.axis = [np.cos(0.3), 0.0, np.sin(0.3)]
    predictor = Predictor(RIGID)
    left, right, _, _ = hands.tips(LEFT, RIGHT)
    for step in range(6000):
        if step % 10 == 0:
            hands.see(state.axis, state.spin)
        hands.advance(1e-3)
        before = left, right
        left, right, _, _ = hands.tips(LEFT, RIGHT)
        predictor.step(state, *before, left, right, 1e-3)
    assert abs(state.axis[2]) < 0.02
    assert np.arctan2(state.axis[1], state.axis[0]) == pytest.approx(hands.heading, abs=0.05)


def test_a_rollout_goes_on_from_a_state() -> None:
    state = State([0, 0, 50], spin=90.0, string_state="flying", tumble=[0.0, 5.0, 0.0])
    tips = diabolo.TipMotion([0.0], [LEFT], [RIGHT])
    batched = diabolo.rollout(
        RIGID, state.to_array(), tips, steps=300, string_state=state.string_state, tumble=[state.tumble]
    )
    assert batched.states.shape[0] == 1
    with pytest.raises(ValueError, match=r"turns: .*; expected -10 to 10"):
        diabolo.rollout(RIGID, state.to_array(), tips, steps=3, turns=30.0)
    with pytest.raises(ValueError, match=r"tumble: .*about the axis"):
        diabolo.rollout(RIGID, state.to_array(), tips, steps=3, tumble=[1.0, 0.0, 0.0])


def test_a_spin_is_set_and_the_rest_stays() -> None:
    state = State([0, 0, 1], axis=[1, 0, 0], tumble=[0.0, 0.5, 0.0], turns=1.0)
    state.spin = 70.0
    assert (state.spin, state.turns, state.tumble[1]) == (70.0, 1.0, 0.5)
    with pytest.raises(ValueError, match=r"tumble: .*at most"):
        State([0, 0, 1], tumble=[0.0, 1e200, 0.0])
    with pytest.raises(ValueError, match=r"turns: 30; expected -10 to 10"):
        state.turns = 30.0


def test_what_cannot_be_levelled_is_refused() -> None:
    with pytest.raises(ValueError, match="gyroscopic_tilt gain: 0 1/m"):
        LevelHands(Model(), LEFT, RIGHT, 60.0)
    with pytest.raises(ValueError, match=r"spin: .*needs 10 at least"):
        LevelHands(RIGID, LEFT, RIGHT, 3.0)
    with pytest.raises(ValueError, match=r"spin: inf"):
        LevelHands(RIGID, LEFT, RIGHT, float("inf"))
    with pytest.raises(ValueError, match=r"hands: 2 m apart; expected less than the string's"):
        LevelHands(RIGID, [0, 1, 1], [0, -1, 1], 60.0)
    for left, right in ((RIGHT, LEFT), (LEFT, LEFT), ([0.8, 0, 1], [0.3, 0, 1])):
        with pytest.raises(ValueError, match="expected them side by side"):
            LevelHands(RIGID, left, right, 60.0)
    with pytest.raises(ValueError, match=r"quickness: .*; must be above 0 and at most 100"):
        LevelHands(RIGID, LEFT, RIGHT, 60.0, quickness=1e300)
    with pytest.raises(ValueError, match="lead: -1"):
        LevelHands(RIGID, LEFT, RIGHT, 60.0, lead=-1.0)
    hands = LevelHands(RIGID, LEFT, RIGHT, 60.0)
    hands.see([1.0, 0.0, 0.0], 3.0)  # slower than it can be steered: as it was
    with pytest.raises(ValueError, match="axis: norm"):
        hands.see([1.0, 1.0, 0.0], 60.0)
    with pytest.raises(ValueError, match="spin"):
        hands.see([1.0, 0.0, 0.0], float("nan"))
    with pytest.raises(ValueError, match="dt: 0"):
        hands.advance(0.0)


def test_a_throw_is_aimed_again_by_its_own_error() -> None:
    assert diabolo.aimed_again((0.6, 0.0), (0.6, 0.0), (0.54, 0.03)) == pytest.approx((0.66, -0.03))
    with pytest.raises(ValueError, match=r"came: shape \(3,\)"):
        diabolo.aimed_again((0.6, 0.0), (0.6, 0.0), (0.5, 0.0, 0.0))
    with pytest.raises(ValueError, match="aim"):
        diabolo.aimed_again((float("nan"), 0.0), (0.6, 0.0), (0.5, 0.0))
