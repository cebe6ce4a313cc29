# SPDX-License-Identifier: MIT
"""`diabolo view`: a recording or a plan in three dimensions."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from .. import files
from ..evaluation import DEFAULT_MODELS, predict
from ..view import places_of, predict_anew, view_html
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
        "  diabolo view swing.csv --model consistent --model out/model.json --every 1 --out swing.html",
    )
    parser.add_argument("recording", metavar="RECORDING", help=f"or a plan: {RECORDING_HELP}")
    parser.add_argument("--out", metavar="FILE.html", type=output_name, required=True, help="what to write")
    parser.add_argument(
        "--model",
        metavar="NAME",
        action="append",
        default=[],
        help="show what a model predicts beside the recording: published, paper, consistent or a model file; "
        "may be given several times",
    )
    parser.add_argument(
        "--every",
        metavar="S",
        type=float,
        help="begin predictions again from the recorded play each so many seconds; "
        "default: once, at the first row that allows it",
    )
    add_calibration(parser)


def run(arguments: argparse.Namespace) -> None:
    if arguments.every is not None and not 0.0 < arguments.every < float("inf"):
        raise ValueError(f"--every: {arguments.every} s; expected more than 0")
    if arguments.every is not None and not arguments.model:
        raise ValueError("--every: there is no prediction to begin again; expected --model too")
    inputs = [split_excerpt(arguments.recording)[0]]
    inputs += [arguments.calibration] if arguments.calibration else []
    inputs += [name for name in arguments.model if name not in DEFAULT_MODELS]
    files.check_outputs([arguments.out], inputs)
    excerpt = read_excerpt(arguments.recording, reading_of(arguments))
    take = excerpt.part()
    predictions = {}
    for name in arguments.model:
        model = read_model(name)
        if model.name in predictions:
            raise ValueError(f"--model {name}: another model is named '{model.name}' too; expected each once")
        predictions[model.name] = (
            places_of(predict(take, model))
            if arguments.every is None
            else predict_anew(take, model, arguments.every)
        )
    again = (
        "" if arguments.every is None else f", begun again from the recorded play each {arguments.every:g} s"
    )
    note = f"predicted by {' and '.join(predictions)}{again}" if predictions else ""
    files.write_texts({Path(arguments.out): view_html(take, predictions=predictions, note=note)})
    print(f"{arguments.out}: {len(take)} samples, {take.time[-1] - take.time[0]:.2f} s")
