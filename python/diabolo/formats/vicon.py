# SPDX-License-Identifier: MIT
"""Vicon's CSV: sections one after another, each with a title, a rate, names, columns, units and rows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NoReturn

import numpy as np

from .._core import RecordingError
from ..checks import shown
from ..rotations import of_vectors
from .bodies import METRES, Body, Floats, check_rate, even_stamps, seen_points, stamps_at
from .text import numbers, whole_lines

BODIES, POINTS, OTHERS = ("Objects", "Segments"), ("Trajectories", "Model Outputs"), ("Devices", "Joints")
TITLES = (*BODIES, *POINTS, *OTHERS)
RADIANS = {"deg": np.pi / 180.0, "rad": 1.0}
HEAD = 5
"""Lines of a section above its rows."""


def read(path: Path) -> tuple[list[Body], list[str]]:
    """Objects and segments are bodies: TX, TY, TZ and RX, RY, RZ, a rotation vector, or with RW a quaternion.
    Trajectories, and model outputs in a unit of length, are points: X, Y, Z. Empty cells, or zeros for
    everything, are a dropout. Also what was left out."""
    lines, notes = whole_lines(path)
    found = [body for section in _sections(path, lines) for body in section.bodies()]
    if not found:
        raise RecordingError(f"{path}: no bodies or points; expected some in {', '.join(BODIES + POINTS)}")
    short = [body.name.split(":")[-1] for body in found]  # of SUBJECT:NAME
    names = [one if short.count(one) == 1 else body.name for one, body in zip(short, found, strict=True)]
    return [replace(body, name=name) for name, body in zip(names, found, strict=True)], notes


def _sections(path: Path, lines: list[str]) -> Iterator[Section]:
    starts = [at for at, line in enumerate(lines) if title_of(line) in TITLES]
    for at, end in zip(starts, [*starts[1:], len(lines)], strict=True):
        yield Section(path, at + 1, title_of(lines[at]), lines[at:end])


def title_of(line: str) -> str:
    """What stands alone in a line, which may be a section's title."""
    return line.rstrip("\r\n ,").lstrip()


@dataclass(frozen=True)
class Section:
    """Lines that begin with a title, which is line number `first` of the file."""

    path: Path
    first: int
    title: str
    lines: list[str]

    def bodies(self) -> Iterator[Body]:
        """Bodies or points, under the names that the file has."""
        if self.title in OTHERS:
            return
        if len(self.lines) <= HEAD:
            self.fail(len(self.lines), "the end", f"{self.title}, rate, names, columns, units and rows")
        rate, (names, columns, units) = self._rate(), map(self._cells, (3, 4, 5))
        if not len(names) <= len(columns) <= len(units):
            self.fail(
                5, f"{len(units)} cells", f"{len(columns)} units, one for each column, and no more names"
            )
        table = numbers(self.path, self.lines[HEAD:], self.first + HEAD, ",", len(columns))
        stamps = even_stamps(len(table), rate)
        if columns[0] == "Frame" and np.isfinite(table[:, 0]).all():
            stamps = stamps_at(self.path, table[:, 0] / rate)
        starts = [at for at, name in enumerate(names) if name]
        if not starts:
            self.fail(3, ",".join(names), "the name of a body or point above its columns")
        for at, end in zip(starts, [*starts[1:], len(columns)], strict=True):
            group = Group(self, names[at], columns[at:end], units[at:end], table[:, at:end])
            if self.title in BODIES:
                yield Body(names[at], stamps, *group.poses())
            elif self.title == "Trajectories" or group.unit("X") in METRES:
                yield Body(names[at], stamps, group.points())

    def fail(self, line: int, found: object, expected: str) -> NoReturn:
        """line: 1 is the title."""
        where = f"{self.path}, line {self.first + line - 1}"
        raise RecordingError(f"{where}: found {shown(found)}; expected {expected}")

    def _rate(self) -> float:
        cell = self.lines[1].split(",")[0]
        try:
            rate = float(cell)
        except ValueError:
            self.fail(2, cell, "the rate")
        check_rate(self.path, rate)
        return rate

    def _cells(self, line: int) -> list[str]:
        return [cell.strip() for cell in self.lines[line - 1].split(",")]


@dataclass(frozen=True, eq=False)
class Group:
    """The columns of one name in a section: their names, units and numbers, shape (n, columns)."""

    section: Section
    name: str
    columns: list[str]
    units: list[str]
    table: Floats

    def unit(self, column: str) -> str | None:
        """None where there is no such column."""
        return self.units[self.columns.index(column)] if column in self.columns else None

    def poses(self) -> tuple[Floats, Floats]:
        """Places [m] and quaternions x, y, z, w."""
        places = self._scaled(METRES, "TX", "TY", "TZ")
        if "RW" in self.columns:
            turned = turns = self._numbers("RX", "RY", "RZ", "RW")
        else:
            turned = self._scaled(RADIANS, "RX", "RY", "RZ")
            turns = of_vectors(turned)
        nothing = (places == 0.0).all(axis=1) & (turned == 0.0).all(axis=1)
        gone = (nothing | ~np.isfinite(places).all(axis=1))[:, None]
        return np.where(gone, np.nan, places), np.where(gone, np.nan, turns)

    def points(self) -> Floats:
        """[m]"""
        return seen_points(self._scaled(METRES, "X", "Y", "Z"))

    def _numbers(self, *wanted: str) -> Floats:
        for one in wanted:
            if one not in self.columns:
                self.section.fail(4, ",".join(self.columns), f"a column {one} of {self.name}")
        numbers: Floats = self.table[:, [self.columns.index(one) for one in wanted]]
        return numbers

    def _scaled(self, units: Mapping[str, float], *wanted: str) -> Floats:
        """Numbers of some columns, each by its own unit."""
        numbers = self._numbers(*wanted)
        scales = []
        for column in wanted:
            unit = self.unit(column) or ""
            if unit not in units:
                self.section.fail(5, unit, f"{' or '.join(units)} below {column} of {self.name}")
            scales.append(units[unit])
        scaled: Floats = numbers * np.array(scales)
        return scaled
