# SPDX-License-Identifier: MIT
"""`diabolo view`: a recording or a plan in three dimensions."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from ..evaluation import DEFAULT_MODELS, predict
from ..view import view_html
from . import files
from .arguments import (
    RECORDING_HELP,
    add_calibration,
    add_command,
    output_name,
    read_excerpt,
    read_model,
    reading_of,
    split_excerpt,
)


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "view",
        run=run,
        summary="show a recording or a plan in three dimensions",
        text="Write a page that shows tips, string, spheroid and diabolo in a browser; it needs no network.",
        example="  diabolo view throw_1.csv --out throw.html\n"
        "  diabolo view throw_1.csv:0-180 --model consistent --out throw.html",
    )
    parser.add_argument("recording", metavar="RECORDING", help=f"or a plan: {RECORDING_HELP}")
    parser.add_argument("--out", metavar="FILE.html", type=output_name, required=True, help="what to write")
    parser.add_argument(
        "--model",
        metavar="NAME",
        help="predict the diabolo too, from the first row that allows it: published, paper, consistent or a "
        "model file",
    )
    add_calibration(parser)


def run(arguments: argparse.Namespace) -> None:
    inputs = [split_excerpt(arguments.recording)[0]]
    inputs += [arguments.calibration] if arguments.calibration else []
    inputs += [arguments.model] if arguments.model and arguments.model not in DEFAULT_MODELS else []
    files.check_outputs([arguments.out], inputs)
    excerpt = read_excerpt(arguments.recording, reading_of(arguments))
    take = excerpt.recording.cut(excerpt.first, excerpt.last)
    prediction = note = None
    if arguments.model:
        model = read_model(arguments.model)
        prediction = predict(take, model).states[:, :3]
        note = f"predicted by {model.name}"
    page = view_html(take, prediction=prediction, note=note or "")
    files.write_texts({Path(arguments.out): page})
    print(f"{arguments.out}: {len(take)} samples, {take.time[-1] - take.time[0]:.2f} s")
