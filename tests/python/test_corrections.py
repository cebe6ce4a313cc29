# SPDX-License-Identifier: MIT
"""Agents that add to the player's plans, in environments and outside."""

import json
import pickle
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
import pytest
from diabolo.cli import main
from numpy.typing import NDArray

pytest.importorskip("gymnasium")
from diabolo.envs import (
    Agent,
    DiaboloEnv,
    DiaboloVectorEnv,
    HandLimits,
    LiveAgent,
    hand_plan,
    observation_infos,
    planned_starts,
    play,
)

TASK, PERIOD = "ThrowAndCatch", 0.02
LIMITS, HOME = HandLimits(), np.array([0.55, 0.0, 1.25])  # where a plan begins
USUAL = sum(info["size"] for info in observation_infos())
SEEN = sum(info["size"] for info in observation_infos(TASK, corrects=True))


@pytest.fixture(scope="module")
def starts() -> list[Any]:
    return planned_starts(TASK, plays=4, seed=5)


def correcting(weights: NDArray[Any]) -> Agent:
    return Agent(TASK, PERIOD, 20, [(weights, np.zeros(6))], corrects=True)


def planned(height: float = 0.6) -> diabolo.PlannedPlay:
    limits = diabolo.TipLimits(
        speed=LIMITS.speed,
        acceleration=LIMITS.acceleration,
        lowest=HOME - LIMITS.half,
        highest=HOME + LIMITS.half,
    )
    return diabolo.plan_action("throw_and_catch", height=height, sideways=0.1, limits=limits)


def test_a_correction_of_zero_throws_as_planned(starts: list[Any]) -> None:
    assert 2 <= len(starts) <= 4
    outcomes = play(correcting(np.zeros((6, SEEN))), 30, starts=starts, start_share=1.0)
    assert np.median(outcomes["apex"]) > 0.1 and (outcomes["flights"] == 1).mean() > 0.3


def test_what_is_off_the_plan_is_seen(starts: list[Any]) -> None:
    env = DiaboloEnv(TASK, period=PERIOD, steps=20, starts=starts[:1], start_share=1.0)
    seen, _ = env.reset(seed=1)
    assert seen.shape == (SEEN,)
    np.testing.assert_allclose(seen[USUAL : USUAL + 18], 0.0, atol=1e-6)  # nothing is off at first
    assert seen[-1] == pytest.approx(PERIOD * (len(hand_plan(planned())) - 1), abs=0.5)  # until its end
    seen, *_ = env.step([0.0, 0.0, 1.0, 0.0, 0.0, -1.0])
    left, right = seen[USUAL + 6 : USUAL + 9], seen[USUAL + 9 : USUAL + 12]
    lifted = 0.5 * 0.5 * LIMITS.acceleration * PERIOD**2
    np.testing.assert_allclose(left, [0.0, 0.0, lifted], atol=1e-6)
    np.testing.assert_allclose(right, [0.0, 0.0, -lifted], atol=1e-6)


def test_a_live_agent_corrects_a_plan_as_it_does_in_an_environment() -> None:
    random = np.random.default_rng(2422)
    agent = correcting(random.normal(size=(6, SEEN)) / 10.0)
    plan = hand_plan(planned())
    live = LiveAgent(agent, plan.left, plan.right, (0.6, 0.1), plan=plan)
    again = LiveAgent(agent, plan.left, plan.right, (0.6, 0.1), plan=pickle.loads(pickle.dumps(plan)))
    state = diabolo.hang_at_rest(diabolo.Model(diabolo.Parameters()), plan.left, plan.right, 90.0)
    first = DiaboloEnv(TASK).observation_space.shape
    assert first == (USUAL,)
    for _ in range(len(plan)):
        tips = live.act(state)
        np.testing.assert_array_equal(tips, again.act(state))
    still = LiveAgent(correcting(np.zeros((6, SEEN))), plan.left, plan.right, (0.6, 0.1), plan=plan)
    path = planned().path
    for number in range(1, len(plan)):
        left, right, *_ = still.act(state)
        wanted = path.derivatives([min(path.begin + number * PERIOD, path.end)])[0, 0].reshape(2, 3)
        np.testing.assert_allclose([left, right], wanted - [0.55, 0.0, 0.0], atol=5e-3)


def test_an_agent_that_corrects_is_a_file_and_plays_by_the_command(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "agent.json"
    path.write_text(correcting(np.zeros((6, SEEN))).to_json(), encoding="utf-8")
    assert json.loads(path.read_text(encoding="utf-8"))["corrects"] is True
    assert Agent.load(str(path)).corrects
    assert main(["play", TASK, "--agent", str(path), "--episodes", "20", "--json", "-"]) == 0
    episodes = json.loads(capsys.readouterr().out)["episodes"]
    assert np.mean(episodes["apex"]) > 0.2  # it throws
    assert main(["play", "SpinUp", "--agent", str(path), "--episodes", "20"]) == 2
    assert "task: 'SpinUp'; expected one of Hop, Throw" in capsys.readouterr().err
    minari = ["--minari", "diabolo/corrected-v0"]
    assert main(["play", TASK, "--agent", str(path), "--episodes", "1", *minari]) == 2


@pytest.mark.parametrize(
    ("call", "complaint"),
    [
        (lambda: planned_starts("SpinUp"), "task: 'SpinUp'; expected one of Hop, Throw"),
        (lambda: planned_starts(TASK, plays=0), "plays: 0"),
        (lambda: planned_starts(TASK, plays=1, period=1.0), "period: 1 s; expected 0.001 to 0.1 s"),
        (lambda: hand_plan(planned(), period=0.0), "period: 0 s; expected 0.001 to 0.1 s"),
        (lambda: hand_plan(planned(), string_length=-1.0), "string_length: -1; expected"),
        (lambda: hand_plan(3), "planned: 3; expected"),  # type: ignore[arg-type]
        (lambda: correcting(np.zeros((6, USUAL))), f"expected {SEEN} inputs"),
        (
            lambda: DiaboloVectorEnv(2, TASK, starts=planned_starts(TASK, plays=1, seed=5), start_share=1.0),
            "starts, 0: a plan for a period of 0.02 s; expected 0.01 s",
        ),
        (
            lambda: LiveAgent(correcting(np.zeros((6, SEEN))), (0, 0.3, 1.25), (0, -0.3, 1.25), (0.6, 0.1)),
            "plan: none, for an agent that corrects one; expected one",
        ),
    ],
)
def test_bad_input_is_told_in_one_sentence(call: Any, complaint: str) -> None:
    with pytest.raises(ValueError) as caught:
        call()
    assert complaint in str(caught.value) and "\n" not in str(caught.value)
