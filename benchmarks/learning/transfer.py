# SPDX-License-Identifier: MIT
"""What a trained agent is worth elsewhere: control steps of training until throws are caught on another
string or diabolo, from nothing and from what the agent of the package knows.

Every 262 thousand steps an agent plays 500 episodes. It is good enough where 95 % of the throws are
caught and 75 % are caught within 10 % of their height. All trainings have the same settings and seed.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import NamedTuple

import diabolo
import numpy as np
from diabolo import Model, Parameters
from diabolo.cli.train import USUALLY_TAUGHT
from diabolo.envs import Agent, play, shipped_agent
from diabolo.training import Settings, Trainer

from .. import command

EXAMPLE = "  python -m benchmarks.learning.transfer --steps 6000000"
TASK = "ThrowAndCatch"
BITE = 262_144  # control steps between two looks: sixteen of PPO's rollouts
EPISODES, FIRST_SEED = 500, 10_000  # of a look
CAUGHT, NEAR = 0.95, 0.75


def rubbing(**changes: float) -> Model:
    """The environments' usual model, changed."""
    return Model(
        Parameters(**changes),  # type: ignore[arg-type]
        name="transfer",
        string_friction=diabolo.StringFriction(coefficient=0.3),
    )


OTHERS = {
    "string of 1.25 m": rubbing(string_length=1.25),
    "string of 1.35 m": rubbing(string_length=1.35),
    "axle of 13 mm": rubbing(axle_radius=0.013),
    "string that stretches, sticks that bend": Model(
        Parameters(),
        name="transfer",
        string_friction=diabolo.StringFriction(coefficient=0.3),
        string_elasticity=diabolo.StringElasticity(compliance=0.0015, damping=10.0),
        stick_flex=diabolo.StickFlex(compliance=0.003, damping=3.0),
    ),
}


class Look(NamedTuple):
    """At an agent: shares of its throws that are caught, and that are caught within 10 % of their height."""

    caught: float
    near: float

    @property
    def good(self) -> bool:
        return self.caught >= CAUGHT and self.near >= NEAR


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.learning.transfer", __doc__, EXAMPLE)
    parser.add_argument(
        "--steps", type=int, default=8_000_000, metavar="N", help="of a training at most; default: 8000000"
    )
    parser.add_argument("--on", nargs="+", choices=OTHERS, default=OTHERS, help="default: all")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="default: 0")
    return command.run(parser, run, arguments)


def run(given: argparse.Namespace) -> int:
    if given.steps < BITE:
        raise ValueError(f"--steps {given.steps}; expected {BITE} or more")
    known = shipped_agent(TASK)
    print("| on | untrained | from nothing | from the agent of the package | share |")
    print("|---|---|---|---|---|")
    for name in given.on:
        model = OTHERS[name]
        before = looked(known, model)
        none = steps_until_good(model, None, given)
        some = 0 if before.good else steps_until_good(model, known, given)
        share = f"{some / none:.2f}" if none is not None and some is not None else "-"
        print(
            f"| {name} | {before.caught:.0%}, {before.near:.0%} | {told(none)} | {told(some)} | {share} |",
            flush=True,
        )
    return 0


def looked(agent: Agent, model: Model) -> Look:
    """At what an agent does with a model."""
    outcomes = play(agent, EPISODES, model=model, seed=FIRST_SEED)
    caught = (outcomes["flights"] > 0) & ~outcomes["dropped"]
    height = outcomes["goal"][:, 0]
    near = caught & (np.abs(outcomes["apex"] - height) < 0.1 * height)
    return Look(float(caught.mean()), float(near.mean()))


def steps_until_good(model: Model, teacher: Agent | None, given: argparse.Namespace) -> int | None:
    """Of a training; None where it does not come to that."""
    trainer = Trainer(Settings(TASK, given.seed, taught=USUALLY_TAUGHT), model, teacher=teacher)
    for done in range(BITE, given.steps + 1, BITE):
        trainer.learn(steps=BITE)
        look = looked(trainer.agent(), model)
        print(f"\r{done / 1e6:.2f} M: {look.caught:.0%}, {look.near:.0%}   ", end="", file=sys.stderr)
        if look.good:
            return done
    return None


def told(steps: int | None) -> str:
    return "not reached" if steps is None else f"{steps / 1e6:.2f} M"


if __name__ == "__main__":
    sys.exit(main())
