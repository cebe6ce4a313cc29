# SPDX-License-Identifier: MIT
"""Many predictions at once, and their derivatives."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import Model, Parameters, TipMotion
from .checks import (
    MOST_THREADS,
    instance_of,
    is_several,
    list_of,
    names_of,
    number,
    numbers,
    shown,
    true_or_false,
    whole_number,
)
from .enums import StringState

ModelOrParameters: TypeAlias = Model | Parameters
AnyStringState: TypeAlias = StringState | int | str

MOST_STEPS = 10**12
MOST_FRAMES = 10**8
"""Of all rollouts of a batch together: 6 GB."""
FARTHEST = 100.0
"""Where play may begin, from the origin along an axis [m]."""
MOST_STRETCH = 1.05
"""Of a string that gives, times its length."""
LONGEST_STEP = 0.02
"""Of the time [s], in which hands beating the string have barely moved."""


class RolloutWarning(UserWarning):
    """What a rollout is given can be used, but is odd, as in other units."""


class Rollout(NamedTuple):
    """What `rollout` gives; the batch axis N is missing where nothing that was handed over had it."""

    time: NDArray[np.float64]
    """Since the initial state [s], shape (frames,); the initial state itself is not repeated."""
    states: NDArray[np.float64]
    """Position [m], velocity [m/s] and spin [rad/s], shape (N, frames, 7)."""
    string_states: NDArray[np.uint8]
    """As in StringState, shape (N, frames)."""
    forces: NDArray[np.float64] | None = None
    """Of the string on the left and the right tip, the mean over a frame's last step [N], shape
    (N, frames, 2, 3); None where nobody asked. A strand's tension is the norm."""
    axis: NDArray[np.float64] | None = None
    """Of the axle, shape (N, frames, 3); this and what follows None where nobody asked for the axle."""
    tumble: NDArray[np.float64] | None = None
    """The axle's angular velocity, square to it [rad/s], shape (N, frames, 3)."""
    turns: NDArray[np.float64] | None = None
    """Of the string around the axle, shape (N, frames)."""

    def __repr__(self) -> str:
        """How many samples, over how long, and where the first one ends."""
        batch = f"{len(self.states)} rollouts of " if self.states.ndim == 3 else ""
        text = f"<Rollout: {batch}{len(self.time)} samples"
        if not len(self.time):
            return text + ">"
        end = self.states[..., -1, :].reshape(-1, self.states.shape[-1])[0]
        code = StringState(int(self.string_states[..., -1].reshape(-1)[0])).name.lower()
        place = ", ".join(f"{x:.3f}" for x in end[:3])
        return (
            f"{text} to {self.time[-1]:.4g} s, {'the first ' if batch else ''}ends at ({place}) m, "
            f"{np.linalg.norm(end[3:6]):.2f} m/s, {end[6]:.1f} rad/s, {code}>"
        )


class RolloutGradient(NamedTuple):
    """What `rollout_gradient` gives."""

    state: NDArray[np.float64]
    """Position [m], velocity [m/s] and spin [rad/s] at the end, shape (7,)."""
    string_state: StringState
    """At the end."""
    derivatives: dict[str, NDArray[np.float64]]
    """Of `state` by each named input: the shape (7,) followed by the input's own."""


