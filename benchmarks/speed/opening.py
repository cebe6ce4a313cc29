# SPDX-License-Identifier: MIT
"""The first ten lines of the page: what a person wants to know, each with its command."""

from __future__ import annotations

import statistics
from typing import Any

from .figures import PROGRAMS, per_step, shown, speed, table


def _step_time(results: dict[str, Any], model: str, scalar: str) -> str:
    return shown(1e-9 * statistics.median(per_step(results["step"][f"step/{model}/{scalar}/beat"])))


def _best_batch(results: dict[str, Any], clock: str) -> str:
    """The fastest kernel here, on one core's processor time or by the clock on all."""
    rates = {
        name: speed(entry, clock) for name, entry in results["batch"].items() if not name.endswith("/alike")
    }
    best = max(rates, key=lambda name: rates[name])
    return f"{rates[best]:.0f} M steps/s ({best.split('/')[1]})"


def _of_use(results: dict[str, Any], name: str, form: str) -> str:
    """`form` gets the time of the processor, the length of what it was about, and the memory."""
    if name not in (results["uses"] or {}):
        return "not run"
    use = results["uses"][name]
    took = shown(statistics.median(use["cpu"]))
    return form.format(took=took, length=use["length"], memory=use["memory"])


def _against_mujoco(results: dict[str, Any], motion: str) -> str:
    """Ours, and the fastest way to give MuJoCo the job."""
    rows = [row for row in (results["mujoco"] or {"rows": []})["rows"] if row["motion"] == motion]
    theirs = [row for row in rows if row["ratio"]]
    if not theirs:
        return "not run"
    best = min(theirs, key=lambda row: row["ratio"])
    return f"{shown(rows[0]['time'])}; MuJoCo {shown(best['time'])}, {best['ratio']:.0f} times as long"


def _cpu(results: dict[str, Any], part: str, name: str) -> str:
    if name not in results.get(part, {}):
        return "not run"
    entry = results[part][name]
    return shown(1e-9 * statistics.median(entry["cpu"]) / entry.get("steps", 1.0))


def opening(results: dict[str, Any]) -> str:
    """A table of ten lines."""
    step, uses = f"{PROGRAMS}/bench_step", "python -m benchmarks.speed.uses"
    mujoco, robot = "python -m benchmarks.speed.mujoco.compare", f"{PROGRAMS}/bench_robot"
    rows = [
        ["a step of `consistent()`", _step_time(results, "consistent", "double"), step],
        ["a step of `published()`", _step_time(results, "published", "double"), step],
        ["a step with 16 derivatives", _step_time(results, "consistent", "Dual<double,16>"), step],
        ["a batch, per core", _best_batch(results, "cpu"), f"{PROGRAMS}/bench_batch"],
        ["a second on a taut string, within 1 mm", _against_mujoco(results, "beat"), mujoco],
        ["a second of hops, within 1 mm", _against_mujoco(results, "hop"), mujoco],
        [
            "a throw and its catch, planned",
            _of_use(results, "plan", "{took} for {length:.1f} s of motion"),
            f"{uses} plan",
        ],
        [
            "a diagnosis",
            _of_use(
                results, "diagnose", "{took} of processor time for {length:.0f} s of play, {memory:.0f} MB"
            ),
            f"{uses} diagnose",
        ],
        [
            "a Motive export of 20 MB, read",
            _cpu(results, "loader", "read_motive_20_MB"),
            f"{PROGRAMS}/bench_loader",
        ],
        ["a UR5e's joints from a pose, all 8 solutions", _cpu(results, "robot", "inverse_all_8"), robot],
    ]
    return table(["what", "takes", "command"], [[*row[:2], f"`{row[2]}`"] for row in rows], text_columns=3)
