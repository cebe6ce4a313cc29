# SPDX-License-Identifier: MIT
"""`diabolo convert`: a recording of one kind as another."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np

from .. import files
from ..checks import warn_of
from ..formats import WITH_JSON, WRITTEN, save_recording
from .arguments import add_calibration, add_command, output_name, reading_of


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "convert",
        run=run,
        summary="write a recording as another kind of file: tidy CSV, a bag of ROS 2, Parquet, rerun",
        text="Read a recording of any kind (docs/recordings.md) and write the stick tips and the diabolo in\n"
        "the world frame (x forward, y left, z up; s, m, unit quaternions), as the suffix of OUT says:\n\n"
        "  .csv      tidy: empty cells are dropouts; beside it OUT.json with mass and sizes of the\n"
        "            diabolo, string length and rate\n"
        "  .mcap     poses of ROS 2 on /left_tip, /right_tip and /diabolo; string, diabolo in the metadata\n"
        "  .parquet  the tidy table, and OUT.json beside it\n"
        "  .rrd      the play in three dimensions, height and spin, to look at in rerun",
        example="  diabolo convert throw_1.csv tidy/throw_1.csv\n"
        "  diabolo convert bag/ take.csv --topics left=/stick_l/pose,right=/stick_r/pose,diabolo=/d/pose\n"
        "  diabolo convert take.csv take.mcap",
    )
    parser.add_argument("recording", metavar="RECORDING", help="what to read")
    parser.add_argument("out", metavar="OUT", type=output_name, help="what to write")
    add_calibration(parser)
    parser.add_argument(
        "--json", metavar="FILE", help="write what was converted as JSON; - is standard output"
    )


def run(arguments: argparse.Namespace) -> None:
    target = Path(arguments.out)
    if target.suffix not in WRITTEN:
        raise ValueError(f"{target}: expected a name that ends in {', '.join(WRITTEN)}")
    inputs = [arguments.recording] + ([arguments.calibration] if arguments.calibration else [])
    beside = target.with_suffix(".json") if target.suffix in WITH_JSON else None
    files.check_outputs([target, beside, arguments.json], inputs)
    recording = reading_of(arguments).load(arguments.recording)
    warn_of([recording])
    save_recording(recording, target)
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
