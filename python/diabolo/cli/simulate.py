# SPDX-License-Identifier: MIT
"""`diabolo simulate`: a predicted play as a tidy recording, or one in real time."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import files
from .._core import (
    Model,
    Recording,
    TipMotion,
    largest_spin,
    played_properties,
    played_recording,
)
from ..enums import StringState
from ..evaluation import DEFAULT_MODELS, predict
from ..live.play import RATE as LIVE_RATE
from ..motions import MOTIONS
from ..player import hang_at_rest
from ..rollout import FARTHEST, rollout
from . import live
from .arguments import (
    OF_RECORDINGS,
    RECORDING_HELP,
    TIPS,
    add_calibration,
    add_command,
    check_not_given,
    output_name,
    read_excerpt,
    read_model,
    reading_of,
    split_excerpt,
)

RATE = 120.0  # of a built-in motion [Hz]
STEPS_PER_SAMPLE = 8


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "simulate",
        run=run,
        summary="write a predicted play as a tidy recording",
        text="Predict the diabolo from a motion of the stick tips, that of a recording or a built-in one,\n"
        "and write tips and diabolo as a tidy recording (TIDY.csv, with TIDY.json beside it).\n\n"
        "With --live you are the player: open the address that is printed in a browser on this machine,\n"
        "and drag the tips with the mouse. Closing the page or Ctrl-C ends the play.",
        example="  diabolo simulate swing.csv --motion swing\n"
        "  diabolo simulate predicted.csv --on throw_1.csv\n"
        "  diabolo simulate --live --out played.csv",
    )
    parser.add_argument(
        "tidy",
        metavar="TIDY.csv",
        type=output_name,
        nargs="?",
        help="the recording to write; with --live it is --out that names one",
    )
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("--on", metavar="RECORDING", help=f"the tips of {RECORDING_HELP}")
    source.add_argument(
        "--motion", choices=MOTIONS, help="a built-in motion, the diabolo hanging at rest before"
    )
    source.add_argument("--live", action="store_true", help="your own, with the mouse, in a browser")
    parser.add_argument(
        "--model",
        metavar="NAME",
        default="consistent",
        help="published, paper, consistent (default) or a model file",
    )
    parser.add_argument("--duration", metavar="S", type=float, help="of a built-in motion [s]; default 5")
    parser.add_argument(
        "--spin",
        metavar="W",
        type=float,
        help="at the start of a built-in motion or a live one [rad/s]; default 100",
    )
    live.add_options(parser)
    add_calibration(parser)
    parser.add_argument("--json", metavar="FILE", help="write a summary as JSON; - is standard output")


def run(arguments: argparse.Namespace) -> None:
    target = target_of(arguments)
    inputs = [split_excerpt(arguments.on)[0]] if arguments.on else []
    inputs += [arguments.calibration] if arguments.calibration else []
    inputs += [arguments.model] if arguments.model not in DEFAULT_MODELS else []
    outputs = [target, target.with_suffix(".json")] if target else []
    files.check_outputs([*outputs, arguments.json], inputs)
    model = read_model(arguments.model)
    spin = 100.0 if arguments.spin is None else arguments.spin
    simulated: tuple[Recording, NDArray[np.uint8]] | None
    sentences = []
    if arguments.live:
        check_spin(spin, LIVE_RATE)
        why, simulated = live.played(arguments, model, spin)
        sentences.append(why)
    elif arguments.on:
        if arguments.duration is not None or arguments.spin is not None:
            raise ValueError("--duration and --spin belong to --motion; a recording has its own")
        simulated = on_recording(arguments, model)
    else:
        check_not_given(arguments, (*OF_RECORDINGS, "arms"), "--motion reads none")
        duration = 5.0 if arguments.duration is None else arguments.duration
        simulated = on_motion(arguments.motion, model, duration, spin, Path(arguments.tidy).stem)
    if target and simulated:
        sentences.append(write(arguments.json, target, model, *simulated))
    if arguments.json != files.STDOUT:
        print(*sentences, sep="\n", flush=True)


def target_of(arguments: argparse.Namespace) -> Path | None:
    """The recording to write; raises ValueError where it is none, or an option does not fit."""
    live.check_options(arguments)
    if not (arguments.live or arguments.tidy):
        raise ValueError("there is nothing to write to; expected TIDY.csv")
    name = arguments.out if arguments.live else arguments.tidy
    if name is not None and Path(name).suffix != ".csv":
        raise ValueError(f"{name}: expected a name that ends in .csv")
    return None if name is None else Path(name)


def write(
    summary: str | None, target: Path, model: Model, played: Recording, string_states: NDArray[np.uint8]
) -> str:
    """Write the recording, and what is in it as JSON to `summary`; returns that as a sentence."""
    played.save(target)
    shares = {state.name.lower(): float(np.mean(string_states == state)) for state in StringState}
    height = played.diabolo[:, 2]
    found = {
        "schema": "diabolo.simulate/1",
        "file": str(target),
        "model": model.name,
        "samples": len(played),
        "duration_s": float(played.time[-1] - played.time[0]),
        "height_m": [float(height.min()), float(height.max())],
        "string_state_share": shares,
    }
    files.write_json(summary, found)
    states = ", ".join(f"{100.0 * share:.0f} % {name.replace('_', ' ')}" for name, share in shares.items())
    return (
        f"{target}: {len(played)} samples, {found['duration_s']:.2f} s, "
        f"the diabolo between {height.min():.2f} and {height.max():.2f} m high; string: {states}"
    )


def on_recording(arguments: argparse.Namespace, model: Model) -> tuple[Recording, NDArray[np.uint8]]:
    """The recording from the first row that a prediction can start from, its diabolo predicted."""
    excerpt = read_excerpt(arguments.on, reading_of(arguments), TIPS)
    take = excerpt.part()
    predicted = predict(take, model)
    assert predicted.axis is not None
    known = ~np.isnan(predicted.states[:, 0])
    first = int(np.argmax(known))
    away = known & ~(np.abs(predicted.states[:, :3]).max(axis=1) <= FARTHEST)
    if away.any():
        seconds = take.time[int(np.argmax(away))] - take.time[first]
        raise ValueError(
            f"{arguments.on}: the prediction is more than {FARTHEST:g} m away after {seconds:.2f} s; "
            "take fewer rows, as in NAME.csv:0-180"
        )
    take = take.cut(first, len(take) - 1)
    # Where a tip is missing, the one that the prediction went by in its place.
    left, right, _, _ = TipMotion.of_recording(take, model.interpolation).at(take.time - take.time[0])
    return (
        played_recording(
            excerpt.recording.name,
            take.time,
            np.where(take.left_valid[:, np.newaxis], take.left, left),
            np.where(take.right_valid[:, np.newaxis], take.right, right),
            predicted.states[first:],
            take.rate,
            take.properties,
            take.string_length,
            predicted.axis[first:],
            take.clock,
        ),
        predicted.string_states[first:],
    )


def check_spin(spin: float, rate: float) -> None:
    """Raise ValueError where samples at this rate [Hz] could not show the spin [rad/s]."""
    if not abs(spin) < largest_spin(rate):
        raise ValueError(
            f"--spin {spin:g}: expected less than {largest_spin(rate):.0f} rad/s; "
            f"at {rate:g} samples a second a faster one looks like a slower one"
        )


def on_motion(
    name: str, model: Model, duration: float, spin: float, title: str
) -> tuple[Recording, NDArray[np.uint8]]:
    """A built-in motion, from a diabolo that hangs at rest below the tips."""
    check_spin(spin, RATE)
    tips = MOTIONS[name](duration)
    length = model.parameters.string_length
    start = tips.at(0.0)
    initial = hang_at_rest(model, start[0], start[1], spin).to_array()
    samples = int(duration * RATE)
    result = rollout(
        model,
        initial,
        tips,
        dt=1.0 / (RATE * STEPS_PER_SAMPLE),
        steps=samples * STEPS_PER_SAMPLE,
        record_every=STEPS_PER_SAMPLE,
        string_state=StringState.ON_STRING,
        axle=True,
    )
    assert result.axis is not None
    time = np.arange(samples + 1) / RATE
    left, right, _, _ = tips.at(time)
    states = np.vstack([initial, result.states])
    codes = np.concatenate([[np.uint8(StringState.ON_STRING)], result.string_states])
    axis = np.vstack([[1.0, 0.0, 0.0], result.axis])
    properties = played_properties(model.parameters)
    return played_recording(title, time, left, right, states, RATE, properties, length, axis), codes
