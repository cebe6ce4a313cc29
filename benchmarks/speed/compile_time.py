# SPDX-License-Identifier: MIT
"""Measures how long each header of the library takes to compile alone, and prints a table, the slowest first.

Every header is compiled without optimisation in a source that includes nothing else; the figure is the
median of several runs, in processor time, so that other work on the machine counts little. Headers of the
core have a budget: those at the top and in the folders below them.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .. import command

INCLUDE_DIR = Path(__file__).resolve().parents[2] / "include"
BUDGET = 2.0  # [s] for one header of the core
CORE_FOLDERS = {"math", "string", "paper", "effects", "batch"}
UMBRELLA = "diabolo/diabolo.hpp"


def in_core(header: str) -> bool:
    """Whether a header, given relative to include/, is of the core."""
    _, first, *rest = header.split("/")
    return first in CORE_FOLDERS if rest else header != UMBRELLA


def processor_time(command: list[str]) -> float:
    """Processor time of a program and of what it starts [s], whatever other threads run meanwhile."""
    process = subprocess.Popen(command)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise subprocess.CalledProcessError(process.returncode, command)
    return used.ru_utime + used.ru_stime


def compile_time(header: str, compiler: str, eigen: str, runs: int) -> float:
    """Median processor time [s] of compiling `header`, given relative to include/, alone."""
    with tempfile.TemporaryDirectory() as folder:
        source, made = Path(folder) / "alone.cpp", Path(folder) / "alone.o"
        source.write_text(f"#include <{header}>\n")
        command = [compiler, "-std=c++20", "-O0", f"-I{INCLUDE_DIR}", "-isystem", eigen, "-c", str(source)]
        return statistics.median(processor_time([*command, "-o", str(made)]) for _ in range(runs))


def main() -> int:
    parser = command.make_parser("benchmarks.speed.compile_time", __doc__)
    parser.add_argument("--compiler", default="c++")
    parser.add_argument("--eigen", default="/usr/include/eigen3", help="folder of Eigen's headers")
    parser.add_argument("--runs", type=int, default=3, help="runs of which the median is taken")
    parser.add_argument("--jobs", type=int, default=1, help="compilers at once; one alone is the fairest")
    parser.add_argument("--core", action="store_true", help="look at the core only")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write the times there, too")
    arguments = parser.parse_args()
    for option in ("runs", "jobs"):
        if getattr(arguments, option) < 1:
            parser.error(f"--{option}: {getattr(arguments, option)}; expected at least 1")

    headers = sorted(str(path.relative_to(INCLUDE_DIR)) for path in INCLUDE_DIR.rglob("*.hpp"))
    headers = [header for header in headers if in_core(header) or not arguments.core]
    try:
        with ThreadPoolExecutor(arguments.jobs) as pool:
            found = pool.map(
                lambda header: compile_time(header, arguments.compiler, arguments.eigen, arguments.runs),
                headers,
            )
            times = dict(zip(headers, found, strict=True))
    except subprocess.CalledProcessError as error:
        print(f"compile_time.py: {' '.join(error.cmd)}: failed", file=sys.stderr)
        return 2

    print(f"{'header':<44} {'compiled alone [s]':>18}")
    over = 0
    for header, seconds in sorted(times.items(), key=lambda item: -item[1]):
        too_long = in_core(header) and seconds > BUDGET
        over += too_long
        print(f"{header:<44} {seconds:>18.2f}{'  over the budget' if too_long else ''}")
    print(f"{over} headers of the core over {BUDGET:g} s")
    if arguments.json:
        arguments.json.write_text(json.dumps({"budget": BUDGET, "seconds": times}, indent=1) + "\n")
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main())
