# SPDX-License-Identifier: MIT
"""An environment as a picture: what the player sees, left to the left."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .._core import HandLimits, State
from ..checks import check_drawing
from ..enums import StringState

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SIZE = (480, 480)
"""Of a picture [pixels]."""
INK = {"tips": "#17202c", "string": "#0b5fa5", "diabolo": "#c76f00"}


def string_curve(left: NDArray[np.float64], right: NDArray[np.float64], length: float) -> NDArray[np.float64]:
    """A slack string between tips [m]: a parabola of about its length."""
    share = np.linspace(0.0, 1.0, 41)[:, None]
    apart = float(np.linalg.norm(right - left))
    sag = np.sqrt(max(0.0, 0.375 * apart * (length - apart)))
    curve: NDArray[np.float64] = left + share * (right - left)
    curve[:, 2] -= 4.0 * sag * (share * (1.0 - share))[:, 0]
    return curve


def picture(
    task: str,
    state: State,
    tips: tuple[NDArray[np.float64], NDArray[np.float64]],
    limits: HandLimits,
    length: float,
) -> NDArray[np.uint8]:
    """RGB, shape (480, 480, 3)."""
    check_drawing("render_mode rgb_array", "matplotlib")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(SIZE[0] / 100.0, SIZE[1] / 100.0), dpi=100, layout="constrained")
    canvas = FigureCanvasAgg(figure)
    _draw(figure.add_subplot(), task, state, tips, limits, length)
    canvas.draw()  # type: ignore[no-untyped-call]
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()  # type: ignore[no-untyped-call]


def _draw(
    axes: Axes,
    task: str,
    state: State,
    tips: tuple[NDArray[np.float64], NDArray[np.float64]],
    limits: HandLimits,
    length: float,
) -> None:
    left, right = tips
    place = np.asarray(state.position)
    slack = state.string_state is StringState.FLYING
    string = string_curve(left, right, length) if slack else np.array([left, place, right])
    axes.plot(-string[:, 1], string[:, 2], color=INK["string"])
    axes.plot([-left[1], -right[1]], [left[2], right[2]], "o", color=INK["tips"])
    axes.plot(-place[1], place[2], "D", markersize=12, color=INK["diabolo"])
    middle, reach = limits.centre, float(limits.half[1]) + 0.2
    axes.set_xlim(-middle[1] - reach, -middle[1] + reach)
    axes.set_ylim(middle[2] - 1.2 * reach, middle[2] + 1.2 * reach)
    axes.set_aspect("equal")
    axes.set_xlabel("to the right [m]")
    axes.set_ylabel("height [m]")
    axes.set_title(
        f"{task}: {state.spin:.0f} rad/s, {StringState(state.string_state).name.lower().replace('_', ' ')}"
    )
