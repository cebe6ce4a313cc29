# SPDX-License-Identifier: MIT
"""The axle in Python: a rigid diabolo, and hands that level it."""

from __future__ import annotations

import copy
import json
import pickle
import re
from collections.abc import Callable
from pathlib import Path

import diabolo
import numpy as np
import pytest
from conftest import rotation
from diabolo import (
    Groove,
    GyroscopicTilt,
    LevelHands,
    LevelHorizon,
    Model,
    Parameters,
    Predictor,
    Recording,
    State,
    StickSpline,
)
from diabolo.cli import main
from diabolo.cli.plan import recording_of
from diabolo.live.page import live_html
from diabolo.live.play import DT, STEPS_PER_SAMPLE, Play
from diabolo.view import predict_anew
from numpy.typing import NDArray

LEFT, RIGHT = [0.55, 0.3, 1.25], [0.55, -0.3, 1.25]
RIGID = Model(
    Parameters(spin_coupling=0.0),
    gyroscopic_tilt=GyroscopicTilt(gain=3.4, inertia_ratio=1.2),
    groove=Groove(profile_radius=0.004, half_width=0.005),
)
TILTED = np.array([np.cos(0.2), 0.0, np.sin(0.2)])


def axes_of(recording: Recording) -> NDArray[np.float64]:
    """Where body x lies, row by row."""
    assert recording.diabolo_orientation is not None
    return np.array([rotation(turn)[:, 0] for turn in recording.diabolo_orientation])


def tilted_take() -> Recording:
    """A second of a diabolo that hangs below resting hands while its groove yaws it."""
    tips = diabolo.TipMotion([0.0, 1.0], [LEFT] * 2, [RIGHT] * 2)
    start = diabolo.hang_at_rest(RIGID, LEFT, RIGHT, 60.0).to_array()
    told = diabolo.rollout(
        RIGID,
        start,
        tips,
        dt=1 / 960,
        steps=960,
        record_every=8,
        string_state="on_string",
        axis=TILTED,
        axle=True,
    )
    assert told.axis is not None
    tracks = [np.vstack([first, rest]) for first, rest in ((start, told.states), (TILTED, told.axis))]
    hands = np.tile(LEFT, (121, 1)), np.tile(RIGHT, (121, 1))
    properties, time = diabolo.played_properties(RIGID.parameters), np.arange(121) / 120.0
    return diabolo.played_recording("tilted", time, *hands, tracks[0], 120.0, properties, 1.45, tracks[1])


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


def test_a_prediction_tells_the_axle() -> None:
    take = tilted_take()
    predicted = diabolo.predict(take, RIGID)
    assert predicted.axis is not None and predicted.tumble is not None and predicted.turns is not None
    assert predicted.axis == pytest.approx(axes_of(take), abs=0.02)  # its first velocity is rounded
    assert np.abs(predicted.axis[-1] - TILTED).max() > 0.1
    assert predicted.tumble[0].tolist() == [0.0, 0.0, 0.0] and predicted.tumble[-1].any()
    late = diabolo.predict(take, RIGID, row=60, start="fair")
    assert late.axis is not None and np.isnan(late.axis[:60]).all()
    assert late.axis[60] == pytest.approx(axes_of(take)[60], abs=1e-9)


def test_simulate_on_a_recording_writes_the_axle_that_was_simulated(tmp_path: Path) -> None:
    take, model, out = tmp_path / "take.csv", tmp_path / "rigid.json", tmp_path / "out.csv"
    tilted_take().save(take)
    RIGID.save(model)
    assert main(["simulate", str(out), "--on", str(take), "--model", str(model), "--json", "-"]) == 0
    written, predicted = Recording.load(out), diabolo.predict(take, Model.load(model))
    assert predicted.axis is not None and np.abs(predicted.axis[-1] - TILTED).max() > 0.1
    assert axes_of(written) == pytest.approx(predicted.axis, abs=1e-6)  # the file has nine digits
    assert np.nanmean(written.spin()) == pytest.approx(60.0, rel=0.01)


def test_a_plan_is_written_with_the_axle_that_was_planned_on() -> None:
    left, right = diabolo.plan_action("swing").path.derivatives(np.zeros(1))[0][0].reshape(2, 3)
    start = diabolo.hang_at_rest(RIGID, left, right, 60.0)
    start.axis = TILTED
    played = diabolo.plan_action("swing", RIGID, start=start)
    assert played.axis[0] == pytest.approx(TILTED)
    written = recording_of(played, "tilted", diabolo.played_properties(RIGID.parameters), 1.45)
    seen = diabolo.rollout(
        RIGID,
        start.to_array(),
        played.path.tips(),
        dt=1 / 960,
        record_every=4,
        string_state=start.string_state,
        axis=TILTED,
        axle=True,
    ).axis
    assert seen is not None and np.abs(seen[-1] - TILTED).max() > 0.1
    rows = min(len(seen), len(written) - 1)
    assert axes_of(written)[1 : rows + 1] == pytest.approx(seen[:rows], abs=0.01)  # other steps
    assert played.axis[-1] == pytest.approx(axes_of(written)[-1], abs=0.01)


