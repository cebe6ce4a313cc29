# SPDX-License-Identifier: MIT
"""What the examples of this folder play, and how far a host's body is from the plain predictor."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from diabolo import Model, Parameters, State, StringFriction, TipMotion, rollout
from diabolo.files import whole_file
from diabolo.motions import swing_and_beat
from numpy.typing import NDArray

DURATION = 2.0  # [s]


class Both(NamedTuple):
    """Where the host's body and the predicted one are after each step of `dt` [s], (steps, 3) [m]."""

    dt: float
    host: NDArray[np.float64]
    plain: NDArray[np.float64]

    def apart(self) -> NDArray[np.float64]:
        distances: NDArray[np.float64] = np.linalg.norm(self.host - self.plain, axis=1)
        return distances


def play() -> TipMotion:
    """Tips that swing and beat, for longer than is played. Their poses lie on all steps, so that a host which
    reads the poses at its steps makes the same spline of them."""
    t = np.linspace(0.0, DURATION + 0.1, 211)
    left, right = swing_and_beat(DURATION + 0.1).at(t)[:2]
    return TipMotion(t, left, right, "spline")


def compare(simulate: Callable[[Model, State, TipMotion, float, int], NDArray[np.float64]]) -> list[Both]:
    """By two steps, see play_motion.Simulate; prints how far they part."""
    model = Model(Parameters(), name="rubbing", string_friction=StringFriction(coefficient=0.2))
    tips, drop = play(), 0.5 * np.sqrt(model.parameters.string_length**2 - 0.8**2)
    start = State([0.0, 0.0, 1.3 - drop], [0.3, 0.2, 0.0], 60.0, "loose")
    found = []
    for dt in (2e-3, 1e-3):
        path = simulate(model, start, tips, dt, round(DURATION / dt))
        plain = rollout(model, start.to_array(), tips, dt=dt, steps=len(path), string_state="loose").states
        found.append(Both(dt, path, plain[:, :3]))
        print(f"dt {1e3 * dt:g} ms: {found[-1].apart().max():.1e} m from the predictor")
    return found


def draw(found: list[Both], host: str, picture: Path) -> None:
    """The paths as the player sees them, and how far they part."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.2, 3.4), layout="constrained")
    paths, apart = figure.subplots(1, 2)
    body, plain = found[-1].host, found[-1].plain
    paths.plot(plain[:, 1], plain[:, 2], color="tab:orange", lw=5, alpha=0.5, label="the plain predictor")
    paths.plot(body[:, 1], body[:, 2], color="black", lw=0.9, label=f"{host}'s body, our string")
    paths.set(xlabel="left [m]", ylabel="up [m]")
    paths.invert_xaxis()
    paths.margins(y=0.25)
    paths.legend(frameon=False, fontsize=8, loc="upper center")
    for each, colour in zip(found, ("tab:red", "tab:blue"), strict=True):
        distances = np.maximum(each.apart(), np.finfo(float).eps / 10.0)  # a logarithm has no zero
        times = each.dt * np.arange(1, len(distances) + 1)
        apart.semilogy(times, distances, color=colour, lw=0.9, label=f"steps of {1e3 * each.dt:g} ms")
    apart.margins(y=0.3)
    apart.set(xlabel="time [s]", ylabel="they part by [m]")
    apart.legend(frameon=False, fontsize=8)
    with whole_file(picture) as temporary:
        figure.savefig(temporary, dpi=80)
