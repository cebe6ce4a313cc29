# SPDX-License-Identifier: MIT
from __future__ import annotations

import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest
from diabolo import (
    Model,
    Parameters,
    Predictor,
    RolloutWarning,
    State,
    StickFlex,
    StringElasticity,
    StringState,
    TipMotion,
    hang_at_rest,
    motions,
    plan_action,
    rollout,
)
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

DT = 1e-3
SWING = motions.swing(2.0)
BEAT = motions.beat(2.0)
STICKS = np.array([[0.8, 0.6, 0.0], [0.0, -0.6, 0.8]])
POINTED = TipMotion(
    SWING.times, SWING.left, SWING.right, "spline", *(np.tile(stick, (len(SWING), 1)) for stick in STICKS)
)
UNITS_OF_MILLIMETRES = TipMotion([0.0], [[0.0, 300.0, 0.0]], [[0.0, -300.0, 0.0]])
CENTRE = np.array([0.5, 0.0, 1.0])


def initial_states(count: int, seed: int) -> NDArray[np.float64]:
    """Somewhere below the tips, moving and spinning somehow."""
    print(f"seed {seed}")
    random = np.random.default_rng(seed)
    position = CENTRE + random.uniform([-0.1, -0.2, -0.6], [0.1, 0.2, -0.2], size=(count, 3))
    velocity = random.normal(scale=0.5, size=(count, 3))
    return np.hstack([position, velocity, random.uniform(-200.0, 200.0, size=(count, 1))])


@pytest.mark.parametrize("rate", [250.0, 500.0])
def test_tips_in_straight_lines_throw_as_smooth_ones_do(rate: float) -> None:
    """Whatever the rate of the lines, and whether steps end at their instants."""
    path = plan_action("throw_and_catch").path
    times = np.arange(path.begin, path.end, 1.0 / rate)
    left, right, *_ = path.tips().at(times)
    model = Parameters()
    start = hang_at_rest(model, left[0], right[0], 100.0)
    highest = {
        (how, dt): rollout(
            model, start.to_array(), TipMotion(times, left, right, how), dt=dt, string_state="on_string"
        )
        .states[:, 2]
        .max()
        for how in ("linear", "spline")
        for dt in (1.0 / rate, 0.25 / rate)
    }
    assert highest["spline", 1.0 / rate] > 1.9
    for height in highest.values():
        assert height == pytest.approx(1.907, abs=0.03), highest  # lines lag behind their curve


def step_by_step(
    predictor: Predictor, initial: NDArray[np.float64], tips: TipMotion, steps: int
) -> tuple[NDArray[np.float64], list[int]]:
    times = DT * np.arange(steps + 1)
    left, right, left_velocity, right_velocity = tips.at(times)
    left_stick, right_stick = tips.directions_at(times)
    state = State(initial[:3], initial[3:6], initial[6])
    states, string_states = [], []
    for i in range(steps):
        velocities = (left_velocity[i], right_velocity[i], left_velocity[i + 1], right_velocity[i + 1])
        sticks = (left_stick[i], right_stick[i], left_stick[i + 1], right_stick[i + 1])
        predictor.step(state, left[i], right[i], left[i + 1], right[i + 1], DT, velocities, sticks)
        states.append(state.to_array())
        string_states.append(int(state.string_state))
    return np.array(states), string_states


@pytest.mark.parametrize(
    "model",
    [
        Model(),
        Model(string_elasticity=StringElasticity.of_stiffness(600.0, 2.0)),
        Model(stick_flex=StickFlex(compliance=5e-3, damping=2.0)),
        Model.paper(),
        Model.published(),
    ],
    ids=["consistent", "elastic", "bending", "paper", "published"],
)
def test_a_batch_is_what_single_steps_are(model: Model) -> None:
    initial = initial_states(9, seed=4)
    batch = rollout(model, initial, POINTED, steps=500)
    predictor = Predictor(model)
    for i in range(len(initial)):
        states, string_states = step_by_step(predictor, initial[i], POINTED, 500)
        # Vector instructions may round otherwise; a taut string forgets that, and nothing here is chaotic.
        np.testing.assert_allclose(batch.states[i], states, rtol=1e-7, atol=1e-7)
        np.testing.assert_array_equal(batch.string_states[i], string_states)


@given(count=st.integers(1, 20), threads=st.integers(1, 5), seed=st.integers(0, 2**32 - 1))
def test_neither_threads_nor_neighbours_matter(count: int, threads: int, seed: int) -> None:
    initial = initial_states(count, seed)
    together = rollout(Parameters(), initial, BEAT, steps=300, record_every=100, threads=threads)
    alone = rollout(Parameters(), initial[-1], BEAT, steps=300, record_every=100, threads=1)
    np.testing.assert_array_equal(together.states[-1], alone.states)
    all_cores = rollout(Parameters(), initial, BEAT, steps=300, record_every=100, threads=0)
    np.testing.assert_array_equal(together.states, all_cores.states)
    np.testing.assert_array_equal(together.string_states, all_cores.string_states)


