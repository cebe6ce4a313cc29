# SPDX-License-Identifier: MIT
"""Puts plans to the proof on the independent plant.

Each draw of a plant is a line of the results' file; what is there is not run again, so that a run may be
ended at any time and gone on with. `small` is for every day: it exits with status 1 where it falls short.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ... import command
from .. import files, plant
from .session import GAINS, KINDS, cycles, diagnosed, draw, throws

Line = dict[str, Any]


EXAMPLE = """\
  make plant && python -m benchmarks.proof.player small
  python -m benchmarks.proof.player throws --count 100 --kind diagnosed
  python -m benchmarks.proof.player cycles --action circular_acceleration --look-every 5
  python -m benchmarks.proof.player report"""


def run(given: argparse.Namespace) -> int:
    for number in range(given.first, given.first + given.count):
        key: Line = {"what": given.what, "kind": given.kind, "seed": given.seed, "draw": number}
        if given.what == "cycles":
            key |= {"action": given.action, "rounds": given.rounds, "look_every": given.look_every}
        lines = files.read_lines(given.results)
        if any(key.items() <= line.items() for line in lines):
            continue
        line = key | drawn(given.plant, key, lines)
        files.append_line(given.results, line)
        print(text_of(line), flush=True)
    return 0


def drawn(program: Path, key: Line, before: Sequence[Line] = ()) -> Line:
    """A draw; a plant that was diagnosed in an earlier one is not diagnosed again."""
    rng = np.random.default_rng([key["seed"], key["draw"]])
    drawn_plant = draw(program, rng)
    diagnosis = None
    if key["kind"] in ("diagnosed", "guessed"):
        same = (line["diagnosis"] for line in before if _same_plant(line, key) and line["diagnosis"])
        diagnosis = next(same, None) or diagnosed(drawn_plant)
    if key["what"] == "throws":
        found = throws(drawn_plant, key["draw"], key["kind"], rng, diagnosis)
    else:
        found = cycles(drawn_plant, key["action"], key["rounds"], key["kind"], key["look_every"], diagnosis)
    return found | {"diagnosis": diagnosis}


def _same_plant(line: Line, key: Line) -> bool:
    return bool(line["seed"] == key["seed"] and line["draw"] == key["draw"])


def text_of(line: Line) -> str:
    if line["what"] == "cycles":
        return (
            f"{line['action']}, {line['kind']}, draw {line['draw']}: {line['done']} of {line['rounds']} "
            f"cycles, spin at the end {line['end_spin']:.0f} rad/s"
        )

    def outcome(which: str) -> str:
        one = line[which]
        if one["apex"] is None:
            return f"{which}: {line[f'{which}_error']}"
        return (
            f"{which}: {one['apex']:.3f} m, {one['place'] - line['sideways']:+.3f} m aside, "
            f"{'caught' if one['caught'] else 'lost'}"
        )

    asked = f"{line['kind']}, draw {line['draw']}: asked {line['height']:.2f} m"
    return f"{asked}; {outcome('first')}; {outcome('corrected')}"


def wilson(count: int, of: int) -> tuple[float, float]:
    """95 % interval of a share."""
    z, share = 1.96, count / of
    middle, square = share + z * z / (2 * of), z * np.sqrt(share * (1 - share) / of + z * z / (4 * of * of))
    return (middle - square) / (1 + z * z / of), (middle + square) / (1 + z * z / of)


def share_text(found: Iterable[bool]) -> str:
    several = list(found)
    low, high = wilson(sum(several), len(several))
    return f"{sum(several)} of {len(several)} [{100 * low:.0f}, {100 * high:.0f}] %"


def errors(lines: list[Line], which: str) -> tuple[list[float], list[float], list[bool]]:
    """Relative errors of the height, those of the place [m], what was caught; a missed throw is infinite."""

    def of(line: Line, what: str, wanted: float) -> float:
        found = line[which][what]
        return np.inf if found is None else abs(found - wanted)

    heights = [of(line, "apex", line["height"]) / line["height"] for line in lines]
    places = [of(line, "place", line["sideways"]) for line in lines]
    return heights, places, [line[which]["caught"] for line in lines]


def report(given: argparse.Namespace) -> int:
    lines = files.read_lines(given.results)
    print(
        "| planner knows | throws | height within 5 % | within 20 % | median | landing within 5 cm | median "
        "| caught |"
    )
    print("|---|---|---|---|---|---|---|---|")
    for kind in KINDS:
        thrown = [line for line in lines if line["what"] == "throws" and line["kind"] == kind]
        for which in ("first", "corrected") if thrown else ():
            heights, places, caught = errors(thrown, which)
            print(
                f"| {kind}, {which} | {len(thrown)} | {share_text(h <= 0.05 for h in heights)} "
                f"| {share_text(h <= 0.2 for h in heights)} | {100 * np.median(heights):.1f} % "
                f"| {share_text(p <= 0.05 for p in places)} | {100 * np.median(places):.1f} cm "
                f"| {share_text(caught)} |"
            )
    for line in lines:
        if line["what"] == "cycles":
            print(text_of(line) + f", a look every {line['look_every']}")
    return 0


def small(given: argparse.Namespace) -> int:
    """Three throws and four cycles; the least that they must come to."""
    seed = given.seed
    thrown = [
        {"what": "throws", "kind": kind, "seed": seed, "draw": number}
        for number, kind in enumerate(("truth", "spread", "truth"))
    ]
    lines = [key | drawn(given.plant, key) for key in thrown]
    heights, _, caught = errors(lines, "corrected")
    turned: Line = {
        "what": "cycles",
        "kind": "truth",
        "seed": seed,
        "draw": 3,
        "action": "linear_acceleration",
        "rounds": 4,
        "look_every": 4,
    }
    lines.append(turned | drawn(given.plant, turned))
    for line in lines:
        print(text_of(line))
    known = [height for height, line in zip(heights, lines, strict=False) if line["kind"] == "truth"]
    short = [
        what
        for what, good in (
            ("a throw was not caught", all(caught)),
            ("a height is off by more than 5 %", max(known) <= 0.05),
            ("a height of the spread is off by more than 20 %", max(heights) <= 0.2),
            ("cycles were lost", lines[-1]["done"] == 4),
            ("the cycles gained less than 10 rad/s", lines[-1]["end_spin"] >= 70.0),
        )
        if not good
    ]
    print("short of the mark: " + "; ".join(short) if short else "all that must be reached is")
    return 1 if short else 0


def make_parser() -> argparse.ArgumentParser:
    parser = command.make_parser("benchmarks.proof.player", __doc__, EXAMPLE)
    parser.add_argument("what", choices=("throws", "cycles", "report", "small"))
    plant.add_option(parser)
    parser.add_argument("--results", type=Path, default=Path("build/proof/player.jsonl"))
    parser.add_argument("--count", type=int, default=15, help="draws of a plant")
    parser.add_argument("--first", type=int, default=0, help="number of the first draw")
    parser.add_argument("--kind", choices=KINDS, default="diagnosed", help="what the planner knows")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--action", choices=tuple(GAINS), default="linear_acceleration", help="of cycles")
    parser.add_argument("--rounds", type=int, default=20, help="cycles of a draw")
    parser.add_argument("--look-every", type=int, default=20, help="so many cycles")
    return parser


def act(given: argparse.Namespace) -> int:
    if given.what == "report":
        return report(given)
    plant.check(given.plant)
    return small(given) if given.what == "small" else run(given)


if __name__ == "__main__":
    sys.exit(command.run(make_parser(), act))
