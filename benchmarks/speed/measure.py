# SPDX-License-Identifier: MIT
"""Runs the benchmark programs and collects their figures."""

from __future__ import annotations

import json
import os
import platform
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
TO_NANOSECONDS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
COUNTERS = ("steps", "allocations", "on_string", "flying", "snaps", "p99_us")


class MeasurementError(Exception):
    """A benchmark failed; the text is for the user."""


def run(command: list[str], **options: Any) -> subprocess.CompletedProcess[str]:
    done = subprocess.run(command, capture_output=True, text=True, **options)
    if done.returncode:
        raise MeasurementError(f"{' '.join(command)}: {done.stderr.strip() or done.stdout.strip()}")
    return done


def python(module: str) -> list[str]:
    """The command of another benchmark, to be run in the root of the checkout."""
    return [sys.executable, "-m", f"benchmarks.speed.{module}"]


def timed(program: Path, repetitions: int, seconds: float) -> dict[str, Any]:
    """Processor and wall-clock times [ns] of every repetition, in turns, by benchmark."""
    command = [str(program), "--benchmark_format=json", f"--benchmark_repetitions={repetitions}"]
    command += [f"--benchmark_min_time={seconds}", "--benchmark_enable_random_interleaving=true"]
    found: dict[str, Any] = {}
    for entry in json.loads(run(command).stdout)["benchmarks"]:
        if entry.get("error_occurred"):
            raise MeasurementError(f"{entry['run_name']}: {entry['error_message']}")
        if entry["run_type"] != "iteration":
            continue
        name = entry["run_name"].removesuffix("/process_time/real_time")
        one = found.setdefault(name, {"cpu": [], "wall": []})
        unit = TO_NANOSECONDS[entry["time_unit"]]
        one["cpu"].append(entry["cpu_time"] * unit)
        one["wall"].append(entry["real_time"] * unit)
        one.update({key: entry[key] for key in COUNTERS if key in entry})
    return found


def counted(program: Path, pattern: str) -> dict[str, float]:
    """Instructions of a run of each job that matches, by callgrind; empty without valgrind.

    The program runs a job once before, and collection is on inside `counted_run` only, after which callgrind
    writes its counts; so what is counted is the steps and nothing else.
    """
    if not shutil.which("valgrind"):
        return {}
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "counts"
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}"]
        command += ["--toggle-collect=counted_run", "--dump-after=counted_run"]
        lines = run([*command, str(program), "--count", pattern]).stdout.splitlines()
        counts = {}
        for number, line in enumerate(lines, start=1):
            text = Path(f"{out}.{number}").read_text()
            total = re.search(r"^totals: (\d+)", text, re.MULTILINE)
            if total is None:
                raise MeasurementError(f"callgrind: no total for {line}")
            counts[line.rsplit(" ", 1)[0]] = float(total[1])
    return counts


def compile_times(brief: bool, compiler: str) -> dict[str, Any]:
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "times.json"
        runs, jobs = (1, os.cpu_count()) if brief else (3, 1)
        command = [*python("compile_time"), "--core", "--runs", str(runs), "--jobs", str(jobs)]
        command += ["--compiler", compiler, "--json", str(out)]
        done = subprocess.run(
            command, capture_output=True, text=True, cwd=ROOT
        )  # 1: a header over its budget
        if not out.exists():
            raise MeasurementError(f"compile_time.py: {done.stderr.strip()}")
        return dict(json.loads(out.read_text()))


def uses(brief: bool) -> dict[str, Any] | None:
    """Figures of what people come for; None where the package is not installed."""
    if subprocess.run([sys.executable, "-c", "import diabolo"], capture_output=True, cwd=ROOT).returncode:
        return None
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "uses.json"
        run([*python("uses"), "--json", str(out), *(["plan", "--brief"] if brief else [])], cwd=ROOT)
        return dict(json.loads(out.read_text()))


def mujoco(short: bool) -> dict[str, Any] | None:
    """Figures of the comparison with MuJoCo; None where it is not installed."""
    if subprocess.run([sys.executable, "-c", "import mujoco"], capture_output=True).returncode:
        return None
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "mujoco.json"
        run([*python("mujoco.compare"), "--json", str(out), *(["--short"] if short else [])], cwd=ROOT)
        return dict(json.loads(out.read_text()))


def header_lines() -> dict[str, int]:
    """Lines of each header, by its name relative to include/."""
    include = ROOT / "include"
    return {
        str(path.relative_to(include)): len(path.read_text().splitlines())
        for path in sorted(include.rglob("*.hpp"))
    }


def machine(compiler: str) -> dict[str, Any]:
    try:
        model = re.search(r"model name\s*:\s*(.*)", Path("/proc/cpuinfo").read_text())
    except OSError:
        model = None
    version = run([compiler, "--version"]).stdout.splitlines()[0]
    system = platform.freedesktop_os_release().get("PRETTY_NAME") if sys.platform == "linux" else None
    return {
        "processor": model[1] if model else platform.processor() or "unknown",
        "cores": os.cpu_count(),
        "compiler": version,
        "system": system or platform.platform(),
    }


def spread(times: list[float]) -> float:
    """How far the worst repetition is above the median."""
    return max(times) / statistics.median(times) - 1.0
