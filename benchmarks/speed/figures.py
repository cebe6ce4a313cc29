# SPDX-License-Identifier: MIT
"""Figures as text."""

from __future__ import annotations

import statistics
from collections.abc import Iterable
from typing import Any

PROGRAMS = "build/bench/benchmarks/speed"


def table(columns: list[str], rows: Iterable[Iterable[str]], text_columns: int = 1) -> str:
    marks = ["---"] * text_columns + ["---:"] * (len(columns) - text_columns)
    return "\n".join(f"| {' | '.join(row)} |" for row in [columns, marks, *rows])


def per_step(entry: dict[str, Any], clock: str = "cpu") -> list[float]:
    """Nanoseconds per step, of every repetition."""
    return [time / entry["steps"] for time in entry[clock]]


def speed(entry: dict[str, Any], clock: str = "cpu") -> float:
    """Million steps a second, median."""
    return 1e3 / statistics.median(per_step(entry, clock))


def shown(seconds: float) -> str:
    """Three digits in a unit that suits."""
    unit, size = next((u for u in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)) if seconds >= u[1]), ("ns", 1e-9))
    return f"{float(f'{seconds / size:.3g}'):g} {unit}"