def test_shapes_and_types() -> None:
    batch = rollout(Parameters(), initial_states(3, seed=5), SWING, steps=100, record_every=20)
    assert (
        batch.time.shape == (5,) and batch.states.shape == (3, 5, 7) and batch.string_states.shape == (3, 5)
    )
    assert batch.states.dtype == np.float64 and batch.states.flags.c_contiguous
    assert batch.string_states.dtype == np.uint8
    np.testing.assert_allclose(batch.time, [0.02, 0.04, 0.06, 0.08, 0.1])
    single = rollout(Parameters(), initial_states(3, seed=5)[0], SWING, steps=100, record_every=20)
    assert single.states.shape == (5, 7) and single.string_states.shape == (5,)
    np.testing.assert_array_equal(single.states, batch.states[0])


def test_frames_are_taken_from_the_same_motion() -> None:
    initial = initial_states(2, seed=6)
    every = rollout(Parameters(), initial, SWING, steps=588)
    some = rollout(Parameters(), initial, SWING, steps=588, record_every=7 * 12)
    np.testing.assert_array_equal(some.states, every.states[:, 83::84])


def test_the_tips_decide_how_long_it_lasts() -> None:
    assert rollout(Parameters(), initial_states(1, seed=7)[0], SWING).states.shape == (2000, 7)
    assert rollout(Parameters(), initial_states(1, seed=7)[0], SWING, dt=0.3e-3).time[-1] <= 2.0
    later = rollout(Parameters(), initial_states(1, seed=7)[0], SWING, begin=1.5)
    assert later.states.shape == (500, 7)


def test_a_rollout_goes_on_where_another_ended() -> None:
    whole = rollout(Parameters(), initial_states(1, seed=8)[0], SWING, steps=1000)
    half = whole.states[499]
    rest = rollout(
        Parameters(), half, SWING, begin=0.5, steps=500, string_state=int(whole.string_states[499])
    )
    np.testing.assert_allclose(rest.states, whole.states[500:], atol=1e-8)


def test_models_tips_and_string_states_may_differ() -> None:
    initial = initial_states(2, seed=9)
    models: list[Model | Parameters] = [Parameters(string_length=1.4), Model.paper()]
    tips = [SWING, BEAT]
    batch = rollout(models, initial, tips, steps=200, string_state=["loose", "flying"])
    for i, name in enumerate(("loose", "flying")):
        alone = rollout(models[i], initial[i], tips[i], steps=200, string_state=name)
        np.testing.assert_array_equal(batch.states[i], alone.states)
        np.testing.assert_array_equal(batch.string_states[i], alone.string_states)
    assert batch.string_states[1, 0] != batch.string_states[0, 0] or not np.array_equal(*batch.states)


def test_one_state_serves_many_models() -> None:
    lengths = [1.40, 1.45, 1.50]
    initial = initial_states(1, seed=10)[0]
    batch = rollout([Parameters(string_length=length) for length in lengths], initial, SWING, steps=2000)
    assert batch.states.shape == (3, 2000, 7)
    lowest = batch.states[:, :, 2].min(axis=1)
    assert np.all(np.diff(lowest) < -0.02)  # the longer the string, the lower the diabolo


