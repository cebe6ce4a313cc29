# SPDX-License-Identifier: MIT
"""What a diagnosis costs: seconds and memory for more and more recordings together."""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import sys
import time
from pathlib import Path

from diabolo import diagnose, load_recording

from .. import command

LOCATING = ("reading the motion", "fitting starts")
CANDIDATES = "fitting everything"
SHIPPED = sorted(
    path
    for path in (Path(__file__).parents[2] / "data" / "recordings").glob("*.csv")
    if not path.name.startswith("puzzle_")  # those of the demo
)


def cost(files: list[str]) -> tuple[float, dict[str, float], float, float]:
    """Length of the recordings [s], seconds of each step, of all, and the most memory of the process [MB]."""
    takes = [load_recording(file) for file in files]
    begin = last = time.monotonic()
    running = ""
    steps: dict[str, float] = {}

    def on_step(step: str, _: float) -> None:
        nonlocal last, running
        now = time.monotonic()
        if running:
            steps[running] = steps.get(running, 0.0) + now - last
        running, last = step, now

    diagnose(takes, progress=on_step)
    end = time.monotonic()
    steps[running] = steps.get(running, 0.0) + end - last
    length = sum(float(take.time[-1] - take.time[0]) for take in takes)
    return length, steps, end - begin, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def make_parser() -> argparse.ArgumentParser:
    parser = command.make_parser(
        "benchmarks.speed.diagnosis", __doc__, "  python -m benchmarks.speed.diagnosis TAKE.csv OTHER.csv"
    )
    parser.add_argument(
        "recording",
        nargs="*",
        default=[str(path) for path in SHIPPED],
        help="of one set-up; default: those that ship",
    )
    return parser


def act(given: argparse.Namespace) -> int:
    files = given.recording
    print(
        "| recordings | length | seconds (wall clock) | per minute | of it locating "
        "| fitting all candidates | memory | longest steps |"
    )
    print("|---|---|---|---|---|---|---|---|")
    counts = sorted({1, 2, 4, len(files)} & set(range(1, len(files) + 1)))
    with multiprocessing.get_context("spawn").Pool(1, maxtasksperchild=1) as pool:
        for count in counts:
            length, steps, seconds, memory = pool.apply(cost, (files[:count],))
            longest = sorted(steps.items(), key=lambda step: -step[1])[:4]
            locating = sum(steps.get(step, 0.0) for step in LOCATING)
            candidates = steps.get(CANDIDATES, 0.0)
            shown = ", ".join(f"{name} {took:.1f} s" for name, took in longest)
            print(
                f"| {count} | {length:.1f} s | {seconds:.1f} | {60.0 * seconds / length:.1f} s "
                f"| {60.0 * locating / length:.1f} s | {60.0 * candidates / length:.1f} s "
                f"| {memory:.0f} MB | {shown} |",
                flush=True,
            )
    return 0


if __name__ == "__main__":
    sys.exit(command.run(make_parser(), act))
