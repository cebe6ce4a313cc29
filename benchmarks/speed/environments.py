# SPDX-License-Identifier: MIT
"""How many periods a second the environments play, through Python, beside Gymnasium's CartPole."""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from statistics import median

import gymnasium
import numpy as np
from diabolo import Air, Model, Parameters, SpinLoss, StickFlex, StringFriction
from diabolo.envs import DiaboloEnv, DiaboloVectorEnv

from .. import command

EXAMPLE = "  python -m benchmarks.speed.environments"
COUNT, REPETITIONS, SECONDS = 1024, 9, 0.3
FRICTION = StringFriction(coefficient=0.3)
MODELS = {
    "plain": Model(Parameters()),
    "friction": Model(Parameters(), string_friction=FRICTION),
    "friction, air, loss of spin, bending sticks": Model(
        Parameters(),
        string_friction=FRICTION,
        air=Air(linear_drag=0.1),
        spin_loss=SpinLoss(air=6e-5),
        stick_flex=StickFlex(compliance=3e-3),
    ),
}


def periods_a_second(step: Callable[[], object], each: int) -> float:
    """Median of some repetitions; a step plays `each` periods."""
    rates = []
    for _ in range(REPETITIONS):
        begin, steps = time.perf_counter(), 0
        while (passed := time.perf_counter() - begin) < SECONDS:
            step()
            steps += 1
        rates.append(steps * each / passed)
    return median(rates)


def alone(model: Model) -> float:
    env = DiaboloEnv("SpinUp", model)
    env.reset(seed=1)
    action = np.zeros(6, np.float32)

    def step() -> None:
        *_, terminated, truncated, _ = env.step(action)
        if terminated or truncated:
            env.reset()

    return periods_a_second(step, 1)


def together(model: Model) -> float:
    env = DiaboloVectorEnv(COUNT, "SpinUp", model)
    env.reset(seed=1)
    random = np.random.default_rng(1)
    actions = random.uniform(-0.1, 0.1, (16, COUNT, 6)).astype(np.float32)
    return periods_a_second(lambda: env.step(actions[random.integers(16)]), COUNT)


def cart_pole() -> tuple[float, float]:
    one = gymnasium.make("CartPole-v1").unwrapped
    one.reset(seed=1)
    many = gymnasium.make_vec("CartPole-v1", num_envs=COUNT, vectorization_mode="vector_entry_point")
    many.reset(seed=1)
    actions = np.random.default_rng(1).integers(0, 2, COUNT)
    state = {"k": 0}

    def step() -> None:
        state["k"] += 1
        if one.step(state["k"] % 2)[2]:
            one.reset()

    return periods_a_second(step, 1), periods_a_second(lambda: many.step(actions), COUNT)


def measure(_: argparse.Namespace) -> int:
    print(f"| model | one environment | {COUNT} together |\n|---|---|---|")
    for name, model in MODELS.items():
        print(f"| {name} | {alone(model) / 1e3:.0f} k/s | {together(model) / 1e6:.2f} M/s |", flush=True)
    one, many = cart_pole()
    print(f"| Gymnasium's CartPole | {one / 1e3:.0f} k/s | {many / 1e6:.2f} M/s |")
    return 0


def main() -> int:
    return command.run(command.make_parser("benchmarks.speed.environments", __doc__, EXAMPLE), measure)


if __name__ == "__main__":
    raise SystemExit(main())
