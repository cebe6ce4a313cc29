# SPDX-License-Identifier: MIT
"""How often a throw and its catch, both played without a look, succeed over a spread of models.

The spread is what a diagnosis leaves open (friction 0.015, string length 2 mm, stick stiffness 7 %), three
times that, or all that may be with a string of known length (session.spread). One plan is made for the middle
of it, one for five models at once, the middle and four corners two deviations out (every other one of a
cube, so that no two parameters go together); both are predicted with fresh draws.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence

import diabolo
import numpy as np
from diabolo import Model, Parameters, PlannedPlay, _core
from diabolo.enums import StringState

from .. import command
from .player.session import spread

SPIN = 150.0  # [rad/s]


CORNERS = ((2, 2, 2), (2, -2, -2), (-2, 2, -2), (-2, -2, 2))
"""Of the models that are planned for [deviations]."""


def diagnosed(off: Sequence[float], times: float) -> Model:
    """So many deviations off in friction, stiffness and length."""
    friction = 0.25 + times * 0.015 * off[0]
    stiffness = 450.0 * (1.0 + times * 0.07 * off[1])
    return Model(
        Parameters(string_length=1.45 + times * 0.002 * off[2], spin_coupling=0.0),
        string_friction=diabolo.StringFriction(coefficient=max(0.0, friction), spin_gain=3.4),
        stick_flex=diabolo.StickFlex(compliance=1.0 / stiffness, damping=3.0),
    )


def anything(rng: np.random.Generator) -> Model:
    model = spread(1.45)[0]
    model.string_friction.coefficient = float(rng.uniform(0.1, 0.35))
    model.string_elasticity.compliance = 1.45 / float(rng.uniform(1000.0, 5000.0))
    model.stick_flex.compliance = 1.0 / float(rng.uniform(250.0, 800.0))
    return model


def caught(play: PlannedPlay, model: Model) -> bool:
    """Whether the diabolo ends on the string, below the hands."""
    _, states, codes, left, right = _core.foresee(model, play.start, play.path)
    return bool(codes[-1] != StringState.FLYING and states[-1, 2] < 0.5 * (left[-1, 2] + right[-1, 2]))


def make_parser() -> argparse.ArgumentParser:
    parser = command.make_parser(
        "benchmarks.proof.robust", __doc__, "  python -m benchmarks.proof.robust --draws 100"
    )
    parser.add_argument("--draws", type=int, default=60, help="fresh models for each plan; default: 60")
    parser.add_argument("--seed", type=int, default=1, help="of the models; default: 1")
    return parser


def act(given: argparse.Namespace) -> int:
    print("| spread | height [m] | planned for one | planned for five | planning of the latter [s] |")
    print("|---|---|---|---|---|")
    spreads: dict[str, tuple[list[Model], Callable[[np.random.Generator], Model]]] = {}
    rng = np.random.default_rng(given.seed)
    for name, times in (("of a diagnosis", 1.0), ("three times that", 3.0)):
        five = [diagnosed(off, times) for off in ((0, 0, 0), *CORNERS)]
        spreads[name] = five, lambda rng, times=times: diagnosed(rng.normal(size=3), times)  # type: ignore[misc]
    spreads["all that may be"] = spread(1.45), anything
    for name, (five, fresh) in spreads.items():
        models = [fresh(rng) for _ in range(given.draws)]
        for height in (0.3, 0.5, 0.7, 0.9):
            plans = [
                diabolo.plan_action("throw_and_catch", planned, height=height, spin=SPIN, seconds=100.0)
                for planned in (five[0], five)
            ]
            rates = [100.0 * np.mean([caught(play, model) for model in models]) for play in plans]
            print(
                f"| {name} | {height} | {rates[0]:.0f} % | {rates[1]:.0f} % | {plans[1].planning_time:.1f} |",
                flush=True,
            )
    return 0


if __name__ == "__main__":
    sys.exit(command.run(make_parser(), act))
