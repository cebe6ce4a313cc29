# SPDX-License-Identifier: MIT
"""The first lines of the benchmarks' page, from figures that are made up."""

from __future__ import annotations

from typing import Any

import pytest

from benchmarks.speed.figures import shown
from benchmarks.speed.opening import opening


def results(**others: Any) -> dict[str, Any]:
    def took(nanoseconds: float, steps: float = 1000.0) -> dict[str, Any]:
        times = [steps * nanoseconds * slower for slower in (1.0, 1.1, 3.0)]
        return {"cpu": times, "wall": times, "steps": steps}

    steps = {"consistent/double": 50.0, "published/double": 120.0, "consistent/Dual<double,16>": 3000.0}
    return {
        "step": {f"step/{name}/beat": took(time) for name, time in steps.items()},
        "batch": {
            "batch/portable/1 thread/shared tips/1000 steps": took(40.0),
            "batch/avx2/1 thread/shared tips/1000 steps": took(20.0),
            "batch/avx2/1 thread/shared tips/4000 steps/alike": took(1.0),
        },
        "loader": {"read_motive_20_MB": {"cpu": [50e6, 60e6, 90e6]}},
        "mujoco": None,
        "uses": None,
        **others,
    }


def row(text: str, what: str) -> str:
    return next(line for line in text.splitlines() if line.startswith(f"| {what}"))


def test_the_page_opens_with_ten_lines_and_their_commands() -> None:
    lines = opening(results()).splitlines()[2:]
    assert len(lines) == 10
    assert all(line.endswith("` |") for line in lines)
    text = "\n".join(lines)
    assert "| 55 ns | `build/bench/benchmarks/speed/bench_step`" in row(text, "a step of `consistent()`")
    assert "| 3.3 us |" in row(text, "a step with 16 derivatives")
    assert "| 45 M steps/s (avx2) |" in row(text, "a batch")
    assert "| 60 ms |" in row(text, "a Motive export")


def test_what_was_not_run_is_told() -> None:
    lines = opening(results()).splitlines()
    assert sum("| not run |" in line for line in lines) == 5  # MuJoCo's two, the package's two, the robot's


def test_mujoco_gets_its_fastest_way() -> None:
    rows = [
        {"motion": "hop", "simulator": "diabolo", "time": 8e-6, "ratio": None},
        {"motion": "hop", "simulator": "MuJoCo mocap", "time": 3e-2, "ratio": None},
        {"motion": "hop", "simulator": "MuJoCo driven", "time": 4e-4, "ratio": 50.0},
        {"motion": "hop", "simulator": "MuJoCo point", "time": 2.6e-4, "ratio": 32.0},
    ]
    text = opening(results(mujoco={"rows": rows}))
    assert "| 8 us; MuJoCo 260 us, 32 times as long |" in row(text, "a second of hops")
    assert "| not run |" in row(text, "a second on a taut string")


@pytest.mark.parametrize(
    ("seconds", "text"), [(61.5e-9, "61.5 ns"), (4.29e-6, "4.29 us"), (0.0161, "16.1 ms"), (15.82, "15.8 s")]
)
def test_a_time_has_three_digits(seconds: float, text: str) -> None:
    assert shown(seconds) == text
