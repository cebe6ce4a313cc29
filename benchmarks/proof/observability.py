# SPDX-License-Identifier: MIT
"""What forces on the tips say of where a play began, by the linearised information over some seconds.

Five numbers of a taut start: two along the string's surface of position and of velocity, and the spin. Two
more of a flying one. The predictor's forces are differentiated by each, and their squares over the sensor's
variance summed. A standard deviation is what all forces together leave of a number, the others unknown,
too. Nothing known counts as much as the prior's deviation. Numbers are scaled by the prior's deviations
before rank and condition are taken; a direction counts for the rank where forces at least halve its
deviation.
"""

from __future__ import annotations

import argparse
import sys
from typing import NamedTuple

import numpy as np
from diabolo import Model, Parameters, State, StringFriction, TipMotion, hang_at_rest, rollout
from numpy.typing import NDArray

from .. import command

RATE = 500  # [Hz]
NOISE = 0.1  # of each component and of each tension [N]
PRIOR = np.array([0.1, 0.1, 0.1, 1.0, 1.0, 1.0, 50.0])  # [m], [m/s], [rad/s]
SMALL = 1e-3  # share of the prior by which numbers are changed

Array = NDArray[np.float64]


class Start(NamedTuple):
    """A play of the predictor: tips, and what it begins with."""

    tips: TipMotion
    state: State
    flying: bool = False


def model() -> Model:
    return Model(
        Parameters(spin_coupling=0.0, catch_slack=0.9),
        string_friction=StringFriction(coefficient=0.2, spin_gain=3.8),
    )


def hands(motion: str, seconds: float) -> tuple[Array, Array, Array]:
    """Times, left and right tips."""
    time = np.linspace(0.0, seconds, int(seconds * RATE) + 1)
    left, right = (np.tile([0.0, y, 1.2], (len(time), 1)) for y in (0.3, -0.3))
    start = np.minimum(1.0, time / 0.5) ** 2 * (3.0 - 2.0 * np.minimum(1.0, time / 0.5))
    if motion == "swing":
        side = 0.1 * np.sin(2 * np.pi * 0.75 * time) * start
        left[:, 1] += side
        right[:, 1] += side
    if motion == "beat":
        lift = 0.06 * np.sin(2 * np.pi * 1.4 * time) * start
        left[:, 2] += lift
        right[:, 2] -= lift
    if motion == "circle":
        for tip, phase in ((left, 0.0), (right, np.pi)):
            tip[:, 1] += 0.1 * np.cos(2 * np.pi * 1.1 * time + phase) * start
            tip[:, 2] += 0.1 * np.sin(2 * np.pi * 1.1 * time + phase) * start
    return time, left, right


def begin(motion: str, seconds: float) -> Start:
    time, left, right = hands(motion, seconds)
    tips = TipMotion(time, left, right)
    if motion == "flight":
        return Start(tips, State([0.0, 0.0, 1.3], [0.0, 0.0, 3.0], 150.0, string_state="flying"), True)
    return Start(tips, hang_at_rest(model(), left[0], right[0], 150.0))


def on_string(position: Array, left: Array, right: Array, length: float) -> Array:
    """The nearest point of the taut string's surface, by Newton's method."""
    for _ in range(5):
        to_left, to_right = position - left, position - right
        gradient = to_left / np.linalg.norm(to_left) + to_right / np.linalg.norm(to_right)
        excess = np.linalg.norm(to_left) + np.linalg.norm(to_right) - length
        position = position - gradient * excess / (gradient @ gradient)
    return position


def directions(start: Start) -> Array:
    """What is varied, as rows of seven numbers in units of the prior."""
    if start.flying:
        return np.eye(7)
    left, right = start.tips.left[0], start.tips.right[0]
    position = start.state.position
    normal = sum((position - tip) / np.linalg.norm(position - tip) for tip in (left, right))
    normal = normal / np.linalg.norm(normal)
    forward = np.array([1.0, 0.0, 0.0])
    forward = forward - normal * (normal @ forward)
    across = np.cross(normal, forward / np.linalg.norm(forward))
    rows = np.zeros((5, 7))
    rows[0, :3], rows[1, :3], rows[2, 3:6], rows[3, 3:6], rows[4, 6] = forward, across, forward, across, 1.0
    return rows


def readings(start: Start, away: Array, seconds: float, tensions: bool) -> Array:
    numbers = start.state.to_array()[:7] + away * PRIOR
    left, right = start.tips.left[0], start.tips.right[0]
    if not start.flying:
        numbers[:3] = on_string(numbers[:3], left, right, model().parameters.string_length)
    found = rollout(
        model(),
        numbers,
        start.tips,
        dt=1.0 / RATE,
        steps=int(seconds * RATE),
        string_state="flying" if start.flying else "on_string",
        forces=True,
    ).forces
    assert found is not None
    return (np.linalg.norm(found, axis=-1) if tensions else found).ravel()


class Seen(NamedTuple):
    deviations: Array
    """Of what is varied, in the units of the prior's deviations."""
    rank: int
    condition: float | None
    """Of the root of the information in the directions of the rank; None where it is zero."""


def seen(start: Start, seconds: float, tensions: bool) -> Seen:
    rows = directions(start)

    def at(away: Array) -> Array:
        return readings(start, away, seconds, tensions)

    slopes = np.stack(
        [
            (
                readings(start, SMALL * row, seconds, tensions)
                - readings(start, -SMALL * row, seconds, tensions)
            )
            / (2 * SMALL)
            for row in rows
        ],
        axis=1,
    )
    information = slopes.T @ slopes / NOISE**2
    eigenvalues = np.maximum(np.linalg.eigvalsh(information), 0.0)
    told = eigenvalues[eigenvalues >= 3.0]  # of what leaves half a deviation
    condition = float(np.sqrt(told[-1] / told[0])) if len(told) else None
    left = np.linalg.inv(information + np.eye(len(rows)))
    return Seen(np.sqrt(np.diag(left)), len(told), condition)


def act(arguments: argparse.Namespace) -> int:
    print(
        "| motion | seconds | sensor | rank | condition | position [mm] | velocity [mm/s] "
        "| spin [rad/s] |\n|" + "---|" * 8
    )
    cases = [(motion, arguments.seconds) for motion in ("hold", "swing", "beat", "circle")]
    for motion, seconds in [*cases, ("flight", 0.5), ("flight", 1.5)]:
        start = begin(motion, seconds)
        for sensor in ("forces", "tensions"):
            found = seen(start, seconds, sensor == "tensions")
            places = len(found.deviations) // 2
            position, velocity = found.deviations[:places] * 100.0, found.deviations[places:-1] * 1000.0
            condition = "" if found.condition is None else f"{found.condition:.0f}"
            print(
                f"| {motion} | {seconds:g} | {sensor} | {found.rank} of {len(found.deviations)} "
                f"| {condition} | {', '.join(f'{x:.1f}' for x in position)} "
                f"| {', '.join(f'{x:.0f}' for x in velocity)} | {50.0 * found.deviations[-1]:.1f} |"
            )
    return 0


def main() -> int:
    parser = command.make_parser(
        "benchmarks.proof.observability", __doc__, "  python -m benchmarks.proof.observability"
    )
    parser.add_argument("--seconds", metavar="S", type=float, default=5.0, help="default: 5")
    return command.run(parser, act)


if __name__ == "__main__":
    sys.exit(main())
