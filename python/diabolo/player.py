# SPDX-License-Identifier: MIT
"""Stick motions that make the diabolo do what is wanted."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import (
    AIMS,
    PLANNED_ACTIONS,
    DiagnosisResult,
    Freedom,
    Goals,
    LadderRow,
    Model,
    Parameters,
    Plan,
    PlannedPlay,
    State,
    StickSpline,
    TipLimits,
)
from .checks import (
    LARGEST_SEED,
    MOST_CYCLES,
    AnyRecording,
    instance_of,
    is_several,
    list_of,
    model_of,
    number,
    numbers,
    one_of,
    recording_of,
    warn_of,
    whole_number,
)

AnyModel: TypeAlias = Model | Parameters | str
"""A model, one of these parameters alone, or the one of that name."""
Solver: TypeAlias = Literal["gradient", "walk"]
SOLVERS: tuple[str, ...] = get_args(Solver)

ACTIONS: tuple[str, ...] = PLANNED_ACTIONS
"""What `plan_action` knows."""
WANTED: dict[str, tuple[str, ...]] = AIMS
"""What may be wanted of which action."""


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
        one_of("solver", solver, SOLVERS),
        whole_number("evaluations", evaluations, 1, 2**31 - 1),
        number("seconds", seconds),
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
    start: of the diabolo; by default it hangs with the given spin [rad/s], see `hang_at_rest`.
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
    return _core.plan_action(
        one_of("name", name, ACTIONS),
        _models(model),
        start,
        whole_number("cycles", cycles, 1, MOST_CYCLES),
        spin,
        size,
        pace,
        height,
        sideways,
        spin_gain,
        TipLimits() if limits is None else limits,
        one_of("solver", solver, SOLVERS),
        number("seconds", seconds),
        whole_number("random_seed", random_seed, 0, LARGEST_SEED),
        dt,
        _directions(sticks),
    )


def hang_at_rest(
    model: AnyModel,
    left: ArrayLike,
    right: ArrayLike,
    spin: float = 0.0,
    sticks: ArrayLike | None = None,
) -> State:
    """The diabolo at rest below resting tips [m], where the model lets it hang: friction leans it to the
    side, and what gives lowers it. sticks: as for `plan_action`."""
    (one,) = _models(model)
    return _core.hang_at_rest(
        one, numbers("left", left), numbers("right", right), number("spin", spin), _directions(sticks)
    )


def aimed_again(aim: ArrayLike, wanted: ArrayLike, came: ArrayLike) -> tuple[float, float]:
    """What to aim a throw at next, where one aimed at `aim` came to `came` instead of `wanted`.

    Each is the apex above the tips and the place to the left where it comes down [m], shape (2,). It is
    Newton's method on the throw's own error, with the identity for what a change of aim changes: each throw
    leaves the share of the error by which the model is wrong. Returns the height and the place of the next.

        height, sideways = aimed_again((0.6, 0.0), (0.6, 0.0), came=(0.54, 0.03))
        plan_action("throw", height=height, sideways=sideways)
    """
    return _core.aimed_again(numbers("aim", aim), numbers("wanted", wanted), numbers("came", came))


def success_rate(play: PlannedPlay, models: Sequence[Model]) -> float:
    """The share of the models by which the diabolo of a planned motion ends on its string, within 0.3 m of
    where it was planned to: how robust the motion is."""
    return _core.success_rate(instance_of("play", play, PlannedPlay), list_of("models", models, (Model,)))


def model_for(model: AnyModel, recording: AnyRecording) -> Model:
    """The model with the string's length, mass and axle radius of the recording where it leaves them to it,
    as one that `diagnose` made does: to plan on it for the set-up that was recorded."""
    one = Model(model) if isinstance(model, Parameters) else model_of("model", model)
    recording = recording_of("recording", recording)
    warn_of([recording])
    return _core.model_for(one, recording)


def best_guess(model: Model, result: DiagnosisResult | Sequence[LadderRow]) -> Model:
    """The model that a diagnosis made, as a plan is best made on: with the string's length put right, where
    it was measured wrongly, and with the likeliest air drag and Magnus lift where they were too unsure to be
    claimed.

    model: that of the diagnosis with what it leaves to the recording, see `model_for`.
    result: `Diagnosis.result`, what `DiagnosisResult.load` reads of its file, or rows of its ladder. Of an
    estimate that is z standard deviations away from zero the share 1 - 1 / z^2 counts; where z is below one,
    nothing.
    """
    rows = result.ladder if isinstance(result, DiagnosisResult) else list_of("result", result, (LadderRow,))
    return _core.best_guess(instance_of("model", model, Model), rows)


def _directions(sticks: ArrayLike | None) -> NDArray[np.float64]:
    return np.zeros(6) if sticks is None else numbers("sticks", sticks)


def _models(given: AnyModel | Sequence[AnyModel]) -> list[Model]:
    several = list(given) if is_several(given) else [given]
    if not several:
        raise ValueError("model: none; at least one expected")
    return [Model(one) if isinstance(one, Parameters) else model_of("model", one) for one in several]
