# SPDX-License-Identifier: MIT
"""`diabolo diagnose`: what does the simulator leave out?"""

from __future__ import annotations

import argparse
import hashlib
import time
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np

from .. import files
from .._core import DiagnosisResult, Estimate, FormulaLaws, InputFile, Recording
from ..checks import LARGEST_SEED, MOST_THREADS, whole_number
from ..diagnosis import MOST_DRAWS, Comparison, Diagnosis, compare_simulator
from ..diagnosis import diagnose as run_diagnosis
from ..evaluation import DEFAULT_MODELS
from ..formats import check_writer, load_recording, reader_of
from ..report import LEAST_PROBABILITY, report_html
from ..report import check as check_report
from ..view import Replay, replay_of
from .arguments import (
    BODIES,
    RECORDING_HELP,
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
COMPARISON_FILE, SIMULATOR_FILE = "comparison.json", "simulator.json"
REPLAY_FILE = "replay.rrd"


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "diagnose",
        run=run,
        summary="name the physics that a simulator misses, or what was measured wrongly",
        text="Compare a simulator with recordings and find where they part. Name what is missing (friction,\n"
        "elasticity, drag, lift, spin losses) or measured wrongly (tilt, scale, delay, offsets). Add it,\n"
        "and show on held-out data that the prediction improves. Several recordings are fitted together.\n\n"
        "exit status: 0 with an answer, be it INSUFFICIENT_DATA (see --json), 2 for bad input.",
        example="  diabolo diagnose swing.csv throw.csv --out diagnosis",
    )
    parser.add_argument(
        "recordings",
        nargs="+",
        metavar="RECORDING",
        help=f"of one set-up, each {RECORDING_HELP}",
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
        action="append",
        default=[],
        help="laws of your own, by formulas, tested as all others are (docs/your_law.md); may be repeated",
    )
    parser.add_argument(
        "--simulated",
        nargs="+",
        default=[],
        metavar="FILE",
        help="what your own simulator made of the same stick motion: it is compared with the recordings, law "
        "by law (docs/your_simulator.md; `diabolo motion` writes the sticks for it)",
    )
    parser.add_argument("--json", metavar="FILE", help="write the result as JSON; - is standard output")
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=output_name,
        help=f"folder for {REPORT_FILE}, {RESULT_FILE} and {MODEL_FILE}; with --simulated also "
        f"{COMPARISON_FILE} and {SIMULATOR_FILE}",
    )
    parser.add_argument(
        "--budget",
        metavar="SECONDS",
        type=float,
        default=1e9,
        help="end after so long, reading aside; what is left out for it is told",
    )
    parser.add_argument(
        "--draws",
        metavar="N",
        type=int,
        default=0,
        help="write so many other models that the recordings do not tell from the best one, as "
        "DIR/model-1.json and so on, for `diabolo train --model DIR/model-*.json`",
    )
    parser.add_argument(
        "--rerun",
        action="store_true",
        help="also write DIR/replay-1.rrd and so on, one for each recording and held-out one: the play, what "
        "base and corrected model predict, begun again each second, and their errors, to look at in rerun",
    )
    parser.add_argument(
        "--seed", metavar="N", type=int, default=1, help="seed of intervals and draws; default: 1"
    )
    parser.add_argument("--threads", metavar="N", type=int, default=0, help="default: all processors")


