# SPDX-License-Identifier: MIT
"""The plugin diabolo.string in MuJoCo: how far its body is from the plain predictor, and what a step costs.

Tips swing and beat for two seconds, on mocap bodies, at steps of 1 ms. Times are medians over turns of the
same scene with a plugin that does nothing, with a plain string and with one of six effects, and of what these
take more in a turn.
"""

from __future__ import annotations

import argparse
import re
import statistics
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import mujoco
import numpy as np
from diabolo import (
    Air,
    FiniteAxle,
    MagnusLift,
    Model,
    Parameters,
    SpinLoss,
    State,
    StringElasticity,
    StringFriction,
    TipMotion,
    rollout,
)
from diabolo.hosts import mujoco as host
from diabolo.motions import swing_and_beat

from ... import command

EXAMPLE = "  python -m benchmarks.speed.mujoco.plugin"
INTEGRATORS = ("Euler", "implicit", "implicitfast", "RK4")
DT, STEPS = 1e-3, 2000
EMPTY, EMPTY_NAME = Path(__file__).with_name("empty_plugin.cpp"), "an empty plugin"
MODELS = {
    "plain": Model(Parameters()),
    "six effects": Model(
        Parameters(),
        name="six effects",
        string_friction=StringFriction(coefficient=0.2),
        string_elasticity=StringElasticity(compliance=5e-4, damping=5.0),
        finite_axle=FiniteAxle(radius=0.0065),
        air=Air(linear_drag=0.05, quadratic_drag=0.02),
        magnus_lift=MagnusLift(coefficient=1e-3),
        spin_loss=SpinLoss(air=1e-4),
    ),
}


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.speed.mujoco.plugin", __doc__, EXAMPLE)
    parser.add_argument("--turns", type=int, default=15, metavar="N", help="of the timing; default: 15")
    return command.run(parser, run, arguments)


def run(given: argparse.Namespace) -> int:
    if given.turns < 1:
        raise ValueError(f"--turns {given.turns}; expected 1 or more")
    host.load_plugin()
    print("| farthest from the predictor [m] | " + " | ".join(INTEGRATORS) + " |")
    print("|---|" + "---|" * len(INTEGRATORS))
    for name, model in MODELS.items():
        print(f"| {name} | " + " | ".join(f"{farthest(model, each):.1e}" for each in INTEGRATORS) + " |")
    mujoco.mj_loadPluginLibrary(str(host.build_plugin(EMPTY)))
    scenes = {EMPTY_NAME: with_empty_plugin(host.scene())}
    scenes |= {name: host.scene(model) for name, model in MODELS.items()}
    costs = step_costs(scenes, given.turns)
    print("\n| | " + " | ".join(costs) + " |\n|---|" + "---|" * len(costs))
    more = {"a step of MuJoCo [us]": 0.0, "over the empty one [us]": costs[EMPTY_NAME]}
    for title, over in more.items():
        found = " | ".join(f"{statistics.median(cost - over):.2f}" for cost in costs.values())
        print(f"| {title} | {found} |")
    return 0


def tips() -> TipMotion:
    """At rest for a moment, then swinging and beating."""
    return swing_and_beat(DT * STEPS, rest=0.02)


def hung(text: str) -> tuple[mujoco.MjModel, mujoco.MjData, State]:
    """A scene with the diabolo at the end of its string, moving."""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    drop = 0.5 * np.sqrt(Parameters().string_length ** 2 - 0.8**2)
    start = State([0.0, 0.0, 1.3 - drop], [0.3, 0.2, 0.0], 60.0, "loose")
    data.mocap_pos[:] = [[0.0, 0.4, 1.3], [0.0, -0.4, 1.3]]
    data.qpos[:3], data.qvel[:3], data.qvel[3] = start.position, start.velocity, -start.spin
    return model, data, start


def farthest(model: Model, integrator: str) -> float:
    """From the plain predictor, in two seconds [m]."""
    text = host.scene(model, DT).replace('integrator="implicitfast"', f'integrator="{integrator}"')
    physics, data, start = hung(text)
    motion, path = tips(), []
    left, right, *_ = motion.at(np.arange(STEPS + 1) * DT)
    for data.mocap_pos[0], data.mocap_pos[1] in zip(left[1:], right[1:], strict=True):
        mujoco.mj_step(physics, data)
        path.append(data.qpos[:3].copy())
    plain = rollout(model, start.to_array(), motion, dt=DT, steps=STEPS, string_state="loose").states
    return float(np.linalg.norm(np.array(path) - plain[:, :3], axis=1).max())


def with_empty_plugin(text: str) -> str:
    return re.sub(r"<config [^>]*/>", "", text).replace("diabolo.string", "diabolo.empty")


def step_costs(scenes: dict[str, str], turns: int) -> dict[str, np.ndarray]:
    """The cost of a step [us] in each turn, so that what else the machine does is in all of a turn."""
    ready = {name: hung(text)[:2] for name, text in scenes.items()}
    times: dict[str, list[float]] = {name: [] for name in scenes}
    for _ in range(turns):
        for name, (model, data) in ready.items():
            mujoco.mj_resetData(model, data)
            data.mocap_pos[:], data.qpos[:3] = [[0.0, 0.4, 1.3], [0.0, -0.4, 1.3]], [0.0, 0.0, 0.7]
            if name == EMPTY_NAME:
                model.opt.gravity[:] = 0.0  # lest it fall to the floor
            begin = time.perf_counter()
            mujoco.mj_step(model, data, nstep=5000)
            times[name].append((time.perf_counter() - begin) / 5000 * 1e6)
    return {name: np.array(values) for name, values in times.items()}


if __name__ == "__main__":
    sys.exit(main())
