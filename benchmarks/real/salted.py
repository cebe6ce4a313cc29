# SPDX-License-Identifier: MIT
"""Adds the response to a known force to recordings and asks whether the diagnosis finds it.

.venv/bin/python benchmarks/real/salted.py RECORDING... [--salts N] [--seed N]

What a recording's own diagnosis says is predicted from its first row on, with the force and without; the
difference is added to the diabolo's recorded centre and spin. A third of the doses is zero.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from typing import Any

import numpy as np
from diabolo import (
    Air,
    Diagnosis,
    MagnusLift,
    Model,
    Recording,
    SpinLoss,
    StringFriction,
    diagnose,
    load_recording,
    predict,
    start_state,
)
from numpy.typing import NDArray

EFFECTS = (
    "finite_axle",
    "gravity_tilt",
    "gyroscopic_tilt",
    "landing_restitution",
    "stick_flex",
    "string_elasticity",
    "string_mass",
)
FARTHEST = 0.15  # that a prediction may be from the recording for its response to count [m]


@dataclass(frozen=True)
class Force:
    """A force with its smallest and largest dose."""

    name: str
    parameter: str
    least: float
    most: float

    def added_to(self, model: Model, dose: float) -> Model:
        """The model with so much more of it."""
        air, loss, friction = model.air or Air(), model.spin_loss or SpinLoss(), model.string_friction
        effects: dict[str, Any] = {name: getattr(model, name) for name in EFFECTS}
        effects |= {
            "air": air,
            "spin_loss": loss,
            "magnus_lift": model.magnus_lift,
            "string_friction": friction,
        }
        if self.name == "air_drag_linear":
            effects["air"] = Air(
                linear_drag=air.linear_drag + dose,
                quadratic_drag=air.quadratic_drag,
                wind_x=air.wind_x,
                wind_y=air.wind_y,
            )
        elif self.name == "magnus_lift":
            effects["magnus_lift"] = MagnusLift(
                coefficient=(model.magnus_lift or MagnusLift()).coefficient + dose
            )
        elif self.name == "spin_drag":
            effects["spin_loss"] = SpinLoss(air=loss.air + dose, axle=loss.axle)
        else:
            rubs = friction or StringFriction()
            effects["string_friction"] = StringFriction(
                coefficient=rubs.coefficient + dose, spin_gain=rubs.spin_gain
            )
        return Model(model.parameters, **effects)


FORCES = (
    Force("air_drag_linear", "rate", 0.05, 0.4),
    Force("magnus_lift", "coefficient", 0.0005, 0.004),
    Force("spin_drag", "coefficient", 1e-4, 8e-4),
    Force("string_friction", "coefficient", 0.05, 0.2),
)


def turned(quaternions: NDArray[np.float64], angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Orientations (x, y, z, w) after a turn about the body's x axis [rad]."""
    x, y, z, w = quaternions.T
    s, c = np.sin(0.5 * angles), np.cos(0.5 * angles)
    return np.column_stack([x * c + w * s, y * c + z * s, z * c - y * s, w * c - x * s])


def first_start(take: Recording) -> int:
    """The first row from which a prediction can begin."""
    for row in range(len(take.time)):
        try:
            start_state(take, row, start="fair")
        except ValueError:
            continue
        return row
    raise ValueError(f"{take.name}: no row from which a prediction can begin")


def salted(take: Recording, model: Model, force: Force, dose: float) -> Recording | None:
    """The recording as it would be with the force; None where the prediction loses the recording."""
    row = first_start(take)
    without = predict(take, model, row=row, start="fair")
    with_force = predict(take, force.added_to(model, dose), row=row, start="fair")
    change = with_force.states - without.states
    off = np.linalg.norm(without.states[:, :3] - take.diabolo, axis=1)[row:]
    if not (np.isfinite(change[row:]).all() and np.nanmax(off) < FARTHEST):
        return None
    if np.abs(change[row:, :3]).max() > FARTHEST:
        return None
    change[:row] = 0.0
    orientation = take.diabolo_orientation
    if orientation is not None:
        steps = np.diff(take.time, prepend=take.time[0])
        forward = np.sign(
            1.0 - 2.0 * (orientation[:, 1] ** 2 + orientation[:, 2] ** 2)
        )  # body x, or backward
        orientation = turned(orientation, -forward * np.cumsum(change[:, 6] * steps))
    return Recording(
        take.time,
        take.left,
        take.right,
        take.diabolo + change[:, :3],
        take.rate,
        diabolo_orientation=orientation,
        left_orientation=take.left_orientation,
        right_orientation=take.right_orientation,
        name=f"{take.name} salted",
        properties=take.properties,
        string_length=take.string_length,
    )


def found(answer: Diagnosis, force: Force) -> dict[str, Any] | None:
    """The effect's parameter where it is claimed, or tied with what is."""
    for effect in answer.effects:
        if force.name in (effect["name"], *effect["tied_with"]):
            named = {parameter["name"]: parameter for parameter in effect["parameters"]}
            return dict(named.get(force.parameter, {"value": float("nan"), "ci90": None}))
    return None


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", nargs="+")
    parser.add_argument("--salts", type=int, default=6, help="for each recording (6)")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    draw = np.random.default_rng(given.seed)
    print("| recording | force | dose | before | after | claimed |\n|---|---|---|---|---|---|")
    for file in given.recording:
        take = load_recording(file)
        own = diagnose(take)
        for index in range(given.salts):
            force = FORCES[draw.integers(len(FORCES))]
            dose = 0.0 if index % 3 == 0 else draw.uniform(force.least, force.most)
            recording = salted(take, own.model, force, dose)
            if recording is None:
                print(
                    f"| {take.name} | {force.name} | {dose:.3g} | - | - | the prediction loses it |",
                    flush=True,
                )
                continue
            answer = diagnose(recording)
            before, after = found(own, force), found(answer, force)
            values = [f"{one['value']:.3g}" if one else "-" for one in (before, after)]
            claims = ", ".join(effect["name"] for effect in answer.effects)
            print(
                f"| {take.name} | {force.name} | {dose:.3g} | {values[0]} | {values[1]} | {claims} |",
                flush=True,
            )
    return 0


if __name__ == "__main__":
    sys.exit(main())
