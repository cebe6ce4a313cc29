# SPDX-License-Identifier: MIT
"""`diabolo prove`: the diagnosis on concealed data; what it runs lies in benchmarks/concealed."""

from __future__ import annotations

import argparse
import importlib
import math
import sys
from pathlib import Path
from typing import Any

from ..checks import LARGEST_SEED, whole_number
from . import files
from .arguments import add_command, progress_steps

SOURCES, BUILD, PLANT = "benchmarks/concealed", "build/concealed", "build/plant/diabolo-plant"
QUICK_CASES, SEALED_CASES = 24, 600


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "prove",
        run=run,
        summary="put the diagnosis to the proof on recordings whose truth it cannot see",
        text="Draw recordings with known truth from the project's plant, diagnose and score them.\n"
        "Without a subcommand, or with `quick`: a few cases that are not sealed. A sealed proof goes\n"
        "seal, run, score, page; the batch's seed is the commit of the tool. Needs the project's sources.",
        example="  make test-plant && diabolo prove quick --cases 24\n"
        "  diabolo prove seal first --cases 600 && diabolo prove run first && diabolo prove score first",
    )
    _add_places(parser, suppress=False)
    _add_quick(parser, suppress=False)
    parser.set_defaults(what="quick")
    actions = parser.add_subparsers(metavar="ACTION", parser_class=type(parser))

    def add(name: str, summary: str) -> argparse.ArgumentParser:
        action: argparse.ArgumentParser = actions.add_parser(
            name, help=summary, description=summary, allow_abbrev=False
        )
        _add_places(action, suppress=True)
        action.set_defaults(what=name)
        return action

    _add_quick(
        add("quick", "make, diagnose and score a few cases; exit status 1 where a score is off its bound"),
        True,
    )
    for name, summary in (
        ("seal", "draw a batch, and publish the hashes of its keys"),
        ("run", "diagnose the recordings of a batch; goes on where it was stopped"),
        ("score", "open the keys of a batch, and score the answers"),
        ("page", "write the page of a batch's scores"),
    ):
        action = add(name, summary)
        action.add_argument("name", metavar="NAME", help="of the batch")
        if name == "seal":
            _add_cases(action, suppress=True)
        if name in ("run", "score"):
            _add_tool(action, suppress=True)
            _add_jobs(action, suppress=True)
        if name == "run":
            action.add_argument(
                "--minutes",
                metavar="M",
                type=float,
                default=math.inf,
                help="begin no new case after so long",
            )
        if name == "score":
            _add_json(action, suppress=True)
        if name == "page":
            action.add_argument(
                "--out", metavar="FILE", default="docs/proof.md", help="default: docs/proof.md"
            )


def _default(value: Any, suppress: bool) -> Any:
    """Of options that a subcommand shares with `prove` itself, which keeps the default."""
    return argparse.SUPPRESS if suppress else value


def _add_places(parser: argparse.ArgumentParser, suppress: bool) -> None:
    parser.add_argument(
        "--sources", metavar="DIR", default=_default(SOURCES, suppress), help=f"default: {SOURCES}"
    )
    parser.add_argument(
        "--plant",
        metavar="FILE",
        default=_default(PLANT, suppress),
        help=f"the plant's program; default: {PLANT}",
    )


def _add_cases(parser: argparse.ArgumentParser, suppress: bool) -> None:
    parser.add_argument(
        "--cases",
        metavar="N",
        type=int,
        default=_default(None, suppress),
        help=f"default: {QUICK_CASES} for quick, {SEALED_CASES} for seal",
    )
    _add_jobs(parser, suppress)


def _add_jobs(parser: argparse.ArgumentParser, suppress: bool) -> None:
    parser.add_argument(
        "--jobs", metavar="N", type=int, default=_default(1, suppress), help="plants at once; default: 1"
    )


def _add_tool(parser: argparse.ArgumentParser, suppress: bool) -> None:
    parser.add_argument(
        "--tool",
        metavar="TOOL",
        default=_default("diagnose", suppress),
        help="diagnose (default), or a baseline: no_faults, parameter_fit, bic, sindy",
    )


def _add_json(parser: argparse.ArgumentParser, suppress: bool) -> None:
    parser.add_argument(
        "--json", metavar="FILE", default=_default(None, suppress), help="write the scores as JSON, too"
    )


def _add_quick(parser: argparse.ArgumentParser, suppress: bool) -> None:
    _add_cases(parser, suppress)
    parser.add_argument(
        "--seed", metavar="N", type=int, default=_default(1, suppress), help="of the cases; default: 1"
    )
    _add_tool(parser, suppress)
    _add_json(parser, suppress)


def load_commands(sources: Path) -> Any:
    """The module that does it all. Raises ValueError where it is not there."""
    if not (sources / "commands.py").is_file():
        raise ValueError(
            f"{sources}: the sources of the proof are not there; run this in the project's root, or name "
            "them by --sources"
        )
    sys.path.insert(0, str(sources.absolute().parent))
    try:
        commands = importlib.import_module(f"{sources.absolute().name}.commands")
    except (ImportError, SyntaxError) as error:
        raise ValueError(f"{sources}: not the sources of the proof ({error})") from error
    if not hasattr(commands, "Places"):
        raise ValueError(f"{sources}: not the sources of the proof (its commands.py is another)")
    return commands


def run(arguments: argparse.Namespace) -> None:
    sources = Path(arguments.sources)
    commands = load_commands(sources)
    cases = {"quick": QUICK_CASES, "seal": SEALED_CASES}.get(arguments.what, 0)
    cases = arguments.cases if arguments.cases is not None else cases
    if arguments.what in ("quick", "seal"):
        whole_number("--cases", cases, 1, 9999)
    whole_number("--jobs", arguments.jobs, 1, 256)
    whole_number("--seed", arguments.seed, 0, LARGEST_SEED)
    minutes = getattr(arguments, "minutes", math.inf)
    if not minutes > 0.0:
        raise ValueError(f"--minutes: {minutes}; expected more than 0")
    name = getattr(arguments, "name", None)
    own = [path for folder in ("batches", "results") for path in (sources / folder).glob(f"{name}.*")]
    files.check_outputs([arguments.json, getattr(arguments, "out", None)], own)
    with progress_steps() as report:
        places = commands.Places(sources, Path(BUILD), Path(arguments.plant), report)
        status = _act(commands, places, arguments, cases, minutes)
    if status != 0:
        raise SystemExit(status)


def _act(commands: Any, places: Any, arguments: argparse.Namespace, cases: int, minutes: float) -> int:
    json_file = None if arguments.json is None else Path(arguments.json)
    what = arguments.what
    if what == "quick":
        status = commands.quick(places, cases, arguments.seed, arguments.tool, arguments.jobs, json_file)
    elif what == "seal":
        status = commands.seal_batch(places, arguments.name, cases, arguments.jobs)
    elif what == "run":
        status = commands.run_batch(places, arguments.name, arguments.tool, minutes, arguments.jobs)
    elif what == "score":
        status = commands.score_batch(places, arguments.name, arguments.tool, arguments.jobs, json_file)
    else:
        status = commands.write_page(places, arguments.name, Path(arguments.out))
    return int(status)
