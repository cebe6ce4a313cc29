# SPDX-License-Identifier: MIT
"""Draws recordings with known truth from the project's plant, diagnoses them, and scores the answers.

`quick` makes a few cases that are not sealed. A sealed proof goes seal, run, score, page; the commit of the
tool gives the seed, so that no batch can be chosen.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from diabolo.checks import LARGEST_SEED, whole_number
from diabolo.cli.arguments import progress_steps
from diabolo.files import check_outputs

from ... import command
from .. import plant
from . import commands, strangers, tools

BUILD = Path("build/proof/diagnosis")
QUICK_CASES, SEALED_CASES, PAIRS, OWN_CASES = 24, 600, 30, 40
EXAMPLE = """\
  make plant && python -m benchmarks.proof.diagnosis quick --cases 24
  python -m benchmarks.proof.diagnosis strangers --cases 14
  python -m benchmarks.proof.diagnosis own-laws --cases 40
  python -m benchmarks.proof.diagnosis simulators --cases 30
  python -m benchmarks.proof.diagnosis seal next --cases 600       # then commit batches/next.json
  python -m benchmarks.proof.diagnosis run next --minutes 60       # goes on where it was stopped
  python -m benchmarks.proof.diagnosis score next && python -m benchmarks.proof.diagnosis page next
  python -m benchmarks.proof.diagnosis score fifteenth              # again from its record"""


def make_parser() -> argparse.ArgumentParser:
    parser = command.make_parser("benchmarks.proof.diagnosis", __doc__, EXAMPLE)
    actions = parser.add_subparsers(dest="what", metavar="ACTION", required=True)
    _add_quick(actions.add_parser("quick", help="a few cases, not sealed: make, diagnose and score them"))
    _add_strangers(
        actions.add_parser("strangers", help="laws that no name stands for: is the answer silent about one?")
    )
    _add_own_laws(
        actions.add_parser("own-laws", help="formulas of a user's own: named where they are at work alone?")
    )
    _add_simulators(
        actions.add_parser("simulators", help="plants with half of their physics: is what they lack named?")
    )
    for name, summary in (
        ("seal", "draw a batch, and publish the hashes of its keys"),
        ("run", "diagnose the recordings of a batch; goes on where it was stopped"),
        ("score", "open the keys of a batch and score the answers; again from its record where it has one"),
        ("page", "write the page of a batch's scores"),
        ("retire", "keep of a batch its seed, its hash and its scores alone"),
    ):
        _add_action(actions.add_parser(name, help=summary, description=summary), name)
    return parser


def _add_quick(parser: argparse.ArgumentParser) -> None:
    parser.description = (
        "Exit status 1 where a score is off its bound by more than its interval allows, "
        "or more than 3 % of the strangers that stand out are met with silence."
    )
    parser.add_argument("--cases", metavar="N", type=int, default=QUICK_CASES, help=f"default: {QUICK_CASES}")
    parser.add_argument("--seed", metavar="N", type=int, default=1, help="of the cases; default: 1")
    _add_making(parser)
    _add_tool(parser)
    _add_json(parser)


def _add_strangers(parser: argparse.ArgumentParser) -> None:
    parser.description = "Exit status as of quick."
    kinds = len(strangers.KINDS)
    parser.add_argument("--cases", metavar="N", type=int, default=kinds, help=f"default: {kinds}, one a kind")
    parser.add_argument("--seed", metavar="N", type=int, default=1, help="of the cases; default: 1")
    _add_making(parser)
    _add_tool(parser)
    _add_json(parser)


def _add_own_laws(parser: argparse.ArgumentParser) -> None:
    parser.description = "Exit status 1 where less than 95 % are named, or one is claimed that is not there."
    parser.add_argument(
        "--cases", metavar="N", type=int, default=OWN_CASES, help=f"with and without; default: {OWN_CASES}"
    )
    parser.add_argument("--seed", metavar="N", type=int, default=1, help="of the cases; default: 1")
    plant.add_option(parser)
    _add_json(parser)


