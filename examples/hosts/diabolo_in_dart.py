# SPDX-License-Identifier: MIT
"""The diabolo in DART: their rigid body and integrator, our string (docs/hosts.md).

    pip install '.[dart,plot]'
    python examples/hosts/diabolo_in_dart.py --picture dart.png
    python examples/hosts/diabolo_in_dart.py MOTION.csv SIM.csv

Tips swing and beat for two seconds. It prints, and draws, how far DART's body is from the plain predictor.
Or it plays what `diabolo motion` wrote, for `diabolo diagnose TAKE.csv --simulated SIM.csv`.
"""

from __future__ import annotations

import itertools
import sys

import numpy as np
from diabolo import AttachedString, Model, State, TipMotion
from diabolo.hosts.mjcf import INERTIA
from play_motion import main

try:
    import dartpy as dart
except ModuleNotFoundError as error:
    print(f"diabolo_in_dart.py: {error}; expected it from: pip install 'diabolo[dart]'", file=sys.stderr)
    sys.exit(2)


def simulate(model: Model, start: State, tips: TipMotion, dt: float, steps: int) -> np.ndarray:
    """Where DART's body is after each step, (steps, 3).

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
    samples = list(zip(*tips.at(np.arange(steps + 1) * dt), strict=True))
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


if __name__ == "__main__":
    main(simulate, "DART")
