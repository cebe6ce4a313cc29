# SPDX-License-Identifier: MIT
"""Two hands that follow the pointer as far as hands can."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .._core import TipLimits
from ..motions import FORWARD

FOLLOW = 22.0
"""Rate of the critically damped spring by which a hand goes after the pointer [1/s]."""
FASTEST, HARDEST = TipLimits().speed, TipLimits().acceleration
"""Largest speed [m/s] and acceleration [m/s^2] of a hand, as in a plan for a person."""
WIDEST = 0.995
"""Share of the string's length beyond which hands do not part."""
AT_REST = 0.9
"""Share of the string's length beyond which hands that begin are not apart."""
HOME = ((0.4, 1.25), (-0.4, 1.25))
"""Where the left and the right tip begin: to the left and up [m]."""
REACH = ((-1.2, 1.2), (0.5, 2.2))
"""Where a tip may be, to the left and up [m]. REACH, HOME and the law are those of `make page`, too."""


class Hands:
    """Both tips, left and right: `position` [m] and `velocity` [m/s], shape (2, 3), world frame."""

    def __init__(self, string_length: float) -> None:
        self.string_length = string_length
        self.rest_at(in_plane(HOME))

    def rest_at(self, wanted: NDArray[np.float64]) -> None:
        """Both hands at rest where they are wanted, shape (2, 3) [m], or closer for a short string."""
        middle = wanted.mean(axis=0)
        apart = float(np.linalg.norm(wanted[0] - wanted[1]))
        self.position = middle + (wanted - middle) * min(1.0, AT_REST * self.string_length / max(apart, 1e-9))
        self.velocity = np.zeros((2, 3))

    def follow(self, wanted: NDArray[np.float64], dt: float) -> None:
        """Move for `dt` [s] towards where they are wanted, shape (2, 3) [m]."""
        pull = FOLLOW**2 * (wanted - self.position) - 2.0 * FOLLOW * self.velocity
        velocity = bounded(self.velocity + bounded(pull, HARDEST) * dt, FASTEST)
        apart = self.position[0] - self.position[1] + (velocity[0] - velocity[1]) * dt
        torn = apart - bounded(apart[np.newaxis], WIDEST * self.string_length)[0]
        velocity += np.array([-0.5, 0.5])[:, np.newaxis] * torn / dt  # taken out, else the string tears
        self.position, self.velocity = self.position + velocity * dt, velocity


def bounded(vectors: NDArray[np.float64], longest: float) -> NDArray[np.float64]:
    """Vectors, shape (N, 3), shortened where they are too long."""
    lengths = np.sqrt((vectors**2).sum(axis=1, keepdims=True))
    shortened: NDArray[np.float64] = vectors * np.minimum(1.0, longest / np.maximum(lengths, 1e-9))
    return shortened


def in_plane(tips: tuple[tuple[float, float], tuple[float, float]]) -> NDArray[np.float64]:
    """Both tips, to the left and up [m], in the plane that the pointer plays in: shape (2, 3) [m]."""
    return np.array([[FORWARD, *tip] for tip in tips])
