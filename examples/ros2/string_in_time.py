# SPDX-License-Identifier: MIT
"""The diabolo on a string whose tips come one stamp after the other. Nothing here knows ROS or a clock."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np
from diabolo import Model, Predictor, State, TipMotion, hang_at_rest
from diabolo.rollout import LONGEST_STEP
from numpy.typing import NDArray
from tips import MessageError, Tips

Vector: TypeAlias = NDArray[np.float64]
FourVectors: TypeAlias = tuple[Vector, Vector, Vector, Vector]
"""Left and right, where a step begins and where it ends."""
LARGEST = 1e4
"""Number of a start; there are none so large in play."""
LONGEST_GAP = 100_000_000
"""Between two stamps [ns]; what comes later, or as much earlier, is another play."""


class StringInTime:
    """Steps the predictor from stamp to stamp, the tips going straight between them.

    start: where the diabolo begins; without it, it hangs at rest below the first tips, with a spin [rad/s].
    dt: the longest step [s]; equal ones fill the time between two stamps.
    warn: is told what is odd, its kind and a sentence.
    """

    def __init__(
        self,
        model: Model,
        warn: Callable[[str, str], None],
        start: Sequence[float] | None = None,
        spin: float = 0.0,
        dt: float = 2e-3,
    ) -> None:
        """Raises ValueError."""
        if start is not None and not (len(start) == 7 and np.abs(start).max() <= LARGEST):
            raise ValueError(
                f"start: {list(start)}; expected position, velocity, spin: seven numbers within {LARGEST:g}"
            )
        if not abs(spin) <= LARGEST:
            raise ValueError(f"spin: {spin:g} rad/s; expected a number within {LARGEST:g}")
        if not 1e-5 <= dt <= LONGEST_STEP:
            raise ValueError(f"dt: {dt:g} s; expected 1e-5 to {LONGEST_STEP:g}")
        self._model, self._warn = model, warn
        self._start, self._spin, self._dt = start, spin, dt
        self._predictor = Predictor(model)
        self._began: int | None = None

    def advance(self, stamp: int, tips: Tips) -> None:
        """On to the tips at a stamp [ns]. Raises MessageError, and stays, where it is not after the last."""
        if self._began is None:
            self._begin(stamp, tips)
        elif abs(stamp - self._stamp) > LONGEST_GAP:
            seconds = 1e-9 * (stamp - self._stamp)
            self._warn("stamps jump", f"{seconds:+.3f} s after the last one; the play begins anew")
            self._begin(stamp, tips)
        elif stamp <= self._stamp:
            seconds = 1e-9 * (stamp - self._stamp)
            raise MessageError("late stamps", f"{seconds:+.6f} s after the last one; expected more")
        else:
            self._move(stamp, tips)
        self._stamp, self._tips = stamp, tips

    def _begin(self, stamp: int, tips: Tips) -> None:
        (left, stick), (right, other) = tips
        if self._start is None:
            self.state = hang_at_rest(self._model, left, right, self._spin, np.concatenate([stick, other]))
        else:
            self.state = State(self._start[:3], self._start[3:6], self._start[6])
        self.turned = 0.0
        self.tensions = (0.0, 0.0)
        self._began = stamp

    def _move(self, stamp: int, tips: Tips) -> None:
        began, span = 1e-9 * (self._stamp - self._began), 1e-9 * (stamp - self._stamp)
        count = max(1, math.ceil(span / self._dt - 1e-6))
        motion = _straight(span, self._tips, tips)
        times = np.arange(count + 1) * (span / count)
        lefts, rights, _, _ = motion.at(times)
        left_sticks, right_sticks = motion.directions_at(times)
        for i in range(count):
            now, after = i, i + 1
            self._step(
                (lefts[now], rights[now], lefts[after], rights[after]),
                (left_sticks[now], right_sticks[now], left_sticks[after], right_sticks[after]),
                span / count,
                began + times[now],
            )

    def _step(self, places: FourVectors, sticks: FourVectors, dt: float, time: float) -> None:
        """One of the predictor, and its tensions. Raises MessageError where it is not finite."""
        state, spin = self.state, self.state.spin
        try:
            status = self._predictor.step(state, *places, dt, directions=sticks, time=time)
        except FloatingPointError as error:
            self._began = None
            raise MessageError("prediction", f"{error}; the play begins anew") from None
        self.turned += 0.5 * (spin + state.spin) * dt
        self.tensions = status.tensions
        if status.overstretched:
            apart, length = np.linalg.norm(places[2] - places[3]), self._model.parameters.string_length
            self._warn("tips", f"{apart:.3f} m apart; the string is {length:g} m long")


def _straight(span: float, begin: Tips, end: Tips) -> TipMotion:
    """From one to the other in that time [s]."""
    (left0, stick0), (right0, other0) = begin
    (left1, stick1), (right1, other1) = end
    return TipMotion(
        [0.0, span], [left0, left1], [right0, right1], "linear", [stick0, stick1], [other0, other1]
    )
