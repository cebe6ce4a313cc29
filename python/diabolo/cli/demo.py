# SPDX-License-Identifier: MIT
"""`diabolo demo`: the main job on recordings that come with the package."""

from __future__ import annotations

import argparse
import json
import os
import sys
import textwrap
import time
from importlib import resources
from pathlib import Path
from typing import Any

from .. import files
from .._core import Model, Recording
from ..diagnosis import diagnose
from ..formats import load_recording
from ..report import check as check_report
from ..report import quantity, report_html, words
from ..view import replay_html, replay_of
from .arguments import add_command, output_name, progress_steps
from .diagnose import MODEL_FILE, REPORT_FILE, RESULT_FILE, input_file

REPLAY_FILE = "replay.html"
BASE = "consistent"
AT_WORK = {
    "string_friction": "coefficient",
    "string_wrap": "turns",
    "air_drag_linear": "rate",
    "air_drag_quadratic": "coefficient",
    "magnus_lift": "coefficient",
    "spin_drag": "coefficient",
    "axle_drag": "rate",
    "gravity_tilt": "angle_deg",
    "time_offset": "seconds",
    "marker_offset": "radius",
}
"""By name in a key of the plant, the parameter that is 0 where the effect is not at work."""

NEXT = f"""
Your own recordings:
  diabolo diagnose TAKE.csv --out diagnosis
  diabolo view TAKE.csv --model {BASE} --model diagnosis/{MODEL_FILE} --every 1 --out replay.html"""

LINE = 100  # characters, of what is said in words
BOLD, RED, GREEN, YELLOW, CYAN = "1", "31", "32", "33", "36"


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "demo",
        run=run,
        summary="diagnose recordings whose physics is concealed, and show what was found",
        text="Diagnose two recordings that come with the package. Another simulator made them, with physics\n"
        "that the tool cannot see. Print what was found beside what was concealed, and write a report\n"
        "and a replay for the browser.",
        example="  diabolo demo --out demo",
    )
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=output_name,
        default="diabolo-demo",
        help="folder for report and replay; default: diabolo-demo",
    )
    parser.add_argument(
        "--json", metavar="FILE", help="write found and concealed values as JSON; - is standard output"
    )


def packaged_recordings() -> list[Path]:
    """The recordings that come with the package: made by the project's own plant, not by its predictor."""
    with resources.as_file(resources.files("diabolo") / "recordings") as folder:
        return sorted(folder.glob("*.csv"))


def run(arguments: argparse.Namespace) -> None:
    folder = Path(arguments.out)
    outputs = [folder / name for name in (REPORT_FILE, REPLAY_FILE, RESULT_FILE, MODEL_FILE)]
    check_report(outputs[0])
    paths = packaged_recordings()
    if not paths:
        raise ValueError("this installation of diabolo came without its recordings")
    files.check_outputs([arguments.json, *outputs], paths, folder)
    takes = [load_recording(path) for path in paths]
    quiet = arguments.json == files.STDOUT
    if not quiet:
        print(introduction(takes), flush=True)
    hashes = [input_file(path) for path in paths]
    begin = time.monotonic()
    with progress_steps() as progress:
        diagnosis = diagnose(takes, BASE, progress=progress)
    answer = diagnosis.result.completed(
        seconds=time.monotonic() - begin, inputs=hashes, model=MODEL_FILE
    ).to_dict()
    concealed = concealed_in(paths[0])  # only now: nothing that was diagnosed has seen it
    replays = [replay_of(take, Model.named(BASE), diagnosis.model) for take in takes]
    texts = [
        report_html(answer, replays=replays),
        replay_html(replays[0]),
        files.json_text(answer),
        diagnosis.model.to_json(),
    ]
    with files.made_folder(folder):
        files.write_texts(dict(zip(outputs, texts, strict=True)))
    files.write_json(arguments.json, summary(answer, concealed))
    if not quiet:
        print(summary_text(answer, concealed, takes, Painter.of_terminal()))
        print(f"\nreport  {outputs[0]}\nreplay  {outputs[1]}  (before, after and recording, side by side)")
        print(NEXT)


def concealed_in(recording: Path) -> dict[str, dict[str, float]]:
    """What is at work in a recording of the plant, by its key: effects with their parameters."""
    key = json.loads(recording.with_suffix(".key.json").read_text(encoding="utf-8"))
    return {name: key["effects"][name] for name, leading in AT_WORK.items() if key["effects"][name][leading]}


# ---- what is said ----


