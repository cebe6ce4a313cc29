# SPDX-License-Identifier: MIT
"""A baseline: a Gaussian process of the acceleration that the simulator leaves over, by the state.

Rasmussen, Williams (Gaussian Processes for Machine Learning, 2006), sections 2.2 and 5.4: exact, with a
squared exponential of one length over scaled inputs, chosen by the marginal likelihood. It knows no names.
Where it predicts other seconds than those it was fitted to, something is missing.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from diabolo import load_recording

from .sindy import Array, library

MOST = 400  # samples that are fitted: the cost grows with the cube
BLOCK = 1.0  # fitted and predicted in turn [s]
LENGTHS, NOISES = (0.5, 1.0, 2.0, 4.0, 8.0), (0.1, 0.3, 0.6, 0.9)  # of inputs, of all variance
LEAST_SHARE = 0.1  # of the variance, to be predicted
DIRECTIONS = ("acceleration_forward", "acceleration_left", "acceleration_up")


def kernel(one: Array, other: Array, length: float) -> Array:
    square = np.sum(one**2, axis=1)[:, np.newaxis] + np.sum(other**2, axis=1) - 2.0 * one @ other.T
    return np.asarray(np.exp(-0.5 * np.maximum(square, 0.0) / length**2))


def predicted(inputs: Array, values: Array, asked: Array) -> Array:
    """Mean of the process where it is asked; values have the deviation one."""
    best, result = -np.inf, np.zeros(len(asked))
    for length in LENGTHS:
        covariance = kernel(inputs, inputs, length)
        for noise in NOISES:
            factor = np.linalg.cholesky((1.0 - noise) * covariance + noise * np.eye(len(inputs)))
            weights = np.linalg.solve(factor.T, np.linalg.solve(factor, values))
            likelihood = -0.5 * float(values @ weights) - float(np.sum(np.log(np.diag(factor))))
            if likelihood > best:
                best, result = likelihood, (1.0 - noise) * kernel(asked, inputs, length) @ weights
    return result


def explained(inputs: Array, values: Array, times: Array) -> float:
    """Share of the variance of every other second that the seconds between predict."""
    fitted = np.floor(times / BLOCK) % 2.0 == 0.0
    rows = np.flatnonzero(fitted)
    rows = rows[:: max(1, -(-len(rows) // MOST))]
    mean, deviation = values[rows].mean(), values[rows].std()
    if len(rows) < 50 or fitted.all() or not deviation > 0.0:
        return 0.0
    scaled = (inputs - inputs[rows].mean(axis=0)) / np.maximum(inputs[rows].std(axis=0), 1e-9)
    found = mean + deviation * predicted(scaled[rows], (values[rows] - mean) / deviation, scaled[~fitted])
    left, all_of_it = np.mean((values[~fitted] - found) ** 2), np.mean(values[~fitted] ** 2)
    return float(1.0 - left / all_of_it)


def diagnose(path: Path) -> dict[str, Any]:
    """An answer of the schema of the diagnosis, as far as this method has one."""
    recording = load_recording(path)
    values, terms, known = library(recording)
    spin, times = np.asarray(recording.spin())[known], np.asarray(recording.time)[known]
    states = [terms[:, :, 0], recording.diabolo[known], spin[:, np.newaxis], times[:, np.newaxis]]
    inputs = np.concatenate(states, axis=1)
    shares = [explained(inputs, values[:, axis], times) for axis in range(3)] if len(values) else [0.0] * 3
    unnamed = [
        {"where": {"direction": direction}, "law": "a Gaussian process of the state", "explained": share}
        for direction, share in zip(DIRECTIONS, shares, strict=True)
        if share > LEAST_SHARE
    ]
    return {
        "headline": "UNNAMED_STRUCTURE" if unnamed else "NOTHING_MISSING",
        "effects": [],
        "unnamed": unnamed,
    }
