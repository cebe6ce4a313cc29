# SPDX-License-Identifier: MIT
"""What the examples of this folder play, and how far a host's body is from the plain predictor."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from diabolo import Model, Parameters, State, StringFriction, TipMotion, rollout
from numpy.typing import NDArray

DURATION = 2.0  # [s]


def play() -> TipMotion:
    """Tips that swing and beat, for longer than is played."""
    t = np.linspace(0.0, DURATION + 0.1, 211)
    sway, beat = (0.05 * (1.0 - np.cos(2.0 * np.pi * rate * t)) for rate in (0.75, 1.5))
    left = np.stack([sway, np.full_like(t, 0.4), 1.3 + beat], axis=1)
    right = np.stack([-sway, np.full_like(t, -0.4), 1.3 - 0.5 * beat], axis=1)
    return TipMotion(t, left, right, "spline")


def compare(simulate: Callable[[Model, State, TipMotion, float, int], NDArray[np.float64]]) -> None:
    """Prints it for two steps, see play_motion.Simulate."""
    model = Model(Parameters(), name="rubbing", string_friction=StringFriction(coefficient=0.2))
    tips, drop = play(), 0.5 * np.sqrt(model.parameters.string_length**2 - 0.8**2)
    start = State([0.0, 0.0, 1.3 - drop], [0.3, 0.2, 0.0], 60.0, "loose")
    for dt in (2e-3, 1e-3):
        path = simulate(model, start, tips, dt, round(DURATION / dt))
        plain = rollout(model, start.to_array(), tips, dt=dt, steps=len(path), string_state="loose").states
        farthest = np.linalg.norm(path - plain[:, :3], axis=1).max()
        print(f"dt {1e3 * dt:g} ms: {farthest:.1e} m from the predictor")
