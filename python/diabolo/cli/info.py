# SPDX-License-Identifier: MIT
"""`diabolo info`: what is in a recording."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._core import MotiveTake, Recording, RecordingError, load_recording
from . import files
from .arguments import add_calibration, add_command, read_calibration
from .tables import format_table

SCHEMA = "diabolo.info/1"


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "info",
        run=run,
        summary="show what is in a recording",
        text="Show what is in a recording: rigid bodies and their dropouts, duration, the diabolo's spin.",
        example="  diabolo info throw_1.csv\n  diabolo info throw_1.csv --json -",
    )
    parser.add_argument("recording", metavar="RECORDING", help="a Motive export or a tidy recording")
    add_calibration(parser)
    parser.add_argument(
        "--json",
        metavar="FILE",
        nargs="?",
        const=files.STDOUT,
        help="write the figures as JSON; to standard output, and nothing else, without FILE or with -",
    )


def run(arguments: argparse.Namespace) -> None:
    calibration = read_calibration(arguments.calibration)
    inputs = [arguments.recording] + ([arguments.calibration] if arguments.calibration else [])
    files.check_outputs([arguments.json], inputs)
    found = describe(arguments.recording, calibration)
    files.write_json(arguments.json, found)
    if arguments.json != files.STDOUT:
        print(text_of(found))


def describe(path: str, calibration: Any) -> dict[str, Any]:
    """The figures, for JSON of the schema diabolo.info/1."""
    if Path(path).exists() and not Path(path).is_file():
        raise ValueError(f"{path}: a folder, a device or a pipe; expected a file")
    take = _motive_take(path)
    recording: Recording | None = None
    problem = None
    try:
        recording = load_recording(path, calibration)
    except RecordingError as error:
        if take is None:
            raise
        problem = str(error).removeprefix(f"{path}: ")
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
    return {
        "schema": SCHEMA,
        "file": path,
        "format": "motive" if take is not None else "tidy",
        "samples": len(time),
        "rate_hz": rate,
        "duration_s": float(time[-1] - time[0]),
        "bodies": [_body(name, valid, rate) for name, valid in bodies.items()],
        "spin_rad_s": _spin(recording) if recording is not None else None,
        "not_calibrated": problem,
        "warnings": recording.warnings() if recording is not None else [],
    }


def text_of(found: dict[str, Any]) -> str:
    kind = {"motive": "Motive export", "tidy": "tidy recording"}[found["format"]]
    lines = [
        f"{found['file']}: {kind}, {found['samples']} samples at {found['rate_hz']:g} Hz, "
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
    spin = found["spin_rad_s"]
    if found["not_calibrated"]:
        lines.append(f"No tips and no spin: {found['not_calibrated']}.")
    elif spin is None:
        lines.append("The diabolo's spin is unknown: no orientations that tell it.")
    else:
        lines.append(
            f"spin: {spin['min']:.1f} to {spin['max']:.1f} rad/s, median {spin['median']:.1f} rad/s; "
            f"faster than {spin['aliases_beyond']:.0f} rad/s would alias"
        )
    lines += [f"odd: {sentence}" for sentence in found["warnings"]]
    return "\n".join(lines)


def _motive_take(path: str) -> MotiveTake | None:
    with open(path, encoding="utf-8-sig", errors="replace") as file:
        if not file.readline(80).lstrip('"').startswith("Format Version"):
            return None
    return MotiveTake.load(path)


def _body(name: str, valid: NDArray[np.bool_], rate: float) -> dict[str, Any]:
    edges = np.flatnonzero(np.diff(np.concatenate(([True], valid, [True])).astype(np.int8)))
    gaps = edges[1::2] - edges[::2]
    return {
        "name": name,
        "samples": len(valid),
        "dropouts": int(np.count_nonzero(~valid)),
        "longest_gap_s": float(gaps.max() / rate) if len(gaps) else 0.0,
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