def test_a_live_play_shows_and_records_the_axle() -> None:
    play = Play(RIGID, 60.0)
    play.state.axis = TILTED
    play.advance(1.0)
    while play.steps % STEPS_PER_SAMPLE:
        play.advance(DT)
    assert np.abs(play.state.axis - TILTED).max() > 0.1
    shown = np.array(json.loads(play.frame())["orientation"])
    assert rotation(shown)[:, 0] == pytest.approx(play.state.axis, abs=1e-3)  # four digits
    assert f'"orientation":[{json.dumps(shown.tolist(), separators=(",", ":"))}]' in live_html(play)
    taken = play.recording("live")
    assert taken is not None
    assert axes_of(taken[0])[-1] == pytest.approx(play.state.axis, abs=1e-9)


def test_a_ghost_lies_as_it_is_predicted() -> None:
    take = tilted_take()
    predicted = predict_anew(take, RIGID, 0.5)
    seen = np.isfinite(predicted[:, 0])
    assert seen.sum() > 80
    assert predicted[seen, 3:] == pytest.approx(axes_of(take)[seen], abs=0.03)  # predicted by a fair start
    page = diabolo.view_html(take, predictions={"rigid": predicted, "place": take.diabolo})
    data = json.loads(re.search(r"const data = (\{.*\});\n", page)[1])  # type: ignore[index]
    rigid, place = data["predictions"]
    assert rigid["axes"][-1] == predicted[-1, 3:].round(4).tolist()
    assert rigid["positions"][-1] == predicted[-1, :3].round(4).tolist()
    assert place["axes"] == []


def expect_levelled(hands: LevelHands | LevelHorizon, see: Callable[[float, State], None]) -> None:
    """Hands take back a tilt of 0.3 rad within six seconds."""
    state = diabolo.hang_at_rest(RIGID, LEFT, RIGHT, 60.0)
    state.axis = [np.cos(0.3), 0.0, np.sin(0.3)]
    predictor = Predictor(RIGID)
    left, right, _, _ = hands.tips(LEFT, RIGHT)
    for step in range(6000):
        if step % 10 == 0:
            see(1e-3 * step, state)
        hands.advance(1e-3)
        before = left, right
        left, right, _, _ = hands.tips(LEFT, RIGHT)
        predictor.step(state, *before, left, right, 1e-3)
    assert abs(state.axis[2]) < 0.02
    assert np.arctan2(state.axis[1], state.axis[0]) == pytest.approx(hands.heading, abs=0.05)


def test_hands_level_an_axle() -> None:
    hands = LevelHands(RIGID, LEFT, RIGHT, 60.0)
    assert hands.gains.shape == (2, 3)
    expect_levelled(hands, lambda _, state: hands.see(state.axis, state.spin))


def test_hands_take_no_lead_while_the_diabolo_flies() -> None:
    hands = LevelHands(RIGID, LEFT, RIGHT, 60.0)
    tilted = np.array([np.cos(0.3), 0.0, np.sin(0.3)])
    leads = []
    for string in ("on_string", "flying", diabolo.StringState.LOOSE, 0):
        hands.see(tilted, 60.0, string)
        for _ in range(100):
            hands.advance(0.01)
        leads.append(abs(hands.lead))
    assert min(leads[0], leads[3]) > 0.5
    assert max(leads[1], leads[2]) < 1e-3
    with pytest.raises(ValueError, match="string_state: 'up'"):
        hands.see(tilted, 60.0, "up")


def test_hands_level_an_axle_by_a_receding_horizon() -> None:
    hands = LevelHorizon(RIGID, LEFT, RIGHT, 60.0)
    still = StickSpline([0.0, 0.5], [LEFT] * 2, [RIGHT] * 2).path()
    expect_levelled(hands, lambda time, state: hands.see(time, state, still))
    state = diabolo.hang_at_rest(RIGID, LEFT, RIGHT, 60.0)
    with pytest.raises(ValueError, match="time"):
        hands.see(float("nan"), state, still)
    with pytest.raises(ValueError, match="gyroscopic_tilt gain: 0 1/m"):
        LevelHorizon(Model(), LEFT, RIGHT, 60.0)


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
    with pytest.raises(ValueError, match=r"quickness: .*; expected a positive number up to 100"):
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
