# SPDX-License-Identifier: MIT
"""Bodies that were tracked, each with times of its own, brought to common times."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .._core import RecordingError
from ..checks import shown

Floats = NDArray[np.float64]
Tracks = list[tuple[str, Floats, "Floats | None"]]
ALIKE = 1.05  # as many different stamps as of one body, within this: the bodies have the same ones
LONGEST_STEP = 2.5  # that is interpolated, in a body's own median steps


@dataclass(frozen=True)
class Body:
    """A body or a point over n samples: stamps [ns], places [m], shape (n, 3), and orientations x, y, z, w,
    shape (n, 4), None of a point. A row with NaN is a dropout."""

    name: str
    stamps: NDArray[np.int64]
    position: Floats
    orientation: Floats | None = None


def check_names(path: Path, bodies: Sequence[Body], names: Mapping[str, str]) -> None:
    """Raise RecordingError where a body that is asked for is not there."""
    known = [body.name for body in bodies]
    for role, name in names.items():
        if name not in known:
            there = ", ".join(map(shown, known[:12])) or "none"
            raise RecordingError(f"{path}: no body {shown(name)} for {role}; the file has {there}")


def together(path: Path, bodies: Sequence[Body], names: Mapping[str, str]) -> tuple[Floats, Tracks]:
    """Times [s] from the first stamp on, and all bodies at them. names: of bodies, by their role.

    Bodies with the same stamps keep them. Otherwise the times are the diabolo's, and the others are
    interpolated between their neighbours, not across dropouts.
    """
    wanted = [body for body in bodies if body.name in names.values()] or bodies
    if not wanted or max(len(body.stamps) for body in wanted) < 2:
        raise RecordingError(f"{path}: no bodies with two samples; expected two tips and a diabolo")
    for body in wanted:
        back = np.flatnonzero(np.diff(body.stamps) <= 0)
        if len(back):
            raise RecordingError(
                f"{path}, {body.name}: stamp {body.stamps[back[0] + 1]} ns does not come after the one before"
            )
    all_stamps = np.unique(np.concatenate([body.stamps for body in wanted]))
    alike = len(all_stamps) <= ALIKE * max(len(body.stamps) for body in wanted)
    times = all_stamps if alike else _leader(wanted, names).stamps
    tracks = [_at(body, times, interpolates=not alike) for body in wanted]
    return (times - times[0]) * 1e-9, tracks


def _leader(bodies: Sequence[Body], names: Mapping[str, str]) -> Body:
    """The diabolo, or who has the most samples."""
    told = [body for body in bodies if body.name == names.get("diabolo")]
    told = told or [body for body in bodies if "diabolo" in body.name.lower()]
    return told[0] if len(told) == 1 else max(bodies, key=lambda body: len(body.stamps))


def _at(body: Body, times: NDArray[np.int64], *, interpolates: bool) -> tuple[str, Floats, Floats | None]:
    """The body at given stamps; NaN where it was not seen."""
    if not interpolates:
        rows = np.searchsorted(times, body.stamps)
        turns = None if body.orientation is None else _spread(body.orientation, rows, len(times))
        return body.name, _spread(body.position, rows, len(times)), turns
    count = len(body.stamps)
    after = np.searchsorted(body.stamps, times).clip(0, count - 1)
    exact = body.stamps[after] == times
    before = np.where(exact, after, (after - 1).clip(0))
    span = (body.stamps[after] - body.stamps[before]).astype(float)
    share = np.divide(times - body.stamps[before], span, out=np.zeros(len(times)), where=span > 0)
    longest = LONGEST_STEP * np.median(np.diff(body.stamps)) if count > 1 else 0.0
    inside = (share >= 0.0) & (share <= 1.0) & (span <= longest) & ((span > 0) | exact)
    weight = np.where(inside, share, np.nan)[:, None]

    def between(values: Floats) -> Floats:
        mixed: Floats = (1.0 - weight) * values[before] + weight * values[after]
        return mixed

    if body.orientation is None:
        return body.name, between(body.position), None
    near = np.sign((body.orientation[before] * body.orientation[after]).sum(axis=1, keepdims=True))
    turned = (1.0 - weight) * body.orientation[before] + weight * near * body.orientation[after]
    norm = np.linalg.norm(turned, axis=1, keepdims=True)
    return body.name, between(body.position), turned / norm


def _spread(values: Floats, rows: NDArray[np.intp], size: int) -> Floats:
    """Values at rows of an array that has `size`; NaN elsewhere."""
    spread = np.full((size, values.shape[1]), np.nan)
    spread[rows] = values
    return spread
