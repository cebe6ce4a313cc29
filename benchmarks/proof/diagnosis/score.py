# SPDX-License-Identifier: MIT
"""The scores of a proof, each with the bound that it has to keep."""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from . import intervals, told
from .answer import Answer
from .judge import SURE, Verdict, judge
from .names import PHYSICS

SCHEMA = "diabolo.proof/1"
WITH_PHYSICS = ("single", "several", "with_fault")


@dataclass(frozen=True)
class Score:
    """A rate or a median, its 95 % interval, and the range that it has to lie in; None where none is set."""

    name: str
    value: float | None
    """None where no case says anything."""
    hits: int | None
    total: int
    interval: tuple[float, float] | None
    least: float | None = None
    most: float | None = None
    is_strict: bool = False
    """Whether its interval excuses nothing."""

    @property
    def keeps(self) -> bool | None:
        """Whether the value itself keeps its bounds; None where it says nothing or has none."""
        if self.value is None or (self.least is None and self.most is None):
            return None
        return self._within((self.value, self.value))

    @property
    def fails(self) -> bool:
        """Whether it is off its bounds by more than its interval allows."""
        if self.is_strict:
            return self.keeps is False
        return self.value is not None and self.interval is not None and not self._within(self.interval)

    def _within(self, span: tuple[float, float]) -> bool:
        """Whether any of a span keeps the bounds."""
        above = self.least is None or span[1] >= self.least
        return above and (self.most is None or span[0] <= self.most)


def rate(name: str, hits: Iterable[bool], least: float | None = None, most: float | None = None) -> Score:
    """A rate with its Clopper-Pearson interval."""
    marks = list(hits)
    total, count = len(marks), sum(marks)
    value = count / total if total else None
    return Score(name, value, count, total, intervals.clopper_pearson(count, total), least, most)


def median(
    name: str, values: Sequence[float], least: float | None = None, most: float | None = None
) -> Score:
    interval = intervals.median_interval(values)
    return Score(name, intervals.median(values), None, len(values), interval, least, most)


def mean(name: str, values: Sequence[float], most: float) -> Score:
    """With the interval of a normal distribution."""
    interval = intervals.mean_interval(values)
    return Score(name, statistics.fmean(values) if values else None, None, len(values), interval, None, most)


def _of(verdicts: list[Verdict], *arms: str) -> list[Verdict]:
    return [verdict for verdict in verdicts if verdict.arm in arms]


def _clear(verdicts: list[Verdict]) -> list[Verdict]:
    """Those with physics beyond its floor that stands out by ten standard deviations."""
    return [v for v in verdicts if v.owed]