def test_no_steps_give_no_frames() -> None:
    assert rollout(Parameters(), initial_states(2, seed=1), SWING, steps=0).states.shape == (2, 0, 7)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"initial": np.zeros((2, 6))}, r"initial: shape \(2, 6\); expected \(7,\) or \(N, 7\)"),
        ({"initial": np.full((2, 7), np.nan)}, "initial: nan at index 0"),
        ({"dt": 0.0}, "dt: 0"),
        ({"dt": float("nan"), "steps": 5}, "dt: nan"),
        ({"steps": -1}, "steps: -1"),
        ({"record_every": 0}, "record_every: 0; expected a whole number from 1"),
        ({"steps": 10, "record_every": 3}, "steps: 10; expected a multiple of record_every, which is 3"),
        ({"threads": -1}, "threads: -1"),
        ({"threads": 1.5}, "threads: 1.5; expected a whole number"),
        ({"threads": 10**30}, "threads: 10"),
        ({"initial": np.zeros((0, 7))}, r"initial: shape \(0, 7\)"),
        ({"steps": None, "dt": 1e-9}, "frames; expected at most 100000000"),
        ({"steps": 10**10}, "rollout: 20000000000 frames"),
        ({"steps": None, "begin": 1e3}, r"begin: 1000\.0 s; the tips end at"),
        ({"model": "paper"}, "model: 'paper'; expected Model or Parameters"),
        ({"string_state": "away"}, "'away'; expected one of on_string, loose, flying"),
        ({"string_state": 3}, "string_state: 3"),
        ({"string_state": [0, 1, 2]}, "string_state: 3 given for 3 rollouts|initial: 2 given for 3 rollouts"),
        ({"string_state": np.zeros((2, 2), int)}, r"string_state: shape \(2, 2\)"),
        ({"model": [Parameters()] * 3}, "initial: 2 given for 3 rollouts; expected 1 or 3"),
        ({"tips": []}, "^tips: none; at least one expected$"),
        ({"begin": float("inf")}, "begin: inf s; must be within 1e9 s"),
        ({"begin": float("nan")}, "begin: nan s"),
        ({"dt": 1e-300}, "dt: 1e-300 s; must be within"),
        ({"steps": 10**30}, "steps: 1000000000000000000000000000000; expected a whole number"),
    ],
)
def test_bad_input_is_named(change: dict[str, object], text: str) -> None:
    arguments: dict[str, object] = {
        "model": Parameters(),
        "initial": np.zeros((2, 7)),
        "tips": SWING,
        "steps": 6,
        **change,
    }
    with pytest.raises(ValueError, match=text):
        rollout(**arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"initial": np.full((9, 7), 500.0)}, "initial: a coordinate of 500 m; are the positions in metres?"),
        ({"tips": [UNITS_OF_MILLIMETRES]}, "tips: 600 m apart, but the string is 1.45 m long"),
        ({"dt": 0.1}, "dt: 0.1 s; steps beyond 0.02 s leave out how the tips move"),
    ],
)
def test_other_units_are_warned_of_once(change: dict[str, object], sentence: str) -> None:
    arguments = {"model": Parameters(), "initial": np.zeros((9, 7)), "tips": SWING, "steps": 2, **change}
    with pytest.warns(RolloutWarning) as caught:
        rollout(**arguments)  # type: ignore[arg-type]
    assert [str(one.message) for one in caught] == [sentence]
    assert caught[0].filename == __file__


def test_a_tip_motion_of_another_type_is_named() -> None:
    with pytest.raises(ValueError, match=r"tips\[1\]: None; expected TipMotion"):
        rollout(Parameters(), np.zeros((2, 7)), [SWING, None], steps=1)  # type: ignore[list-item]


def test_what_is_not_finite_does_not_travel_on() -> None:
    initial = np.zeros((3, 7))
    initial[1, 3] = 1e308
    with pytest.raises(FloatingPointError, match="rollout 1: the state is no longer finite at frame"):
        rollout(Parameters(), initial, SWING, dt=0.02, steps=1000, string_state="flying")


def test_ctrl_c_ends_it_at_once_and_other_threads_run_on() -> None:
    initial = initial_states(2000, seed=11)
    delays = []
    for _ in range(3):
        pressed: list[float] = []

        def press(pressed: list[float] = pressed) -> None:
            pressed.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(0.1, press)  # runs only where the interpreter's lock is free
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            rollout(Parameters(), initial, SWING, steps=10_000_000, record_every=10_000_000)
        delays.append(time.monotonic() - pressed[0])
        timer.join()
    print(f"delays: {delays} s")
    assert min(delays) < 0.2


def test_tip_motions_can_be_pickled() -> None:
    other = pickle.loads(pickle.dumps(POINTED))
    assert repr(other) == repr(POINTED)
    for name in ("times", "left", "right", "left_directions", "right_directions"):
        np.testing.assert_array_equal(getattr(other, name), getattr(POINTED, name))
    flexible = Model(stick_flex=StickFlex(compliance=5e-3))
    initial = initial_states(1, seed=13)[0]
    ends = [rollout(flexible, initial, tips).states[-1] for tips in (POINTED, other, SWING)]
    np.testing.assert_array_equal(ends[0], ends[1])
    assert np.abs(ends[0] - ends[2]).max() > 1e-3


def test_sticks_that_are_not_known_have_no_direction() -> None:
    assert not SWING.left_directions.any() and not SWING.directions_at(0.5)[1].any()
    one = TipMotion(SWING.times, SWING.left, SWING.right, right_directions=POINTED.right_directions)
    assert not one.left_directions.any()
    np.testing.assert_array_equal(one.right_directions, POINTED.right_directions)
    with pytest.raises(ValueError, match=r"left_directions: shape \(1, 3\); expected \(\d+, 3\)"):
        TipMotion(SWING.times, SWING.left, SWING.right, left_directions=STICKS[:1])


def test_string_states_are_those_of_the_enumeration() -> None:
    result = rollout(Parameters(), initial_states(5, seed=12), SWING)
    assert set(np.unique(result.string_states)) <= {int(state) for state in StringState}
    assert np.any(result.string_states == StringState.ON_STRING)
