# SPDX-License-Identifier: MIT
"""The driver of the plant, with scripts that stand in for its program."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from benchmarks.proof import plant
from benchmarks.proof.diagnosis import making
from benchmarks.proof.player.plant import Plant

ROOT = Path(__file__).resolve().parents[2]
KEY = '{"effects": {"string_friction": {"coefficient": 0.2}}}'


def program(folder: Path, then: str) -> Path:
    """A program that is called as the plant's is: SCENARIO --out OUT --key KEY [--truth TRUTH]."""
    path = folder / "stand-in"
    path.write_text(f'#!/bin/sh\n[ "$1" = --help ] && echo "--key" && exit 0\n{then}\n')
    path.chmod(0o755)
    return path


def test_a_play_says_what_is_at_work(tmp_path: Path) -> None:
    stand_in = program(tmp_path, f'cp "$1" "$3"; echo \'{KEY}\' > "$5"')
    plant.check(stand_in)
    found = plant.play(stand_in, {"seed": 3}, tmp_path / "take.csv")
    assert found == {"string_friction": {"coefficient": 0.2}}
    assert json.loads((tmp_path / "take.csv").read_text()) == {"seed": 3}


def test_a_refusal_and_a_failure_are_told(tmp_path: Path) -> None:
    refusing = program(tmp_path, 'echo "$1: string.lay: unknown" >&2; exit 2')
    with pytest.raises(plant.RefusedError, match=r"^the plant refuses: scenario: string\.lay: unknown$"):
        plant.play(refusing, {}, tmp_path / "take.csv")
    with pytest.raises(plant.RefusedError):
        making.play(refusing, {}, tmp_path / "take.csv")
    assert not making.knows_chain(refusing)
    failing = program(tmp_path, 'echo "not finite" >&2; exit 1')
    with pytest.raises(plant.FailedError, match="the plant failed: not finite"):
        plant.play(failing, {}, tmp_path / "take.csv")
    assert making.play(failing, {}, tmp_path / "take.csv") is None  # drawn again
    with pytest.raises(plant.FailedError, match=r"more than 0\.2 s"):
        plant.play(program(tmp_path, "exec sleep 10"), {}, tmp_path / "take.csv", longest=0.2)


def test_what_truly_happened_counts_from_the_motion(tmp_path: Path) -> None:
    shipped = ROOT / "data" / "recordings" / "hold.csv"
    tips = [f"{side}_tip_{axis}" for side in ("left", "right") for axis in "xyz"]
    columns = ["time", "x", "y", "z", "spin", "mode", *tips]
    with (tmp_path / "truth.csv").open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(columns)
        for time in (0.0, 0.3, 0.6):
            rows.writerow([time, 0.5, 0.0, 0.6, 100.0, "ON_STRING", *[0.0] * 6])
    stand_in = program(
        tmp_path,
        f'cp {shipped} "$3"; cp {shipped.with_suffix(".json")} "${{3%.csv}}.json"; '
        f'echo \'{KEY}\' > "$5"; cp {tmp_path / "truth.csv"} "$7"',
    )
    played = Plant(stand_in).practice()
    assert len(played) > 1  # until there are thirty seconds
    truth = Plant(stand_in)._run({})
    assert truth.time.tolist() == pytest.approx([-0.3, 0.0, 0.3])
    assert truth.spin.tolist() == [100.0] * 3


def test_hands_are_moved_a_period_at_a_time(tmp_path: Path) -> None:
    line = "0.02 FLYING 1 2 3 4 5 6 90 0 0.3 1.25 0 -0.3 1.25 1 0 0"
    live = program(tmp_path, f'echo "{line}"; while read period rest; do echo "{line}"; done')
    with plant.LivePlay(live, {}) as play:
        assert play.moment.mode == "FLYING"
        moment = play.push(0.02, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert moment.position.tolist() == [1.0, 2.0, 3.0]
    assert (moment.spin, moment.right.tolist()) == (90.0, [0.0, -0.3, 1.25])
    assert moment.axis.tolist() == [1.0, 0.0, 0.0]


def test_a_live_play_that_is_refused_says_why(tmp_path: Path) -> None:
    refusing = program(tmp_path, 'echo "period: found x" >&2; exit 2')
    with pytest.raises(plant.RefusedError, match="the plant: period: found x"):
        plant.LivePlay(refusing, {})
