# SPDX-License-Identifier: MIT
"""Times the library against MuJoCo on the same job at the same accuracy, and prints two Markdown tables.

The job: a point mass on an inextensible massless string between two moving tips, for 1 s. `beat` keeps the
string taut; `hop` lets it go slack and snap taut. MuJoCo does it with the length limit of a spatial tendon
over the diabolo's body. The reference is an integrator of its own (reference.hpp: index reduction,
Runge-Kutta of fourth order, events located) at a step of 1 us. An error is the greatest distance from it at
ten instants, the last of them at 1 s.

Each simulator gets the largest timestep at which it is within 1 mm of the reference, and at every smaller one
of a ladder that ends at 0.1 ms. For MuJoCo that search runs over its integrators and the stiffness and
impedance of the limit; of each integrator's best, over its solvers, the fastest counts. Then both run in
turns in one process, in compiled loops that read the same tips from memory; times are medians. MuJoCo is
given the job in three ways:

  mocap    a free body between two mocap bodies, as one would write it. MuJoCo takes mocap bodies for resting
           (its documentation says so), so that the string's damping and its catch see a wrong velocity.
  driven   a free body between two heavy bodies that get the tips' position, velocity and acceleration before
           each step.
  point    as `driven`, the diabolo on three slides instead of a free joint: the least work for MuJoCo.

What is unfair: MuJoCo simulates anything that has joints and contacts, and pays for it in every step; ours
knows this one string, and is a header that the compiler sees through where MuJoCo comes compiled. MuJoCo
turns a rigid body (not in `point`), ours a point with a spin. The smooth motion suits large steps. Timesteps
are found on the motion that is then timed, on both sides. Ours has no options to tune here, MuJoCo's are
tuned for each motion, and `driven` is a trick that a user must know.

Needs: pip install mujoco==4.0.0 (C library and headers come with it), a C++20 compiler, Eigen; valgrind for
the instruction counts, which are left out without it.
"""

from __future__ import annotations

import json
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from ... import command
from .models import Model, variants
from .program import CHECKS, BenchmarkError, Program

MOTIONS = ("beat", "hop")
LIMIT = 1e-3  # accuracy wanted [m]
REFERENCE_STEPS = 1_000_000
# Steps per tenth of a second, 100 ms to 0.1 ms, each about 1.12 of the last.
LADDER = sorted({round(10 ** (i / 20)) for i in range(61)})
SHORT_LADDER = (5, 10, 20, 50, 100)
SHOWN = (2, 5, 10, 20, 50, 100, 200, 1000)  # of the table of accuracy: 50 ms to 0.1 ms


@dataclass
class Row:
    """One simulator on one motion."""

    motion: str
    simulator: str
    options: str
    timestep: float | None  # largest within the limit [s]; None when there is none
    error: float  # at that timestep, or the smallest at any [m]
    error_timestep: float  # timestep of that error [s]
    errors: dict[str, float]  # by timestep in ms [m]
    time: float | None = None  # median, per second of motion [s]
    our_time: float | None = None  # the library's median beside it in turns [s]
    ratio: float | None = None  # time over the library's beside it, median; None where not accurate
    instructions: float | None = None  # per second of motion


def largest_step(errors: dict[int, float]) -> int | None:
    """The fewest steps per tenth of a second that are, with every finer one, within the limit."""
    found = None
    for steps in sorted(errors, reverse=True):
        if not errors[steps] <= LIMIT:
            break
        found = steps
    return found


