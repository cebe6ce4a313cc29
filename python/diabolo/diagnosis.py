# SPDX-License-Identifier: MIT
"""What a simulator leaves out, found by comparing it with recordings."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Sequence
from os import PathLike
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import (
    DIAGNOSIS_SCHEMA,
    ClaimedEffect,
    ComparedLaw,
    DiagnosisResult,
    FormulaLaws,
    Model,
    Recording,
    SimulatorComparison,
    TipMotion,
)
from .checks import (
    LARGEST_SEED,
    MOST_THREADS,
    AnyRecording,
    RecordingWarning,
    callable_or_none,
    check_distinct,
    laws_of,
    list_of,
    model_of,
    names_of,
    number,
    warn_of,
    whole_number,
)

SCHEMA: str = DIAGNOSIS_SCHEMA

MOST_DRAWS = 100_000
SAME_SET_UP = 0.01
"""Part by which lengths and masses of one set-up may differ, measured anew for each take."""


class Diagnosis(NamedTuple):
    """What `diagnose` gives."""

    result: DiagnosisResult
    """Everything that its file holds, of the schema diabolo.diagnosis/1 (docs/diagnosis.md)."""
    model: Model
    """The base with the physics that was found; for recordings without the faults that were found."""
    models: tuple[Model, ...] = ()
    """Others that these recordings do not tell from it, to train or plan on: as many as `draws` asked for."""

    @property
    def headline(self) -> str:
        """NAMED, TIE, NOTHING_MISSING and the like: the first of the schema's list that holds."""
        return self.result.headline

    @property
    def sentence(self) -> str:
        """The answer."""
        return self.result.sentence

    @property
    def effects(self) -> list[ClaimedEffect]:
        """What is claimed, the surest first."""
        return self.result.effects

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return self.result.to_dict()


Simulate = Callable[[NDArray[np.float64], TipMotion, NDArray[np.float64]], ArrayLike]
"""A simulator: see `compare_simulator`."""


class Comparison(NamedTuple):
    """What `compare_simulator` gives."""

    result: SimulatorComparison
    """Everything that its file holds, of the schema diabolo.comparison/1 (docs/your_simulator.md)."""
    real: Diagnosis
    """Of the recordings; its model is what the simulator should be."""
    simulated: Diagnosis
    """Of what was simulated; its model is what the simulator is."""

    @property
    def sentence(self) -> str:
        """The answer."""
        return self.result.sentence

    @property
    def laws(self) -> list[ComparedLaw]:
        """What differs, the largest first, and then what agrees."""
        return self.result.laws

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return self.result.to_dict()


def diagnose(
    recordings: AnyRecording | Iterable[AnyRecording],
    base: Model | str = "consistent",
    *,
    holdout: AnyRecording | Iterable[AnyRecording] = (),
    bank: Iterable[str] = (),
    laws: FormulaLaws | Iterable[dict[str, Any]] | str | PathLike[str] = (),
    budget: float = 1e9,
    seed: int = 1,
    threads: int = 0,
    progress: Callable[[str, float], None] | None = None,
    draws: int = 0,
) -> Diagnosis:
    """Find what a simulator leaves out, or what a measurement got wrong.

    recordings: of one set-up, or the names of their files; they are looked at together. Of more than two
        minutes those windows are fitted that say most, from all takes and times.
    base: the simulator: a Model, "consistent", "paper" or "published".
    holdout: recordings that nothing is fitted to, to compare base and answer on; by default recordings, or
        thirds of a single one, are left out in turn. Those on which nothing can be compared are named in
        `result.fit.holdout_unused`.
    bank: names of what may be claimed, such as "string_friction"; by default everything known but placebos.
        What no measurement is without stays free in every fit.
    laws: of your own, by formulas (FormulaLaws, what makes it, or the name of its file): they are candidates
        as all others are, and `bank` may name them.
    budget: seconds after which it ends. Fewer windows are fitted where that takes longer, then trials are
        left out; `result.not_done` tells of it.
    seed: of the bootstrap intervals. threads: 0 takes all processors; the result does not depend on it.
    progress: called with the name of the step and the fraction done.
    draws: how many `models` to draw from what these recordings leave open: numbers together, by the
        covariance of the fit; of what is tied one or the other; in half of them one effect that is not
        claimed, as large as is not excluded.

        diagnose("swing.csv").sentence

    Ctrl-C ends it at once. Raises ValueError about bad input, such as samples that are given twice; a
    recording that can decide nothing is an answer, INSUFFICIENT_DATA. Warns (RecordingWarning) of recordings
    that are odd, such as with rows that are missing.
    """
    asked = _asked(recordings, base, holdout, bank, laws, budget, seed, threads, progress)
    whole_number("draws", draws, 0, MOST_DRAWS)
    result, model, models = _core.diagnose(*(*asked, draws))
    if result.headline == "INSUFFICIENT_DATA":
        return Diagnosis(result, asked[1], (asked[1],) * draws)
    return Diagnosis(result, model, tuple(models))


