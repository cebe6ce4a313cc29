# SPDX-License-Identifier: MIT
"""`diabolo motion`: what a simulator of your own needs to play a recording."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np

from .. import files
from .._core import recorded_plan, stretch_starts
from ..checks import warn_of
from .arguments import (
    RECORDING_HELP,
    TIPS,
    add_calibration,
    add_command,
    output_name,
    read_excerpt,
    reading_of,
    split_excerpt,
)

MOST_ROWS = 10_000_000


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "motion",
        run=run,
        summary="write the stick motion and the starts of a recording, for a simulator of your own",
        text="Write what a simulator needs to play a recording: MOTION.csv with the time and the tips,\n"
        "smoothed and at a rate of your choice, and beside it MOTION.json with the string's length, the\n"
        "diabolo, and starts (position, velocity, spin) every 1.65 s. Let the simulator play it and add the\n"
        "columns diabolo_x, diabolo_y, diabolo_z (m). Then ask\n"
        "`diabolo diagnose TAKE.csv --simulated SIM.csv` (docs/your_simulator.md).",
        example="  diabolo motion swing.csv motion.csv --rate 1000",
    )
    parser.add_argument("recording", metavar="RECORDING", help=RECORDING_HELP)
    parser.add_argument("motion", metavar="MOTION.csv", type=output_name, help="what to write")
    parser.add_argument(
        "--rate", metavar="HZ", type=float, default=1000.0, help="rows per second; default: 1000"
    )
    add_calibration(parser)


def run(arguments: argparse.Namespace) -> None:
    target = Path(arguments.motion)
    if target.suffix != ".csv":
        raise ValueError(f"{target}: expected a name that ends in .csv")
    inputs = [split_excerpt(arguments.recording)[0]]
    inputs += [arguments.calibration] if arguments.calibration else []
    files.check_outputs([target, target.with_suffix(".json")], inputs)
    excerpt = read_excerpt(arguments.recording, reading_of(arguments), TIPS)
    take = excerpt.part()
    warn_of([take])
    tips = recorded_plan(take)
    rows = (tips.end - tips.begin) * arguments.rate
    if not 2.0 <= rows <= MOST_ROWS:
        raise ValueError(
            f"--rate: {arguments.rate:g} Hz would make {rows:.3g} rows; expected 2 to {MOST_ROWS}"
        )
    times = tips.begin + np.arange(int(rows + 1e-6) + 1) / arguments.rate
    left, right, _, _ = tips.at(times)
    starts = [
        {
            "time": float(take.time[row] - take.time[0]),
            "position": state[:3].tolist(),
            "velocity": state[3:6].tolist(),
            "spin": float(state[6]),
        }
        for row, state in stretch_starts(take)
    ]
    body = take.properties
    header = "time,left_x,left_y,left_z,right_x,right_y,right_z"
    table = np.column_stack([times, left, right])
    lines = [header, *(",".join(f"{number:.9g}" for number in row) for row in table)]
    told = {
        "schema": "diabolo.recording/1",
        "diabolo": {
            "mass": body.mass,
            "diameter": body.diameter,
            "length": body.length,
            "axle_radius": body.axle_radius,
        },
        "string_length": take.string_length,
        "rate": arguments.rate,
        "units": "SI",
        "frame": "x forward, y left, z up",
        "starts": starts,
    } | ({"clock": take.clock} if take.clock else {})
    files.write_texts(
        {target: "\n".join(lines) + "\n", target.with_suffix(".json"): json.dumps(told, indent=1) + "\n"}
    )
    print(f"{target}: {len(times)} rows at {arguments.rate:g} Hz, {len(starts)} starts")
