# SPDX-License-Identifier: MIT
"""A play as a page that shows it in three dimensions: one HTML file that needs no network."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._core import Model, Recording, Waypoint
from .checks import AnyRecording, RecordingWarning, instance_of, list_of, recording_of, shown, warn_of
from .evaluation import predict
from .rollout import Rollout

TEMPLATE = Path(__file__).with_name("templates") / "view.html"
MOST_ROWS_SHOWN = 40_000
"""Longer recordings are thinned out."""
PREDICTED_ANEW = 1.0
"""Between the starts of a replay's predictions [s]."""
LONGEST_REPLAY = 20.0
"""Of a longer recording its worst stretch is replayed [s]."""


class Replay(NamedTuple):
    """A recording, and beside it what base and answer predict, begun again each second from recorded play."""

    recording: Recording
    predictions: dict[str, NDArray[np.float64]]
    """By name, as for `view_html`."""

    def errors(self, name: str) -> NDArray[np.float64]:
        """Distances from the recorded diabolo [m], shape (N,)."""
        distances: NDArray[np.float64] = np.linalg.norm(
            self.predictions[name][:, :3] - self.recording.diabolo, axis=1
        )
        return distances

    def worst(self) -> tuple[int, int]:
        """First and last row of the stretch in which the base is farthest off."""
        rows = min(len(self.recording), round(LONGEST_REPLAY * self.recording.rate))
        sums = np.concatenate([[0.0], np.cumsum(np.nan_to_num(self.errors("base")))])
        first = int(np.argmax(sums[rows:] - sums[: len(sums) - rows]))
        return first, first + rows - 1


def view_html(
    recording: AnyRecording,
    *,
    title: str | None = None,
    predictions: Mapping[str, NDArray[np.float64]] | None = None,
    goals: Sequence[Waypoint] = (),
    note: str = "",
) -> str:
    """The page of a recording, or of the file of that name: tips, string, spheroid, diabolo, a time slider.

    predictions: by name, positions [m] at the recording's rows, shape (N, 3), NaN where there is none; or
        positions and the axle's direction beside them, shape (N, 6), else it is as recorded. Each plays as a
        ghost, or in a scene of its own beside the others.
    goals: states that were wanted. note: a sentence below the title.

    Warns (RecordingWarning) of a recording that is odd, such as in other units.
    """
    recording = recording_of("recording", recording)
    if len(recording) == 0:
        raise ValueError(f"recording: {recording.name} has no rows; expected at least one")
    warn_of([recording])
    goals = list_of("goals", goals, (Waypoint,))
    step = max(1, -(-len(recording) // MOST_ROWS_SHOWN))
    rows = slice(None, None, step)
    if predictions is not None and not isinstance(predictions, Mapping):
        raise ValueError(f"predictions: {shown(predictions)}; expected positions by name")
    for name, positions in (predictions or {}).items():
        if np.shape(positions) not in ((len(recording), 3), (len(recording), 6)):
            raise ValueError(
                f"prediction '{name}': shape {np.shape(positions)}; expected ({len(recording)}, 3), or "
                f"({len(recording)}, 6)"
            )
    orientation = recording.diabolo_orientation
    if orientation is None:
        orientation = np.full((len(recording), 4), np.nan)
    data: dict[str, Any] = {
        "title": instance_of("title", recording.name if title is None else title, str),
        "note": instance_of("note", note, str),
        "time": _numbers(recording.time[rows] - recording.time[0]),
        "left": _numbers(recording.left[rows]),
        "right": _numbers(recording.right[rows]),
        "diabolo": _numbers(recording.diabolo[rows]),
        "orientation": _numbers(orientation[rows]),
        "predictions": [
            {
                "name": name,
                "positions": _numbers(positions[rows, :3]),
                "axes": _numbers(positions[rows, 3:]) if np.shape(positions)[1] == 6 else [],
            }
            for name, positions in (predictions or {}).items()
        ],
        "string_length": recording.string_length,
        "size": [recording.properties.diameter, recording.properties.length],
        "goals": [
            {"position": _numbers(goal.position), "velocity": _numbers(goal.velocity)} for goal in goals
        ],
    }
    return page_of(data)


def page_of(data: Mapping[str, Any]) -> str:
    """The page that shows these data."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    page = TEMPLATE.read_text(encoding="utf-8")
    return page.replace("/*DATA*/null", text, 1)


@contextmanager
def told_before() -> Iterator[None]:
    """What is odd about recordings is not said: it was before, or their simulator knows better."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RecordingWarning)
        yield


@told_before()
def replay_of(recording: Recording, base: Model, corrected: Model) -> Replay:
    """Base and answer beside a recording."""
    models = {"base": base, "corrected": corrected}
    return Replay(
        recording, {name: predict_anew(recording, model, PREDICTED_ANEW) for name, model in models.items()}
    )


@told_before()
def replay_html(replay: Replay) -> str:
    """The page of a replay; of a long one that of its worst stretch."""
    take, (first, last) = replay.recording, replay.worst()
    begin, end = take.time[[first, last]] - take.time[0]
    stretch = "" if last - first + 1 == len(take) else f", from {begin:.1f} to {end:.1f} s"
    return view_html(
        take.cut(first, last),
        title=f"{take.name}{stretch}",
        predictions={name: positions[first : last + 1] for name, positions in replay.predictions.items()},
        note=f"begun again each {PREDICTED_ANEW:g} s from the recorded play",
    )


def predict_anew(recording: Recording, model: Model, every: float) -> NDArray[np.float64]:
    """Positions [m] and axles that a model predicts, begun again from the recorded play each `every` seconds.

    Shape (N, 6), to be shown beside the recording. Each begins at the first row that has a fair start; rows
    without a prediction are NaN.
    """
    warn_of([recording])
    places = np.full((len(recording), 6), np.nan)
    step = max(1, round(every * recording.rate))
    with told_before():
        for first in range(0, len(recording), step):
            last = min(first + step, len(recording)) - 1
            piece = recording.cut(0, last)
            for row in range(first, last + 1):
                try:
                    predicted = predict(piece, model, row=row, start="fair")
                except ValueError:  # no start here, such as in a dropout
                    continue
                places[row : last + 1] = places_of(predicted)[row:]
                break
    return places


def places_of(predicted: Rollout) -> NDArray[np.float64]:
    """Positions [m] and axles of what `predict` gives, shape (N, 6), NaN where there is none."""
    assert predicted.axis is not None
    return np.concatenate([predicted.states[:, :3], predicted.axis], axis=1)


def _numbers(values: NDArray[np.float64]) -> Any:
    """Nested lists, rounded to a tenth of a millimetre; None where a number is missing."""
    rounded = np.round(np.asarray(values, dtype=np.float64), 4)
    numbers = rounded.astype(object)
    numbers[np.isnan(rounded)] = None
    return numbers.tolist()
