# SPDX-License-Identifier: MIT
"""Stick motions that make the diabolo do what is wanted."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping, Sequence
from copy import copy
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import (
    ACTION_NAMES,
    Freedom,
    Goals,
    Model,
    Parameters,
    Plan,
    State,
    StickSpline,
    TipLimits,
    TipPath,
)
from .checks import (
    LARGEST_SEED,
    AnyRecording,
    instance_of,
    list_of,
    model_of,
    number,
    numbers,
    recording_of,
    shown,
    warn_of,
    whole_number,
)
from .enums import StringState

AnyModel: TypeAlias = Model | Parameters | str
Solver: TypeAlias = Literal["gradient", "walk"]

ACTIONS: tuple[str, ...] = (*ACTION_NAMES, "throw_and_catch")
"""What `plan_action` knows."""
MOST_CYCLES = 1000
LONGEST_SEARCH = 1e6  # [s]
LONGEST_PLAY = 3600.0  # [s]
LONGEST_FLIGHT = 10.0  # that a play shows after its end; it ends at the height of the hands [s]
WANTED = {
    "height": ("hop", "throw", "side_throw", "throw_and_catch"),
    "sideways": ("swing", "side_throw", "throw_and_catch"),
    "spin_gain": ("linear_acceleration", "circular_acceleration"),
}
"""What may be wanted of which action."""
GUESSED = ("string_length", "air_drag_quadratic", "magnus_lift")
"""What `best_guess` takes from a diagnosis."""
LARGEST_FOUND = 1e6


class PlannedPlay(NamedTuple):
    """A planned motion, and what it leads to by the model that it was planned with."""

    action: str
    path: TipPath
    """Of the tips."""
    plans: list[Plan]
    """One a cycle; of a throw and catch, two, or one where there is nothing to catch."""
    wanted: list[Goals]
    """The goals of the first cycle."""
    start: State
    time: NDArray[np.float64]
    """[s], shape (N,)."""
    states: NDArray[np.float64]
    """Position [m], velocity [m/s] and spin [rad/s], shape (N, 7)."""
    string_states: NDArray[np.uint8]
    """As in StringState, shape (N,)."""
    left: NDArray[np.float64]
    """Left tip [m], shape (N, 3)."""
    right: NDArray[np.float64]
    planning_time: float
    """Of all plans together [s]."""
    ended: str = ""
    """Why there are fewer cycles than were asked for; empty where there are not."""

    @property
    def reached(self) -> bool:
        """Whether every goal of every cycle is reached."""
        return not self.ended and all(plan.reached for plan in self.plans)

    @property
    def answer(self) -> str:
        """The same in a sentence: that of the first plan that misses a goal, or why there are no more."""
        each = 2 if self.action == "throw_and_catch" else 1
        several = len(self.plans) > each or self.ended != ""
        for index, plan in enumerate(self.plans):
            if not plan.reached:
                return (f"cycle {index // each + 1}: " if several else "") + plan.answer
        return self.ended or "every goal is reached"


def plan(
    start: State | Sequence[State],
    seed: StickSpline,
    goals: Goals,
    model: AnyModel | Sequence[AnyModel] = "consistent",
    *,
    limits: TipLimits | None = None,
    freedom: Freedom | None = None,
    solver: Solver = "gradient",
    evaluations: int = 100_000,
    seconds: float = 10.0,
    random_seed: int = 1,
    dt: float = 4e-3,
) -> Plan:
    """Find a motion of the tips near `seed` that reaches the goals and keeps the limits.

    start: of the diabolo when the motion begins; of several models one for all, or one for each.
    model: what the diabolo may do. Several are planned for at once: their mean cost counts, and the first
        one is the nominal one.
    solver: "gradient" follows derivatives through the prediction; "walk" is the paper's random walk, whose
        random numbers `random_seed` decides.
    evaluations, seconds: at most so many motions are predicted, at most so long; then the best so far counts.
    dt: longest step of the search [s].

    Every plan keeps its limits. A goal that is missed is named by `answer`, with what stood in the way.
    Ctrl-C ends it at once. Raises ValueError about bad input.
    """
    return _core.plan(
        _models(model),
        list_of("start", start, (State,)),
        seed,
        goals,
        TipLimits() if limits is None else limits,
        Freedom() if freedom is None else freedom,
        solver,
        whole_number("evaluations", evaluations, 1, 2**31 - 1),
        min(number("seconds", seconds), LONGEST_SEARCH),
        whole_number("random_seed", random_seed, 0, LARGEST_SEED),
        dt,
    )


def plan_action(
    name: str,
    model: AnyModel | Sequence[AnyModel] = "consistent",
    *,
    start: State | None = None,
    cycles: int = 1,
    spin: float = 100.0,
    size: float = 1.0,
    pace: float = 1.0,
    height: float | None = None,
    sideways: float | None = None,
    spin_gain: float | None = None,
    limits: TipLimits | None = None,
    solver: Solver = "gradient",
    seconds: float = 10.0,
    random_seed: int = 1,
    dt: float = 4e-3,
    sticks: ArrayLike | None = None,
) -> PlannedPlay:
    """Plan a figure of play from its home pose.

    name: one of ACTIONS.
    start: of the diabolo; by default it hangs with the given spin [rad/s], see `hanging`.
    cycles: so many in a row, each planned from the predicted end of the one before, where position, velocity
        and acceleration of the tips go on; fewer, and `ended` says why, where a throw leaves nothing to catch
        or no motion goes on within the limits.
    size, pace: of the seed's hands, relative to the usual ones.
    height: of a throw's apex above the tips, or of a hop [m]; sideways: how far to the left a swing goes or a
    throw comes down [m]; spin_gain: wanted of each cycle of acceleration [rad/s] (needs a model with string
    friction).
    sticks: their directions throughout, unit vectors, shape (6,), left over right; by default not known, and
    a StickFlex then gives in every direction. The rest is as for `plan`; of several models each starts where
    it hangs, if no start is given, and goes on from where it is predicted to be.

        plan_action("throw_and_catch", height=0.6).answer
    """
    if name not in ACTIONS:
        raise ValueError(f"name: {shown(name)}; expected one of {', '.join(ACTIONS)}")
    for what, value in (("height", height), ("sideways", sideways), ("spin_gain", spin_gain)):
        if value is not None and name not in WANTED[what]:
            raise ValueError(
                f"{what}: nothing that {name} can aim at; expected with {', '.join(WANTED[what])}"
            )
    if name == "throw_and_catch" and solver != "gradient":
        raise ValueError(f"solver: {solver!r}; throw_and_catch is planned by 'gradient' only")
    cycles = whole_number("cycles", cycles, 1, MOST_CYCLES)
    catches = name == "throw_and_catch"
    figure = name if not catches else "side_throw" if sideways else "throw"
    if figure in ("throw", "side_throw") and not catches and cycles > 1:
        raise ValueError(f"cycles: {cycles}; a throw that is not caught has one")
    models = _models(model)
    length = models[0].parameters.string_length
    left, right = _core.home_pose(figure, length)
    if start is not None:
        instance_of("start", start, State)
    initials = [start or hanging(one, left, right, spin, sticks) for one in models]
    if start is None and figure == "stop":
        for initial in initials:
            initial.velocity = np.array([0.0, 0.8, 0.0])  # something to stop
    limits = TipLimits() if limits is None else instance_of("limits", limits, TipLimits)

    def planned(path: TipPath | None, states: list[State]) -> tuple[TipPath, list[Plan], Goals]:
        """A cycle that goes on from a path and the states at its end."""
        action = _core.action(
            figure,
            left,
            right,
            states[0],
            length,
            size=size,
            pace=pace,
            height=(0.15 if figure == "hop" else 0.5) if height is None else height,
            sideways=0.3 if sideways is None else sideways,
            spin=spin_gain,
            sticks=_directions(sticks),
        )
        seed = action.seed if path is None else _going_on(action.seed, path)
        if catches:
            thrown, caught, piece, _ = _core.plan_throw_and_catch(
                models,
                states,
                seed,
                action.goals,
                limits,
                action.freedom,
                100_000,
                min(number("seconds", seconds), LONGEST_SEARCH),
                dt,
            )
            return piece, [thrown] if caught is None else [thrown, caught], action.goals
        found = plan(
            states,
            seed,
            action.goals,
            models,
            limits=limits,
            freedom=action.freedom,
            solver=solver,
            seconds=seconds,
            random_seed=random_seed,
            dt=dt,
        )
        return found.path, [found], action.goals

    began = time.perf_counter()
    path, plans, goals = planned(None, initials)
    states_now, piece, ended = initials, path, ""
    for cycle in range(2, cycles + 1):
        states_now = [_end(one, now, piece) for one, now in zip(models, states_now, strict=True)]
        if states_now[0].string_state == StringState.FLYING:
            ended = f"cycle {cycle}: the diabolo flies, nothing holds it"
            break
        if catches and len(plans) < 2 * (cycle - 1):
            ended = f"cycle {cycle}: the throw before it was none"
            break
        try:
            piece, more, _ = planned(path, states_now)
        except ValueError as error:
            ended = f"cycle {cycle}: {str(error).removeprefix('plan: ')}"
            break
        if path.end + piece.end - piece.begin > LONGEST_PLAY:
            ended = f"cycle {cycle}: the play would last more than {LONGEST_PLAY:g} s"
            break
        path = path.followed_by(piece)
        plans += more
    took = time.perf_counter() - began
    hands = float(path.derivatives(np.array([path.end]))[0, 0, [2, 5]].mean())
    flight = 0.0 if catches and len(plans) % 2 == 0 else LONGEST_FLIGHT
    time_s, states, codes, lefts, rights = _core.foresee(
        models[0], initials[0], path, flight=flight, down_to=hands
    )
    return PlannedPlay(
        name, path, plans, [goals], initials[0], time_s, states, codes, lefts, rights, took, ended
    )


def hanging(
    model: AnyModel,
    left: ArrayLike,
    right: ArrayLike,
    spin: float = 0.0,
    sticks: ArrayLike | None = None,
) -> State:
    """The diabolo at rest below resting tips [m], where the model lets it hang: friction leans it to the
    side, and what gives lowers it. sticks: as for `plan_action`."""
    (one,) = _models(model)
    state = _core.hanging_state(left, right, one.parameters.string_length, spin)
    rest = StickSpline(
        [0.0, 0.15], np.tile(left, (2, 1)), np.tile(right, (2, 1)), sticks=_directions(sticks)
    ).path()
    for _ in range(60):  # let go, and stopped again, until it stays
        before = state.position
        _, states, _, _, _ = _core.foresee(one, state, rest)
        state = State(states[-1, :3], np.zeros(3), spin, StringState.ON_STRING)
        if np.linalg.norm(state.position - before) < 1e-6:
            break
    return state


def success_rate(play: PlannedPlay, models: Sequence[Model]) -> float:
    """The share of the models by which the diabolo of a planned motion ends on its string, within 0.3 m of
    where it was planned to: how robust the motion is."""
    given = list_of("models", models, (Model,))
    instance_of("play", play, PlannedPlay)
    if not given:
        raise ValueError("models: none; at least one expected")
    ended = 0
    for one in given:
        _, states, codes, _, _ = _core.foresee(one, play.start, play.path)
        close = float(np.linalg.norm(states[-1, :3] - play.states[-1, :3])) < 0.3
        ended += close and codes[-1] != StringState.FLYING
    return ended / len(given)


def model_for(model: AnyModel, recording: AnyRecording) -> Model:
    """The model with the string's length, mass and axle radius of the recording where it leaves them to it,
    as one that `diagnose` made does: to plan on it for the set-up that was recorded."""
    one = Model(model) if isinstance(model, Parameters) else model_of("model", model)
    recording = recording_of("recording", recording)
    warn_of([recording])
    fields = one.to_dict()
    parameters = copy(one.parameters)
    if not one.own_string_length:
        parameters.string_length = recording.string_length
    if not one.own_mass:
        parameters.mass = recording.properties.mass
    if not one.own_axle_radius:
        parameters.axle_radius = recording.properties.axle_radius
    return Model(**{**fields, "parameters": parameters})


def best_guess(model: Model, result: Mapping[str, Any]) -> Model:
    """The model that a diagnosis made, as a plan is best made on: with the string's length put right, where
    it was measured wrongly, and with the likeliest air drag and Magnus lift where they were too unsure to be
    claimed.

    model: that of the diagnosis with what it leaves to the recording, see `model_for`.
    result: `Diagnosis.result`, or what its file holds. Of an estimate that is z standard deviations away from
    zero the share 1 - 1 / z^2 counts; where z is below one, nothing.
    """
    instance_of("model", model, Model)
    found = {entry["name"]: entry for entry in _rungs(result)}

    def claimed(name: str) -> bool:
        return name in found and bool(found[name]["claimed"])

    def likeliest(name: str) -> float:
        if name not in found or claimed(name) or not abs(found[name]["z"]) > 1.0:
            return 0.0
        return float(found[name]["estimate"] * (1.0 - 1.0 / found[name]["z"] ** 2))

    guess = copy(model)
    if claimed("string_length") and not model.own_string_length:
        guess.parameters.string_length += found["string_length"]["estimate"]
    if not claimed("air_drag_linear"):
        guess.air.quadratic_drag += max(0.0, likeliest("air_drag_quadratic"))
    guess.magnus_lift.coefficient += likeliest("magnus_lift")
    return guess


def _rungs(result: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The candidates of a diagnosis."""
    if not isinstance(result, Mapping):
        raise ValueError(f"result: {result!r:.60}; expected what a diagnosis found, as its file holds it")
    ladder = result.get("ladder")
    if not isinstance(ladder, list):
        raise ValueError(f"ladder: {ladder!r:.60}; expected a list of candidates, as a diagnosis has")
    for index, rung in enumerate(ladder):
        known = isinstance(rung, dict) and isinstance(rung.get("name"), str)
        if not known or not isinstance(rung.get("claimed"), bool):
            raise ValueError(f"ladder[{index}]: {rung!r:.60}; expected a candidate with name and claimed")
        for field in ("z", "estimate") if rung["name"] in GUESSED else ():
            value = rung.get(field)
            number = isinstance(value, int | float) and not isinstance(value, bool)
            if not number or not abs(value) <= LARGEST_FOUND:
                raise ValueError(
                    f"ladder[{index}], {field}: {value!r:.60}; expected a number of at most {LARGEST_FOUND:g}"
                )
    return ladder


def _directions(sticks: ArrayLike | None) -> NDArray[np.float64]:
    return np.zeros(6) if sticks is None else numbers("sticks", sticks)


def _going_on(seed: StickSpline, path: TipPath) -> StickSpline:
    """A seed that sets in where a path ends, with its velocity and acceleration."""
    tips, velocity, acceleration, _ = path.derivatives(np.array([path.end]))[:, 0]
    left, right = np.array(seed.left), np.array(seed.right)
    left[0], right[0] = tips[:3], tips[3:]
    return StickSpline(seed.times, left, right, start=(velocity, acceleration), sticks=seed.sticks)


def _end(model: Model, start: State, path: TipPath) -> State:
    """Where a model predicts the diabolo to be at the end of a path."""
    _, states, codes, _, _ = _core.foresee(model, start, path)
    return State(states[-1, :3], states[-1, 3:6], float(states[-1, 6]), StringState(codes[-1]))


def _models(given: AnyModel | Sequence[AnyModel]) -> list[Model]:
    several = list(given) if isinstance(given, Iterable) and not isinstance(given, str) else [given]
    if not several:
        raise ValueError("model: none; at least one expected")
    return [Model(one) if isinstance(one, Parameters) else model_of("model", one) for one in several]
