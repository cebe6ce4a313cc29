# SPDX-License-Identifier: MIT
"""How far models are off on recordings."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Literal, NamedTuple, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._core import HorizonScore, Model, Recording
from .checks import (
    LARGEST_SEED,
    MOST_THREADS,
    AnyRecording,
    callable_or_none,
    check_distinct,
    excerpt_of,
    instance_of,
    is_several,
    list_of,
    model_of,
    number,
    one_of,
    recording_of,
    shown,
    warn_of,
    whole_number,
)
from .excerpt import Excerpt
from .rollout import Rollout, axle_parts

DEFAULT_MODELS = ("published", "paper", "consistent")
DEFAULT_HORIZONS = (0.1, 0.25, 0.5, 1.0, 2.0)
SCHEMA = "diabolo.evaluation/1"

Start: TypeAlias = Literal["fair", "published"]
STARTS: tuple[str, ...] = get_args(Start)

ALL_RECORDINGS = "all recordings"
"""The name under which HorizonRow gives the errors over several recordings together."""

RESERVED_NAMES = ("baseline", "program", "printed")
"""What else stands beside the models in a table."""


class TableRow(NamedTuple):
    """One model on one excerpt, by the recipe of the paper's table; errors are mean distances [m]."""

    recording: str
    frames: tuple[int, int]
    """Rows of the recording, both included."""
    model: str
    error: float | None
    """None where the prediction diverged."""
    baseline_error: float
    """Of the lowest-point baseline over the same rows: what a model has to beat."""
    paper_error: float | None
    """As the paper prints it; None where its table has no such excerpt."""
    program_error: float | None
    """Of the authors' program, run again."""
    score: _core.ExcerptScore
    """The same, and how many rows were compared."""


class HorizonRow(NamedTuple):
    """One model at one horizon, over many starts."""

    recording: str
    model: str
    score: HorizonScore


class Evaluation(NamedTuple):
    """What `evaluate` gives."""

    rows: list[TableRow]
    horizons: list[HorizonRow]

    def to_dict(self) -> dict[str, Any]:
        """For JSON, of the schema diabolo.evaluation/1: errors in metres, horizons in seconds."""
        return {
            "schema": SCHEMA,
            "rows": [_table_entry(row) for row in self.rows],
            "horizons": [_horizon_entry(row) for row in self.horizons],
        }


def evaluate(
    recordings: AnyRecording | Iterable[AnyRecording],
    models: Model | str | Iterable[Model | str] = DEFAULT_MODELS,
    *,
    starts_every: float | None = None,
    horizons: Sequence[float] = DEFAULT_HORIZONS,
    start: Start = "fair",
    seed: int = 1,
    threads: int = 0,
    progress: Callable[[float], None] | None = None,
) -> Evaluation:
    """Compare predictions with recordings.

    recordings: Recording, Excerpt of one, or the name of a recording's file; each is given once.
    models: Model, or "published", "paper", "consistent".
    starts_every: by default one prediction from the first row of each recording (and of the excerpt of it
        that the paper's table has), by the paper's recipe. Given [s], predictions from a start each so often,
        compared at `horizons` [s], for each recording and, where there are several, for all together.
    start: how the state at such a start is found: "fair", from the rows up to it, the same for every model
        (where string or sticks give a little it is brought to rest on them, if noise may have it off them);
        or "published", by the rules of the authors' program, which look one row ahead.
    seed: of the bootstrap intervals. threads: 0 takes all cores; the result does not depend on it.
    progress: called with the fraction done.

    Warns (RecordingWarning) of recordings that are odd, such as in other units.

        evaluate("throw_1.csv").rows[0].error  # [m]
    """
    given = [_checked(take) for take in list_of("recordings", recordings, (Recording, Excerpt), least=1)]
    one_of("start", start, STARTS)
    chosen = [model_of("models", model) for model in (models if is_several(models) else [models])]
    if not chosen:
        raise ValueError("models: none; at least one expected")
    for index, model in enumerate(chosen):
        if any(other.name == model.name for other in chosen[:index]):
            raise ValueError(f"models: two are named '{model.name}'; their results could not be told apart")
        if model.name in RESERVED_NAMES:
            raise ValueError(f"models: one is named '{model.name}'; so is what the models are compared with")
    threads = whole_number("threads", threads, 0, MOST_THREADS)
    seed = whole_number("seed", seed, 0, LARGEST_SEED)
    callable_or_none("progress", progress)
    report = progress or (lambda fraction: None)
    takes = [take if isinstance(take, Recording) else take.part() for take in given]
    check_distinct(takes, parts=False)
    warn_of([_under_its_name(take) for take in given])
    if starts_every is None:
        return Evaluation(_table(given, chosen, report), [])

    if not is_several(horizons):
        raise ValueError(f"horizons: {shown(horizons)}; expected times in seconds")
    at = [number("horizons", time) for time in horizons]
    groups = [(label, [take]) for label, take in zip(_labels(given), takes, strict=True)]
    if len(groups) > 1:
        groups.append((ALL_RECORDINGS, takes))
    rows: list[HorizonRow] = []
    jobs = [(model, name, group) for model in chosen for name, group in groups]
    for index, (model, name, group) in enumerate(jobs):

        def report_part(fraction: float, done: int = index) -> None:
            report((done + fraction) / len(jobs))

        scores = _core.score_horizons(group, model, starts_every, at, start, seed, threads, report_part)
        rows += [HorizonRow(name, model.name, score) for score in scores]
    report(1.0)
    return Evaluation([], rows)


