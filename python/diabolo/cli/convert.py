# SPDX-License-Identifier: MIT
"""`diabolo convert`: a Motive export as a tidy recording."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np

from ..checks import warn_of
from . import files
from .arguments import add_calibration, add_command, output_name, reading_of


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "convert",
        run=run,
        summary="write a Motive export as a tidy recording",
        text="Write a Motive export as a tidy recording: TIDY.csv with the stick tips and the diabolo in\n"
        "the world frame (x forward, y left, z up; s, m, unit quaternions; empty cells are dropouts), and\n"
        "beside it TIDY.json with mass and sizes of the diabolo, string length and rate.",
        example="  diabolo convert throw_1.csv tidy/throw_1.csv",
    )
    parser.add_argument(
        "motive", metavar="MOTIVE.csv", help="what to read: a Motive export (or a tidy recording)"
    )
    parser.add_argument("tidy", metavar="TIDY.csv", type=output_name, help="what to write")
    add_calibration(parser)
    parser.add_argument(
        "--json", metavar="FILE", help="write what was converted as JSON; - is standard output"
    )


def run(arguments: argparse.Namespace) -> None:
    target = Path(arguments.tidy)
    if target.suffix != ".csv":
        raise ValueError(f"{target}: expected a name that ends in .csv")
    inputs = [arguments.motive] + ([arguments.calibration] if arguments.calibration else [])
    files.check_outputs([target, target.with_suffix(".json"), arguments.json], inputs)
    recording = reading_of(arguments).load(arguments.motive)
    warn_of([recording])
    recording.save(target)
    dropouts = int(np.count_nonzero(~recording.diabolo_valid))
    files.write_json(
        arguments.json,
        {
            "schema": "diabolo.convert/1",
            "file": str(target),
            "samples": len(recording),
            "rate_hz": recording.rate,
            "diabolo_dropouts": dropouts,
        },
    )
    if arguments.json != files.STDOUT:
        print(
            f"{target}: {len(recording)} samples at {recording.rate:g} Hz, the diabolo missing in {dropouts}"
        )