def run(arguments: argparse.Namespace) -> None:
    check_options(arguments)
    folder = None if arguments.out is None else Path(arguments.out)
    outputs: list[Path | str | None] = [arguments.json]
    if folder is not None:
        outputs += [folder / name for name in names_in(folder, arguments)]
        check_report(folder / REPORT_FILE)
        if arguments.rerun:
            check_writer(folder / REPLAY_FILE)
    inputs = [split_excerpt(text)[0] for text in [*arguments.recordings, *arguments.holdout]]
    settings = [arguments.calibration] if arguments.calibration else []
    settings += [arguments.base] if arguments.base not in DEFAULT_MODELS else []
    settings += arguments.law
    files.check_outputs(outputs, [*inputs, *settings, *arguments.simulated], folder)
    laws = [law for file in arguments.law for law in FormulaLaws.load(file).to_list()]
    reading = reading_of(arguments)
    takes, held = (
        [read_excerpt(text, reading, BODIES).part() for text in given]
        for given in (arguments.recordings, arguments.holdout)
    )
    simulated = [read_simulated(path, takes[0]) for path in arguments.simulated]
    hashes = [input_file(path) for path in inputs]
    begin = time.monotonic()
    comparison = None
    with progress_steps() as report:
        settings_of_run: dict[str, Any] = {
            "holdout": held,
            "laws": laws,
            "budget": arguments.budget,
            "seed": arguments.seed,
            "threads": arguments.threads,
            "progress": report,
        }
        base = read_model(arguments.base)
        if simulated:
            comparison = compare_simulator(takes, simulated, base, **settings_of_run)
            diagnosis = comparison.real
        else:
            diagnosis = run_diagnosis(takes, base, draws=arguments.draws, **settings_of_run)
    result = diagnosis.result.completed(
        seconds=time.monotonic() - begin, inputs=hashes, model=None if folder is None else MODEL_FILE
    ).to_dict()
    told = result if comparison is None else comparison.to_dict()
    texts, replays = {}, []
    if folder is not None:
        replays = [replay_of(take, base, diagnosis.model) for take in [*takes, *held]]
        texts = _texts(folder, diagnosis, result, comparison, replays)
    if arguments.json not in (None, files.STDOUT):
        texts[Path(arguments.json)] = files.json_text(told)
    with nullcontext() if folder is None else files.made_folder(folder):
        if folder is not None and arguments.rerun:
            save_replays(folder, replays)
        files.write_texts(texts)
    if arguments.json == files.STDOUT:
        files.write_json(arguments.json, told)
    if arguments.json != files.STDOUT:
        own = [law["name"] for law in laws]
        print(text_of(diagnosis, own) if comparison is None else comparison_text(comparison, own))
        if folder is not None:
            print(f"{folder / REPORT_FILE}: the report; {folder / MODEL_FILE}: the model")


def check_options(arguments: argparse.Namespace) -> None:
    """Raise ValueError about one that cannot be, or not with another."""
    whole_number("--threads", arguments.threads, 0, MOST_THREADS)
    whole_number("--seed", arguments.seed, 0, LARGEST_SEED)
    whole_number("--draws", arguments.draws, 0, MOST_DRAWS)
    if arguments.draws and (arguments.out is None or arguments.simulated):
        raise ValueError(f"--draws {arguments.draws}: expected with --out DIR, and without --simulated")
    if arguments.rerun and arguments.out is None:
        raise ValueError("--rerun: expected with --out DIR")
    if not arguments.budget > 0.0:
        raise ValueError(f"--budget: {arguments.budget} s; expected more than 0")


def names_in(folder: Path, arguments: argparse.Namespace) -> list[str]:
    """Of the files to write. Raises ValueError where older ones would stay among them."""
    names = [MODEL_FILE, REPORT_FILE, RESULT_FILE]
    names += [COMPARISON_FILE, SIMULATOR_FILE] if arguments.simulated else []
    replayed = len(arguments.recordings) + len(arguments.holdout) if arguments.rerun else 0
    return [*names, *numbered(folder, MODEL_FILE, arguments.draws), *numbered(folder, REPLAY_FILE, replayed)]


def numbered(folder: Path, file: str, count: int) -> list[str]:
    """NAME-1.SUFFIX and so on for a file NAME.SUFFIX. Raises ValueError where a folder holds one with a
    greater number, which would stay."""
    name, suffix = Path(file).stem, Path(file).suffix
    for path in sorted(folder.glob(f"{name}-*{suffix}")):
        number = path.stem.removeprefix(f"{name}-")
        if number.isdecimal() and int(number) > count:
            raise ValueError(f"{path}: written before; remove it, or take another folder")
    return [f"{name}-{i + 1}{suffix}" for i in range(count)]


def save_replays(folder: Path, replays: list[Replay]) -> None:
    """One file each, of rerun."""
    from ..formats import rrd

    for name, replay in zip(numbered(folder, REPLAY_FILE, len(replays)), replays, strict=True):
        rrd.save_replay(replay, folder / name)


def read_simulated(path: str, like: Recording) -> Recording:
    """What a simulator wrote: a tidy recording; without a JSON string and diabolo are those of `like`."""
    if Path(path).with_suffix(".json").exists() or reader_of(Path(path)) not in (None, "parquet"):
        return load_recording(path)
    bare = load_recording(path, columns="time=time")
    return Recording(
        bare.time,
        bare.left,
        bare.right,
        bare.diabolo,
        bare.rate,
        diabolo_orientation=bare.diabolo_orientation,
        left_orientation=bare.left_orientation,
        right_orientation=bare.right_orientation,
        name=bare.name,
        properties=like.properties,
        string_length=like.string_length,
    )


