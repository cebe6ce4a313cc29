# SPDX-License-Identifier: MIT
"""Faults of measurement that the plant's cameras do not have, done to a tidy recording."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

BODIES = ("left", "right", "diabolo")
Array = NDArray[np.float64]


@dataclass
class Tidy:
    """A tidy recording: columns by name, NaN where a body was not seen, and its description."""

    columns: dict[str, Array]
    description: dict[str, Any]

    @staticmethod
    def read(path: Path) -> Tidy:
        header, *lines = path.read_text(encoding="utf-8").splitlines()
        cells = np.array([[float(cell or "nan") for cell in line.split(",")] for line in lines])
        columns = {name: cells[:, i].copy() for i, name in enumerate(header.split(","))}
        return Tidy(columns, json.loads(path.with_suffix(".json").read_text(encoding="utf-8")))

    def write(self, path: Path) -> None:
        rows = zip(*self.columns.values(), strict=True)
        lines = [",".join("" if np.isnan(cell) else f"{cell:.6f}" for cell in row) for row in rows]
        path.write_text("\n".join([",".join(self.columns), *lines]) + "\n", encoding="utf-8")
        text = json.dumps(self.description, indent=2) + "\n"
        path.with_suffix(".json").write_text(text, encoding="utf-8")

    def of(self, body: str) -> list[str]:
        return [name for name in self.columns if name.startswith(body + "_")]

    def cut(self, rows: int) -> None:
        self.columns = {name: values[:rows] for name, values in self.columns.items()}


def apply(steps: list[dict[str, Any]], recording: Tidy) -> None:
    """Does all steps in their order."""
    for step in steps:
        _STEPS[step["step"]](step, recording)


def _frame_rate(step: dict[str, Any], recording: Tidy) -> None:
    """The file tells a rate that the camera did not have: recorded over true rate is the factor."""
    recording.columns["time"] = recording.columns["time"] / step["factor"]
    recording.description["rate"] *= step["factor"]


def _filled(values: Array) -> Array:
    known = ~np.isnan(values)
    rows = np.arange(len(values))
    return np.interp(rows, rows[known], values[known]) if known.any() else values


def low_passed(values: Array, interval: float, tau: float) -> Array:
    """What a first-order low pass makes of a line through the values; exact for that line."""
    result = values.copy()
    decay = np.exp(-interval / tau)
    for i in range(1, len(values)):
        slope = (values[i] - values[i - 1]) / interval
        behind = result[i - 1] - values[i - 1] + tau * slope
        result[i] = values[i] - tau * slope + behind * decay
    return result


def slopes(values: Array, interval: float, reach: int = 4) -> Array:
    """Rates of change, by cubics through each value and its neighbours."""
    offsets = np.arange(-reach, reach + 1)
    padded = np.concatenate(
        [2.0 * values[0] - values[reach:0:-1], values, 2.0 * values[-1] - values[-2 : -reach - 2 : -1]]
    )
    weights = np.linalg.pinv(np.vander(offsets, 4, increasing=True))[1] / interval
    return np.convolve(padded, weights[::-1], mode="valid")


def _filter_lag(step: dict[str, Any], recording: Tidy) -> None:
    """The diabolo's track comes through a first-order low pass."""
    for name in (f"diabolo_{axis}" for axis in "xyz"):
        values = recording.columns[name]
        lagging = low_passed(_filled(values), 1.0 / recording.description["rate"], step["seconds"])
        recording.columns[name] = np.where(np.isnan(values), np.nan, lagging)


def _robot_servo_lag(step: dict[str, Any], recording: Tidy) -> None:
    """Commands in place of the sticks, which follow them with a lag of first order."""
    for name in (f"{side}_{axis}" for side in ("left", "right") for axis in "xyz"):
        values = recording.columns[name]
        leading = step["seconds"] * slopes(_filled(values), 1.0 / recording.description["rate"])
        recording.columns[name] = values + leading


def _body_swap(step: dict[str, Any], recording: Tidy) -> None:
    """Two bodies change names over bursts, given as shares of the recording."""
    one, other = (recording.of(body) for body in step["bodies"])
    rows = len(recording.columns["time"])
    for begin, end in step["bursts"]:
        span = slice(int(begin * rows), int(end * rows))
        for a in one:
            b = step["bodies"][1] + a[len(step["bodies"][0]) :]
            if b in other:
                first, second = recording.columns[a], recording.columns[b]
                first[span], second[span] = second[span].copy(), first[span].copy()


def _cut(step: dict[str, Any], recording: Tidy) -> None:
    recording.cut(int(step["seconds"] * recording.description["rate"]))


def _blank(step: dict[str, Any], recording: Tidy) -> None:
    """The diabolo is lost for good."""
    first = int(step["after"] * recording.description["rate"])
    for name in recording.of("diabolo"):
        recording.columns[name][first:] = np.nan


_STEPS = {
    "frame_rate": _frame_rate,
    "filter_lag": _filter_lag,
    "robot_servo_lag": _robot_servo_lag,
    "body_swap": _body_swap,
    "cut": _cut,
    "blank": _blank,
}
