# SPDX-License-Identifier: MIT
"""`diabolo diagnose`: what does the simulator leave out?"""

from __future__ import annotations

import argparse
import hashlib
import time
from contextlib import nullcontext
from pathlib import Path
from typing import Any

from .._core import Estimate, FormulaLaws, InputFile, Model, Recording
from ..checks import LARGEST_SEED, MOST_THREADS, whole_number
from ..diagnosis import Diagnosis
from ..diagnosis import diagnose as run_diagnosis
from ..evaluation import DEFAULT_MODELS, Excerpt
from ..report import check as check_report
from ..report import report_html
from . import files
from .arguments import (
    add_calibration,
    add_command,
    output_name,
    progress_steps,
    read_excerpt,
    read_model,
    reading_of,
    split_excerpt,
)

MODEL_FILE, REPORT_FILE, RESULT_FILE = "model.json", "report.html", "diagnosis.json"


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "diagnose",
        run=run,
        summary="name the physics that a simulator misses, or what was measured wrongly",
        text="Compare a simulator with recordings and find where they part. Name what is missing (friction,\n"
        "elasticity, drag, lift, spin losses) or measured wrongly (tilt, scale, delay, offsets). Add it,\n"
        "and show on held-out data that the prediction improves. Several recordings are fitted together.",
        example="  diabolo diagnose swing.csv throw.csv --out diagnosis",
    )
    parser.add_argument(
        "recordings",
        nargs="+",
        metavar="RECORDING",
        help="Motive exports or tidy recordings of one set-up; NAME.csv:0-180 takes the rows 0 to 180 only",
    )
    parser.add_argument(
        "--base",
        metavar="MODEL",
        default="consistent",
        help="the simulator: consistent (default), paper, published, or a model file",
    )
    add_calibration(parser)
    parser.add_argument(
        "--holdout",
        nargs="+",
        default=[],
        metavar="RECORDING",
        help="held-out recordings, or rows of them as above: nothing is fitted to them",
    )
    parser.add_argument(
        "--law",
        metavar="FILE",
        help="laws of your own, by formulas, which are asked about as all others: see docs/your_law.md",
    )
    parser.add_argument("--json", metavar="FILE", help="write the result as JSON; - is standard output")
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=output_name,
        help=f"folder for {REPORT_FILE}, {RESULT_FILE} and {MODEL_FILE}",
    )
    parser.add_argument(
        "--budget",
        metavar="SECONDS",
        type=float,
        default=1e9,
        help="end after so long, reading aside; what is left out for it is told",
    )
    parser.add_argument("--seed", metavar="N", type=int, default=1, help="seed of the intervals; default: 1")
    parser.add_argument("--threads", metavar="N", type=int, default=0, help="default: all processors")


def run(arguments: argparse.Namespace) -> None:
    whole_number("--threads", arguments.threads, 0, MOST_THREADS)
    whole_number("--seed", arguments.seed, 0, LARGEST_SEED)
    if not arguments.budget > 0.0:
        raise ValueError(f"--budget: {arguments.budget} s; expected more than 0")
    folder = None if arguments.out is None else Path(arguments.out)
    outputs: list[Path | str | None] = [arguments.json]
    if folder is not None:
        outputs += [folder / name for name in (MODEL_FILE, REPORT_FILE, RESULT_FILE)]
        check_report(folder / REPORT_FILE)
    inputs = [split_excerpt(text)[0] for text in [*arguments.recordings, *arguments.holdout]]
    settings = [arguments.calibration] if arguments.calibration else []
    settings += [arguments.base] if arguments.base not in DEFAULT_MODELS else []
    settings += [arguments.law] if arguments.law else []
    files.check_outputs(outputs, [*inputs, *settings], folder)
    laws = FormulaLaws.load(arguments.law) if arguments.law else ()
    reading = reading_of(arguments)
    takes, held = (
        [_cut(read_excerpt(text, reading)) for text in given]
        for given in (arguments.recordings, arguments.holdout)
    )
    hashes = [input_file(path) for path in inputs]
    begin = time.monotonic()
    with progress_steps() as report:
        diagnosis = run_diagnosis(
            takes,
            read_model(arguments.base),
            holdout=held,
            laws=laws,
            budget=arguments.budget,
            seed=arguments.seed,
            threads=arguments.threads,
            progress=report,
        )
    result = diagnosis.result.completed(
        seconds=time.monotonic() - begin, inputs=hashes, model=None if folder is None else MODEL_FILE
    ).to_dict()
    texts = {} if folder is None else _texts(folder, diagnosis.model, result)
    if arguments.json not in (None, files.STDOUT):
        texts[Path(arguments.json)] = files.json_text(result)
    with nullcontext() if folder is None else files.made_folder(folder):
        files.write_texts(texts)
    if arguments.json == files.STDOUT:
        files.write_json(arguments.json, result)
    if arguments.json != files.STDOUT:
        print(text_of(diagnosis))
        if folder is not None:
            print(f"{folder / REPORT_FILE}: the report; {folder / MODEL_FILE}: the model")


def text_of(diagnosis: Diagnosis) -> str:
    """The answer in a few lines."""
    lines = [f"{diagnosis.headline}: {diagnosis.sentence}"]
    for effect in diagnosis.effects:
        values = ", ".join(_value(parameter) for parameter in effect.parameters)
        p_value = "" if effect.p_value is None else f"; p = {effect.p_value:.1g}"
        lines.append(f"  {effect.name}: {values}{p_value}")
    fit = diagnosis.result.fit
    compared = zip(fit.horizons_s, fit.base_error_m, fit.augmented_error_m, strict=False)
    shown = [
        f"{horizon:g} s: {1e3 * before:.1f} -> {1e3 * after:.1f} mm"
        for horizon, before, after in compared
        if before is not None and after is not None
    ]
    if shown:
        lines.append(f"  mean error on held-out {fit.heldout}, after " + "; ".join(shown))
    if fit.holdout_unused:
        names = ", ".join(fit.holdout_unused)
        lines.append(f"  held out, but without a start that could be compared: {names}")
    return "\n".join(lines)


def _cut(excerpt: Excerpt) -> Recording:
    return excerpt.recording.cut(excerpt.first, excerpt.last)


def _value(parameter: Estimate) -> str:
    text = f"{parameter.name} {parameter.value:.4g}"
    if parameter.ci90 is not None:
        text += f" [{parameter.ci90.low:.4g}, {parameter.ci90.high:.4g}]"
    return text if parameter.unit == "1" else f"{text} {parameter.unit}"


def input_file(path: str | Path) -> InputFile:
    return InputFile(file=Path(path).name, sha256=hashlib.sha256(Path(path).read_bytes()).hexdigest())


def _texts(folder: Path, model: Model, result: dict[str, Any]) -> dict[Path, str]:
    return {
        folder / MODEL_FILE: model.to_json(),
        folder / REPORT_FILE: report_html(result),
        folder / RESULT_FILE: files.json_text(result),
    }
