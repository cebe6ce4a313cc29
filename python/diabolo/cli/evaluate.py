# SPDX-License-Identifier: MIT
"""`diabolo evaluate`: how far models are off on recordings."""

from __future__ import annotations

import argparse
from typing import Any

from .. import files
from .._core import Model
from ..checks import LARGEST_SEED, MOST_THREADS, whole_number
from ..evaluation import DEFAULT_HORIZONS, DEFAULT_MODELS, Evaluation, TableRow, evaluate
from ..excerpt import Excerpt
from .arguments import (
    BODIES,
    RECORDING_HELP,
    add_calibration,
    add_command,
    output_name,
    progress_bar,
    read_excerpt,
    read_model,
    reading_of,
    split_excerpt,
)
from .tables import format_table

SHORTEST_BETWEEN_STARTS = 1e-3  # a step of the prediction [s]

TABLE_NOTE = """\
mean distance between predicted and recorded diabolo [m]; one prediction from the first row, as in the paper
baseline: the diabolo rests at the lowest point of the string; a model that is worse explains nothing"""

PAPER_NOTE = "program: the authors' program, run again on the same rows; printed: the figure in the paper"

HORIZON_NOTE = """\
distance between predicted and recorded diabolo [m] at a time after the start, over many starts
baseline: the diabolo rests at the lowest point of the string; intervals: of the mean, by block bootstrap
too few starts: fewer than five are statistically independent"""


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "evaluate",
        run=run,
        summary="measure the error of models on recordings",
        text="Predict the diabolo of each recording from its stick tips, and measure the error.",
        example="  diabolo evaluate throw_1.csv z_hop_1.csv:0-180\n"
        "  diabolo evaluate *.csv --starts every=0.1 --model consistent --plot errors.png",
    )
    parser.add_argument("recordings", metavar="RECORDING", nargs="+", help=RECORDING_HELP)
    parser.add_argument(
        "--model",
        metavar="NAME",
        action="append",
        help="published, paper, consistent or a model file; repeat it to compare; default: those three",
    )
    parser.add_argument(
        "--starts",
        metavar="WHERE",
        default="first",
        help="first (default): one prediction from the first row, as in the paper's table; every=0.1: one "
        "from a start each 0.1 s, evaluated after " + ", ".join(f"{h:g}" for h in DEFAULT_HORIZONS) + " s",
    )
    add_calibration(parser)
    parser.add_argument("--json", metavar="FILE", help="write the figures as JSON; - is standard output")
    parser.add_argument(
        "--plot",
        metavar="FILE",
        type=output_name,
        help="draw error against time after the start (.png, .pdf, .svg)",
    )
    parser.add_argument("--threads", metavar="N", type=int, default=0, help="default: all processors")
    parser.add_argument(
        "--seed", metavar="N", type=int, default=1, help="seed of the bootstrap intervals; default 1"
    )


def run(arguments: argparse.Namespace) -> None:
    starts_every = parse_starts(arguments.starts)
    whole_number("--threads", arguments.threads, 0, MOST_THREADS)
    whole_number("--seed", arguments.seed, 0, LARGEST_SEED)
    models = [read_model(text) for text in arguments.model or DEFAULT_MODELS]
    inputs = [split_excerpt(text)[0] for text in arguments.recordings]
    inputs += [text for text in arguments.model or () if text not in DEFAULT_MODELS]
    inputs += [arguments.calibration] if arguments.calibration else []
    files.check_outputs([arguments.json, arguments.plot], [*inputs, *arguments.recordings])
    if arguments.plot is not None:
        from . import plots

        plots.check(arguments.plot)
    reading = reading_of(arguments)
    excerpts = [read_excerpt(text, reading, BODIES) for text in arguments.recordings]
    result = evaluate_excerpts(
        excerpts, models, starts_every=starts_every, seed=arguments.seed, threads=arguments.threads
    )
    if result.horizons and not any(row.score.windows for row in result.horizons):
        raise ValueError(
            f"{', '.join(arguments.recordings)}: no start to predict from; expected diabolo and both tips "
            "to be seen for some tenths of a second without a gap"
        )
    if arguments.plot is not None:
        plots.draw_errors(arguments.plot, result, excerpts, models)
    files.write_json(arguments.json, result.to_dict())
    if arguments.json != files.STDOUT:
        print(text_of(result))


