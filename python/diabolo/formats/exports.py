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
from .bodies import Body
from .c3d import quaternions

METRES = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}
RADIANS = {"deg": np.pi / 180.0, "rad": 1.0}


def read_qualisys(path: Path) -> list[Body]:
    """Bodies of a TSV export, in mm: X, Y, Z and the rotation matrix Rot[0] to Rot[8], column after column.
    The residual -1, or zeros for everything, is a dropout."""
    lines = read_text(path).splitlines()
    facts: dict[str, list[str]] = {}
    while lines and re.fullmatch(r"[A-Z_]{2,}", (cells := lines[0].split("\t"))[0]):
        facts[cells[0]] = [cell.strip() for cell in cells[1:]]
        del lines[0]
    names = [name for name in facts.get("BODY_NAMES", []) if name]
    if not names:
        raise RecordingError(f"{path}: no BODY_NAMES; expected an export of bodies (6D) of Qualisys")
    try:
        rate = float(facts["FREQUENCY"][0])
    except (KeyError, IndexError, ValueError):
        raise RecordingError(f"{path}: no FREQUENCY with a number; expected one") from None
    if not rate > 0.0:
        raise RecordingError(f"{path}: FREQUENCY {rate:g}; expected more than 0")
    head, *rows = lines or [""]
    columns = [cell.strip() for cell in head.split("\t")]
    table = _numbers(path, rows, len(facts) + 2, "\t", len(columns))
    bodies = []
    for name, at in zip(names, _starts(path, columns, names), strict=True):
        places = table[:, at : at + 3] * 1e-3
        matrices = table[:, at + 7 : at + 16].reshape(-1, 3, 3).swapaxes(1, 2)
        gone = (table[:, at + 6] < 0.0) | (places == 0.0).all(axis=1)
        places[gone], matrices[gone] = np.nan, np.nan
        bodies.append(Body(name, _stamps(len(table), rate), places, quaternions(matrices)))
    return bodies


def read_vicon(path: Path) -> list[Body]:
    """Objects of a CSV export: RX, RY, RZ, a rotation vector, or with RW a quaternion, and TX, TY, TZ. Empty
    cells, or zeros for everything, are a dropout."""
    lines = list(csv.reader(read_text(path).splitlines()))

    def fail(line: int, found: object, expected: str) -> NoReturn:
        raise RecordingError(f"{path}, line {line}: found {shown(found)}; expected {expected}")

    if len(lines) < 6:
        fail(len(lines), "the end", "an export of Vicon: Objects, rate, names, columns, units and rows")
    try:
        rate = float(lines[1][0])
    except (ValueError, IndexError):
        fail(2, lines[1][:1], "the rate")
    if not rate > 0.0:
        fail(2, rate, "a rate of more than 0")
    names, columns, units = lines[2], [cell.strip() for cell in lines[3]], [cell.strip() for cell in lines[4]]
    text = [",".join(row) for row in lines[5:] if any(cell.strip() for cell in row)]
    table = _numbers(path, text, 6, ",", len(columns))
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
        bodies.append(Body(names[at].strip().split(":")[-1], _stamps(len(table), rate), places, turns))
    return bodies


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
    """Numbers of lines; empty cells are NaN. first: the number of the first line."""
    table = np.full((len(rows), size), np.nan)
    for i, row in enumerate(rows):
        cells = row.split(mark)
        if (len(cells) > size and any(cell.strip() for cell in cells[size:])) or len(cells) < size:
            raise RecordingError(f"{path}, line {first + i}: {len(cells)} cells; expected {size}")
        for k, cell in enumerate(cells[:size]):
            if text := cell.strip():
                try:
                    table[i, k] = float(text)
                except ValueError:
                    raise RecordingError(
                        f"{path}, line {first + i}, cell {k + 1}: found {shown(text)}; expected a number"
                    ) from None
    if not len(rows):
        raise RecordingError(f"{path}: no rows; expected at least two")
    return table


def _of_vectors(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Quaternions of rotation vectors [rad]."""
    angle = np.linalg.norm(vectors, axis=1, keepdims=True)
    half = np.sinc(angle / (2.0 * np.pi)) / 2.0  # sin(angle / 2) / angle
    return np.concatenate([vectors * half, np.cos(angle / 2.0)], axis=1)


def _stamps(size: int, rate: float) -> NDArray[np.int64]:
    return np.rint(np.arange(size) / rate * 1e9).astype(np.int64)
