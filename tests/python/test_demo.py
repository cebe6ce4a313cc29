# SPDX-License-Identifier: MIT
from __future__ import annotations

import json
from pathlib import Path

import diabolo
import jsonschema
import pytest
from conftest import Command
from diabolo.cli.demo import packaged_recordings
from test_cli import EVALUATION_SCHEMA

DATA = Path(__file__).parents[2] / "data" / "recordings"


def test_the_package_brings_recordings_of_the_project() -> None:
    paths = packaged_recordings()
    assert [path.stem for path in paths] == ["hop", "linear_acceleration", "swing"]
    for path in paths:
        assert path.read_bytes() == (DATA / path.name).read_bytes()
        assert diabolo.load_recording(path).diabolo_valid.mean() > 0.9


def test_the_demo_prints_the_table_and_where_the_pictures_are(command: Command, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    done = command("demo", "--out", "shown", "--json", "demo.json")
    assert (done.returncode, done.stderr) == (0, "")
    found = json.loads((tmp_path / "demo.json").read_text())
    jsonschema.validate(found, EVALUATION_SCHEMA)
    assert len(found["rows"]) == 9 and len(found["horizons"]) == 60
    lines = done.stdout.splitlines()
    assert [line.split()[0] for line in lines[2:5]] == ["hop", "linear_acceleration", "swing"]
    assert sorted(path.name for path in (tmp_path / "shown").iterdir()) == ["errors.png", "trajectory.png"]
    for name in ("errors.png", "trajectory.png"):
        assert f"shown/{name}" in lines[-1]
        assert (tmp_path / "shown" / name).read_bytes().startswith(b"\x89PNG")


def test_the_short_view_is_better_than_the_baseline(command: Command) -> None:
    """What the demo is there to show; it would not, were recordings or models broken."""
    pytest.importorskip("matplotlib")
    found = json.loads(command("demo", "--json", "-").stdout)
    for row in found["horizons"]:
        if row["horizon_s"] <= 0.25:
            assert row["mean_m"] < 0.6 * row["baseline"]["mean_m"]
