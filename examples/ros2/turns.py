# SPDX-License-Identifier: MIT
"""Quaternions x, y, z, w of bodies whose x axis is what counts: an axle or a stick."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def first_axis(x: float, y: float, z: float, w: float) -> Floats:
    """Where a unit quaternion takes the x axis: a unit vector."""
    return np.array([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)])


def turn_of(axis: Floats, angle: float = 0.0) -> tuple[float, float, float, float]:
    """First by an angle [rad] about x, then the shortest way from x to a unit vector; zeros for no vector."""
    x, y, z = axis.tolist()
    if not (x or y or z):
        return 0.0, 0.0, 0.0, 0.0
    w = math.sqrt(max(0.0, 0.5 * (1.0 + x)))
    y, z = (-0.5 * z / w, 0.5 * y / w) if w > 1e-6 else (0.0, 1.0)
    s, c = math.sin(0.5 * angle), math.cos(0.5 * angle)
    return w * s, y * c + z * s, z * c - y * s, w * c