def summary(answer: dict[str, Any], concealed: dict[str, dict[str, float]]) -> dict[str, Any]:
    """For JSON: the claims, what was concealed, and errors on held-out data."""
    fit = answer["fit"]
    return {
        "schema": "diabolo.demo/1",
        "headline": answer["headline"],
        "found": {effect["name"]: effect["parameters"] for effect in answer["effects"]},
        "concealed": concealed,
        **{key: fit[key] for key in ("heldout", "horizons_s", "base_error_m", "augmented_error_m")},
    }


class Painter:
    """Colours, where there is someone to see them."""

    def __init__(self, colored: bool) -> None:
        self.colored = colored

    @classmethod
    def of_terminal(cls) -> Painter:
        plain = bool(os.environ.get("NO_COLOR")) or os.environ.get("TERM") == "dumb"
        return cls(sys.stdout.isatty() and not plain)

    def __call__(self, text: str, color: str) -> str:
        return f"\033[{color}m{text}\033[0m" if self.colored else text


def introduction(takes: list[Recording]) -> str:
    names = " and ".join(take.name for take in takes)
    return (
        f"Recordings: {names}, {seconds_of(takes):.0f} s of play from another simulator, data/plant.\n"
        "It knows physics that our base model lacks. What that is stays concealed until the answer,\n"
        "in some ten seconds."
    )


def seconds_of(takes: list[Recording]) -> float:
    return sum(float(take.time[-1] - take.time[0]) for take in takes)


def summary_text(
    answer: dict[str, Any], concealed: dict[str, dict[str, float]], takes: list[Recording], paint: Painter
) -> str:
    said = textwrap.fill(f"{answer['headline']}: {answer['sentence']}", LINE)
    lines = ["", said.replace(answer["headline"], paint(answer["headline"], BOLD), 1), ""]
    rows = found_rows(answer, concealed, seconds_of(takes))
    header = ("", "found [90 % interval]", "concealed", "where it shows")
    widths = [max(len(row[column]) for row, _ in [(header, ""), *rows]) for column in range(3)]
    for cells, color in [(header, CYAN), *rows]:
        name, found, truth = (cell.ljust(width) for cell, width in zip(cells[:3], widths, strict=True))
        lines.append(f"  {name}  {paint(found, color)}  {truth}  {cells[3]}".rstrip())
    fit = answer["fit"]
    lines += ["", "  " + paint("mean error on each recording, held out in turn", CYAN)]
    compared = zip(fit["horizons_s"], fit["base_error_m"], fit["augmented_error_m"], strict=True)
    for horizon, before, after in compared:
        if before is not None and after is not None:
            better = paint(f"{1e3 * after:5.1f} mm", GREEN if after < before else RED)
            lines.append(f"  {f'{horizon:g} s ahead':12} {1e3 * before:6.1f} mm -> {better}")
    return "\n".join(lines)


def found_rows(
    answer: dict[str, Any], concealed: dict[str, dict[str, float]], seconds: float
) -> list[tuple[tuple[str, str, str, str], str]]:
    """Cells and a colour for each parameter that was found, and for what was missed."""
    rows = []
    for effect in answer["effects"]:
        truths = concealed.get(effect["name"])
        for index, parameter in enumerate(effect["parameters"]):
            value = number(parameter["value"], parameter["unit"], parameter["ci90"])
            truth = truths.get(parameter["name"]) if truths is not None else None
            name = words(effect["name"]) if index == 0 else f"  {words(parameter['name'])}"
            shown = "nothing" if truth is None else number(truth, parameter["unit"])
            where = place(effect, seconds) if index == 0 else ""
            rows.append(((name, value, shown, where), color_of(parameter["ci90"], truth)))
    found = [effect["name"] for effect in answer["effects"]]
    for name, truths in concealed.items():
        if name not in found:
            rows.append(((words(name), "not found", f"{truths[AT_WORK[name]]:g}", ""), RED))
    return rows


def color_of(interval: list[float] | None, truth: float | None) -> str:
    """Green where the interval holds the truth; it should in nine of ten."""
    if truth is None:
        return RED
    return GREEN if interval is not None and interval[0] <= truth <= interval[1] else YELLOW


def number(value: float, unit: str, interval: list[float] | None = None) -> str:
    return quantity(value, unit, interval).removesuffix(" (no unit)")


def place(effect: dict[str, Any], seconds: float) -> str:
    """Where an effect was located: its direction, and in how much of the play."""
    if effect["kind"] == "measurement":
        return "in what was recorded, not in the play"
    shown = sum(end - begin for begin, end in effect["where"]["intervals"])
    return f"{words(effect['where']['direction'])}, in {shown:.0f} of {seconds:.0f} s"
