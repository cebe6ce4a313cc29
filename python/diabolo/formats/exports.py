# SPDX-License-Identifier: MIT
"""Text that programs of motion capture export: Qualisys Track Manager's TSV of bodies (6D), and Vicon's CSV
of objects."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from .._core import RecordingError, read_text
from ..checks import shown
from .bodies import METRES, Body, check_rate, even_stamps
from .c3d import quaternions

RADIANS = {"deg": np.pi / 180.0, "rad": 1.0}


def read_qualisys(path: Path) -> tuple[list[Body], list[str]]:
    """Bodies of a TSV export, in mm: X, Y, Z and the rotation matrix Rot[0] to Rot[8], column after column.
    The residual -1, zeros for everything, or nothing is a dropout. Also what was left out."""
    lines, notes = _whole_lines(path)
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
    table = _numbers(path, lines[at_head + 1 :], at_head + 2, "\t", len(columns))
    declared = (facts.get("NO_OF_FRAMES") or [""])[0]
    if declared.isdecimal() and int(declared) > len(table):
        notes.append(
            f"of the {declared} frames that its head tells of, {len(table)} are there: it is cut off"
        )
    stamps = even_stamps(len(table), rate)
    if "Time" in columns:
        stamps = np.rint(table[:, columns.index("Time")] * 1e9).astype(np.int64)
    bodies = []
    for name, at in zip(names, _starts(path, columns, names), strict=True):
        places = table[:, at : at + 3] * 1e-3
        matrices = table[:, at + 7 : at + 16].reshape(-1, 3, 3).swapaxes(1, 2)
        gone = (table[:, at + 6] < 0.0) | (places == 0.0).all(axis=1)
        places[gone], matrices[gone] = np.nan, np.nan
        bodies.append(Body(name, stamps, places, quaternions(matrices)))
    return bodies, notes


def read_vicon(path: Path) -> tuple[list[Body], list[str]]:
    """Objects of a CSV export: RX, RY, RZ, a rotation vector, or with RW a quaternion, and TX, TY, TZ. Empty
    cells, or zeros for everything, are a dropout. Also what was left out."""
    whole, notes = _whole_lines(path)
    lines = list(csv.reader(whole))

    def fail(line: int, found: object, expected: str) -> NoReturn:
        raise RecordingError(f"{path}, line {line}: found {shown(found)}; expected {expected}")

    if len(lines) < 6:
        fail(len(lines), "the end", "an export of Vicon: Objects, rate, names, columns, units and rows")
    try:
        rate = float(lines[1][0])
    except (ValueError, IndexError):
        fail(2, lines[1][:1], "the rate")
    check_rate(path, rate)
    names, columns, units = lines[2], [cell.strip() for cell in lines[3]], [cell.strip() for cell in lines[4]]
    if not len(names) <= len(columns) <= len(units):
        fail(5, f"{len(units)} cells", f"{len(columns)} units, one for each column, and no more names")
    table = _numbers(path, [",".join(row) for row in lines[5:]], 6, ",", len(columns))
    stamps = even_stamps(len(table), rate)
    if columns[0] == "Frame" and np.isfinite(table[:, 0]).all():
        stamps = np.rint(table[:, 0] / rate * 1e9).astype(np.int64)
    starts = [at for at, name in enumerate(names) if name.strip()]
    bodies = []
    for at, end in zip(starts, [*starts[1:], len(columns)], strict=True):
        own = {columns[k]: k for k in range(at, end)}
        wanted = ["RX", "RY", "RZ", *(["RW"] if "RW" in own else []), "TX", "TY", "TZ"]
        if missing := [one for one in wanted if one not in own]:
            fail(4, ",".join(columns[at:end]), f"a column {missing[0]} of {names[at]}")
        unit, turn_unit = units[own["TX"]], units[own["RX"]]
        if unit not in METRES or ("RW" not in own and turn_unit not in RADIANS):
            fail(5, f"{turn_unit}, {unit}", "deg or rad, and mm, cm or m")
        places = table[:, [own[one] for one in ("TX", "TY", "TZ")]] * METRES[unit]
        turned = table[:, [own[one] for one in wanted[:-3]]]
        turns = turned if "RW" in own else _of_vectors(turned * RADIANS[turn_unit])
        gone = ~np.isfinite(places).all(axis=1) | ((places == 0.0).all(axis=1) & (turned == 0.0).all(axis=1))
        places[gone], turns[gone] = np.nan, np.nan
        bodies.append(Body(names[at].strip().split(":")[-1], stamps, places, turns))
    return bodies, notes


def _whole_lines(path: Path) -> tuple[list[str], list[str]]:
    """Lines of a text, without a last one that may be cut off, and a note of that."""
    text = read_text(path)
    if text.endswith(("\n", "\r")) or "\n" not in text:
        return text.splitlines(), []
    return text.splitlines()[:-1], [
        "the last line has no line end and may be cut off inside a number: it is left out"
    ]


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


def _numbers(path: Path, rows: list[str], first: int, mark: str, size: int) -> NDArray[np.float64]:
    """Numbers of lines, of which `first` is the first one's number; empty cells are NaN, blank lines are left
    out."""
    table = []
    for line, row in enumerate(rows, first):
        cells = [cell.strip() for cell in row.split(mark)]
        if not any(cells) and (mark == "," or len(cells) < size):
            continue  # a blank line; of tabs alone it is a frame in which nothing was seen
        if len(cells) < size or any(cells[size:]):
            raise RecordingError(f"{path}, line {line}: {len(cells)} cells; expected {size}")
        table.append([_number(path, line, k, cell) for k, cell in enumerate(cells[:size])])
    if not table:
        raise RecordingError(f"{path}: no rows; expected at least two")
    return np.array(table)


def _number(path: Path, line: int, at: int, text: str) -> float:
    try:
        return float(text) if text else np.nan
    except ValueError:
        raise RecordingError(
            f"{path}, line {line}, cell {at + 1}: found {shown(text)}; expected a number"
        ) from None


def _of_vectors(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Quaternions of rotation vectors [rad]."""
    angle = np.linalg.norm(vectors, axis=1, keepdims=True)
    half = np.sinc(angle / (2.0 * np.pi)) / 2.0  # sin(angle / 2) / angle
    return np.concatenate([vectors * half, np.cos(angle / 2.0)], axis=1)
