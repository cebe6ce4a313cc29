# SPDX-License-Identifier: MIT
"""`diabolo info`: what is in a recording."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import files
from .._core import Recording, RecordingError, TrackedTake
from ..excerpt import Excerpt
from ..formats import reader_of
from .arguments import RECORDING_HELP, Reading, add_calibration, add_command, reading_of, split_excerpt
from .tables import format_table

SCHEMA = "diabolo.info/1"
KINDS = {
    "motive": "Motive export",
    "tidy": "tidy recording",
    "csv": "CSV of mapped columns",
    "parquet": "Parquet table",
    "bag": "bag of ROS",
    "c3d": "C3D",
    "qualisys": "Qualisys export",
    "vicon": "Vicon export",
}
MOST_DROPOUTS = 0.5  # of a body's samples
LONGEST_GAP = 1.0  # [s]


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "info",
        run=run,
        summary="show what is in a recording",
        text="Show what is in a recording: rigid bodies and their dropouts, duration, the diabolo's spin,\n"
        "what was changed in reading it, and what is odd about it.",
        example="  diabolo info throw_1.csv\n  diabolo info throw_1.csv --json -\n"
        "  diabolo info own.csv --columns time=t[ms],left_x=lx[mm],...",
    )
    parser.add_argument("recording", metavar="RECORDING", help=RECORDING_HELP)
    add_calibration(parser)
    parser.add_argument(
        "--json",
        metavar="FILE",
        nargs="?",
        const=files.STDOUT,
        help="write the figures as JSON; to standard output, and nothing else, without FILE or with -",
    )


def run(arguments: argparse.Namespace) -> None:
    reading = reading_of(arguments)
    inputs = [split_excerpt(arguments.recording)[0]] + (
        [arguments.calibration] if arguments.calibration else []
    )
    files.check_outputs([arguments.json], inputs)
    found = describe(arguments.recording, reading)
    files.write_json(arguments.json, found)
    if arguments.json != files.STDOUT:
        print(text_of(found))


def describe(text: str, reading: Reading) -> dict[str, Any]:
    """The figures of a file, or of some rows of it, for JSON of the schema diabolo.info/1."""
    path, rows = split_excerpt(text)
    if Path(path).exists() and not Path(path).is_file() and not Path(path).is_dir():
        raise ValueError(f"{path}: a device or a pipe; expected a file")
    reader = reader_of(Path(path))
    take = None if reader else _motive_take(path)
    recording: Recording | None = None
    problem = refused = None
    try:
        recording = reading.load(path)
    except RecordingError as error:
        refused = str(error).removeprefix(f"{path}: ")
        if "points up" in refused:  # the frame alone is wrong, and the rest can be told
            recording = replace(reading, up="z").load(path)
        elif take is None:
            raise
        else:
            problem = refused
    if take is not None:
        time, rate = take.time, take.rate
        bodies = {body.name: ~np.isnan(body.position[:, 0]) for body in take.bodies}
    else:
        assert recording is not None
        time, rate = recording.time, recording.rate
        bodies = {
            "left": recording.left_valid,
            "right": recording.right_valid,
            "diabolo": recording.diabolo_valid,
        }
    first, last = rows or (0, len(time) - 1)
    if not first <= last < len(time):
        raise ValueError(f"{text}: rows {first} to {last}; expected rows from 0 to {len(time) - 1}")
    time = time[first : last + 1]
    if recording is not None:
        recording = Excerpt(recording, first, last).part()
    seen = [_body(name, valid[first : last + 1], time, rate) for name, valid in bodies.items()]
    return {
        "schema": SCHEMA,
        "file": path,
        "rows": [first, last],
        "format": reader or ("motive" if take is not None else "csv" if reading.columns else "tidy"),
        "samples": len(time),
        "rate_hz": rate,
        "duration_s": float(time[-1] - time[0]),
        "bodies": seen,
        "spin_rad_s": _spin(recording) if recording is not None else None,
        "not_calibrated": problem,
        "string_length_m": recording.string_length if recording is not None else None,
        "mass_kg": recording.properties.mass if recording is not None else None,
        "warnings": _unseen(seen) + (_warnings(recording, refused) if recording is not None else []),
    }


def text_of(found: dict[str, Any]) -> str:
    kind = KINDS[found["format"]]
    lines = [
        f"{found['file']}: {kind}, {_rows(found['rows'])} at {found['rate_hz']:g} Hz, "
        f"{found['duration_s']:.2f} s",
        "",
        format_table(
            ["body", "dropouts", "", "longest gap [s]"],
            [
                [
                    b["name"],
                    str(b["dropouts"]),
                    f"{100.0 * b['dropouts'] / b['samples']:.1f} %",
                    f"{b['longest_gap_s']:.3f}",
                ]
                for b in found["bodies"]
            ],
        ),
        "",
    ]
    if found["string_length_m"] is not None:
        lines.append(f"string {found['string_length_m']:g} m, diabolo {1e3 * found['mass_kg']:g} g")
    spin = found["spin_rad_s"]
    if found["not_calibrated"]:
        lines.append(f"No tips and no spin: {found['not_calibrated']}.")
    elif spin is None:
        lines.append(
            "The diabolo's spin is unknown: no orientations that tell it. "
            "A diagnosis finds friction without it, but tests no law of the spin."
        )
    else:
        lines.append(
            f"spin: {spin['min']:.1f} to {spin['max']:.1f} rad/s, median {spin['median']:.1f} rad/s; "
            f"faster than {spin['aliases_beyond']:.0f} rad/s would alias"
        )
    lines += [f"odd: {sentence}" for sentence in found["warnings"]]
    if not found["warnings"] and not found["not_calibrated"]:
        lines.append("nothing odd")
    return "\n".join(lines)


def _rows(rows: list[int]) -> str:
    first, last = rows
    return f"{last - first + 1} samples" + (f" from row {first} on" if first > 0 else "")


def _warnings(recording: Recording, refused: str | None) -> list[str]:
    if refused is None:
        return recording.warnings()
    return [refused, *(sentence for sentence in recording.warnings() if "points up" not in sentence)]


def _unseen(bodies: list[dict[str, Any]]) -> list[str]:
    """A sentence for each body that is mostly, or for long, not seen."""
    return [
        f"{b['name']}: not seen in {100.0 * b['dropouts'] / b['samples']:.1f} % of the samples, "
        f"for up to {b['longest_gap_s']:.3f} s at a time"
        for b in bodies
        if b["dropouts"] > MOST_DROPOUTS * b["samples"]
        or (b["dropouts"] and b["longest_gap_s"] > LONGEST_GAP)
    ]


def _motive_take(path: str) -> TrackedTake | None:
    with open(path, encoding="utf-8-sig", errors="replace") as file:
        if not file.readline(80).lstrip('"').startswith("Format Version"):
            return None
    return TrackedTake.load(path)


def _body(name: str, valid: NDArray[np.bool_], time: NDArray[np.float64], rate: float) -> dict[str, Any]:
    """Its gaps are of time, in whole periods: dropouts, and rows that are missing."""
    period = 1.0 / rate
    seen = np.concatenate(([time[0] - period], time[valid], [time[-1] + period]))
    return {
        "name": name,
        "samples": len(valid),
        "dropouts": int(np.count_nonzero(~valid)),
        "longest_gap_s": float(np.rint(np.diff(seen) * rate).max() - 1.0) / rate,
    }


def _spin(recording: Recording) -> dict[str, float] | None:
    spin = recording.spin()
    known = spin[~np.isnan(spin)]
    if len(known) == 0:
        return None
    return {
        "min": float(known.min()),
        "median": float(np.median(known)),
        "max": float(known.max()),
        "aliases_beyond": math.pi * recording.rate,
    }
