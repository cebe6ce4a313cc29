# SPDX-License-Identifier: MIT
"""Environments under random and hostile actions, for as many control steps as wanted: whether every number
that they give stays finite, and every tip within its limits.

All tasks in turn, with the usual model and with every effect, seen exactly and by a camera. Of the
environments a third moves at random, a third goes from one extreme to the other, and a third pushes on.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence

import diabolo
import numpy as np
from diabolo import Model, Parameters
from diabolo.envs import TASKS, DiaboloVectorEnv, HandLimits
from numpy.typing import NDArray

from .. import command

EXAMPLE = "  python -m benchmarks.learning.endurance --steps 100000000"
ENVS = 1024
BITE = 200  # periods in a row


def everything() -> Model:
    """Every effect at once, large."""
    return Model(
        Parameters(),
        name="everything",
        string_friction=diabolo.StringFriction(coefficient=0.4),
        string_elasticity=diabolo.StringElasticity(compliance=0.002, damping=5.0),
        stick_flex=diabolo.StickFlex(compliance=0.006, damping=2.0),
        finite_axle=diabolo.FiniteAxle(radius=0.01),
        air=diabolo.Air(linear_drag=0.1, quadratic_drag=0.1),
        magnus_lift=diabolo.MagnusLift(coefficient=0.003),
        spin_loss=diabolo.SpinLoss(air=1e-4),
        landing_restitution=diabolo.LandingRestitution(coefficient=0.5),
    )


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.learning.endurance", __doc__, EXAMPLE)
    parser.add_argument(
        "--steps", type=int, default=10_000_000, metavar="N", help="control steps; default: 10000000"
    )
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="default: 1")
    return command.run(parser, run, arguments)


def run(given: argparse.Namespace) -> int:
    if given.steps < ENVS * BITE:
        raise ValueError(f"--steps {given.steps}; expected {ENVS * BITE} or more")
    rng = np.random.default_rng(given.seed)
    cases = [
        (task, model, difficulty)
        for task in TASKS
        for model in (None, everything())
        for difficulty in ("easy", "real")
    ]
    done, faults, begun = 0, 0, time.monotonic()
    for bite in range(-(-given.steps // (ENVS * BITE))):
        task, model, difficulty = cases[bite % len(cases)]
        found = wrong_numbers(task, model, difficulty, rng)
        if found:
            print(f"{task}, {difficulty}, {'usual' if model is None else model.name}: {found} wrong numbers")
        faults, done = faults + found, done + ENVS * BITE
        rate = done / (time.monotonic() - begun)
        print(f"\r{done / 1e6:.1f} M, {rate / 1e6:.2f} M/s", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    print(f"{done} control steps, seed {given.seed}: {faults} wrong numbers")
    return int(faults > 0)


def wrong_numbers(task: str, model: Model | None, difficulty: str, rng: np.random.Generator) -> int:
    """Numbers that are not finite, and tips outside their box, in a bite."""
    env = DiaboloVectorEnv(ENVS, task, model, difficulty=difficulty, copy=False)
    env.reset(seed=int(rng.integers(2**31)))
    half = HandLimits().half + 1e-6
    held = rng.uniform(-1.0, 1.0, (ENVS, 6)).astype(np.float32)
    wrong = 0
    for _ in range(BITE):
        act(held, rng)
        observations, rewards, *_ = env.step(held)
        tips = observations[:, 10:16].reshape(-1, 2, 3)
        wrong += int((~np.isfinite(observations)).sum() + (~np.isfinite(rewards)).sum())
        wrong += int((np.abs(tips) > half).sum())
    return wrong


def act(held: NDArray[np.float32], rng: np.random.Generator) -> None:
    """The next actions: at random, from extreme to extreme, or as before with now and then another one."""
    third = len(held) // 3
    held[:third] = rng.uniform(-1.0, 1.0, (third, 6))
    held[third : 2 * third] = rng.choice([-1e30, -1.0, 1.0, 1e30], (third, 6))
    again = 2 * third + np.flatnonzero(rng.random(len(held) - 2 * third) < 0.02)
    held[again] = rng.choice([-1.0, 0.0, 1.0], (len(again), 6))


if __name__ == "__main__":
    sys.exit(main())
