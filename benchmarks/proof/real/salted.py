# SPDX-License-Identifier: MIT
"""Adds to real recordings what a known force would have done to them, and has it found."""

from __future__ import annotations

import argparse
import copy
import sys

import diabolo
import numpy as np
from diabolo import Air, MagnusLift, Model, Recording, SpinLoss, StringFriction, TipMotion
from diabolo.rotations import first_axes
from numpy.typing import NDArray

from ... import command

SALTS = {  # name: largest dose, unit, and which entry of the ladder tells its size
    "string_friction": (0.15, "1", "friction"),
    "air_drag_linear": (0.4, "1/s", "linear_drag"),
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
    elif name == "air_drag_linear":
        fields = model.air.to_dict()
        salted.air = Air(**{**fields, "linear_drag": fields["linear_drag"] + dose})
    elif name == "magnus_lift":
        salted.magnus_lift = MagnusLift(coefficient=model.magnus_lift.coefficient + dose)
    else:
        fields = model.spin_loss.to_dict()
        salted.spin_loss = SpinLoss(**{**fields, "air": fields["air"] + dose})
    return salted


def on_rigid_string(model: Model) -> Model:
    """The model without what gives: the measured path from tip to tip says how long the string is."""
    fields = model.to_dict()
    given = ("string_friction", "air", "magnus_lift", "spin_loss", "gravity_tilt")
    return Model(model.parameters, **{name: fields[name] for name in given if name in fields})


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
        longer = measured.path(row, state[:3]) - measured.path(row, base[:3])
        follows = taut and abs(float(longer)) < TAUT
        if follows:  # as long a string as was measured
            left, right = state[:3] - measured.left[row], state[:3] - measured.right[row]
            gradient = left / np.linalg.norm(left) + right / np.linalg.norm(right)
            added[row, :3] -= gradient * longer / (gradient @ gradient)
            state = base + added[row]
        after = measured.stepped(model, row, base, taut)
        added[row + 1] = measured.stepped(salted, row, state, follows) - after
        base = after  # where the next row is not known
    return added


def with_response(take: Recording, added: NDArray[np.float64]) -> Recording:
    """The recording with the diabolo moved, and turned about its axle by what the spin is more."""
    return Recording(
        take.time,
        take.left,
        take.right,
        take.diabolo + added[:, :3],
        take.rate,
        diabolo_orientation=turned(take, added[:, 6]),
        left_orientation=take.left_orientation,
        right_orientation=take.right_orientation,
        name=take.name,
        properties=take.properties,
        string_length=take.string_length,
    )


def turned(take: Recording, spin: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """The diabolo's orientations with so much more spin [rad/s], about the axle as it points backwards."""
    if take.diabolo_orientation is None:
        return None
    x, y, z, w = take.diabolo_orientation.T
    forward = first_axes(take.diabolo_orientation)[:, 0] >= 0.0
    turns = np.where(forward, -1.0, 1.0)[:-1] * spin[:-1] * np.diff(take.time)
    half = 0.5 * np.concatenate([[0.0], np.cumsum(turns)])
    s, c = np.sin(half), np.cos(half)
    return np.stack([w * s + x * c, y * c + z * s, z * c - y * s, w * c - x * s], axis=1)


def estimate_of(answer: diabolo.Diagnosis, parameter: str) -> float:
    """What the ladder says of the candidate with this parameter, claimed or not."""
    return float(next(row.estimate for row in answer.result.ladder if row.parameter == parameter))


def names_of(answer: diabolo.Diagnosis) -> set[str]:
    return {effect.name for effect in answer.effects}


def make_parser() -> argparse.ArgumentParser:
    parser = command.make_parser(
        "benchmarks.proof.real.salted",
        __doc__,
        "  python -m benchmarks.proof.real.salted data/recordings/{swing,hop}.csv",
    )
    parser.add_argument("recording", nargs="+", help="of one set-up")
    parser.add_argument("--seed", type=int, default=1, help="of the doses; default: 1")
    return parser


def act(given: argparse.Namespace) -> int:
    random = np.random.default_rng(given.seed)
    takes = [diabolo.load_recording(file) for file in given.recording]
    plain = diabolo.diagnose(takes)
    model = on_rigid_string(plain.model)
    print("| salt | dose | found more | named without it | named with it | newly named beside it | no more |")
    print("|---|---|---|---|---|---|---|")
    for name, (largest, unit, parameter) in SALTS.items():
        dose = largest * random.uniform(0.4, 1.0)
        salted = with_salt(model, name, dose)
        takes_with = [with_response(take, response(take, model, salted)) for take in takes]
        answer = diabolo.diagnose(takes_with)
        before, after = names_of(plain), names_of(answer)
        cells = [
            name,
            f"{dose:.3g} {unit}",
            f"{estimate_of(answer, parameter) - estimate_of(plain, parameter):.3g}",
            *("yes" if name in names else "no" for names in (before, after)),
            ", ".join(sorted(after - before - {name})) or "-",
            ", ".join(sorted(before - after)) or "-",
        ]
        print(f"| {' | '.join(cells)} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(command.run(make_parser(), act))