def predict(
    recording: AnyRecording,
    model: Model | str = "consistent",
    *,
    row: int | None = None,
    start: Start = "published",
) -> Rollout:
    """Predict the diabolo at each row of a recording from its state at one row and the recorded tips.

    row: where to start; by default the first one from which the authors' program could.
    start: as for `evaluate`; the first row shows where it begins. Rows before the start are NaN; `time` is
        that of the recording. `forces` are those of the string on the tips; axis, tumble and turns are there,
        too.

    Warns (RecordingWarning) of a recording that is odd, such as in other units.
    """
    recording = recording_of("recording", recording)
    if row is not None:
        row = whole_number("row", row, 0, len(recording) - 1)
    warn_of([recording])
    chosen = model_of("model", model)
    rule = one_of("start", start, STARTS)
    states, string_states, forces, axles = _core.predict(recording, chosen, row, rule)
    return Rollout(np.asarray(recording.time), states, string_states, forces, *axle_parts(axles))


def position_errors(recording: AnyRecording, predicted: Rollout) -> NDArray[np.float64]:
    """Distance from the recorded to the predicted diabolo [m], shape (N,); NaN where one is missing."""
    recording = recording_of("recording", recording)
    if len(instance_of("predicted", predicted, Rollout).states) != len(recording):
        raise ValueError(
            f"predicted: {len(predicted.states)} rows; expected {len(recording)}, the recording's"
        )
    distance: NDArray[np.float64] = np.linalg.norm(predicted.states[:, :3] - recording.diabolo, axis=1)
    return distance


def _checked(take: Recording | Excerpt) -> Recording | Excerpt:
    """An excerpt of rows that are there; of all rows, its recording."""
    if isinstance(take, Recording):
        return take
    excerpt = excerpt_of("recordings", take)
    return excerpt.recording if excerpt.is_whole else excerpt


def _under_its_name(take: Recording | Excerpt) -> Recording:
    """The rows under the name of the whole, by which the paper's table knows it, and of which one is warned
    once."""
    return take if isinstance(take, Recording) else take.recording.cut(take.first, take.last)


def _labels(given: list[Recording | Excerpt]) -> list[str]:
    """Names, with the rows where they are not all; equal ones are numbered."""
    labels = [ALL_RECORDINGS]  # taken
    for take in given:
        names = itertools.chain([take.name], (f"{take.name} ({number})" for number in itertools.count(2)))
        labels.append(next(name for name in names if name not in labels))
    return labels[1:]


def _table(
    given: list[Recording | Excerpt], models: list[Model], report: Callable[[float], None]
) -> list[TableRow]:
    rows: list[TableRow] = []
    for index, take in enumerate(given):
        per_model = [_scores(take, model) for model in models]
        first = take.first if isinstance(take, Excerpt) else 0
        rows += [_table_row(score, first) for scores in zip(*per_model, strict=True) for score in scores]
        report((index + 1) / len(given))
    return rows


def _scores(take: Recording | Excerpt, model: Model) -> list[_core.ExcerptScore]:
    if isinstance(take, Excerpt):
        return [_core.score_excerpt(_under_its_name(take), model)]
    return _core.score_excerpts(take, model)


def _table_row(score: _core.ExcerptScore, first: int) -> TableRow:
    of_paper = first == 0  # all excerpts of the paper's table begin there
    return TableRow(
        score.recording,
        (first, first + score.rows - 1),
        score.model,
        score.error,
        score.baseline_error,
        score.paper_error if of_paper else None,
        score.program_error if of_paper else None,
        score,
    )


def _table_entry(row: TableRow) -> dict[str, Any]:
    return {
        "recording": row.recording,
        "frames": list(row.frames),
        "model": row.model,
        "mean_error_m": row.error,
        "baseline_m": row.baseline_error,
        "paper_m": row.paper_error,
        "program_m": row.program_error,
        "start_row": row.frames[0] + row.score.start_row,
        "rows_scored": row.score.scored,
        "rows_skipped": row.score.skipped,
        "duration_s": row.score.duration,
        "diverged_s": row.score.diverged,
    }


def _horizon_entry(row: HorizonRow) -> dict[str, Any]:
    score = row.score
    return {
        "recording": row.recording,
        "model": row.model,
        "horizon_s": score.horizon,
        "windows": score.windows,
        **_summary(score.model),
        "failed": score.failed,
        "missed_catches": score.missed_catches,
        "baseline": _summary(score.baseline),
        "advantage_m": score.advantage,
        "advantage_ci95_m": _interval(score.advantage_ci95),
    }


def _summary(summary: _core.ErrorSummary | None) -> dict[str, Any]:
    return {
        "mean_m": summary.mean if summary else None,
        "median_m": summary.median if summary else None,
        "p90_m": summary.percentile_90 if summary else None,
        "ci95_m": _interval(summary.mean_ci95) if summary else None,
    }


def _interval(interval: _core.Interval | None) -> list[float] | None:
    return [interval.low, interval.high] if interval else None
