# SPDX-License-Identifier: MIT
"""`diabolo convert`: a recording of one kind as another, and a model as a robot cell."""

from __future__ import annotations

import argparse
import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from .. import files
from ..checks import warn_of
from ..evaluation import DEFAULT_MODELS
from ..formats import READERS, WITH_JSON, WRITTEN, check_writer, save_recording
from ..hosts import mjcf, sdf, urdf
from ..player import model_for
from .arguments import (
    OF_RECORDINGS,
    add_calibration,
    add_command,
    arms_of,
    check_not_given,
    output_name,
    read_excerpt,
    read_model,
    reading_of,
    split_excerpt,
)

CELLS = (".urdf", ".xml", ".sdf")
"""Suffixes of what is written from a model."""
RECORDED = (".csv", ".tsv", *READERS)
"""Suffixes of recordings."""


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "convert",
        run=run,
        summary="write a recording as another kind of file, or a model as a robot cell for simulators",
        text="Read a recording of any kind (docs/recordings.md) and write the stick tips and the diabolo in\n"
        "the world frame (x forward, y left, z up; s, m, unit quaternions), as the suffix of OUT says:\n\n"
        "  .csv      tidy: empty cells are dropouts; beside it OUT.json with mass and sizes of the\n"
        "            diabolo, string length and rate\n"
        "  .mcap     poses of ROS 2 on /left_tip, /right_tip and /diabolo; string, diabolo in the metadata\n"
        "  .parquet  the tidy table, and OUT.json beside it\n"
        "  .rrd      the play in three dimensions, height and spin, to look at in rerun\n\n"
        "Of a model (a file, or consistent, paper or published) it writes the cell of two UR5e with sticks\n"
        "and the diabolo (docs/hosts.md); --arms says where they stand, --recording what the\n"
        "set-up is like:\n\n"
        "  .xml      MJCF, with our string as MuJoCo's plugin and the model in it\n"
        "  .sdf      a world of SDF, with the name of the model's file\n"
        "  .urdf     the arms and sticks alone",
        example="  diabolo convert throw_1.csv tidy/throw_1.csv\n"
        "  diabolo convert bag/ take.csv --topics left=/stick_l/pose,right=/stick_r/pose,diabolo=/d/pose\n"
        "  diabolo convert take.csv take.mcap\n"
        "  diabolo convert out/model.json cell.sdf --recording take.csv",
    )
    parser.add_argument(
        "recording",
        metavar="RECORDING|MODEL",
        help="what to read; NAME.csv:0-180 takes the rows 0 to 180 of a recording only",
    )
    parser.add_argument("out", metavar="OUT", type=output_name, help="what to write")
    parser.add_argument(
        "--recording",
        dest="take",
        metavar="TAKE",
        help="a take of the set-up: its string length, mass and axle radius, which a diagnosed model "
        "leaves open",
    )
    add_calibration(parser)
    parser.add_argument(
        "--json", metavar="FILE", help="write what was converted as JSON; - is standard output"
    )


def run(arguments: argparse.Namespace) -> None:
    target = Path(arguments.out)
    if target.suffix in CELLS:
        done, said = _convert_model(arguments, target)
    elif target.suffix in WRITTEN:
        done, said = _convert_recording(arguments, target)
    else:
        raise ValueError(f"{target}: expected a name that ends in {', '.join((*WRITTEN, *CELLS))}")
    files.write_json(arguments.json, {"schema": "diabolo.convert/1", "file": str(target), **done})
    if arguments.json != files.STDOUT:
        print(f"{target}: {said}")


Done = tuple[dict[str, Any], str]
"""What was written, for the JSON file and as a sentence."""


def _convert_recording(arguments: argparse.Namespace, target: Path) -> Done:
    if arguments.take is not None:
        raise ValueError(f"--recording: it says of which set-up a model is; {target.name} is of a recording")
    inputs = [split_excerpt(arguments.recording)[0]]
    inputs += [arguments.calibration] if arguments.calibration else []
    beside = target.with_suffix(".json") if target.suffix in WITH_JSON else None
    files.check_outputs([target, beside, arguments.json], inputs)
    check_writer(target)
    check_is_recording(Path(arguments.recording))
    excerpt = read_excerpt(arguments.recording, reading_of(arguments))
    recording = excerpt.part()
    warn_of([recording])
    save_recording(recording, target)
    dropouts = int(np.count_nonzero(~recording.diabolo_valid))
    return (
        {"samples": len(recording), "rate_hz": recording.rate, "diabolo_dropouts": dropouts},
        f"{len(recording)} samples at {recording.rate:g} Hz, the diabolo missing in {dropouts}",
    )


def check_is_recording(path: Path) -> None:
    """Raise ValueError about a model."""
    if path.suffix == ".json" or (str(path) in DEFAULT_MODELS and not path.exists()):
        raise ValueError(f"{path}: a model; expected OUT to end in {', '.join(CELLS)}")


def _convert_model(arguments: argparse.Namespace, target: Path) -> Done:
    name = arguments.recording
    takes = [] if arguments.take is None else [arguments.take]
    if not takes:
        check_not_given(arguments, OF_RECORDINGS, f"{target.name} is of a model")
    is_file = name not in DEFAULT_MODELS and Path(name).exists()
    files.check_outputs([target, arguments.json], [*([name] if is_file else []), *takes])
    if is_file and (Path(name).suffix in RECORDED or Path(name).is_dir()):
        raise ValueError(f"{name}: a recording; expected OUT to end in {', '.join(WRITTEN)}")
    arms, model = arms_of(arguments), read_model(name)
    for take in takes:
        model = model_for(model, replace(reading_of(arguments), arms=None).load(take))
        model.own_string_length = model.own_axle_radius = True
    if target.suffix == ".urdf":
        text = urdf.urdf(arms)
    elif target.suffix == ".xml":
        text = mjcf.cell(arms, model)
    else:
        text = sdf.world(arms, model, os.path.relpath(name, target.parent) if is_file else name)
    files.write_texts({target: text})
    mass, length = model.parameters.mass, model.parameters.string_length
    diabolo = (
        "" if target.suffix == ".urdf" else f", and a diabolo of {mass:g} kg on a string of {length:g} m"
    )
    return {"model": model.name, "mass_kg": mass, "string_length_m": length}, f"two UR5e with sticks{diabolo}"
