# SPDX-License-Identifier: MIT
"""What a diagnosis of long takes costs, with and without a budget: seconds and the most memory."""

from __future__ import annotations

import argparse
import itertools
import json
import multiprocessing
import resource
import sys
import tempfile
import time
import warnings
from pathlib import Path
from typing import NamedTuple

import numpy as np
from diabolo import Recording, RecordingWarning, diagnose, load_recording
from numpy.typing import NDArray

from .. import command
from ..proof import plant

SCENARIOS = sorted(
    path
    for path in (Path(__file__).parents[2] / "data" / "recordings").glob("*.scenario.json")
    if not path.name.startswith("puzzle_")  # those of the demo, of other plants
)
UNSEEN = 0.5
"""Between the plays that make one take [s]."""


class Cost(NamedTuple):
    """Of one diagnosis."""

    seconds: float
    processor_seconds: float
    megabytes: float
    """The most that the process had, the recording included."""
    fitted: int
    """Windows."""
    answer: list[str]
    left: int
    """Things that were not done."""


def play(program: Path, scenario: Path, seed: int, folder: Path) -> Path:
    """A play of the plant, the same motion for each camera's seed."""
    out = folder / f"{seed}.csv"
    plant.play(program, json.loads(scenario.read_text()) | {"seed": seed}, out)
    return out


def plays(program: Path, minutes: float, folder: Path) -> list[Path]:
    """As many plays as make a take of this length."""
    files: list[Path] = []
    seconds = 0.0
    for seed, scenario in zip(itertools.count(1000), itertools.cycle(SCENARIOS), strict=False):
        if seconds >= 60.0 * minutes:
            break
        files.append(play(program, scenario, seed, folder))
        seconds += float(load_recording(files[-1]).time[-1]) + UNSEEN
    return files


def joined(files: list[Path], minutes: float) -> Recording:
    """One take of plays, between which nothing is seen."""
    takes = [load_recording(file) for file in files]
    rate = takes[0].rate
    rows, gap = int(60.0 * minutes * rate), int(UNSEEN * rate)

    def track(name: str, width: int) -> NDArray[np.float64]:
        unseen = np.full((gap, width), np.nan)
        parts = [part for take in takes for part in (getattr(take, name), unseen)]
        return np.ascontiguousarray(np.concatenate(parts)[:rows])

    orientations = ("diabolo_orientation", "left_orientation", "right_orientation")
    left = track("left", 3)
    return Recording(
        np.arange(len(left)) / rate,
        left,
        track("right", 3),
        track("diabolo", 3),
        rate,
        name=f"{minutes:g} minutes",
        string_length=takes[0].string_length,
        properties=takes[0].properties,
        **{name: track(name, 4) for name in orientations},
    )


def cost(files: list[Path], minutes: float, budget: float, threads: int) -> Cost:
    warnings.simplefilter("ignore", RecordingWarning)
    take = joined(files, minutes)
    begin, processor = time.monotonic(), time.process_time()
    answer = diagnose(take, budget=budget, threads=threads)
    return Cost(
        time.monotonic() - begin,
        time.process_time() - processor,
        resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
        len(answer.result.locate.windows),
        [effect.name for effect in answer.effects],
        len(answer.result.not_done),
    )


def make_parser() -> argparse.ArgumentParser:
    parser = command.make_parser(
        "benchmarks.speed.long_takes",
        __doc__,
        "  make plant && python -m benchmarks.speed.long_takes --minutes 4 --budgets 30",
    )
    plant.add_option(parser)
    parser.add_argument("--minutes", nargs="+", type=float, default=[1.0, 4.0, 20.0])
    parser.add_argument("--budgets", nargs="+", type=float, default=[5.0, 30.0, 1e9])
    parser.add_argument("--threads", type=int, default=2)
    return parser


def act(given: argparse.Namespace) -> int:
    plant.check(given.plant)
    print("| minutes | budget | seconds | of processors | memory | windows | answer | not done |")
    print("|---|---|---|---|---|---|---|---|")
    with (
        tempfile.TemporaryDirectory() as folder,
        multiprocessing.get_context("spawn").Pool(1, maxtasksperchild=1) as pool,
    ):
        files = plays(given.plant, max(given.minutes), Path(folder))
        for minutes, budget in itertools.product(given.minutes, given.budgets):
            spent = Cost(*pool.apply(cost, (files, minutes, budget, given.threads)))
            print(
                f"| {minutes:g} | {'none' if budget >= 1e9 else f'{budget:g} s'} | {spent.seconds:.1f} "
                f"| {spent.processor_seconds:.1f} | {spent.megabytes:.0f} MB | {spent.fitted} "
                f"| {', '.join(spent.answer)} | {spent.left} |",
                flush=True,
            )
    return 0


if __name__ == "__main__":
    sys.exit(command.run(make_parser(), act))
