# SPDX-License-Identifier: MIT
"""Lines and numbers of text that programs of motion capture export."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .._core import RecordingError, read_text
from ..checks import shown

LARGEST = 1e12
"""Number in a file."""


def whole_lines(path: Path) -> tuple[list[str], list[str]]:
    """Lines of a text, without a last one that may be cut off, and a note of that."""
    text = read_text(path)
    if text.endswith(("\n", "\r")) or "\n" not in text:
        return text.splitlines(), []
    return text.splitlines()[:-1], [
        "the last line has no line end and may be cut off inside a number: it is left out"
    ]


def numbers(path: Path, rows: Sequence[str], first: int, mark: str, size: int) -> NDArray[np.float64]:
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
        raise RecordingError(f"{path}, line {first}: no rows; expected at least two")
    return np.array(table)


def _number(path: Path, line: int, at: int, text: str) -> float:
    plain = text.isascii() and "_" not in text  # as Python's own numbers need not be
    try:
        found = float(text if plain else "inf") if text else np.nan
    except ValueError:
        found = np.inf
    if abs(found) > LARGEST:
        raise RecordingError(
            f"{path}, line {line}, cell {at + 1}: found {shown(text)}; expected a number within {LARGEST:g}"
        )
    return found
