# SPDX-License-Identifier: MIT
"""The diabolo inside DART and Drake."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.hosts
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.mark.parametrize("host", ["dart", "drake"])
def test_the_host_s_body_goes_where_the_predictor_goes(host: str) -> None:
    example = EXAMPLES / "hosts" / f"diabolo_in_{host}.py"
    done = subprocess.run([sys.executable, str(example)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    errors = [float(line.split(": ")[1].split()[0]) for line in done.stdout.splitlines()]
    assert len(errors) == 2
    assert max(errors) < 1e-6
