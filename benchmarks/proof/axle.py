# SPDX-License-Identifier: MIT
"""Does a diagnosis say what turns the axle? On plants whose hands leave it free.

Half of the plants have a groove whose flanks the string climbs, half have cups of unlike weight, a quarter
both; the gain of the strands' levers is each plant's own, and all rub. Cameras have the small faults that
no measurement is without.

A law that is there is found where it is claimed, or said to be there and too small to matter; one that is
not there must be neither.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import diabolo
import numpy as np
from diabolo.checks import LARGEST_SEED, whole_number

from .. import command
from . import plant
from .diagnosis import base
from .diagnosis.sizes import either_sign, log_uniform, merged

EXAMPLE = "  make plant && python -m benchmarks.proof.axle --cases 24"
LAWS = ("gyroscopic_tilt", "groove", "unbalance")
HALF_WIDTH = 0.008  # of every groove [m]
LEAST_SHARE = 0.7  # of the laws that are there shall be found
MOST_FALSE = 0.1  # of those that are not there may be


class Case(NamedTuple):
    """What a plant is, and what its axle does by the laws' names."""

    scenario: dict[str, Any]
    truth: dict[str, float]


class Told(NamedTuple):
    """Of one law: whether it is there, was said to be there and was claimed; whether its interval holds the
    truth."""

    law: str
    truth: float
    estimate: float
    sure: bool
    claimed: bool
    holds: bool


class Answer(NamedTuple):
    """What a diagnosis said, and the mean error of the axle's direction before and after [deg]."""

    laws: list[Told]
    before: float
    after: float


def draw(number: int, seed: int) -> Case:
    rng = np.random.default_rng([seed, number])
    profile = rng.uniform(0.002, 0.01) if number % 2 else 0.0
    offset = either_sign(rng) * log_uniform(rng, 4e-4, 2e-3) if number // 2 % 2 else 0.0
    body = base.body_and_camera(rng, "springs")
    own = {
        "diabolo": {"groove_radius": profile, "groove_half_width": HALF_WIDTH, "groove_offset": -offset},
        "string": {"friction": rng.uniform(0.08, 0.3)},
        "player": {"catches": True, "steers": False},
    }
    scenario = merged(merged(body, own), base.play(rng, "lively", throws=False))
    diabolo_, string = scenario["diabolo"], scenario["string"]
    lever = diabolo_["axle_radius"] + string["radius"]
    gain = diabolo_["mass"] * lever / diabolo_["axial_inertia"]
    return Case(scenario, {"gyroscopic_tilt": gain, "groove": profile, "unbalance": offset})


def told_of(result: diabolo.DiagnosisResult, law: str, truth: float) -> Told:
    rung = next(rung for rung in result.ladder if rung.name == law)
    claim = next((effect for effect in result.effects if effect.name == law), None)
    sure = claim is not None or rung.reason.endswith("too small to matter")
    interval = claim.parameters[0].ci90 if claim else None
    holds = interval is not None and interval.low <= truth <= interval.high
    return Told(law, truth, rung.estimate, sure, claim is not None, holds)


def ask(case: Case, program: Path) -> Answer | None:
    """None where the plant cannot play it: the diabolo falls over, or off its string."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "play.csv"
        try:
            plant.play(program, case.scenario, file)
        except (plant.FailedError, plant.RefusedError):
            return None
        result = diabolo.diagnose([diabolo.load_recording(file)], threads=1).result
    fit = result.fit
    before, after = np.degrees(np.array([fit.base_axle_error_rad, fit.augmented_axle_error_rad], float))
    return Answer([told_of(result, law, case.truth[law]) for law in LAWS], float(before), float(after))


def line_of(told: Told) -> str:
    unit, factor = ("1/m", 1.0) if told.law == "gyroscopic_tilt" else ("mm", 1e3)
    said = "claimed" if told.claimed else "there" if told.sure else "not told"
    estimate = f"{factor * told.estimate:.2f}" if told.sure else "-"
    return f"{told.law} {factor * told.truth:.2f} {unit}: {said}, {estimate}"


def answers(given: argparse.Namespace) -> Iterator[tuple[int, Answer | None]]:
    with ThreadPoolExecutor(given.jobs) as pool:
        cases = [draw(number, given.seed) for number in range(given.cases)]
        yield from enumerate(pool.map(lambda case: ask(case, given.plant), cases))


def run(given: argparse.Namespace) -> int:
    for option, least, most in (("cases", 1, 9999), ("jobs", 1, 256), ("seed", 0, LARGEST_SEED)):
        whole_number(f"--{option}", getattr(given, option), least, most)
    plant.check(given.plant)
    told: list[Told] = []
    errors = []
    for number, answer in answers(given):
        if answer is None:
            print(f"{number}: cannot be played to its end")
            continue
        print(
            f"{number}: {'; '.join(map(line_of, answer.laws))}; "
            f"axle {answer.before:.1f} -> {answer.after:.1f} deg",
            flush=True,
        )
        told += answer.laws
        errors.append((answer.before, answer.after))
    if not errors:
        raise ValueError(f"none of {given.cases} plants could be played to its end; expected one at least")
    there, absent = [one for one in told if one.truth], [one for one in told if not one.truth]
    claims = [one for one in there if one.claimed]
    found, false = sum(one.sure for one in there), sum(one.sure for one in absent)
    before, after = np.median(errors, axis=0)
    sizes = [abs(one.estimate / one.truth - 1.0) for one in there if one.sure]
    held = sum(one.holds for one in claims)
    print(
        f"found {found} of {len(there)} laws that are there; said {false} of {len(absent)} that are not\n"
        f"sizes of those found: off by {np.median(sizes or [np.nan]):.1%} in the median\n"
        f"claimed: {len(claims)}, the 90 % interval holds the truth in {held}\n"
        f"the axle's direction on data not fitted: {before:.1f} -> {after:.1f} deg in the middle plant"
    )
    good = found >= LEAST_SHARE * len(there) and false <= MOST_FALSE * len(absent) and after < 0.5 * before
    return 0 if good else 1


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.proof.axle", __doc__, EXAMPLE)
    parser.add_argument("--cases", metavar="N", type=int, default=8, help="plants; default: 8")
    parser.add_argument("--seed", metavar="N", type=int, default=1, help="of the plants; default: 1")
    parser.add_argument("--jobs", metavar="N", type=int, default=2, help="plants at a time; default: 2")
    plant.add_option(parser)
    return command.run(parser, run, arguments)


if __name__ == "__main__":
    sys.exit(main())