def compare_simulator(
    recordings: AnyRecording | Iterable[AnyRecording],
    simulated: AnyRecording | Iterable[AnyRecording] | Simulate,
    base: Model | str = "consistent",
    *,
    holdout: AnyRecording | Iterable[AnyRecording] = (),
    bank: Iterable[str] = (),
    laws: FormulaLaws | Iterable[dict[str, Any]] | str | PathLike[str] = (),
    budget: float = 1e9,
    seed: int = 1,
    threads: int = 0,
    progress: Callable[[str, float], None] | None = None,
) -> Comparison:
    """Find what a simulator of your own lacks, and what it has and should not have, law by law.

    simulated: recordings, or their files, that hold what the simulator makes of the recorded motion of the
        sticks, at any rate. Or the simulator itself, a function of `start` (position [m], velocity [m/s] and
        spin [rad/s], shape (7,)), `tips` (a TipMotion, time zero at the start) and `times` (N of them [s]):
        it returns the states, shape (N, 7), or positions alone, (N, 3). It plays stretches of 1.5 s from
        recorded starts, with the faults of the recordings taken out; `result.fit` tells its errors, and those
        of it corrected by the difference of our models.
    base: what both are compared with; the other arguments are as of `diagnose`, `budget` for each of the two.

        compare_simulator("swing.csv", "simulated.csv").sentence

    Ctrl-C ends it between and within diagnoses. Raises and warns as `diagnose`, and raises ValueError about a
    simulator that returns something else.
    """
    asked = _asked(recordings, base, holdout, bank, laws, budget, seed, threads, progress)
    simulate = simulated if callable(simulated) else None
    takes = [] if callable(simulated) else list_of("simulated", simulated)
    if simulate is None and not takes:
        raise ValueError("simulated: none; at least one recording expected, or a function")
    warn_of(takes)
    result, real, theirs = _core.compare_simulator(asked[0], takes, simulate, *asked[1:])
    return Comparison(result, Diagnosis(result.real, real), Diagnosis(result.simulated, theirs))


def _asked(
    recordings: AnyRecording | Iterable[AnyRecording],
    base: Model | str,
    holdout: AnyRecording | Iterable[AnyRecording],
    bank: Iterable[str],
    laws: FormulaLaws | Iterable[dict[str, Any]] | str | PathLike[str],
    budget: float,
    seed: int,
    threads: int,
    progress: Callable[[str, float], None] | None,
) -> tuple[Any, ...]:
    """The arguments as the core takes them, checked; warns of what is odd."""
    given = list_of("recordings", recordings, least=1)
    threads = whole_number("threads", threads, 0, MOST_THREADS)
    seed = whole_number("seed", seed, 0, LARGEST_SEED)
    callable_or_none("progress", progress)
    if not number("budget", budget) > 0.0:
        raise ValueError(f"budget: {budget} s; must be positive")
    names = names_of("bank", bank, "string_friction")
    chosen = model_of("base", base)
    own = laws_of("laws", laws)
    held = list_of("holdout", holdout)
    trimmed, overlaps = _core.trim_overlaps([*given, *held])
    for sentence in overlaps:
        warnings.warn(sentence, RecordingWarning, stacklevel=3)
    if overlaps:
        given, held = trimmed[: len(given)], trimmed[len(given) :]
    check_distinct([*given, *held], parts=True)
    warn_of([*given, *held], stacklevel=4)
    _warn_of_other_set_ups([*given, *held])
    return given, chosen, held, names, own, budget, seed, threads, progress


def _warn_of_other_set_ups(recordings: Sequence[Recording]) -> None:
    """Warn where recordings that are looked at together say that they are not of one set-up."""
    quantities: dict[str, Callable[[Recording], float]] = {
        "string length [m]": lambda take: take.string_length,
        "mass [kg]": lambda take: take.properties.mass,
        "axle radius [m]": lambda take: take.properties.axle_radius,
    }
    for name, of in quantities.items():
        least, most = min(recordings, key=of), max(recordings, key=of)
        if of(most) > of(least) * (1.0 + SAME_SET_UP):
            warnings.warn(
                f"'{least.name}' and '{most.name}' differ in {name}, {of(least):g} and {of(most):g}; "
                "what is found is one value for all",
                RecordingWarning,
                stacklevel=4,
            )
