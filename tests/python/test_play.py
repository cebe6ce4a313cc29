# SPDX-License-Identifier: MIT
"""`diabolo play`, and `diabolo train` where it cannot begin."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from diabolo import load_recording
from diabolo.cli import main

pytest.importorskip("gymnasium")


def test_an_agent_plays_and_its_outcomes_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["play", "SpinUp", "--episodes", "20", "--seed", "3"]) == 0
    text = capsys.readouterr().out
    assert text.startswith("SpinUp: 0 of 20 episodes ended with a drop\n")
    assert main(["play", "SpinUp", "--episodes", "20", "--seed", "3", "--json", "-"]) == 0
    episodes = json.loads(capsys.readouterr().out)["episodes"]
    assert f"{np.median(episodes['worth']):.2f}" in text
    assert len(episodes["spin"]) == 20


def test_the_first_episode_is_a_recording_and_a_page(tmp_path: Path) -> None:
    take, page = tmp_path / "play.csv", tmp_path / "play.html"
    told = tmp_path / "told.json"
    outputs = ["--out", str(take), "--html", str(page), "--json", str(told)]
    assert main(["play", "SpinUp", "--episodes", "20", *outputs]) == 0
    episodes = json.loads(told.read_text(encoding="utf-8"))["episodes"]
    recording = load_recording(take)
    assert recording.rate == pytest.approx(50.0) and len(recording) == 501
    assert recording.string_length == pytest.approx(1.45)
    assert np.nanmean(recording.spin()[-3:]) == pytest.approx(episodes["spin"][0], rel=0.03)
    assert "<html" in page.read_text(encoding="utf-8")[:200]


def test_another_model_is_another_play(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    worth = []
    for model in ([], ["--model", "paper"]):
        assert main(["play", "SpinUp", "--episodes", "20", "--json", "-", *model]) == 0
        worth.append(np.median(json.loads(capsys.readouterr().out)["episodes"]["worth"]))
    assert abs(worth[0] - worth[1]) > 0.1


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ("play Fly", "TASK 'Fly'; expected one of Hold, Swing"),
        ("play Hold", "task: 'Hold' has no agent in the package; expected Level, SpinUp"),
        ("play SpinUp --episodes 0", "--episodes 0; expected 1 to 1048576"),
        ("play SpinUp --seed -1", "--seed -1; expected 0 to"),
        ("play SpinUp --agent nothing.json", "nothing.json: "),
        ("play SpinUp --agent agent.json", "agent.json: "),
        ("play SpinUp --model theirs", "model theirs: no such file"),
        ("play SpinUp --json agent.json --agent agent.json", "agent.json: this file is read"),
        ("play SpinUp --out take", "take: expected a name that ends in .csv"),
        ("play SpinUp --agent=", "--agent '': expected the name of a file"),
    ],
)
def test_bad_input_is_told_in_one_sentence(
    arguments: str,
    complaint: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("agent.json").write_text('{"schema": "diabolo.agent/1", "task": "SpinUp"}')
    assert main(arguments.split()) == 2
    error = capsys.readouterr().err
    assert complaint in error and error.count("\n") == 1


@pytest.mark.parametrize(("command", "library"), [("play", "gymnasium"), ("train", "stable_baselines3")])
def test_what_is_missing_is_told(
    command: str,
    library: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setitem(sys.modules, library, None)
    assert main([command, "SpinUp", *(["--out", str(tmp_path / "d")] if command == "train" else [])]) == 2
    assert f"diabolo {command}: needs {library} (pip install" in capsys.readouterr().err
    assert not (tmp_path / "d").exists()


def test_a_data_set_needs_minari(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setitem(sys.modules, "minari", None)
    assert main(["play", "SpinUp", "--episodes", "1", "--minari", "diabolo/spin-up-v0"]) == 2
    assert "a data set of Minari: needs minari (pip install '.[minari]'" in capsys.readouterr().err


def test_each_period_is_kept() -> None:
    from diabolo.envs import Transition, play, shipped_agent

    kept: list[Transition] = []
    outcomes = play(shipped_agent("SpinUp"), 3, keep=kept.append)
    assert len(kept) == round(outcomes["seconds"][0] / 0.02)
    np.testing.assert_allclose(sum(one.rewards for one in kept), outcomes["worth"])
    np.testing.assert_array_equal(kept[0].after, kept[1].observations)
    assert kept[-1].truncated.all() and not kept[-2].truncated.any()
