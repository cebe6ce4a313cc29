# SPDX-License-Identifier: MIT
"""The diabolo inside DART and Drake."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from diabolo import load_recording
from diabolo.cli import main

pytestmark = pytest.mark.hosts
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def run(host: str, *arguments: object) -> str:
    program = [sys.executable, EXAMPLES / "hosts" / f"diabolo_in_{host}.py", *arguments]
    done = subprocess.run([str(word) for word in program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("host", ["dart", "drake"])
def test_the_host_s_body_goes_where_the_predictor_goes(host: str) -> None:
    errors = [float(line.split(": ")[1].split()[0]) for line in run(host).splitlines()]
    assert len(errors) == 2
    assert max(errors) < 1e-6


def test_two_hosts_play_a_recorded_motion_alike(tmp_path: Path) -> None:
    motion = tmp_path / "motion.csv"
    assert main(["motion", str(EXAMPLES.parent / "data" / "recordings" / "hold.csv"), str(motion)]) == 0
    for host in ("dart", "drake"):
        run(host, motion, tmp_path / f"{host}.csv")
    one, other = (load_recording(tmp_path / f"{host}.csv") for host in ("dart", "drake"))
    assert len(one) > 1000
    np.testing.assert_allclose(one.diabolo, other.diabolo, rtol=0.0, atol=1e-9)
