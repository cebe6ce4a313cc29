# SPDX-License-Identifier: MIT
"""Adds to real recordings what a known force would have done to them, and has it found.

.venv/bin/python benchmarks/real/salted.py RECORDING...
"""

from __future__ import annotations

import argparse
import copy
import sys
from collections.abc import Iterator

import diabolo
import numpy as np
from diabolo import Air, MagnusLift, Model, Recording, SpinLoss, StringFriction, TipMotion
from numpy.typing import NDArray

SALTS = {  # name: largest dose, unit, and which entry of the ladder tells its size
    "string_friction": (0.15, "1", "friction"),
    "linear_drag": (0.4, "1/s", "linear_drag"),
    "magnus_lift": (4e-3, "1/rad", "lift"),
    "spin_drag": (5e-4, "1/rad", "spin_air"),
}
STEPS = 8  # of the simulation from row to row
TAUT = 0.012  # how much shorter than usual a taut string's path may be [m]


def with_salt(model: Model, name: str, dose: float) -> Model:
    """The model with more of one effect."""
    salted = copy.copy(model)
    if name == "string_friction":
        f = model.string_friction
        salted.string_friction = StringFriction(coefficient=f.coefficient + dose, spin_gain=f.spin_gain)
    elif name == "linear_drag":
        fields = model.air.to_dict()
        salted.air = Air(**{**fields, "linear_drag": fields["linear_drag"] + dose})
    elif name == "magnus_lift":
        salted.magnus_lift = MagnusLift(coefficient=model.magnus_lift.coefficient + dose)
    else:
        fields = model.spin_loss.to_dict()
        salted.spin_loss = SpinLoss(**{**fields, "air": fields["air"] + dose})
    return salted


class Measured:
    """A recorded play, row by row: the diabolo's state, and the string's length where it is taut."""

    def __init__(self, take: Recording) -> None:
        self.take = take
        self.tips = TipMotion.of_recording(take)
        self.time = take.time - take.time[0]
        self.left, self.right, _, _ = self.tips.at(self.time)
        position, spin = take.diabolo, take.spin()
        velocity = np.full_like(position, np.nan)
        velocity[2:-2] = (position[4:] - position[:-4]) / (self.time[4:] - self.time[:-4])[:, None]
        self.states = np.concatenate([position, velocity, np.nan_to_num(spin)[:, None]], axis=1)
        self.known = ~np.isnan(self.states).any(axis=1)
        below = position[:, 2] < 0.5 * (self.left + self.right)[:, 2]
        self.paths = self.path(np.arange(len(position)), position)
        self.usual = float(np.median(self.paths[below & self.known]))

    def path(self, row: int | NDArray[np.int64], position: NDArray[np.float64]) -> NDArray[np.float64]:
        """From tip to tip over a position [m]."""
        length: NDArray[np.float64] = np.linalg.norm(position - self.left[row], axis=-1) + np.linalg.norm(
            position - self.right[row], axis=-1
        )
        return length

    def is_taut(self, row: int) -> bool:
        return bool(self.known[row] and self.paths[row] > self.usual - TAUT)

    def stepped(self, model: Model, row: int, state: NDArray[np.float64], taut: bool) -> NDArray[np.float64]:
        """A state one row later. A string that is taut is as long as its path."""
        moved = copy.copy(model)
        parameters = copy.copy(model.parameters)
        parameters.string_length = float(self.path(row, state[:3])) if taut else self.usual
        parameters.mass = self.take.properties.mass
        moved.parameters = parameters
        result: NDArray[np.float64] = diabolo.rollout(
            moved,
            state,
            self.tips,
            begin=self.time[row],
            dt=(self.time[row + 1] - self.time[row]) / STEPS,
            steps=STEPS,
            record_every=STEPS,
            string_state="on_string" if taut else "loose",
        ).states[-1]
        return result


