# SPDX-License-Identifier: MIT
"""The diabolo in DART: their rigid body and integrator, our string (docs/hosts.md).

    pip install '.[dart]'
    python examples/dart/diabolo_in_dart.py

Tips swing and beat for two seconds. It prints how far DART's body is from the plain predictor.
"""

from __future__ import annotations

import itertools
import sys

import dartpy as dart
import numpy as np
from diabolo import AttachedString, Model, Parameters, State, StringFriction, TipMotion, rollout

INERTIA = (5.6e-4, 6.6e-4, 6.6e-4)  # about and across the axle, which is the body's x axis [kg m^2]
DURATION, SPIN = 2.0, 60.0  # [s], [rad/s]


def play() -> TipMotion:
    t = np.linspace(0.0, DURATION, 201)
    sway, beat = (0.05 * (1.0 - np.cos(2.0 * np.pi * rate * t)) for rate in (0.75, 1.5))
    left = np.stack([sway, np.full_like(t, 0.4), 1.3 + beat], axis=1)
    right = np.stack([-sway, np.full_like(t, -0.4), 1.3 - 0.5 * beat], axis=1)
    return TipMotion(t, left, right, "spline")


def simulate(model: Model, start: State, tips: TipMotion, dt: float) -> np.ndarray:
    """Where DART's body is after each step, (N, 3).

    The diabolo is a hub that is moved along three axes, with cups that turn on it. (DART's free joint counts
    velocities in the turning body's frame, which puts a spinning one off its straight way by the first order
    of the step.)
    """
    world = dart.simulation.World()
    world.setTimeStep(dt)
    gravity = [0.0, 0.0, -model.parameters.gravity]
    world.setGravity(gravity)
    skeleton = dart.dynamics.Skeleton("diabolo")
    place, hub = skeleton.createTranslationalJointAndBodyNodePair()
    axle, cups = skeleton.createRevoluteJointAndBodyNodePair(hub)
    axle.setAxis([1.0, 0.0, 0.0])
    for body in (hub, cups):
        half = dart.dynamics.Inertia()
        half.setMass(0.5 * model.parameters.mass)
        half.setMoment(np.diag(INERTIA))
        body.setInertia(half)
    world.addSkeleton(skeleton)
    place.setPositions(start.position)
    place.setVelocities(start.velocity)
    axle.setVelocities([-start.spin])

    string = AttachedString(model, model.parameters.mass, INERTIA[0], gravity)
    path = []
    samples = list(zip(*tips.at(np.arange(round(DURATION / dt) + 1) * dt), strict=True))
    for now, after in itertools.pairwise(samples):
        wrench = string.step(
            place.getPositions(),
            place.getVelocities(),
            [1.0, 0.0, 0.0],
            axle.getVelocities()[0],
            *now[:2],
            *after[:2],
            dt,
            velocities=(*now[2:4], *after[2:4]),
        )
        place.setForces(wrench.force)
        axle.setForces([wrench.torque[0]])
        world.step()
        path.append(place.getPositions())
    return np.array(path)


def main() -> int:
    model, tips = Model(Parameters(), name="rubbing", string_friction=StringFriction(coefficient=0.2)), play()
    drop = 0.5 * np.sqrt(model.parameters.string_length**2 - 0.8**2)
    start = State([0.0, 0.0, 1.3 - drop], [0.3, 0.2, 0.0], SPIN, "loose")
    for dt in (2e-3, 1e-3):
        path = simulate(model, start, tips, dt)
        plain = rollout(model, start.to_array(), tips, dt=dt, steps=len(path), string_state="loose").states
        farthest = np.linalg.norm(path - plain[:, :3], axis=1).max()
        print(f"dt {1e3 * dt:g} ms: {farthest:.1e} m from the predictor")
    return 0


if __name__ == "__main__":
    sys.exit(main())