class Comparison:
    """All simulators on one motion."""

    def __init__(self, program: Program, motion: str, short: bool, repeats: int) -> None:
        self.program, self.motion, self.short, self.repeats = program, motion, short, repeats
        self.ladder = SHORT_LADDER if short else LADDER
        *self.reference, last = program.lines("reference", motion, REFERENCE_STEPS)
        self.checks = dict(zip(("slack_time", "snap_speed", "drift"), last, strict=True))
        *coarse, _ = program.lines("reference", motion, REFERENCE_STEPS // 10)
        pairs = zip(coarse, self.reference, strict=True)
        self.checks["change_from_coarser"] = max(math.dist(*pair) for pair in pairs)
        self.checks["library_at_10_us"] = program.error(motion, REFERENCE_STEPS // 10, None, self.reference)

    def rows(self) -> list[Row]:
        ours = self.row("diabolo", None, self.errors(None, to_the_end=True))
        if ours.timestep is None:
            raise BenchmarkError(f"{self.motion}: the library is never within {1e3 * LIMIT:g} mm")
        self.our_steps = round(1 / ours.timestep)
        rows = [self.mujoco_row(kind) for kind in ("mocap", "driven", "point")]
        ours.time = statistics.median(row.our_time for row in rows)
        if not self.short:
            ours.instructions = self.program.instructions("diabolo", self.motion, self.our_steps, None)
        return [ours, *rows]

    def mujoco_row(self, kind: str) -> Row:
        model, errors = self.search(kind)
        row = self.row(f"MuJoCo {kind}", model, errors)
        steps = round(1 / row.error_timestep)
        times = self.times(model, steps)
        row.our_time, row.time = map(statistics.median, zip(*times, strict=True))
        if row.timestep is not None:
            row.ratio = statistics.median(theirs / ours for ours, theirs in times)
        if not self.short:
            row.instructions = self.program.instructions("mujoco", self.motion, steps, model)
        return row

    def row(self, simulator: str, model: Model | None, errors: dict[int, float]) -> Row:
        largest = largest_step(errors)
        at = largest or min(errors, key=lambda steps: errors[steps])
        return Row(
            motion=self.motion,
            simulator=simulator,
            options="as is" if model is None else model.options(),
            timestep=None if largest is None else 0.1 / largest,
            error=errors[at],
            error_timestep=0.1 / at,
            errors={f"{100 / steps:g}": self.error(model, steps) for steps in SHOWN},
        )

    def error(self, model: Model | None, steps: int) -> float:
        return self.program.error(self.motion, CHECKS * steps, model, self.reference)

    def errors(self, model: Model | None, to_the_end: bool) -> dict[int, float]:
        """By steps per tenth of a second, the finest first, up to the first beyond the limit or the end."""
        errors: dict[int, float] = {}
        for steps in reversed(self.ladder):
            errors[steps] = self.error(model, steps)
            if not to_the_end and not errors[steps] <= LIMIT:
                break
        return errors

    def times(self, model: Model, steps: int) -> list[list[float]]:
        """Seconds per second of motion of both, in turns: [[ours, MuJoCo's], ...]."""
        model_file = self.program.model_file(model, steps)
        return self.program.lines("time", self.motion, self.our_steps, steps, model_file, self.repeats)

    def search(self, kind: str) -> tuple[Model, dict[int, float]]:
        """The fastest variant of this kind at its largest timestep, and its errors; where none is accurate
        enough, the one with the smallest error anywhere."""
        scanned = [(model, self.errors(model, to_the_end=False)) for model in variants(kind, self.short)]
        passing = [(model, errors) for model, errors in scanned if largest_step(errors)]
        if not passing:
            scanned = [(model, self.errors(model, to_the_end=True)) for model, _ in scanned]
            return min(scanned, key=lambda pair: min(pair[1].values()))

        def coarseness(pair: tuple[Model, dict[int, float]]) -> tuple[int, float]:
            steps = largest_step(pair[1])
            return steps, pair[1][steps]

        timed = []
        for integrator in sorted({model.integrator for model, _ in passing}):
            model, errors = min((p for p in passing if p[0].integrator == integrator), key=coarseness)
            steps = largest_step(errors)
            for solver in ("Newton",) if self.short else ("Newton", "CG", "PGS"):
                candidate = replace(model, solver=solver)
                if self.error(candidate, steps) <= LIMIT:
                    times = self.times(candidate, CHECKS * steps)
                    timed.append((statistics.median(theirs for _, theirs in times), candidate, errors))
        _, model, errors = min(timed, key=lambda entry: entry[0])
        return model, errors


def figure(value: float | None, scale: float, form: str = ".3g") -> str:
    return "-" if value is None else "diverges" if math.isinf(value) else format(scale * value, form)


def finite(value):
    """JSON has no infinity: null where a simulation diverged."""
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def markdown(rows: list[Row]) -> str:
    columns = ["motion", "simulator", "timestep [ms]", "error [mm]", "time per s of motion [us]"]
    columns += ["instructions per s of motion", "time over ours", "options"]
    lines = [f"| {' | '.join(columns)} |", "|---|---|---:|---:|---:|---:|---:|---|"]
    for row in rows:
        step = figure(row.timestep, 1e3)
        if row.timestep is None:
            step = f"none; best {figure(row.error_timestep, 1e3)}"
        lines.append(
            f"| {row.motion} | {row.simulator} | {step} | {figure(row.error, 1e3)} | {figure(row.time, 1e6)} "
            f"| {figure(row.instructions, 1, ',.0f')} | {figure(row.ratio, 1)} | {row.options} |"
        )
    steps = list(rows[0].errors)
    lines += ["", f"| motion | simulator | error [mm] at {' | '.join(f'{step} ms' for step in steps)} |"]
    lines.append("|---|---|" + "---:|" * len(steps))
    for row in rows:
        lines.append(
            f"| {row.motion} | {row.simulator} | "
            + " | ".join(figure(error, 1e3) for error in row.errors.values())
            + " |"
        )
    return "\n".join(lines)


def versions(compiler: str) -> dict[str, str]:
    import mujoco

    first_line = subprocess.run([compiler, "--version"], capture_output=True, text=True).stdout.split("\n")[0]
    try:
        cpu = re.search(r"model name\s*:\s*(.*)", Path("/proc/cpuinfo").read_text())
    except OSError:
        cpu = None
    return {"mujoco": mujoco.__version__, "compiler": first_line, "cpu": cpu[1] if cpu else "unknown"}


def main() -> int:
    parser = command.make_parser("benchmarks.speed.mujoco.compare", __doc__)
    parser.add_argument("--json", metavar="FILE", type=Path, help="write every figure there, too")
    parser.add_argument("--short", action="store_true", help="few variants and timesteps, nothing counted")
    parser.add_argument("--repeats", type=int, help="of each timing (default: 15; 1 with --short)")
    parser.add_argument("--compiler", default="c++")
    parser.add_argument("--eigen", default="/usr/include/eigen3", help="folder of Eigen's headers")
    options = parser.parse_args()
    repeats = options.repeats or (1 if options.short else 15)

    rows: list[Row] = []
    references = {}
    try:
        with tempfile.TemporaryDirectory() as folder:
            program = Program(Path(folder), options.compiler, options.eigen)
            for motion in MOTIONS:
                comparison = Comparison(program, motion, options.short, repeats)
                references[motion] = comparison.checks
                rows += comparison.rows()
    except BenchmarkError as error:
        print(f"compare.py: {error}", file=sys.stderr)
        return 2
    about = versions(options.compiler)
    print(markdown(rows))
    print(f"\nMuJoCo {about['mujoco']}, {about['compiler']}, {about['cpu']}.")
    for motion, checks in references.items():
        print(
            f"Reference of {motion}: slack for {checks['slack_time']:.3f} s, caught at "
            f"{checks['snap_speed']:.2f} m/s; string too long by at most {checks['drift']:.1e} m; moves by "
            f"{checks['change_from_coarser']:.1e} m from 10 us to 1 us; the library at 10 us is "
            f"{checks['library_at_10_us']:.1e} m from it."
        )
    if options.json:
        report = {"versions": about, "limit": LIMIT, "references": references}
        report["rows"] = [asdict(row) for row in rows]
        temporary = options.json.with_name(options.json.name + ".part")
        temporary.write_text(json.dumps(finite(report), indent=1, allow_nan=False) + "\n")
        os.replace(temporary, options.json)
    return 0


if __name__ == "__main__":
    sys.exit(main())