def response(take: Recording, model: Model, salted: Model) -> NDArray[np.float64]:
    """What the salt adds to position, velocity and spin in each row: row after row the difference between a
    step with it from where the salted diabolo is and one without it from where the recorded one is."""
    measured = Measured(take)
    added = np.zeros((len(take), 7))
    first = int(np.argmax(measured.known))
    base = measured.states[first]
    for row in range(first, len(take) - 1):
        if measured.known[row]:
            base = measured.states[row]
        state = base + added[row]
        taut = measured.is_taut(row)
        follows = taut and abs(measured.path(row, state[:3]) - measured.path(row, base[:3])) < TAUT
        if follows:  # as long a string as was measured
            left, right = state[:3] - measured.left[row], state[:3] - measured.right[row]
            gradient = left / np.linalg.norm(left) + right / np.linalg.norm(right)
            longer = measured.path(row, state[:3]) - measured.path(row, base[:3])
            added[row, :3] -= gradient * longer / (gradient @ gradient)
            state = base + added[row]
        after = measured.stepped(model, row, base, taut)
        added[row + 1] = measured.stepped(salted, row, state, follows) - after
        base = after  # where the next row is not known
    return added


def with_response(take: Recording, added: NDArray[np.float64]) -> Recording:
    """The recording with the diabolo moved, and turned about its axle by what the spin is more."""
    angle = np.concatenate([[0.0], np.cumsum(added[:-1, 6] * np.diff(take.time))])
    turned = take.diabolo_orientation.copy()
    x, y, z, w = turned.T
    forward = 1.0 - 2.0 * (y * y + z * z) >= 0.0  # the axle's x component in the world
    half = np.where(forward, -0.5, 0.5) * angle  # a spin about the axle as it points backwards
    s, c = np.sin(half), np.cos(half)
    turned = np.stack([w * s + x * c, y * c + z * s, z * c - y * s, w * c - x * s], axis=1)
    return Recording(
        take.time,
        take.left,
        take.right,
        take.diabolo + added[:, :3],
        take.rate,
        diabolo_orientation=turned,
        left_orientation=take.left_orientation,
        right_orientation=take.right_orientation,
        name=take.name,
        properties=take.properties,
        string_length=take.string_length,
    )


def rung_of(answer: diabolo.Diagnosis, parameter: str) -> dict[str, object]:
    """What the ladder says of the candidate with this parameter."""
    return next(rung for rung in answer.result["ladder"] if rung["parameter"] == parameter)


def doses(random: np.random.Generator) -> Iterator[tuple[str, float]]:
    """Each salt with a dose of 40 to 100 % of the largest."""
    for name, (largest, _, _) in SALTS.items():
        yield name, largest * random.uniform(0.4, 1.0)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", nargs="+")
    parser.add_argument("--seed", type=int, default=1, help="of the doses; default 1")
    arguments = parser.parse_args()
    random = np.random.default_rng(arguments.seed)
    print("| salt | dose | found more | named before | named with it | moved [mm] |")
    print("|---|---|---|---|---|---|")
    takes = [diabolo.load_recording(file) for file in arguments.recording]
    plain = diabolo.diagnose(takes)
    for name, dose in doses(random):
        salted = with_salt(plain.model, name, dose)
        added = [response(take, plain.model, salted) for take in takes]
        answer = diabolo.diagnose([with_response(*pair) for pair in zip(takes, added, strict=True)])
        _, unit, parameter = SALTS[name]
        before, after = rung_of(plain, parameter), rung_of(answer, parameter)
        more = float(after["estimate"]) - float(before["estimate"])  # type: ignore[arg-type]
        moved = 1e3 * float(np.sqrt(np.mean(np.concatenate(added)[:, :3] ** 2 * 3.0)))
        claims = ["yes" if rung["claimed"] else "no" for rung in (before, after)]
        print(
            f"| {name} | {dose:.3g} {unit} | {more:.3g} | {claims[0]} | {claims[1]} | {moved:.1f} |",
            flush=True,
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