def parse_starts(text: str) -> float | None:
    """Seconds between starts; None for the first row only."""
    if text == "first":
        return None
    try:
        seconds = float(text.removeprefix("every="))
    except ValueError:
        seconds = 0.0
    if not text.startswith("every=") or not SHORTEST_BETWEEN_STARTS <= seconds < float("inf"):
        raise ValueError(
            f"--starts {text}: expected first, or every=SECONDS as in every=0.1, "
            f"at least {SHORTEST_BETWEEN_STARTS:g}"
        )
    return seconds


def evaluate_excerpts(
    excerpts: list[Excerpt],
    models: list[Model],
    *,
    starts_every: float | None = None,
    seed: int = 1,
    threads: int = 0,
) -> Evaluation:
    """As diabolo.evaluate, with a progress bar."""
    with progress_bar("evaluating") as progress:
        return evaluate(
            excerpts, models, starts_every=starts_every, seed=seed, threads=threads, progress=progress
        )


def text_of(result: Evaluation) -> str:
    return _table_text(result) if result.rows else _horizon_text(result)


def _table_text(result: Evaluation) -> str:
    models = list(dict.fromkeys(row.model for row in result.rows))
    lines = []
    for start in range(0, len(result.rows), len(models)):
        rows = result.rows[start : start + len(models)]  # one excerpt, each model
        program, paper = rows[0].program_error, rows[0].paper_error
        lines.append(
            [
                rows[0].recording,
                f"{rows[0].frames[0]}-{rows[0].frames[1]}",
                *map(_number, rows),
                f"{rows[0].baseline_error:.3f}",
                "" if program is None else f"{program:.3f}",
                "" if paper is None else f"{paper:.2f}",
            ]
        )
    header = ["recording", "rows", *models, "baseline", "program", "printed"]
    if not any(row.paper_error for row in result.rows):
        return f"{format_table(header[:-2], [line[:-2] for line in lines])}\n\n{TABLE_NOTE}"
    return f"{format_table(header, lines)}\n\n{TABLE_NOTE}\n{PAPER_NOTE}"


def _number(row: TableRow) -> str:
    if row.error is None:
        return f"diverged at {row.score.diverged:.2f} s"
    return f"{row.error:.3f}"


def _horizon_text(result: Evaluation) -> str:
    blocks = []
    for recording in dict.fromkeys(row.recording for row in result.horizons):
        rows = [row for row in result.horizons if row.recording == recording]
        lines = []
        for horizon in dict.fromkeys(row.score.horizon for row in rows):
            at_horizon = [row for row in rows if row.score.horizon == horizon]
            entries = [(row.model, row.score.model, row.score.failed) for row in at_horizon]
            entries.append(("baseline", at_horizon[0].score.baseline, 0))
            for index, (name, summary, failed) in enumerate(entries):
                first = [f"{horizon:g} s", str(at_horizon[0].score.windows)] if index == 0 else ["", ""]
                lines.append([*first, name, *_summary_cells(summary), f"{failed} diverged" if failed else ""])
        header = ["after", "starts", "model", "mean", "95 % interval", "median", "90 % below", ""]
        blocks.append(f"{recording}\n{format_table(header, lines, left=3)}")
    return "\n\n".join([*blocks, HORIZON_NOTE])


def _summary_cells(summary: Any) -> list[str]:
    if summary is None:
        return ["-", "", "-", "-"]
    interval = summary.mean_ci95
    return [
        f"{summary.mean:.3f}",
        f"{interval.low:.3f} to {interval.high:.3f}" if interval else "too few starts",
        f"{summary.median:.3f}",
        f"{summary.percentile_90:.3f}",
    ]