def comparison_text(comparison: Comparison, own: Sequence[str] = ()) -> str:
    """The answer about a simulator in a few lines; `own` are the names of one's own laws."""
    lines = [comparison.sentence]
    for law in comparison.laws:
        lines.append(f"  {law.verdict.replace('_', ' '):15} {law.name}")
        for name, numbers in (
            ("reality", law.real),
            ("simulator", law.simulated),
            ("to add", law.difference),
        ):
            if numbers and not (law.verdict in ("agrees", "cannot_tell") and name == "to add"):
                lines.append(f"    {name:10} {', '.join(_value(number) for number in numbers)}")
    lines.append(f"Of the recordings alone: {text_of(comparison.real, own)}")
    return "\n".join(lines)


def text_of(diagnosis: Diagnosis, own: Sequence[str] = ()) -> str:
    """The answer in a few lines; `own` are the names of one's own laws."""
    lines = [f"{diagnosis.headline}: {diagnosis.sentence}"]
    for effect in diagnosis.effects:
        values = ", ".join(_value(parameter) for parameter in effect.parameters)
        lines.append(f"  {effect.name}: {values}{_p_value(effect.p_value)}")
    lines += [f"  {own_law_text(name, diagnosis.result)}" for name in own]
    fit = diagnosis.result.fit
    for what, unit, per_unit, base, augmented in (
        ("error", "mm", 1e3, fit.base_error_m, fit.augmented_error_m),
        ("error of the spin", "rad/s", 1.0, fit.base_spin_error_radps, fit.augmented_spin_error_radps),
    ):
        shown = [
            f"{horizon:g} s: {per_unit * before:.1f} -> {per_unit * after:.1f} {unit}"
            for horizon, before, after in zip(fit.horizons_s, base, augmented, strict=False)
            if before is not None and after is not None
        ]
        if shown:
            lines.append(f"  mean {what} on held-out {fit.heldout}, after " + "; ".join(shown))
    axle = fit.constant_axle_error_rad, fit.base_axle_error_rad, fit.augmented_axle_error_rad
    if fit.axle_ahead_s is not None and None not in axle:
        constant, before, after = np.degrees(np.array(axle, float))
        lines.append(
            f"  mean error of the axle's direction on held-out {fit.axle_heldout},"
            f" after {fit.axle_ahead_s:.2g} s: {before:.1f} -> {after:.1f} deg"
            f" (a constant axle: {constant:.1f} deg)"
        )
    if fit.holdout_unused:
        names = ", ".join(fit.holdout_unused)
        lines.append(f"  held out, but without a start that could be compared: {names}")
    return "\n".join(lines)


def own_law_text(name: str, result: DiagnosisResult) -> str:
    """Whether a law of --law is claimed, and if not, why and how much of it may be there."""
    row = next((row for row in result.ladder if row.name == name), None)
    if row is None:
        return f"your law {name}: not tested"
    if row.claimed:
        return f"your law {name}: claimed, with the numbers above"
    limits = [limit for limit in result.upper_limits if limit.name == name]
    below = [
        f"; {limit.parameter} below {_with_unit(f'{limit.limit95:.4g}', limit.unit)}" for limit in limits
    ]
    return f"your law {name}: not claimed, {row.reason}{''.join(below)}"


def _p_value(p: float | None) -> str:
    if p is None:
        return ""
    return f"; p = {p:.1g}" if p >= LEAST_PROBABILITY else f"; p < {LEAST_PROBABILITY:g}"


def _value(parameter: Estimate) -> str:
    text = f"{parameter.name} {parameter.value:.4g}"
    if parameter.ci90 is not None:
        text += f" [{parameter.ci90.low:.4g}, {parameter.ci90.high:.4g}]"
    return _with_unit(text, parameter.unit)


def _with_unit(text: str, unit: str) -> str:
    return text if unit == "1" else f"{text} {unit}"


def input_file(path: str | Path) -> InputFile:
    """A file, or a bag's folder, by its name and what is in it."""
    path, digest = Path(path), hashlib.sha256()
    for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
        if file.is_file():
            digest.update(file.read_bytes())
    return InputFile(file=path.name, sha256=digest.hexdigest())


def _texts(
    folder: Path,
    diagnosis: Diagnosis,
    result: dict[str, Any],
    comparison: Comparison | None,
    replays: list[Replay],
) -> dict[Path, str]:
    told = None if comparison is None else comparison.to_dict()
    texts = {
        folder / MODEL_FILE: diagnosis.model.to_json(),
        folder / REPORT_FILE: report_html(result, told, replays),
        folder / RESULT_FILE: files.json_text(result),
    }
    drawn = diagnosis.models
    for name, model in zip(numbered(folder, MODEL_FILE, len(drawn)), drawn, strict=True):
        texts[folder / name] = model.to_json()
    if comparison is not None:
        texts[folder / COMPARISON_FILE] = comparison.result.to_json()
        texts[folder / SIMULATOR_FILE] = comparison.simulated.model.to_json()
    return texts
