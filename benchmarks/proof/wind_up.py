# SPDX-License-Identifier: MIT
"""The spin that a wind-up with one turn gains on the plant, beside a linear acceleration of the same time.

Both are the player's seeds (`plan/motions.hpp`), cycle after cycle as they are: nothing is planned.
"""

from __future__ import annotations

import argparse
import sys

import numpy as np
from diabolo import TipPath
from diabolo.motions import cycles_of

from .. import command
from . import plant
from .player.plant import Plant

TWICE = 2.0
"""What the wind-up must gain, over the linear acceleration."""


def gained(player: Plant, path: TipPath, spin: float, seconds: float) -> float:
    """Spin gained in so many seconds of a motion [rad/s]; raises ValueError where the diabolo is lost."""
    played = player.play(path, spin)
    if not played.held_at(seconds):
        raise ValueError(f"the diabolo is lost before {seconds:.2f} s; expected it on the string")
    begin, end = np.interp([0.0, seconds], played.time, played.spin)
    return float(end - begin)


def main() -> int:
    parser = command.make_parser(
        "benchmarks.proof.wind_up", __doc__, "  .venv/bin/python -m benchmarks.proof.wind_up"
    )
    plant.add_option(parser)
    parser.add_argument("--cycles", metavar="N", type=int, default=9, help="of the wind-up; default: 9")
    return command.run(parser, act)


def act(arguments: argparse.Namespace) -> int:
    if not 1 <= arguments.cycles <= 100:
        raise ValueError(f"--cycles {arguments.cycles}: expected 1 to 100")
    plant.check(arguments.plant)
    wind_up = cycles_of("wind_up", arguments.cycles)
    seconds = wind_up.end - wind_up.begin
    one = cycles_of("linear_acceleration", 1)
    linear = cycles_of("linear_acceleration", int(np.ceil(seconds / (one.end - one.begin))))
    print(f"spin gained in {seconds:.2f} s [rad/s]")
    print(f"{'friction':>8} {'spin':>5} {'linear':>7} {'wind-up':>8}  ratio")
    enough = True
    for friction in (0.2, 0.25, 0.3):
        for spin in (30.0, 60.0):
            plain = gained(Plant(arguments.plant, friction), linear, spin, seconds)
            wound = gained(Plant(arguments.plant, friction, wraps=1), wind_up, spin, seconds)
            print(f"{friction:8.2f} {spin:5.0f} {plain:7.1f} {wound:8.1f}  {wound / plain:5.2f}", flush=True)
            enough = enough and wound >= TWICE * plain
    return 0 if enough else 1


if __name__ == "__main__":
    sys.exit(main())
