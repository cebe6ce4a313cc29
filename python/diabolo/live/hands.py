# SPDX-License-Identifier: MIT
"""Two hands that follow the pointer as far as hands can."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .._core import follow_pointers
from ..motions import FORWARD

AT_REST = 0.9
"""Share of the string's length beyond which hands that begin are not apart."""
HOME = ((0.4, 1.25), (-0.4, 1.25))
"""Where the left and the right tip begin: to the left and up [m]."""
REACH = ((-1.2, 1.2), (0.5, 2.2))
"""Where a tip may be, to the left and up [m]. REACH and HOME are those of `make page`, too."""


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
        self.position, self.velocity = follow_pointers(
            self.position, self.velocity, wanted, self.string_length, dt
        )


def in_plane(tips: tuple[tuple[float, float], tuple[float, float]]) -> NDArray[np.float64]:
    """Both tips, to the left and up [m], in the plane that the pointer plays in: shape (2, 3) [m]."""
    return np.array([[FORWARD, *tip] for tip in tips])
