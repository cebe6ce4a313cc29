# SPDX-License-Identifier: MIT
"""What several commands understand: recordings with excerpts, models, calibrations, progress."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .._core import Calibration, Model, Recording, StickArm
from ..arms import SIDES
from ..checks import shown
from ..evaluation import DEFAULT_MODELS
from ..excerpt import Excerpt
from ..files import STDOUT
from ..formats import load_recording

CALIBRATIONS = {"published": Calibration.published, "blue": Calibration.blue}
SHOWN_BODIES = {"left": "left tip", "right": "right tip", "diabolo": "diabolo"}
TIPS, BODIES = tuple(SHOWN_BODIES)[:2], tuple(SHOWN_BODIES)
OF_RECORDINGS = ("calibration", "up", "columns", "topics")
"""Options that say how a recording is read, but for --arms."""
FARTHEST_BASE = 100.0
"""An arm stands no farther from the world's origin [m]."""
FILE_HELP = (
    "a Motive export, a tidy recording, a CSV of your own (--columns), a bag of ROS, C3D, or another of "
    "docs/recordings.md"
)
RECORDING_HELP = f"{FILE_HELP}; NAME.csv:0-180 takes the rows 0 to 180 of it only"


def add_command(
    commands: Any,
    name: str,
    *,
    run: Callable[[argparse.Namespace], int | None],
    summary: str,
    text: str,
    example: str,
) -> argparse.ArgumentParser:
    """A subcommand whose help teaches it by example."""
    parser: argparse.ArgumentParser = commands.add_parser(
        name,
        help=summary,
        description=text,
        epilog=f"example:\n{example}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.set_defaults(run=run)
    return parser


def add_calibration(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--calibration",
        metavar="NAME",
        help="where tips and diabolo sit in the rigid bodies of Motive exports: a file "
        "(diabolo.calibration/1), or the authors' for their red or their blue diabolo: published (default) "
        "or blue",
    )
    parser.add_argument(
        "--up",
        metavar="AXIS",
        help="which axis of the file points up: x, y (Motive's default), z, -x, -y or -z, with -mirrored "
        "behind it for a left-handed frame; default: z, and a motion that clearly says otherwise is refused",
    )
    parser.add_argument(
        "--columns",
        metavar="LIST",
        help="map a CSV of your own: time=t[ms],left_x=lx[mm],..., each TIDY=NAME or TIDY=NAME[UNIT] "
        "with s, ms, us, ns, m, cm, mm, in or ft",
    )
    parser.add_argument(
        "--topics",
        metavar="LIST",
        help="which topics or bodies of a bag, C3D, Vicon's or Qualisys' file are the tips and the diabolo: "
        "left=NAME,right=NAME,diabolo=NAME; default: by their names",
    )
    parser.add_argument(
        "--arms",
        metavar=("HEIGHT", "SPACING", "FORWARD"),
        nargs=3,
        type=float,
        help="where two UR5e stand whose joints a bag tells of: height, distance and x of their bases [m]; "
        "default 0.7 1.1 0",
    )


def add_playing(parser: argparse.ArgumentParser, verb: str) -> None:
    """What agents play with: the models, what they see, and their limits."""
    parser.add_argument(
        "--model",
        metavar="NAME",
        nargs="+",
        action="extend",
        help=f"to {verb} on: consistent, paper, published or model files; of several, each episode draws "
        "one; default: consistent with a string that rubs on the axle",
    )
    parser.add_argument(
        "--difficulty",
        choices=("easy", "real", "sealed"),
        default="easy",
        help="what the agent sees: the exact state (easy, default), or what a camera would (real); sealed: "
        "that, and models that a diagnosis leaves open, without --model",
    )
    parser.add_argument(
        "--limits",
        choices=("player", "ur5e"),
        default="player",
        help="of the hands: a player's (default), or those of the paper's two UR5e",
    )


def check_task(task: str, tasks: tuple[str, ...]) -> None:
    """Raise ValueError where there is no such task."""
    if task not in tasks:
        raise ValueError(f"TASK {shown(task)}; expected one of {', '.join(tasks)}")


def output_name(text: str) -> str:
    """The name of a file or folder to write, as argparse takes it."""
    if text in ("", STDOUT):
        raise argparse.ArgumentTypeError(f"{text!r}; expected a name; standard output is for --json only")
    return text


def split_excerpt(text: str) -> tuple[str, tuple[int, int] | None]:
    """The file and the rows of NAME.csv:0-180; a file that has such a name itself comes first."""
    if Path(text).exists():
        return text, None
    file, _, rows = text.rpartition(":")
    if match := re.fullmatch(r"([0-9]{1,9})-([0-9]{1,9})", rows):
        return file, (int(match[1]), int(match[2]))
    if Path(file).is_file():
        raise ValueError(f"{text}: '{rows}'; expected the rows FIRST-LAST, as in {file}:0-180")
    return text, None


@dataclass(frozen=True)
class Reading:
    """How recordings are read: what their files do not say of themselves."""

    calibration: Calibration | None
    up: str | None
    columns: str | None
    topics: str | None
    arms: list[StickArm] | None

    def load(self, path: str) -> Recording:
        return load_recording(
            path,
            self.calibration,
            up=self.up,
            columns=self.columns,
            topics=self.topics,
            arms=self.arms,
        )


def reading_of(arguments: argparse.Namespace) -> Reading:
    path = arguments.calibration
    calibration = None if path is None else CALIBRATIONS.get(path, lambda: Calibration.load(path))()
    arms = arms_of(arguments)
    return Reading(calibration, arguments.up, arguments.columns, arguments.topics, arms)


def check_not_given(arguments: argparse.Namespace, options: Sequence[str], why: str) -> None:
    """Raise ValueError about the first of these options that is given."""
    for option in options:
        if getattr(arguments, option) is not None:
            raise ValueError(f"--{option}: it says how a recording is read; {why}")


def arms_of(arguments: argparse.Namespace) -> list[StickArm] | None:
    """The arms of --arms; None without it."""
    if arguments.arms is None:
        return None
    if far := [one for one in arguments.arms if abs(one) > FARTHEST_BASE]:
        raise ValueError(f"--arms: {far[0]:g} m; expected at most {FARTHEST_BASE:g} m")
    try:
        return [StickArm(side, *arguments.arms) for side in SIDES]
    except ValueError as error:
        raise ValueError(f"--arms: {error}") from None


def read_excerpt(text: str, reading: Reading, needs: Sequence[str] = ()) -> Excerpt:
    """The recording that an argument names, and its rows. Raises ValueError where one of the bodies that it
    `needs` is never seen."""
    path, rows = split_excerpt(text)
    recording = reading.load(path)
    for body in needs:
        if not getattr(recording, f"{body}_valid").any():
            raise ValueError(f"{path}: the {SHOWN_BODIES[body]} is never seen; expected its positions")
    first, last = rows if rows is not None else (0, len(recording) - 1)
    recording.cut(first, last)  # complains about rows that are not there
    return Excerpt(recording, first, last)


def read_model(text: str) -> Model:
    if text in DEFAULT_MODELS:
        return Model.named(text)
    if not Path(text).exists():
        raise ValueError(f"model {text}: no such file; expected {', '.join(DEFAULT_MODELS)} or a model file")
    return Model.load(text)


@contextmanager
def progress_steps() -> Iterator[Callable[[str, float], None]]:
    """A function to call with a step's name and the fraction done; draws a bar where there is a terminal."""
    from tqdm import tqdm  # type: ignore[import-untyped]

    layout = "{percentage:3.0f} %|{bar}| {elapsed} {desc}"
    disable = sys.stderr is None or None  # None: where it is no terminal
    with tqdm(total=1.0, bar_format=layout, leave=False, disable=disable, file=sys.stderr) as bar:

        def report(step: str, fraction: float) -> None:
            bar.set_description_str(step, refresh=False)
            bar.update(fraction - bar.n)

        yield report


@contextmanager
def progress_bar(description: str) -> Iterator[Callable[[float], None]]:
    """The same for work of a single step: a function to call with the fraction done."""
    with progress_steps() as report:
        yield lambda fraction: report(description, fraction)