def _add_simulators(parser: argparse.ArgumentParser) -> None:
    parser.description = "Exit status 1 where all that was switched off is named in less than nine of ten."
    parser.add_argument("--cases", metavar="N", type=int, default=PAIRS, help=f"default: {PAIRS}")
    parser.add_argument("--seed", metavar="N", type=int, default=1, help="of the cases; default: 1")
    plant.add_option(parser)
    _add_json(parser)


def _add_action(parser: argparse.ArgumentParser, name: str) -> None:
    parser.add_argument("name", metavar="NAME", help="of the batch")
    if name in ("seal", "run", "score"):
        _add_making(parser)
    if name in ("run", "score"):
        _add_tool(parser)
    if name == "seal":
        parser.add_argument(
            "--cases", metavar="N", type=int, default=SEALED_CASES, help=f"default: {SEALED_CASES}"
        )
    if name == "run":
        parser.add_argument(
            "--minutes", metavar="M", type=float, default=math.inf, help="begin no new case after so long"
        )
    if name == "score":
        _add_json(parser)
    if name == "page":
        parser.add_argument("--out", metavar="FILE", type=Path, default=Path("docs/proof.md"))


def _add_making(parser: argparse.ArgumentParser) -> None:
    plant.add_option(parser)
    parser.add_argument("--jobs", metavar="N", type=int, default=1, help="plants at once; default: 1")


def _add_tool(parser: argparse.ArgumentParser) -> None:
    others = ", ".join(name for name in tools.TOOLS if name != commands.DIAGNOSE)
    parser.add_argument(
        "--tool",
        metavar="TOOL",
        default=commands.DIAGNOSE,
        help=f"diagnose (default), or a baseline: {others}",
    )


def _add_json(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", metavar="FILE", type=Path, help="write the scores as JSON, too")


def act(given: argparse.Namespace) -> int:
    for option, least, most in (("cases", 1, 9999), ("jobs", 1, 256), ("seed", 0, LARGEST_SEED)):
        if hasattr(given, option):
            whole_number(f"--{option}", getattr(given, option), least, most)
    commands.tool_named(getattr(given, "tool", commands.DIAGNOSE))
    if not getattr(given, "minutes", math.inf) > 0.0:
        raise ValueError(f"--minutes: {given.minutes}; expected more than 0")
    sources = Path(__file__).parent
    check_outputs(
        [getattr(given, "json", None), getattr(given, "out", None)], (sources / "batches").iterdir()
    )
    with progress_steps() as report:
        places = commands.Places(sources, BUILD, getattr(given, "plant", plant.PROGRAM), report)
        return ACTIONS[given.what](places, given)


ACTIONS: dict[str, Callable[[commands.Places, argparse.Namespace], int]] = {
    "quick": lambda at, g: commands.quick(at, g.cases, g.seed, g.tool, g.jobs, g.json),
    "strangers": lambda at, g: commands.meet_strangers(at, g.cases, g.seed, g.tool, g.jobs, g.json),
    "own-laws": lambda at, g: commands.give_own_laws(at, g.cases, g.seed, g.json),
    "simulators": lambda at, g: commands.compare_simulators(at, g.cases, g.seed, g.json),
    "seal": lambda at, g: commands.seal_batch(at, g.name, g.cases, g.jobs),
    "run": lambda at, g: commands.run_batch(at, g.name, g.tool, g.minutes, g.jobs),
    "score": lambda at, g: commands.score_batch(at, g.name, g.tool, g.jobs, g.json),
    "page": lambda at, g: commands.write_page(at, g.name, g.out),
    "retire": lambda at, g: commands.retire_batch(at, g.name),
}


def main(arguments: Sequence[str] | None = None) -> int:
    return command.run(make_parser(), act, arguments)


if __name__ == "__main__":
    sys.exit(main())
