# SPDX-License-Identifier: MIT
"""One agent for several tasks: each episode is one of them, and it sees which."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from diabolo.cli import main

gymnasium = pytest.importorskip("gymnasium")
from diabolo.envs import (  # noqa: E402
    Agent,
    DiaboloEnv,
    DiaboloVectorEnv,
    LiveAgent,
    observation_infos,
    play,
    shipped_agent,
)
from gymnasium.utils.env_checker import check_env  # noqa: E402

BOTH = ("SpinUp", "ThrowAndCatch")
USUAL = sum(info["size"] for info in observation_infos())


def agent_of_both() -> Agent:
    """It plays each as the agent of the package throws: which task it is counts for nothing."""
    (weights, bias), *rest = shipped_agent("ThrowAndCatch").layers
    return Agent(BOTH, 0.02, 20, [(np.hstack([weights, np.zeros((len(bias), 2))]), bias), *rest])


def test_each_episode_is_one_of_them_and_it_is_seen_which() -> None:
    env = DiaboloVectorEnv(200, BOTH, threads=1)
    seen, _ = env.reset(seed=1)
    outcomes = env.outcomes()
    assert seen.shape == (200, USUAL + 2)
    np.testing.assert_array_equal(seen[:, -2:], [[task == one for one in BOTH] for task in outcomes["task"]])
    assert 30 < (outcomes["task"] == "SpinUp").sum() < 85  # 57 are as many as make both as long
    seen, _ = env.reset(seed=1, options={"task": "SpinUp"})
    assert (env.outcomes()["task"] == "SpinUp").all()
    env.reset(seed=2, options={"task": "ThrowAndCatch", "goal": [0.6, 0.1]})
    np.testing.assert_allclose(env.outcomes()["goal"], [[0.6, 0.1]] * 200)


def test_gymnasium_finds_nothing_wrong() -> None:
    check_env(gymnasium.make("Diabolo/SpinUp-v0", task=BOTH).unwrapped, skip_render_check=True)


def test_an_agent_of_several_tasks_plays_each_or_all() -> None:
    agent = agent_of_both()
    assert agent.tasks == list(BOTH)
    throws = play(agent, 30, task="ThrowAndCatch", seed=3)
    assert (throws["task"] == "ThrowAndCatch").all() and (throws["flights"] > 0).mean() > 0.9
    assert set(play(agent, 30, seed=3)["task"]) == set(BOTH)
    with pytest.raises(ValueError, match="task: 'Hold'; expected one of SpinUp, ThrowAndCatch"):
        play(agent, 3, task="Hold")


def test_it_is_a_file_and_plays_by_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "both.json"
    path.write_text(agent_of_both().to_json(), encoding="utf-8")
    assert json.loads(path.read_text(encoding="utf-8"))["task"] == list(BOTH)
    command = ["play", "ThrowAndCatch", "--agent", str(path), "--episodes", "20"]
    page = tmp_path / "play.html"
    assert main([*command, "--html", str(page)]) == 0
    assert "ThrowAndCatch: 0 of 20 episodes ended with a drop" in capsys.readouterr().out
    assert main(["play", "Hop", *command[2:]]) == 2
    assert "task: 'Hop'; expected" in capsys.readouterr().err


def test_a_live_agent_is_told_its_task() -> None:
    agent, tips = agent_of_both(), ((0.0, 0.3, 1.25), (0.0, -0.3, 1.25))
    LiveAgent(agent, *tips, task="SpinUp")
    with pytest.raises(ValueError, match="expected one that the agent knows, SpinUp, ThrowAndCatch"):
        LiveAgent(agent, *tips)


@pytest.mark.parametrize(
    ("call", "complaint"),
    [
        (lambda: DiaboloEnv(["Hop", "Hop"]), "task: Hop twice; expected each once"),
        (lambda: DiaboloEnv(["Hop", "Fly"]), 'task: found "Fly"; expected one of Hold'),
        (lambda: DiaboloEnv([]), "task: "),
        (lambda: DiaboloEnv(3), "task: 3"),  # type: ignore[arg-type]
        (lambda: DiaboloEnv(BOTH).reset(options={"goal": [0.5, 0.1]}), "goal: given without a task"),
        (lambda: DiaboloEnv(BOTH).reset(options={"task": "Hop"}), "options, task: 'Hop'; expected"),
        (lambda: DiaboloEnv(BOTH).reset(options={"task": "SpinUp", "goal": [1.0]}), "goal: 1 numbers"),
    ],
)
def test_bad_input_is_told_in_one_sentence(call: Any, complaint: str) -> None:
    with pytest.raises(ValueError) as caught:
        call()
    assert complaint in str(caught.value) and "\n" not in str(caught.value)
