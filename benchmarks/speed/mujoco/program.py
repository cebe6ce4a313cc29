# SPDX-License-Identifier: MIT
"""Compiles compare.cpp against the MuJoCo that is installed for Python, and runs it."""

from __future__ import annotations

import math
import re
import shutil
import subprocess
from pathlib import Path

from .models import Model

HERE = Path(__file__).resolve().parent
CHECKS = 10  # instants of comparison; steps are multiples of it
Positions = list[list[float]]


class BenchmarkError(Exception):
    """Something that the benchmark needs is missing or failed; the text is for the user."""


class Program:
    """The compiled loops."""

    def __init__(self, folder: Path, compiler: str, eigen: str) -> None:
        self.folder = folder
        self.binary = folder / "compare"
        package = mujoco_folder()
        library = next(iter(sorted(package.glob("libmujoco.so*"))), None)
        if library is None:
            raise BenchmarkError(f"{package}: no libmujoco.so there; this benchmark runs on Linux")
        command = [compiler, "-std=c++20", "-O3", "-DNDEBUG", f"-I{HERE.parents[2] / 'include'}"]
        command += ["-isystem", eigen, "-isystem", str(package / "include"), str(HERE / "compare.cpp")]
        command += ["-o", str(self.binary), str(library), f"-Wl,-rpath,{package}"]
        try:
            subprocess.run(command, check=True)
        except (OSError, subprocess.CalledProcessError) as error:
            raise BenchmarkError(f"{' '.join(command)}: {error}") from error

    def __call__(self, *words: object, prefix: tuple[str, ...] = ()) -> subprocess.CompletedProcess[str]:
        command = [*prefix, str(self.binary), *map(str, words)]
        return subprocess.run(command, capture_output=True, text=True, cwd=self.folder)

    def lines(self, *words: object) -> Positions:
        done = self(*words)
        if done.returncode:
            raise BenchmarkError(done.stderr.strip())
        return [[float(number) for number in line.split()] for line in done.stdout.splitlines()]

    def model_file(self, model: Model, steps: int) -> Path:
        path = self.folder / "model.xml"
        path.write_text(model.text(steps))
        return path

    def error(self, motion: str, steps: int, model: Model | None, reference: Positions) -> float:
        """Greatest distance from the reference [m]; infinite where MuJoCo diverges."""
        try:
            if model is None:
                positions = self.lines("diabolo", motion, steps)
            else:
                positions = self.lines("mujoco", motion, steps, self.model_file(model, steps))
        except BenchmarkError as error:
            if "diverges" in str(error):
                return math.inf
            raise
        distances = [math.dist(*pair) for pair in zip(positions, reference, strict=True)]
        return max(distances) if all(map(math.isfinite, distances)) else math.inf

    def instructions(self, simulator: str, motion: str, steps: int, model: Model | None) -> float | None:
        """Instructions per run, from callgrind's counts of few and of more runs; None where that fails."""
        if not shutil.which("valgrind"):
            return None
        prefix = ("valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null")
        arguments = [] if model is None else [self.model_file(model, steps)]
        counts = []
        for times in (2, 12):
            done = self("repeat", simulator, motion, steps, times, *arguments, prefix=prefix)
            found = re.search(r"Collected\s*:\s*(\d+)", done.stderr)
            if done.returncode or not found:
                return None
            counts.append(int(found[1]))
        return (counts[1] - counts[0]) / 10


def mujoco_folder() -> Path:
    """Where the wheel keeps its library and headers."""
    try:
        import mujoco
    except ImportError as error:
        raise BenchmarkError("MuJoCo is not installed: pip install mujoco==4.0.0") from error
    return Path(mujoco.__file__).parent
