# SPDX-License-Identifier: MIT
"""Rotations as unit quaternions x, y, z, w, body to world."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ._core import played_orientation

__all__ = ["first_axes", "of_vectors", "played_orientation", "quaternions"]

Floats = NDArray[np.float64]


def quaternions(matrices: Floats) -> Floats:
    """Unit quaternions x, y, z, w, shape (n, 4), of matrices, body to world, shape (n, 3, 3); NaN where one
    is no rotation."""
    off = np.abs(np.einsum("nij,nkj->nik", matrices, matrices) - np.eye(3)).max(axis=(1, 2))
    turns = (off < 1e-3) & (np.linalg.det(np.nan_to_num(matrices)) > 0.0)
    m = np.where(turns[:, None, None], matrices, np.nan)
    back = np.swapaxes(m, 1, 2) - m
    trace = np.trace(m, axis1=1, axis2=2)
    # Four times the outer product of (x, y, z, w) with itself: its longest row is the most exact.
    product = np.empty((len(m), 4, 4))
    product[:, :3, :3] = m + np.swapaxes(m, 1, 2) + (1.0 - trace)[:, None, None] * np.eye(3)
    product[:, :3, 3] = product[:, 3, :3] = back[:, (1, 2, 0), (2, 0, 1)]
    product[:, 3, 3] = 1.0 + trace
    longest = np.argmax(np.nan_to_num(np.linalg.norm(product, axis=2)), axis=1)
    rows = product[np.arange(len(m)), longest]
    result: Floats = rows / np.linalg.norm(rows, axis=1, keepdims=True)
    return result


def first_axes(turns: Floats) -> Floats:
    """Body x in the world, shape (..., 3), of quaternions, shape (..., 4)."""
    x, y, z, w = np.moveaxis(turns, -1, 0)
    return np.stack([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)], axis=-1)


def of_vectors(vectors: Floats) -> Floats:
    """Quaternions of rotation vectors [rad]."""
    angle = np.linalg.norm(vectors, axis=1, keepdims=True)
    half = np.sinc(angle / (2.0 * np.pi)) / 2.0  # sin(angle / 2) / angle
    return np.concatenate([vectors * half, np.cos(angle / 2.0)], axis=1)