def rollout(
    model: ModelOrParameters | Sequence[ModelOrParameters],
    initial: ArrayLike,
    tips: TipMotion | Sequence[TipMotion],
    *,
    dt: float = 1e-3,
    steps: int | None = None,
    begin: float | None = None,
    string_state: AnyStringState | ArrayLike = StringState.LOOSE,
    axis: ArrayLike = (1.0, 0.0, 0.0),
    tumble: ArrayLike = (0.0, 0.0, 0.0),
    turns: ArrayLike = 0.0,
    record_every: int = 1,
    threads: int = 0,
    forces: bool = False,
    axle: bool = False,
) -> Rollout:
    """Predict the diabolo from each of N initial states while the tips move (world frame: x forward, away
    from the player, y left, z up).

    model: Parameters or a Model, one for all or a sequence of N.
    initial: position [m], velocity [m/s] and spin [rad/s], shape (N, 7) or (7,).
    tips: a TipMotion, one for all or a sequence of N.
    dt: time step [s], 1e-9 to 1e3.
    steps: how many; by default as many as the (shortest) tip motion lasts.
    begin: time of the initial state within the tip motions [s]; by default where the first one begins.
    string_state: of the initial state; one for all or an array of the shape (N,).
    axis, tumble: the axle's direction, a unit vector that matters to MagnusLift and GyroscopicTilt, and its
    angular velocity, square to it [rad/s], shape (3,) or (N, 3), as in State.
    turns: of the string around the axle, as in State; one for all or an array of the shape (N,).
    record_every: a frame after each so many steps; `steps` must be a multiple of it.
    threads: 0 takes all cores. The result does not depend on it.
    forces, axle: whether the string's forces on the tips, or axis, tumble and turns, are wanted, too.

    Ctrl-C ends it at once. Raises ValueError where an argument is out of range, or of another type or shape,
    and FloatingPointError where a state does not stay finite. Warns (RolloutWarning) of odd units and such.

        tips = TipMotion([0.0], [[0.0, 0.3, 0.0]], [[0.0, -0.3, 0.0]])
        fall = rollout(Parameters(), [0, 0, -0.4, 0, 0, 0, 100], tips, steps=1000)
        fall.states[-1]  # a second later
    """
    models = [_model(one) for one in list_of("model", model, (Model, Parameters), least=1)]
    motions = list_of("tips", tips, (TipMotion,), least=1)
    states = _vectors("initial", initial, 7)
    codes = _codes(string_state)
    axes = _axes(axis)
    tumbles = _vectors("tumble", tumble, 3)
    around = _turns(turns)
    size = _common_size(
        initial=states.size // 7,
        string_state=codes.size,
        axis=axes.size // 3,
        tumble=tumbles.size // 3,
        turns=around.size,
        model=len(models),
        tips=len(motions),
    )
    record_every = whole_number("record_every", record_every, 1, MOST_STEPS)
    start, dt, steps = _times(motions, begin, dt, steps, record_every)
    _check_frames(size * (steps // record_every))
    _warn_of_units(states, motions[0], models[0], dt)

    records, record_states, on_tips, axles = _core.rollout(
        models,
        _side_by_side(size, states, axes, tumbles, around.reshape(-1, 1)),
        np.broadcast_to(codes, (size,)),
        motions,
        start,
        dt,
        steps,
        record_every,
        whole_number("threads", threads, 0, MOST_THREADS),
        true_or_false("forces", forces),
        true_or_false("axle", axle),
    )
    time = np.arange(1, records.shape[1] + 1) * (record_every * dt)
    several = states.ndim == 2 or codes.ndim == 1 or axes.ndim == 2 or tumbles.ndim == 2 or around.ndim == 1
    several = several or is_several(model) or is_several(tips)
    parts = (records, record_states, on_tips, *axle_parts(axles))
    return Rollout(time, *(part if several or part is None else part[0] for part in parts))


def rollout_gradient(
    model: ModelOrParameters,
    initial: ArrayLike,
    tips: TipMotion,
    with_respect_to: Sequence[str] = ("position", "velocity", "spin"),
    *,
    dt: float = 1e-3,
    steps: int | None = None,
    begin: float | None = None,
    string_state: AnyStringState = StringState.LOOSE,
    axis: ArrayLike = (1.0, 0.0, 0.0),
    tumble: ArrayLike = (0.0, 0.0, 0.0),
    turns: float = 0.0,
    threads: int = 0,
) -> RolloutGradient:
    """Final state of a rollout, and its derivatives by forward-mode automatic differentiation.

    `with_respect_to` names inputs:
      "position", "velocity" (3,) and "spin" () of the initial state,
      "left", "right" (M, 3): the poses that the tip motion was made from,
      any numeric field of Parameters () such as "string_length", see Parameters.fields(),
      any field of an effect () such as "string_elasticity.compliance".

    The derivative holds for the sequence of string states that the rollout goes through: instants at which
    the string comes taut are located within a step, so they move with the inputs. `initial` has the shape
    (7,); all else, frame, units and errors, is as for `rollout`.

        g = rollout_gradient(Parameters(), initial, tips, ["string_length"], steps=500)
        g.derivatives["string_length"][2]  # height at the end per string length
    """
    state = numbers("initial", initial)
    if state.shape != (7,):
        raise ValueError(f"initial: shape {state.shape}; expected (7,)")
    start, dt, steps = _times([instance_of("tips", tips, TipMotion)], begin, dt, steps)
    chosen = _model(model)
    _warn_of_units(state, tips, chosen, dt)
    final, final_string_state, derivatives = _core.rollout_gradient(
        chosen,
        _core.State(
            state[:3],
            state[3:6],
            float(state[6]),
            string_state,
            numbers("axis", axis),
            numbers("tumble", tumble),
            number("turns", turns),
        ),
        tips,
        names_of("with_respect_to", with_respect_to, "position"),
        start,
        dt,
        steps,
        whole_number("threads", threads, 0, MOST_THREADS),
    )
    return RolloutGradient(final, StringState(final_string_state), derivatives)


def _model(given: ModelOrParameters) -> Model:
    return Model(given) if isinstance(given, Parameters) else instance_of("model", given, Model)


def _check_frames(frames: int) -> None:
    if frames > MOST_FRAMES:
        raise ValueError(
            f"rollout: {frames} frames; expected at most {MOST_FRAMES}, by a larger record_every"
        )


def axle_parts(axles: NDArray[np.float64] | None) -> tuple[NDArray[np.float64] | None, ...]:
    """Axis, tumble and turns, as Rollout has them."""
    return (None,) * 3 if axles is None else (axles[..., :3], axles[..., 3:6], axles[..., 6])


def _axes(axis: ArrayLike) -> NDArray[np.float64]:
    axes = _vectors("axis", axis, 3)
    if not np.allclose(np.linalg.norm(axes, axis=-1), 1.0, rtol=0.0, atol=1e-6):
        raise ValueError("axis: expected unit vectors")
    return axes


def _turns(turns: ArrayLike) -> NDArray[np.float64]:
    around = numbers("turns", turns)
    if around.ndim > 1:
        raise ValueError(f"turns: shape {around.shape}; expected a number or (N,)")
    return around


def _side_by_side(size: int, *parts: NDArray[np.float64]) -> NDArray[np.float64]:
    """Columns of several parts, each with one row or `size` rows."""
    return np.concatenate([np.broadcast_to(part, (size, part.shape[-1])) for part in parts], axis=1)


def _vectors(name: str, given: ArrayLike, length: int) -> NDArray[np.float64]:
    """One or N of them."""
    vectors = numbers(name, given)
    if vectors.ndim not in (1, 2) or vectors.shape[-1] != length or vectors.size == 0:
        raise ValueError(f"{name}: shape {vectors.shape}; expected ({length},) or (N, {length})")
    return vectors


def _common_size(**sizes: int) -> int:
    """Of a batch whose arguments hold one for all or one for each."""
    size = max(sizes.values())
    for name, given in sizes.items():
        if given not in (1, size):
            raise ValueError(f"{name}: {given} given for {size} rollouts; expected 1 or {size}")
    return size


def _times(
    motions: Sequence[TipMotion], begin: float | None, dt: float, steps: int | None, record_every: int = 1
) -> tuple[float, float, int]:
    """Begin, time step and number of steps, a multiple of record_every; by default as many as fit."""
    start = motions[0].begin if begin is None else number("begin", begin)
    if not abs(start) <= 1e9:
        raise ValueError(f"begin: {start} s; must be within 1e9 s")
    dt = number("dt", dt)
    if not 1e-9 <= dt <= 1e3:
        raise ValueError(f"dt: {dt} s; must be within 1e-9 and 1e3 s")
    if steps is None:
        end = min(motion.end for motion in motions)
        steps = int((end - start) / dt + 1e-6)  # one that misses the end by rounding only does fit
        if steps < record_every:
            raise ValueError(
                f"begin: {start} s; the tips end at {end} s, before the first frame; "
                "give steps for tips at rest"
            )
        steps -= steps % record_every
    steps = whole_number("steps", steps, 0, MOST_STEPS)
    if steps % record_every != 0:
        raise ValueError(f"steps: {steps}; expected a multiple of record_every, which is {record_every}")
    return start, dt, steps


def _warn_of_units(states: NDArray[np.float64], tips: TipMotion, model: Model, dt: float) -> None:
    """Warn of sizes that no play has; of a batch the first tips and model are looked at."""
    farthest = float(np.abs(states[..., :3]).max())
    apart = float(np.linalg.norm(tips.left - tips.right, axis=1).max())
    length = model.parameters.string_length
    for is_odd, sentence in (
        (farthest > FARTHEST, f"initial: a coordinate of {farthest:g} m; are the positions in metres?"),
        (apart > MOST_STRETCH * length, f"tips: {apart:g} m apart, but the string is {length:g} m long"),
        (dt > LONGEST_STEP, f"dt: {dt:g} s; steps beyond {LONGEST_STEP:g} s leave out how the tips move"),
    ):
        if is_odd:
            warnings.warn(sentence, RolloutWarning, stacklevel=3)


def _codes(string_state: AnyStringState | ArrayLike) -> NDArray[np.uint8]:
    """The numbers of string states given by number or name."""
    given = np.asarray(string_state)
    if given.dtype.kind == "U":
        names = {state.name.lower(): int(state) for state in StringState}
        unknown = sorted(set(given.ravel().tolist()) - set(names))
        if unknown:
            raise ValueError(f"string_state: {shown(unknown[0])}; expected one of {', '.join(names)}")
        given = np.vectorize(names.__getitem__, otypes=[np.int64])(given)
    if given.ndim > 1:
        raise ValueError(f"string_state: shape {given.shape}; expected one or (N,)")
    if given.dtype.kind not in "iu" or np.any(given < 0) or np.any(given > max(StringState)):
        raise ValueError(f"string_state: {shown(string_state)}; expected names or numbers of StringState")
    return given.astype(np.uint8)