def scores(verdicts: list[Verdict]) -> list[Score]:
    """All scores."""
    clear = _clear(_of(verdicts, *WITH_PHYSICS))
    true_claims = [(v, name) for v in verdicts for name in v.claimed if name in v.physics]
    measured = [i for v in verdicts if not v.outside for i in v.intervals]
    of_physics = [i for i in measured if i.name in PHYSICS]
    ties = [v for v in _clear(_of(verdicts, "tie")) if v.tie_is_real]
    pairs = [v for v in _of(verdicts, "several") if len(v.owed) >= 2]
    classes = [1.0 + len(v.tied[name]) for v in verdicts for name in v.claimed]
    ratios = [i.width_ratio for i in of_physics if i.width_ratio is not None]
    closures = [v.closure for v in verdicts if v.closure is not None and v.arm in WITH_PHYSICS]
    strong_faults = [
        (v, f) for v in verdicts if not v.outside for f in v.faults if v.fault_z.get(f, 0.0) >= SURE
    ]
    return [
        rate("false physics on nulls", (bool(v.claimed) for v in _of(verdicts, "null")), most=0.045),
        rate("false physics on faults only", (bool(v.claimed) for v in _of(verdicts, "faults")), most=0.05),
        rate("detected, SNR >= 10", (bool(v.claimed) for v in clear), least=0.95),
        rate("top name right, SNR >= 10", (v.top_is_right for v in clear), least=0.90),
        rate("truth in the answer or its tie, SNR >= 10", (_in_answer(v) for v in clear), least=0.98),
        rate("mode right", (v.mode_is_right(name) for v, name in true_claims), least=0.95),
        rate("90 % intervals that cover, physics", (i.covers for i in of_physics), 0.85, 0.95),
        median("width of intervals over the oracle's", ratios, most=2.0),
        median("gap closed after 1 s", closures, least=0.90),
        rate("ties declared, SNR >= 10", (v.declares_tie for v in ties), least=0.90),
        mean("mean size of a class", classes, most=1.5),
        rate("classes of more than three", (size > 3.0 for size in classes), most=0.0),
        rate(
            "laws outside the bank misnamed",
            (bool(v.false_physics) for v in verdicts if v.outside),
            most=0.05,
        ),
        rate("two effects both named, SNR >= 10", (_both(v) for v in pairs), least=0.80),
        rate("more physics than is there", (bool(v.false_physics) for v in _of(verdicts, *WITH_PHYSICS))),
        rate("false faults on nulls", (bool(v.false_faults) for v in _of(verdicts, "null"))),
        rate("more faults than there are", (bool(v.false_faults) for v in _of(verdicts, "faults"))),
        rate("false faults beside physics", (bool(v.false_faults) for v in _of(verdicts, *WITH_PHYSICS))),
        rate("faults named, z >= 10", (v.is_in_answer(f) for v, f in strong_faults)),
        rate("90 % intervals that cover, faults", (i.covers for i in measured if i.name not in PHYSICS)),
        rate("bad data refused", (v.headline == "INSUFFICIENT_DATA" for v in _of(verdicts, "bad"))),
        rate("answers that are errors", (v.headline == "ERROR" for v in verdicts)),
        *(_of_strangers(verdicts) if any(v.outside and v.arm != "outside" for v in verdicts) else []),
    ]


def _of_strangers(verdicts: list[Verdict]) -> list[Score]:
    """What laws get that no name stands for, where they stand out; one silence is one too many for few."""
    clear = [(v, v.met) for v in verdicts if v.met and v.is_clear_stranger]
    closures = [v.closure for v, _ in clear if v.closure is not None]
    silent = (met.verdict == told.SILENT for _, met in clear)
    is_told = [met.verdict == told.TOLD for _, met in clear]
    placed = [so and met.is_placed for so, (_, met) in zip(is_told, clear, strict=True)]
    calm = _of(verdicts, "null", "faults")
    return [
        replace(rate("strangers met with silence, SNR >= 10", silent, most=0.03), is_strict=True),
        rate("strangers told, SNR >= 10", is_told, least=0.85),
        rate("strangers told at the right place, SNR >= 10", placed, least=0.85),
        median("gap of strangers closed after 1 s", closures, least=0.60),
        rate("something unnamed on nulls and faults", (v.says_unnamed for v in calm), most=0.045),
    ]


def _in_answer(verdict: Verdict) -> bool:
    return verdict.is_in_answer(verdict.owed[0])


def _both(verdict: Verdict) -> bool:
    return all(map(verdict.is_in_answer, verdict.owed))


def judged(
    keys: list[dict[str, Any]],
    answers: dict[str, Answer],
    oracles: dict[str, Answer],
    others: dict[str, Answer] | None = None,
) -> list[Verdict]:
    """Verdicts on all cases. Raises ValueError where a case has no answer."""
    missing = [key["case"] for key in keys if key["case"] not in answers]
    if missing:
        raise ValueError(
            f"{len(missing)} cases have no answer yet, the first is {missing[0]}; run them first"
        )
    exchanged = others or {}
    return [
        judge(key, answers[key["case"]], oracles.get(key["case"]), exchanged.get(key["case"])) for key in keys
    ]


def plain(score: Score) -> dict[str, Any]:
    """As JSON."""
    return {**asdict(score), "keeps": score.keeps, "fails": score.fails}


def summary(verdicts: list[Verdict]) -> dict[str, Any]:
    """Everything that a page or a program may want, as JSON."""
    from . import breakdown

    return {
        "schema": SCHEMA,
        "cases": len(verdicts),
        "scores": [plain(score) for score in scores(verdicts)],
        "by_plant": {
            structure: [plain(score) for score in scores([v for v in verdicts if v.structure == structure])]
            for structure in sorted({v.structure for v in verdicts})
        },
        **breakdown.tables(verdicts),
    }
