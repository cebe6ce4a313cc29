# SPDX-License-Identifier: MIT
"""How often a throw and its catch, played without a look, succeed over a spread of models.

    .venv/bin/python benchmarks/player/robust.py

The spread is what a diagnosis leaves open: friction 0.015, string length 2 mm, stick stiffness 7 %. One plan
is made for the middle of it, one for five models at once; both are predicted with fresh draws.
"""

from __future__ import annotations

import argparse

import diabolo
import numpy as np
from diabolo import Model, Parameters


def draw(rng: np.random.Generator, spread: float) -> Model:
    friction = 0.25 + spread * rng.normal(0.0, 0.015)
    stiffness = 450.0 * (1.0 + spread * rng.normal(0.0, 0.07))
    return Model(
        Parameters(string_length=1.45 + spread * rng.normal(0.0, 0.002), spin_coupling=0.0),
        string_friction=diabolo.StringFriction(coefficient=friction, spin_gain=3.4),
        stick_flex=diabolo.StickFlex(compliance=1.0 / stiffness, damping=3.0),
    )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--draws", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    rng = np.random.default_rng(given.seed)
    nominal = draw(rng, 0.0)
    planned_for = [nominal, *(draw(rng, 1.0) for _ in range(4))]
    fresh = [draw(rng, 1.0) for _ in range(given.draws)]
    print("height [m]  planned for one  for five  time of the latter [s]")
    for height in (0.3, 0.5, 0.7, 0.9):
        one = diabolo.plan_action("throw_and_catch", nominal, height=height, spin=150.0)
        five = diabolo.plan_action("throw_and_catch", planned_for, height=height, spin=150.0)
        rates = [diabolo.success_rate(play, fresh) for play in (one, five)]
        print(f"{height:10.1f} {100 * rates[0]:14.0f} % {100 * rates[1]:7.0f} % {five.planning_time:12.2f}")


if __name__ == "__main__":
    main()
