# SPDX-License-Identifier: MIT
"""What a simulator leaves out, found by comparing it with recordings."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from . import _core
from ._core import Model, Recording

SCHEMA = "diabolo.diagnosis/1"


class Diagnosis(NamedTuple):
    """What `diagnose` gives."""

    result: dict[str, Any]
    """Everything, as in a file of the schema diabolo.diagnosis/1 (docs/diagnosis.md)."""
    model: Model
    """The base with the physics that was found; for recordings without the faults that were found."""

    @property
    def headline(self) -> str:
        """NAMED, TIE, NOTHING_MISSING and the like: the first of the schema's list that holds."""
        return str(self.result["headline"])

    @property
    def sentence(self) -> str:
        """The answer."""
        return str(self.result["sentence"])

    @property
    def effects(self) -> list[dict[str, Any]]:
        """What is claimed, the surest first."""
        return list(self.result["effects"])

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return self.result


def diagnose(
    recordings: Recording | Iterable[Recording],
    base: Model | str = "consistent",
    *,
    holdout: Iterable[Recording] = (),
    bank: Iterable[str] = (),
    budget: float = 1e9,
    seed: int = 1,
    threads: int = 0,
    progress: Callable[[str, float], None] | None = None,
) -> Diagnosis:
    """Find what a simulator leaves out, or what a measurement got wrong.

    recordings: of one set-up; they are looked at together.
    base: the simulator: a Model, "consistent", "paper" or "published".
    holdout: recordings that nothing is fitted to, to compare base and answer on; by default recordings, or
        thirds of a single one, are left out in turn.
    bank: names of what may be claimed, such as "string_friction"; by default everything known. What no
        measurement is without stays free in every fit.
    budget: no new refit begins after so many seconds.
    seed: of the bootstrap intervals. threads: 0 takes all that help; the result does not depend on it.
    progress: called with the name of the step and the fraction done.

        diagnose(load_recording("swing.csv")).sentence

    Ctrl-C ends it at once. Raises ValueError about bad input; a recording that can decide nothing is an
    answer, INSUFFICIENT_DATA.
    """
    given = [recordings] if isinstance(recordings, Recording) else list(recordings)
    if not given:
        raise ValueError("recordings: none; at least one expected")
    if threads < 0:
        raise ValueError(f"threads: {threads}; expected 0 (all that help) or more")
    if not budget > 0.0:
        raise ValueError(f"budget: {budget} s; must be positive")
    chosen = Model.named(base) if isinstance(base, str) else base
    text, model = _core.diagnose(
        given, chosen, list(holdout), list(bank), budget, seed, 1 if threads == 1 else 2, progress
    )
    return Diagnosis(json.loads(text), model)
