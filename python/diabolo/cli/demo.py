# SPDX-License-Identifier: MIT
"""`diabolo demo`: the main job on recordings that come with the package."""

from __future__ import annotations

import argparse
from importlib import resources
from pathlib import Path
from typing import Any

from .._core import Model, load_recording
from ..evaluation import ALL_RECORDINGS, DEFAULT_MODELS, Evaluation, Excerpt, predict
from . import evaluate, files
from .arguments import add_command, output_name

SHOWN, SHOWN_SECONDS = "swing", 3.0  # what the picture of a trajectory shows


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "demo",
        run=run,
        summary="evaluate on recordings that come with the package, and draw pictures",
        text="Evaluate the models on recordings that come with the package: print the table of errors,\n"
        "and draw one recording, measured and predicted, and the error against the time after the start.",
        example="  diabolo demo --out demo",
    )
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=output_name,
        default="diabolo-demo",
        help="folder for the pictures; default: diabolo-demo",
    )
    parser.add_argument("--json", metavar="FILE", help="write the figures as JSON; - is standard output")


def packaged_recordings() -> list[Path]:
    """The recordings that come with the package: made by the project's own plant, not by its predictor."""
    with resources.as_file(resources.files("diabolo") / "recordings") as folder:
        return sorted(folder.glob("*.csv"))


def run(arguments: argparse.Namespace) -> None:
    from . import plots

    folder = Path(arguments.out)
    trajectory, errors = folder / "trajectory.png", folder / "errors.png"
    plots.check(trajectory)
    paths = packaged_recordings()
    if not paths:
        raise ValueError("this installation of diabolo came without its recordings")
    files.check_outputs([arguments.json, trajectory, errors], paths, folder)
    recordings = [load_recording(path) for path in paths]
    excerpts = [Excerpt(take, 0, len(take) - 1) for take in recordings]
    models = [Model.named(name) for name in DEFAULT_MODELS]
    table = evaluate.evaluate_excerpts(excerpts, models)
    horizons = evaluate.evaluate_excerpts(excerpts, models, starts_every=0.1)
    whole = next(take for take in recordings if take.name == SHOWN)
    shown = whole.cut(0, round(SHOWN_SECONDS * whole.rate))
    with files.made_folder(folder):
        plots.draw_trajectory(trajectory, shown, {model.name: predict(shown, model) for model in models})
        plots.draw_errors(errors, horizons, excerpts, models)
    files.write_json(arguments.json, Evaluation(table.rows, horizons.horizons).to_dict())
    if arguments.json != files.STDOUT:
        together = [row for row in horizons.horizons if row.recording == ALL_RECORDINGS]
        print(evaluate.text_of(table), evaluate.text_of(Evaluation([], together)), sep="\n\n")
        print("\nWhat the models leave out, `diabolo diagnose TAKE.csv` finds.")
        print(f"pictures: {trajectory} ({SHOWN}, measured and predicted), {errors} (error against time)")
