# SPDX-License-Identifier: MIT
"""A play as a page that shows it in three dimensions: one HTML file that needs no network."""

from __future__ import annotations

import json
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._core import Model, Recording, Waypoint
from .checks import AnyRecording, RecordingWarning, instance_of, list_of, recording_of, shown, warn_of
from .evaluation import predict

TEMPLATE = Path(__file__).with_name("templates") / "view.html"
MOST_FRAMES = 40_000
"""Longer recordings are thinned out."""


def view_html(
    recording: AnyRecording,
    *,
    title: str | None = None,
    predictions: Mapping[str, NDArray[np.float64]] | None = None,
    goals: Sequence[Waypoint] = (),
    note: str = "",
) -> str:
    """The page of a recording, or of the file of that name: tips, string, spheroid, diabolo, a time slider.

    predictions: by name, positions [m] at the recording's rows, shape (N, 3), NaN where there is none. Each
        plays as a ghost, or in a scene of its own beside the others.
    goals: states that were wanted. note: a sentence below the title.

    Warns (RecordingWarning) of a recording that is odd, such as in other units.
    """
    recording = recording_of("recording", recording)
    warn_of([recording])
    goals = list_of("goals", goals, (Waypoint,))
    step = max(1, -(-len(recording) // MOST_FRAMES))
    rows = slice(None, None, step)
    if predictions is not None and not isinstance(predictions, Mapping):
        raise ValueError(f"predictions: {shown(predictions)}; expected positions by name")
    for name, positions in (predictions or {}).items():
        if np.shape(positions) != (len(recording), 3):
            raise ValueError(
                f"prediction '{name}': shape {np.shape(positions)}; expected ({len(recording)}, 3)"
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
            {"name": name, "positions": _numbers(positions[rows])}
            for name, positions in (predictions or {}).items()
        ],
        "string_length": recording.string_length,
        "size": [recording.properties.diameter, recording.properties.length],
        "goals": [
            {"position": _numbers(goal.position), "velocity": _numbers(goal.velocity)} for goal in goals
        ],
    }
    text = json.dumps(data, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    page = TEMPLATE.read_text(encoding="utf-8")
    return page.replace("/*DATA*/null", text, 1)


def predict_anew(recording: Recording, model: Model, every: float) -> NDArray[np.float64]:
    """Positions [m] that a model predicts, begun again from the recorded play each `every` seconds.

    Shape (N, 3), to be shown beside the recording. Each begins at the first row that has a fair start; rows
    without a prediction are NaN.
    """
    warn_of([recording])
    positions = np.full((len(recording), 3), np.nan)
    step = max(1, round(every * recording.rate))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RecordingWarning)  # of each piece, once more
        for first in range(0, len(recording), step):
            last = min(first + step, len(recording)) - 1
            piece = recording.cut(0, last)
            for row in range(first, last + 1):
                try:
                    states = predict(piece, model, row=row, start="fair").states
                except ValueError:  # no start here, such as in a dropout
                    continue
                positions[row : last + 1] = states[row:, :3]
                break
    return positions


def _numbers(values: NDArray[np.float64]) -> Any:
    """Nested lists, rounded to a tenth of a millimetre; None where a number is missing."""
    rounded = np.round(np.asarray(values, dtype=np.float64), 4)
    numbers = rounded.astype(object)
    numbers[np.isnan(rounded)] = None
    return numbers.tolist()
