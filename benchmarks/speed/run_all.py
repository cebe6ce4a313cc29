# SPDX-License-Identifier: MIT
"""Runs every benchmark and writes one page of results; `make bench` calls it.

The programs must have been built (`make build-benchmarks`). MuJoCo is compared with where it is installed in
the Python that runs this; instructions are counted where valgrind is found.
"""

from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path
from typing import Any

from .. import command
from . import measure
from .page import page

COUNTED_IN_BATCH = "1 thread/.*/1000 steps$"  # callgrind would count nothing of what other threads do


def measured(programs: Path, compiler: str, brief: bool) -> dict[str, Any]:
    repetitions, seconds = (1, 0.001) if brief else (9, 0.02)
    started, load = time.monotonic(), [os.getloadavg()[0]]
    results: dict[str, Any] = {"machine": measure.machine(compiler), "repetitions": repetitions}

    def stage(name: str, work: Any) -> None:
        print(f"{time.monotonic() - started:5.0f} s  {name}", flush=True)
        results[name] = work()
        load.append(os.getloadavg()[0])

    for name in ("step", "batch", "loader"):
        stage(name, lambda name=name: measure.timed(programs / f"bench_{name}", repetitions, seconds))
    if (programs / "bench_robot").is_file():  # built where Orocos KDL was found
        stage("robot", lambda: measure.timed(programs / "bench_robot", repetitions, seconds))
    stage(
        "step_counts", lambda: measure.counted(programs / "bench_step", "consistent/double" if brief else "")
    )
    pattern = f"baseline/{COUNTED_IN_BATCH}" if brief else COUNTED_IN_BATCH
    stage("batch_counts", lambda: measure.counted(programs / "bench_batch", pattern))
    for name in ("loader", "robot"):
        if name in results and not brief:
            stage(f"{name}_counts", lambda name=name: measure.counted(programs / f"bench_{name}", ""))
    stage("compile", lambda: measure.compile_times(brief, compiler))
    stage("header_lines", measure.header_lines)
    stage("mujoco", lambda: measure.mujoco(brief))
    stage("uses", lambda: measure.uses(brief))
    results["load"], results["seconds"] = load, time.monotonic() - started
    return results


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(path.name + ".part")
    temporary.write_text(text)
    os.replace(temporary, path)


def main() -> int:
    parser = command.make_parser("benchmarks.speed.run_all", __doc__)
    parser.add_argument("programs", type=Path, help="folder of the built benchmark programs")
    parser.add_argument("page", type=Path, help="Markdown file to write")
    parser.add_argument("--compiler", default="c++", help="the one that built the programs")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write every figure there, too")
    parser.add_argument("--brief", action="store_true", help="only see that all run; the figures say nothing")
    options = parser.parse_args()
    try:
        results = measured(options.programs, options.compiler, options.brief)
    except (measure.MeasurementError, OSError) as error:
        print(f"run_all.py: {error}", file=sys.stderr)
        return 2
    if options.json:
        write(options.json, json.dumps(results, indent=1) + "\n")
    write(options.page, page(results))
    print(f"{results['seconds']:5.0f} s  wrote {options.page}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
