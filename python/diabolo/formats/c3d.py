# SPDX-License-Identifier: MIT
"""C3D files of motion capture: points, and rotations where there are some."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._core import RecordingError
from ..checks import shown
from .bodies import METRES, Body, even_stamps, unreadable


def read(path: Path) -> list[Body]:
    """Each labelled point, and each labelled rotation (a 4 x 4 matrix) as a body with an orientation."""
    import ezc3d

    try:
        file = ezc3d.c3d(str(path))
        points, group = file["data"]["points"], file["parameters"]["POINT"]
        header = file["header"]["points"]
        rate, first = float(header["frame_rate"]), int(header["first_frame"])
        labels, unit = group["LABELS"]["value"], (group["UNITS"]["value"] or ["mm"])[0]
        rotations, rotation_labels, rotation_rate = _rotations(file, rate)
    except Exception as error:  # of the library: whatever a broken file leads to
        raise unreadable(path, "C3D", error) from error
    scale = METRES.get(unit.strip().lower())
    if scale is None:
        raise RecordingError(f"{path}: POINT:UNITS {shown(unit)}; expected {', '.join(METRES)}")
    if not rate > 0.0 or not rotation_rate > 0.0:
        raise RecordingError(f"{path}: {rate:g} frames per second; expected more than 0")
    bodies = [
        Body(label, even_stamps(points.shape[2], rate, first), _seen(points[:3, i].T * scale))
        for i, label in enumerate(labels[: points.shape[1]])
    ]
    for i, label in enumerate(rotation_labels[: rotations.shape[2]]):
        matrices = np.moveaxis(rotations[:, :, i], -1, 0)
        stamps = even_stamps(len(matrices), rotation_rate, first * rotation_rate / rate)
        bodies.append(
            Body(label, stamps, _seen(matrices[:, :3, 3] * scale), quaternions(matrices[:, :3, :3]))
        )
    return bodies


def quaternions(matrices: NDArray[np.float64]) -> NDArray[np.float64]:
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
    result: NDArray[np.float64] = rows / np.linalg.norm(rows, axis=1, keepdims=True)
    return result


def _rotations(file: Any, rate: float) -> tuple[NDArray[np.float64], list[str], float]:
    """Shape (4, 4, bodies, frames), their labels, and how many a second."""
    group, data = file["parameters"].get("ROTATION"), file["data"].get("rotations")
    if group is None or data is None or "LABELS" not in group or 0 in np.shape(data):
        return np.zeros((4, 4, 0, 0)), [], rate
    own = group["RATE"]["value"] if "RATE" in group else []
    return np.asarray(data), list(group["LABELS"]["value"]), float(own[0]) if len(own) else rate


def _seen(places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points that were not seen are NaN, or zero in all three in some programs."""
    gone = ~np.isfinite(places).all(axis=1) | (places == 0.0).all(axis=1)
    return np.where(gone[:, None], np.nan, places)
