# SPDX-License-Identifier: MIT
"""A play as a page that shows it in three dimensions: one HTML file that needs no network."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._core import Waypoint
from .checks import AnyRecording, list_of, recording_of

TEMPLATE = Path(__file__).with_name("templates") / "view.html"
MOST_FRAMES = 40_000
"""Longer recordings are thinned out."""


def view_html(
    recording: AnyRecording,
    *,
    title: str | None = None,
    prediction: NDArray[np.float64] | None = None,
    goals: Sequence[Waypoint] = (),
    note: str = "",
) -> str:
    """The page of a recording, or of the file of that name: tips, string, spheroid, diabolo, a time slider.

    prediction: positions [m] at the recording's rows, shape (N, 3), NaN where there is none.
    goals: states that were wanted. note: a sentence below the title.
    """
    recording = recording_of("recording", recording)
    goals = list_of("goals", goals, (Waypoint,))
    step = max(1, -(-len(recording) // MOST_FRAMES))
    rows = slice(None, None, step)
    if prediction is not None and np.shape(prediction) != (len(recording), 3):
        raise ValueError(f"prediction: shape {np.shape(prediction)}; expected ({len(recording)}, 3)")
    orientation = recording.diabolo_orientation
    if orientation is None:
        orientation = np.full((len(recording), 4), np.nan)
    data: dict[str, Any] = {
        "title": title or recording.name,
        "note": note,
        "time": _numbers(recording.time[rows] - recording.time[0]),
        "left": _numbers(recording.left[rows]),
        "right": _numbers(recording.right[rows]),
        "diabolo": _numbers(recording.diabolo[rows]),
        "orientation": _numbers(orientation[rows]),
        "prediction": None if prediction is None else _numbers(prediction[rows]),
        "string_length": recording.string_length,
        "size": [recording.properties.diameter, recording.properties.length],
        "goals": [
            {"position": _numbers(goal.position), "velocity": _numbers(goal.velocity)} for goal in goals
        ],
    }
    text = json.dumps(data, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    page = TEMPLATE.read_text(encoding="utf-8")
    return page.replace("/*DATA*/null", text, 1)


def _numbers(values: NDArray[np.float64]) -> Any:
    """Nested lists, rounded to a tenth of a millimetre; None where a number is missing."""
    rounded = np.round(np.asarray(values, dtype=np.float64), 4)
    numbers = rounded.astype(object)
    numbers[np.isnan(rounded)] = None
    return numbers.tolist()
