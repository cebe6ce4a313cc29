# SPDX-License-Identifier: MIT
"""The diabolo in Drake: their multibody plant, our string as a system of its own (docs/hosts.md).

    pip install '.[drake,plot]'
    python examples/hosts/diabolo_in_drake.py --picture drake.png
    python examples/hosts/diabolo_in_drake.py MOTION.csv SIM.csv

Tips swing and beat for two seconds. It prints, and draws, how far Drake's body is from the plain predictor.
Or it plays what `diabolo motion` wrote, for `diabolo diagnose TAKE.csv --simulated SIM.csv`.
"""

from __future__ import annotations

import sys

import numpy as np
from diabolo import AttachedString, Model, State, TipMotion
from diabolo.hosts.mjcf import INERTIA
from play_motion import main

try:
    from pydrake.common.value import Value
    from pydrake.math import RigidTransform
    from pydrake.multibody.math import SpatialForce
    from pydrake.multibody.plant import ExternallyAppliedSpatialForce, MultibodyPlant
    from pydrake.multibody.tree import RigidBody, RotationalInertia, SpatialInertia
    from pydrake.systems.analysis import Simulator
    from pydrake.systems.framework import Context, DiagramBuilder, LeafSystem
    from pydrake.systems.framework import State as SystemState
except ModuleNotFoundError as error:
    print(f"diabolo_in_drake.py: {error}; expected it from: pip install 'diabolo[drake]'", file=sys.stderr)
    sys.exit(2)


class StringSystem(LeafSystem):
    """From the plant's state to the string's force on a body. What the string keeps is a discrete state."""

    def __init__(self, plant: MultibodyPlant, body: RigidBody, model: Model, tips: TipMotion) -> None:
        super().__init__()
        self.plant, self.body, self.tips, self.dt = plant, body, tips, plant.time_step()
        self.own = plant.CreateDefaultContext()
        gravity = plant.gravity_field().gravity_vector()
        self.string = AttachedString(model, body.default_mass(), INERTIA[0], gravity)
        self.state = self.DeclareVectorInputPort("state", plant.num_multibody_states())
        self.DeclareDiscreteState(np.array(self.string.memory))
        # As the plant's own update: what is declared as discrete comes after it, and sees its next state.
        self.DeclarePeriodicUnrestrictedUpdateEvent(self.dt, 0.0, self.remember)
        empty = Value([ExternallyAppliedSpatialForce()])
        self.DeclareAbstractOutputPort("force", lambda: empty, self.pull)

    def step(self, context: Context) -> tuple[SpatialForce, list[float]]:
        """The force over the step that begins now, and what is to be kept for the next one."""
        self.plant.SetPositionsAndVelocities(self.own, self.state.Eval(context))
        pose = self.plant.EvalBodyPoseInWorld(self.own, self.body)
        moves = self.plant.EvalBodySpatialVelocityInWorld(self.own, self.body)
        axle = pose.rotation().matrix()[:, 0]
        time = context.get_time()
        (left0, left1), (right0, right1), (u0, u1), (v0, v1), *_ = self.tips.at([time, time + self.dt])
        self.string.memory = context.get_discrete_state_vector().CopyToVector()
        wrench = self.string.step(
            pose.translation(),
            moves.translational(),
            axle,
            axle @ moves.rotational(),
            left0,
            right0,
            left1,
            right1,
            self.dt,
            velocities=(u0, v0, u1, v1),
            time=time,
        )
        return SpatialForce(tau=wrench.torque, f=wrench.force), self.string.memory

    def pull(self, context: Context, output: Value) -> None:
        force = ExternallyAppliedSpatialForce()
        force.body_index = self.body.index()
        force.p_BoBq_B = np.zeros(3)
        force.F_Bq_W, _ = self.step(context)
        output.set_value([force])

    def remember(self, context: Context, state: SystemState) -> None:
        state.get_mutable_discrete_state().set_value(self.step(context)[1])


def simulate(model: Model, start: State, tips: TipMotion, dt: float, steps: int) -> np.ndarray:
    """Where Drake's body is after each step, (steps, 3)."""
    builder = DiagramBuilder()
    plant = builder.AddSystem(MultibodyPlant(dt))
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -model.parameters.gravity])
    about = SpatialInertia.MakeFromCentralInertia(
        model.parameters.mass, np.zeros(3), RotationalInertia(*INERTIA)
    )
    body = plant.AddRigidBody("diabolo", about)
    plant.Finalize()
    string = builder.AddSystem(StringSystem(plant, body, model, tips))
    builder.Connect(plant.get_state_output_port(), string.get_input_port())
    builder.Connect(string.get_output_port(), plant.get_applied_spatial_force_input_port())
    simulator = Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetFreeBodyPose(context, body, RigidTransform(start.position))
    plant.SetVelocities(context, [-start.spin, 0.0, 0.0, *start.velocity])
    path = []
    for i in range(steps):
        simulator.AdvanceTo((i + 1) * dt)
        path.append(plant.EvalBodyPoseInWorld(context, body).translation())
    return np.array(path)


if __name__ == "__main__":
    main(simulate, "Drake")
