# SPDX-License-Identifier: MIT
"""Bodies that were tracked, each with times of its own, resampled at common times."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .._core import RecordingError
from ..checks import shown

Floats = NDArray[np.float64]
Track = tuple[str, Floats, "Floats | None"]
ROLES = ("left", "right", "diabolo")
METRES = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}
EVEN = 0.9  # the median step of all stamps over a body's, at least, where bodies have the same stamps
SAME_RATE = 1.5  # the largest median step of a body over the smallest, at most, if so
CLOCK = 10**18  # stamps beyond are those of a clock that counts from 1970 [ns]
LAST = 1e9  # time within a file [s]
FASTEST = 1e4  # samples a second
NO_FRAME = ""  # of a body whose frame is not told: it goes with any
LONGEST_STEP = 2.5  # that is interpolated, in a body's own median steps


@dataclass(frozen=True, eq=False)
class Body:
    """A body or a point over n samples: stamps [ns], places [m], shape (n, 3), and orientations x, y, z, w,
    shape (n, 4), None of a point. A row with NaN is a dropout. frame: in which it was seen, where told."""

    name: str
    stamps: NDArray[np.int64]
    position: Floats
    orientation: Floats | None = None
    frame: str = NO_FRAME

    @property
    def step(self) -> float:
        """The median one [ns]."""
        return float(np.median(np.diff(self.stamps))) if len(self.stamps) > 1 else np.inf


def unreadable(path: Path, kind: str, error: Exception) -> RecordingError:
    """What a library said of a file that it cannot read, in one sentence."""
    said = f"no {error}" if isinstance(error, KeyError) else str(error)
    why = " ".join(said.split())[:200] or type(error).__name__
    return RecordingError(f"{path}: cannot be read as {kind} ({why})")


def check_rate(path: Path, rate: float) -> None:
    """Raise RecordingError about a rate [Hz] that no camera has."""
    if not 1e-3 <= rate <= 1e6:
        raise RecordingError(f"{path}: {rate:g} frames per second; expected 0.001 to 1e6")


def even_stamps(size: int, rate: float, first: float = 0.0) -> NDArray[np.int64]:
    """Of frames that follow each other, from frame number `first` on [ns]."""
    stamps: NDArray[np.int64] = np.rint((np.arange(size) + first) / rate * 1e9).astype(np.int64)
    return stamps


def stamps_at(path: Path, times: Floats) -> NDArray[np.int64]:
    """Of times [s] that a file has [ns]. Raises RecordingError about one that is none."""
    odd = np.flatnonzero(~(np.abs(times) <= LAST))
    if len(odd):
        raise RecordingError(
            f"{path}, row {odd[0] + 1}: time {times[odd[0]]:g} s; expected one within {LAST:g} s"
        )
    stamps: NDArray[np.int64] = np.rint(times * 1e9).astype(np.int64)
    return stamps


def seen_points(places: Floats) -> Floats:
    """Points that were not seen are NaN, or zero in all three in some programs."""
    gone = ~np.isfinite(places).all(axis=1) | (places == 0.0).all(axis=1)
    return np.where(gone[:, None], np.nan, places)


def check_names(path: Path, bodies: Sequence[Body], names: Mapping[str, str]) -> None:
    """Raise RecordingError where a body that is asked for is not there, or there are two of its name."""
    known = [body.name for body in bodies]
    for name in known:
        telling = name in names.values() or any(role in name.lower() for role in ROLES)
        if telling and known.count(name) > 1:
            raise RecordingError(f"{path}: two bodies are named {shown(name)}; expected names of their own")
    for role, name in names.items():
        if name not in known:
            there = ", ".join(map(shown, known[:12])) or "none"
            raise RecordingError(f"{path}: no body {shown(name)} for {role}; the file has {there}")


def at_common_times(
    path: Path, bodies: Sequence[Body], names: Mapping[str, str]
) -> tuple[Floats, list[Track], bool]:
    """Times [s], the bodies at them, and whether they are counted from the first stamp of a clock.

    names: of bodies, by their role. Bodies with the same stamps keep them. Otherwise the times are the
    diabolo's, and the others are interpolated between their neighbours, not across dropouts.
    """
    wanted = _wanted(bodies, names)
    if not wanted or max(len(body.stamps) for body in wanted) < 2:
        raise RecordingError(f"{path}: no bodies with two samples; expected two tips and a diabolo")
    for body in wanted:
        back = np.flatnonzero(np.diff(body.stamps) <= 0)
        if len(back):
            raise RecordingError(
                f"{path}, {body.name}: stamp {body.stamps[back[0] + 1]} ns does not come after the one before"
            )
    told = [body for body in wanted if body.frame != NO_FRAME]
    for body in told:
        if body.frame != told[0].frame:
            raise RecordingError(
                f"{path}: {told[0].name} is in the frame {shown(told[0].frame)}, {body.name} in "
                f"{shown(body.frame)}; expected one frame"
            )
    for body in wanted:
        if body.step < 1e9 / FASTEST:
            raise RecordingError(
                f"{path}, {body.name}: {1e9 / body.step:g} samples a second by its stamps; expected "
                f"{FASTEST:g} at most (stamps of us or ms where ns belong?)"
            )
    stamps = np.unique(np.concatenate([body.stamps for body in wanted]))
    steps = [body.step for body in wanted]
    alike = bool(np.median(np.diff(stamps)) >= EVEN * min(steps) and max(steps) <= SAME_RATE * min(steps))
    times = stamps if alike else _leader(wanted, names).stamps
    of_a_clock = bool(times[0] > CLOCK)
    tracks = [_spread(body, times) if alike else _interpolated(body, times) for body in wanted]
    return (times - (times[0] if of_a_clock else 0)) * 1e-9, tracks, of_a_clock


def _wanted(bodies: Sequence[Body], names: Mapping[str, str]) -> Sequence[Body]:
    """Those that are named for all roles, or else whose names tell a role, where there are such of each."""
    if len(names) == len(ROLES):
        return [body for body in bodies if body.name in names.values()]
    given = [body for body in bodies if body.name in names.values()]
    telling = [body for body in bodies if sum(role in body.name.lower() for role in ROLES) == 1]
    told = {role for role in ROLES for body in telling if role in body.name.lower()} | {*names}
    return [*given, *(one for one in telling if one not in given)] if len(told) == len(ROLES) else bodies


def _leader(bodies: Sequence[Body], names: Mapping[str, str]) -> Body:
    """The diabolo, or who has the most samples."""
    told = [body for body in bodies if body.name == names.get("diabolo")]
    told = told or [body for body in bodies if "diabolo" in body.name.lower()]
    return told[0] if len(told) == 1 else max(bodies, key=lambda body: len(body.stamps))


def _interpolated(body: Body, times: NDArray[np.int64]) -> Track:
    """The body at given stamps; NaN where its neighbours are farther apart than LONGEST_STEP."""
    count = len(body.stamps)
    after = np.searchsorted(body.stamps, times).clip(0, count - 1)
    exact = body.stamps[after] == times
    before = np.where(exact, after, (after - 1).clip(0))
    span = (body.stamps[after] - body.stamps[before]).astype(float)
    share = np.divide(times - body.stamps[before], span, out=np.zeros(len(times)), where=span > 0)
    inside = (share >= 0.0) & (share <= 1.0) & (span <= LONGEST_STEP * body.step) & ((span > 0) | exact)
    weight = np.where(inside, share, np.nan)[:, None]

    def between(values: Floats) -> Floats:
        mixed: Floats = (1.0 - weight) * values[before] + weight * values[after]
        return mixed

    if body.orientation is None:
        return body.name, between(body.position), None
    turns = body.orientation
    near = np.where((turns[before] * turns[after]).sum(axis=1, keepdims=True) < 0.0, -1.0, 1.0)
    turned = (1.0 - weight) * turns[before] + weight * near * turns[after]
    return body.name, between(body.position), turned / np.linalg.norm(turned, axis=1, keepdims=True)


def _spread(body: Body, times: NDArray[np.int64]) -> Track:
    """The body at stamps that include its own; NaN at the others."""
    rows = np.searchsorted(times, body.stamps)

    def at_rows(values: Floats) -> Floats:
        spread = np.full((len(times), values.shape[1]), np.nan)
        spread[rows] = values
        return spread

    turns = None if body.orientation is None else at_rows(body.orientation)
    return body.name, at_rows(body.position), turns
