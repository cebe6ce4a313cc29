# SPDX-License-Identifier: MIT
"""Agents learn from scratch, by the command: what `pip install '.[learn]'` is for."""

import csv
import json
import signal
import subprocess
import sys
import time
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytestmark = pytest.mark.learn
STEPS = 1_000_000


def diabolo(*arguments: object, status: int = 0) -> subprocess.CompletedProcess[str]:
    done = subprocess.run(
        [sys.executable, "-m", "diabolo", *map(str, arguments)], capture_output=True, text=True, timeout=600
    )
    assert done.returncode == status, done.stderr
    return done


@pytest.fixture(scope="module")
def trained(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("agents") / "spin_up"
    diabolo("train", "SpinUp", "--out", folder, "--steps", STEPS, "--seed", 5)
    return folder


def gained(agent: Any) -> tuple[float, float]:
    """The median of the spin gained [rad/s], and the share of drops."""
    from diabolo.envs import play

    outcomes = play(agent, 200, seed=1000, task="SpinUp", period=0.02, steps=20)
    return float(np.median(outcomes["spin"] - outcomes["first_spin"])), float(outcomes["dropped"].mean())


def test_an_agent_learns_to_spin_the_diabolo_up(trained: Path) -> None:
    from diabolo.envs import Agent

    still, _ = gained(lambda seen: np.zeros((len(seen), 6)))
    spin, dropped = gained(Agent.load(trained / "agent.json"))
    assert spin > still + 50.0
    assert dropped <= 0.05


def test_the_curve_rises_and_the_agent_is_small(trained: Path) -> None:
    with (trained / "progress.csv").open() as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    assert all(one["steps"] < two["steps"] for one, two in pairwise(rows))
    worth = [row["worth"] for row in rows if np.isfinite(row["worth"])]
    assert np.mean(worth[-5:]) > np.mean(worth[:5]) + 0.4
    assert (trained / "agent.json").stat().st_size < 200_000


def test_what_plays_needs_nothing_of_what_trained(trained: Path) -> None:
    script = (
        "import sys; sys.modules['torch'] = sys.modules['stable_baselines3'] = None\n"
        "from diabolo.cli import main\n"
        f"sys.exit(main(['play', 'SpinUp', '--agent', {str(trained / 'agent.json')!r}]))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "episodes ended with a drop" in done.stdout


def steps_kept(folder: Path) -> int:
    path = folder / "training.json"
    return int(json.loads(path.read_text())["progress"]["steps"]) if path.exists() else 0


def test_an_interrupted_training_goes_on_where_it_was(tmp_path: Path) -> None:
    folder = tmp_path / "hold"
    process = subprocess.Popen(
        [sys.executable, "-m", "diabolo", "train", "Hold", "--out", str(folder), "--envs", "32"],
        stderr=subprocess.DEVNULL,
    )
    try:
        end = time.monotonic() + 120.0
        while steps_kept(folder) == 0 and time.monotonic() < end:
            time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        assert process.wait(60) == 130
    finally:
        process.kill()
    before = steps_kept(folder)
    assert before > 0
    diabolo("train", "Hold", "--out", folder, "--envs", 32, "--steps", 4096, status=2)  # not resumed
    diabolo("train", "Hold", "--out", folder, "--envs", 64, "--steps", 4096, "--resume", status=2)
    other = ("--envs", 32, "--steps", 4096, "--resume", "--model", "paper")
    assert "models [] at first" in diabolo("train", "Hold", "--out", folder, *other, status=2).stderr
    diabolo("train", "Hold", "--out", folder, "--envs", 32, "--steps", 4096, "--resume")
    assert steps_kept(folder) >= before + 4096
    steps = [
        int(float(line.split(",")[0])) for line in (folder / "progress.csv").read_text().splitlines()[1:]
    ]
    assert steps == sorted(set(steps))


def test_a_training_may_begin_with_what_an_agent_knows(trained: Path, tmp_path: Path) -> None:
    from diabolo.envs import Agent

    teacher, folder = trained / "agent.json", tmp_path / "longer"
    diabolo("train", "SpinUp", "--out", folder, "--teacher", teacher, "--steps", 16384, "--limits", "ur5e")
    first, second = (Agent.load(path).layers for path in (teacher, folder / "agent.json"))
    apart = [np.abs(one[0] - other[0]).max() for one, other in zip(first, second, strict=True)]
    assert 0.0 < max(apart) < 0.3
    again = ("train", "SpinUp", "--out", folder, "--resume", "--steps", 4096, "--limits", "ur5e")
    assert "teacher" in diabolo(*again, status=2).stderr
    diabolo(*again, "--teacher", teacher)


def test_an_agent_learns_to_correct_plans(tmp_path: Path) -> None:
    from diabolo.envs import Agent, play

    folder = tmp_path / "correction"
    train = ("train", "ThrowAndCatch", "--corrects", "--out", folder, "--seed", 5)
    diabolo(*train, "--steps", 400_000)  # with half as many one of three seeds learnt nothing
    agent = Agent.load(folder / "agent.json")
    assert agent.corrects
    still = [(np.zeros((6, agent.layers[0][0].shape[1])), np.zeros(6))]
    none = Agent(agent.tasks, agent.period, agent.steps, still, corrects=True)
    worth, before = (np.mean(play(one, 400, seed=1000)["worth"]) for one in (agent, none))
    assert worth > before + 0.05
    again = ("train", "ThrowAndCatch", "--out", folder, "--seed", 5, "--steps", 4096, "--resume")
    assert "at first" in diabolo(*again, status=2).stderr
    teacher = tmp_path / "shipped.json"
    teacher.write_text(shipped("SpinUp"))
    other = ("train", "Throw", "--corrects", "--out", tmp_path / "other", "--teacher", teacher)
    assert "teacher: sees 32 numbers; expected 57" in diabolo(*other, status=2).stderr
    assert not (tmp_path / "other").exists()


def shipped(task: str) -> str:
    from diabolo.envs import shipped_agent

    return shipped_agent(task).to_json()


def test_an_agent_learns_several_tasks_at_once(tmp_path: Path) -> None:
    folder = tmp_path / "both"
    diabolo("train", "SpinUp", "ThrowAndCatch", "--out", folder, "--envs", 32, "--steps", 8192)
    kept = json.loads((folder / "training.json").read_text())
    assert kept["settings"]["task"] == ["SpinUp", "ThrowAndCatch"] and kept["settings"]["taught"] == 0.7
    assert json.loads((folder / "agent.json").read_text())["task"] == ["SpinUp", "ThrowAndCatch"]
    again = ("train", "ThrowAndCatch", "--out", folder, "--envs", 32, "--steps", 4096, "--resume")
    assert "task ['SpinUp', 'ThrowAndCatch'] at first" in diabolo(*again, status=2).stderr
    diabolo("train", "SpinUp", *again[1:])
    assert steps_kept(folder) > kept["progress"]["steps"]


def test_many_environments_are_what_stable_baselines_expects() -> None:
    from diabolo.envs import DiaboloEnv
    from diabolo.envs.sb3 import DiaboloVecEnv

    env, one = DiaboloVecEnv(3, "Hop"), DiaboloEnv("Hop")
    env.seed(20)
    seen = env.reset()
    np.testing.assert_array_equal(seen[2], one.reset(seed=22)[0])
    random, worth, length = np.random.default_rng(3), 0.0, 0
    for _ in range(700):
        given = random.uniform(-1.0, 1.0, (3, 6)).astype(np.float32)
        seen, rewards, dones, infos = env.step(given)
        own, reward, over, cut, _ = one.step(given[2])
        worth, length = worth + reward, length + 1
        assert rewards[2] == np.float32(reward) and dones[2] == (over or cut)
        if dones[2]:
            np.testing.assert_array_equal(infos[2]["terminal_observation"], own)
            assert infos[2]["TimeLimit.truncated"] is cut
            assert infos[2]["episode"] == pytest.approx({"r": worth, "l": length})
            own, worth, length = one.reset()[0], 0.0, 0
        np.testing.assert_array_equal(seen[2], own)
    assert env.env_is_wrapped(object) == [False] * 3
    with pytest.raises(ValueError, match="copy: given"):
        DiaboloVecEnv(3, "Hop", copy=False)
    with pytest.raises(ValueError, match="make a DiaboloVecEnv with it"):
        env.set_attr("period", 1.0)


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ("Fly --out d", "TASK 'Fly'; expected one of Hold, Swing"),
        ("Hold Hold --out d", "TASK Hold Hold; expected each once"),
        ("Hold --corrects --out d", "--corrects: the player does not know Hold; expected Hop, Throw"),
        ("Hop --planned-by paper --out d", "--planned-by: given without --corrects; expected both"),
        ("Hop --corrects --taught 0.5 --out d", "--taught 0.5: beside --corrects"),
        ("Hold Swing --taught 0.5 --out d", "--taught 0.5: the player does not teach Hold Swing"),
        ("Hold --out d --seconds 1 --steps 1", "--seconds, --steps: both are given"),
        ("Hold --out d --teacher=", "--teacher '': expected the name of a file"),
        ("Hold --out d --seconds 0", "--seconds 0.0; expected 0.001 to 10000000.0"),
        ("Hold --out d --envs 1", "--envs 1; expected 32 to 65536"),
        ("Hold --out d --resume", "d: expected training.json and checkpoint.zip of a training to resume"),
        ("Hold --out begun --resume", "begun/training.json: "),
        ("Hold --out begun", "begun/training.json: is there; expected another folder, or --resume"),
        ("Hold --out file", "file: a file; expected a folder"),
    ],
)
def test_bad_input_is_told_before_the_work(
    arguments: str,
    complaint: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    from diabolo.cli import main

    monkeypatch.chdir(tmp_path)
    Path("file").write_text("")
    Path("begun").mkdir()
    for name in ("training.json", "checkpoint.zip"):
        (Path("begun") / name).write_text("{}")
    assert main(["train", *arguments.split()]) == 2
    error = capsys.readouterr().err
    assert complaint in error and error.count("\n") == 1
    assert not Path("d").exists()
