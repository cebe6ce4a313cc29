# SPDX-License-Identifier: MIT
"""Puts cases to a tool, one after the other. Never looks at a key."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from .. import files
from . import answer

Ask = Callable[[str], dict[str, Any]]
Report = Callable[[str, float], None]


def silent(step: str, fraction: float) -> None:
    """Reports to nobody."""


def resume(
    cases: list[str],
    results: Path,
    ask: Ask,
    report: Report = silent,
    minutes: float = float("inf"),
) -> int:
    """Adds a line to `results` for each case that has none yet; returns how many cases are left.

    `ask` answers a case by its name. A line is added whole, so that this may be stopped at any time and
    goes on where it was; no case is begun after `minutes`.
    """
    end = time.monotonic() + 60.0 * minutes
    done = {line["case"] for line in files.read_lines(results)}
    left = [case for case in cases if case not in done]
    while left and time.monotonic() < end:
        report(f"{left[0]}: {len(cases) - len(left)} of {len(cases)} done", 1.0 - len(left) / len(cases))
        try:
            found = answer.kept(ask(left[0]))
        except (ValueError, ArithmeticError) as error:
            found = answer.failed(error)
        files.append_line(results, {"case": left[0], "answer": found})
        left.pop(0)
    return len(left)


def answers(results: Path) -> dict[str, answer.Answer]:
    """The answers by case."""
    return {line["case"]: line["answer"] for line in files.read_lines(results)}
