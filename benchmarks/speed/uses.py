# SPDX-License-Identifier: MIT
"""What people come for: seconds and memory of a plan, an evaluation and a diagnosis from Python.

Each runs in a process of its own, once to warm up and then a few times. The recordings are those that ship.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import resource
import statistics
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import diabolo
from diabolo.checks import RecordingWarning

from .. import command
from .diagnosis import SHIPPED

HEIGHT = 0.6  # of the throw above the tips [m]


def plan() -> float:
    """Plans a throw and its catch; returns how long the motion is [s]."""
    play = diabolo.plan_action("throw_and_catch", height=HEIGHT, seconds=100.0)
    return float(play.path.end - play.path.begin)


def _length(takes: list[diabolo.Recording]) -> float:
    return sum(float(take.time[-1] - take.time[0]) for take in takes)


def evaluate() -> float:
    """Evaluates the models on all recordings, a start each 0.1 s; returns their length [s]."""
    takes = [diabolo.load_recording(file) for file in SHIPPED]
    diabolo.evaluate(takes, starts_every=0.1)
    return _length(takes)


def diagnose() -> float:
    """Diagnoses all recordings together; returns their length [s]."""
    takes = [diabolo.load_recording(file) for file in SHIPPED]
    diabolo.diagnose(takes)
    return _length(takes)


JOBS: dict[str, tuple[Callable[[], float], int]] = {
    "plan": (plan, 9),
    "evaluate": (evaluate, 3),
    "diagnose": (diagnose, 1),
}
"""By name, with how often each is timed."""


def measured(name: str, brief: bool) -> dict[str, Any]:
    """Length of what the job is about [s], its times [s] and the most memory of its process [MB]."""
    warnings.simplefilter("ignore", RecordingWarning)  # a tip is lost for a while
    job, repeats = JOBS[name]
    if not brief and repeats > 1:
        job()
    cpu, wall = [], []
    for _ in range(1 if brief else repeats):
        before = time.process_time(), time.perf_counter()
        length = job()
        cpu.append(time.process_time() - before[0])
        wall.append(time.perf_counter() - before[1])
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    return {"length": length, "cpu": cpu, "wall": wall, "memory": memory}


def make_parser() -> argparse.ArgumentParser:
    parser = command.make_parser("benchmarks.speed.uses", __doc__, "  python -m benchmarks.speed.uses plan")
    parser.add_argument("job", nargs="*", metavar="JOB", help=f"of {', '.join(JOBS)}; default: all")
    parser.add_argument("--brief", action="store_true", help="each once; the figures say nothing")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write every figure there, too")
    return parser


def act(given: argparse.Namespace) -> int:
    if unknown := [name for name in given.job if name not in JOBS]:
        raise ValueError(f"{unknown[0]}: no such job; expected one of {', '.join(JOBS)}")
    found = {}
    print("| | length | processor's time | clock's | memory |\n|---|---|---|---|---|")
    with multiprocessing.get_context("spawn").Pool(1, maxtasksperchild=1) as pool:
        for name in given.job or JOBS:
            found[name] = one = pool.apply(measured, (name, given.brief))
            times = " | ".join(f"{statistics.median(one[clock]):.3g} s" for clock in ("cpu", "wall"))
            print(f"| {name} | {one['length']:.1f} s | {times} | {one['memory']:.0f} MB |", flush=True)
    if given.json:
        given.json.write_text(json.dumps(found, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(command.run(make_parser(), act))
