# SPDX-License-Identifier: MIT
"""Qualisys Track Manager's TSV of bodies (6D)."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from .._core import RecordingError
from ..rotations import quaternions
from .bodies import Body, check_rate, even_stamps, stamps_at
from .text import numbers, whole_lines


def read(path: Path) -> tuple[list[Body], list[str]]:
    """Bodies, in mm: X, Y, Z and the rotation matrix Rot[0] to Rot[8], column after column.
    The residual -1, zeros for everything, or nothing is a dropout. Also what was left out."""
    lines, notes = whole_lines(path)
    facts: dict[str, list[str]] = {}
    at_head = 0
    while at_head < len(lines) and re.fullmatch(r"[A-Z_]{2,}", (cells := lines[at_head].split("\t"))[0]):
        facts[cells[0]] = [cell.strip() for cell in cells[1:]]
        at_head += 1
    names = [name for name in facts.get("BODY_NAMES", []) if name]
    if not names:
        raise RecordingError(f"{path}: no BODY_NAMES; expected an export of bodies (6D) of Qualisys")
    try:
        rate = float(facts["FREQUENCY"][0])
    except (KeyError, IndexError, ValueError):
        raise RecordingError(f"{path}: no FREQUENCY with a number; expected one") from None
    check_rate(path, rate)
    columns = [cell.strip() for cell in (lines[at_head:] or [""])[0].split("\t")]
    table = numbers(path, lines[at_head + 1 :], at_head + 2, "\t", len(columns))
    declared = (facts.get("NO_OF_FRAMES") or [""])[0]
    if declared.isdecimal() and int(declared) > len(table):
        notes.append(
            f"of the {declared} frames that its head tells of, {len(table)} are there: it is cut off"
        )
    stamps = even_stamps(len(table), rate)
    if "Time" in columns:
        stamps = stamps_at(path, table[:, columns.index("Time")])
    bodies = []
    for name, at in zip(names, _starts(path, columns, names), strict=True):
        places = table[:, at : at + 3] * 1e-3
        matrices = table[:, at + 7 : at + 16].reshape(-1, 3, 3).swapaxes(1, 2)
        gone = (table[:, at + 6] < 0.0) | (places == 0.0).all(axis=1)
        places[gone], matrices[gone] = np.nan, np.nan
        bodies.append(Body(name, stamps, places, quaternions(matrices)))
    return bodies, notes


def _starts(path: Path, columns: list[str], names: list[str]) -> list[int]:
    """The first of the sixteen columns of each body: X, Y, Z, three angles, residual, nine of the matrix."""
    starts = [at for at, column in enumerate(columns) if column == "X" or column.endswith(" X")]
    whole = [at for at in starts if columns[at + 7 : at + 16] == [f"Rot[{k}]" for k in range(9)]]
    if len(whole) != len(names):
        raise RecordingError(
            f"{path}: columns of {len(whole)} bodies, but BODY_NAMES has {len(names)}; expected of each "
            "X, Y, Z, three angles, Residual and Rot[0] to Rot[8]"
        )
    return whole
