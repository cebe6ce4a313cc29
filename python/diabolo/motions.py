# SPDX-License-Identifier: MIT
"""Simple motions of the stick tips, to try things on."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ._core import TipMotion, TipPath, action, hanging_state, home_pose
from .checks import MOST_CYCLES, number, whole_number

HEIGHT, FORWARD, HALF_SPAN = 1.0, 0.5, 0.3  # where the hands rest [m]
_RATE = 240.0  # samples of a motion per second


def hold(duration: float) -> TipMotion:
    """Both tips rest, 0.6 m apart."""
    return _motion(duration, lambda t: (0.0 * t, 0.0 * t, 0.0 * t))


def swing(duration: float) -> TipMotion:
    """Both tips sway sideways by 5 cm, 0.6 times a second, and the diabolo swings below them."""
    return _motion(duration, lambda t: (0.05 * _fade_in(t) * np.sin(2.0 * np.pi * 0.6 * t), 0.0 * t, 0.0 * t))


def beat(duration: float) -> TipMotion:
    """The right tip goes up by 8 cm and the left one down, 1.6 times a second, as to speed the diabolo up."""
    return _motion(duration, lambda t: (0.0 * t, 0.08 * _fade_in(t) * np.sin(2.0 * np.pi * 1.6 * t), 0.0 * t))


def swing_and_beat(duration: float, rest: float = 0.0) -> TipMotion:
    """The tips, 0.8 m apart, sway against each other, 10 cm forward, 0.75 times a second. They beat
    twice as often, the left one by 10 cm and the right one by 5 cm. Before that they rest [s]."""
    time = _times(duration)
    t = np.maximum(time - number("rest", rest), 0.0)
    sway, beat = (0.05 * (1.0 - np.cos(2.0 * np.pi * rate * t)) for rate in (0.75, 1.5))
    left = np.stack([sway, np.full_like(t, 0.4), 1.3 + beat], axis=1)
    right = np.stack([-sway, np.full_like(t, -0.4), 1.3 - 0.5 * beat], axis=1)
    return TipMotion(time, left, right, "spline")


def throw(duration: float) -> TipMotion:
    """After a second the tips part, within 0.25 s, until the string is almost straight."""

    def shifts(
        t: NDArray[np.float64],
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        s = np.clip((t - 1.0) / 0.25, 0.0, 1.0)
        return 0.0 * t, 0.0 * t, 0.415 * s**3 * (10.0 - 15.0 * s + 6.0 * s**2)

    return _motion(duration, shifts)


def wind_up(duration: float) -> TipMotion:
    """Speeds up a diabolo with one turn of the string (`Parameters.wraps` 1): the right hand pulls, the left
    one follows, and the string slips back while it is all but slack."""
    return _repeated("wind_up", duration)


def one_turn_low(duration: float) -> TipMotion:
    """Likewise, by small strokes of hands that are held low."""
    return _repeated("one_turn_low", duration)


def cycles_of(figure: str, cycles: int, string_length: float = 1.45) -> TipPath:
    """The seed motion of a figure of `diabolo.plan_action`, so many times in a row, from its home; nothing is
    planned. Raises ValueError where there is no such figure."""
    cycles = whole_number("cycles", cycles, 1, MOST_CYCLES)
    string_length = number("string_length", string_length)
    left, right = home_pose(figure, string_length)
    start = hanging_state(left, right, string_length, 0.0)
    cycle = action(figure, left, right, start, string_length).seed.path()
    path = cycle
    for _ in range(cycles - 1):
        path = path.followed_by(cycle)
    return path


MOTIONS: dict[str, Callable[[float], TipMotion]] = {
    "hold": hold,
    "swing": swing,
    "beat": beat,
    "swing_and_beat": swing_and_beat,
    "throw": throw,
    "wind_up": wind_up,
    "one_turn_low": one_turn_low,
}
"""The motions by name; each takes its duration [s]."""


def _fade_in(t: NDArray[np.float64]) -> NDArray[np.float64]:
    """From 0 to 1 within half a second, at rest at both ends."""
    s = np.clip(t / 0.5, 0.0, 1.0)
    return s**2 * (3.0 - 2.0 * s)


def _check(duration: float) -> None:
    if not 0.0 < duration <= 3600.0:
        raise ValueError(f"duration: {duration} s; expected more than 0, at most an hour")


def _times(duration: float) -> NDArray[np.float64]:
    _check(duration)
    return np.linspace(0.0, duration, int(np.ceil(duration * _RATE)) + 1)


def _repeated(figure: str, duration: float) -> TipMotion:
    """Whole cycles of a figure, as many as begin within the duration, and rest from then on."""
    _check(duration)
    cycle = cycles_of(figure, 1)
    return cycles_of(figure, int(np.ceil(duration / (cycle.end - cycle.begin)))).tips()


def _motion(
    duration: float,
    shifts: Callable[
        [NDArray[np.float64]], tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]
    ],
) -> TipMotion:
    """`shifts` gives, at times [s]: both tips to the left, right tip up and left tip down, both apart [m]."""
    time = _times(duration)
    sideways, tilt, apart = shifts(time)
    forward = np.full_like(time, FORWARD)
    left = np.stack([forward, HALF_SPAN + sideways + apart, HEIGHT - tilt], axis=1)
    right = np.stack([forward, -HALF_SPAN + sideways - apart, HEIGHT + tilt], axis=1)
    return TipMotion(time, left, right, "spline")
