# SPDX-License-Identifier: MIT
"""Plays planned motions of the tips on the independent plant (data/plant), and reads what happened."""

from __future__ import annotations

import csv
import json
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
from diabolo import Model, Parameters, State, TipPath
from diabolo.enums import StringState
from numpy.typing import NDArray

LEAD = 0.3
"""The tips rest so long before the motion, the diabolo hanging [s]."""
KNOTS = 120.0
"""The plant's hands follow a spline through so many poses of the plan a second."""
RATE = 500.0
"""Rows of what happened a second."""
STEPS = 24000
"""Of the plant's integrator a second; its usual 48000 change no figure here and take twice as long."""
STICKS = {"yaw_deg": 0, "pitch_deg": 15}
STICK_DAMPING = 3.0  # of a tip [N s/m]
INERTIA_OF_RED = 5.6e-4  # axial [kg m^2]


@dataclass
class Plant:
    """What the plant is, and the program that simulates it."""

    program: Path
    friction: float = 0.3
    bending_stiffness: float = 400.0
    stiffness: float = 2000.0
    drag: float = 0.028
    magnus: float = 0.0011
    length: float = 1.45
    mass: float = 0.2893
    axial_inertia: float = INERTIA_OF_RED
    axle_radius: float = 0.0065
    steers: bool = True
    """The plant's player keeps the axis level and forward by setting one hand forward, the other back."""
    seed: int = 1
    extra: dict[str, Any] = field(default_factory=dict)

    def scenario(self, path: TipPath, spin: float, tail: float) -> dict[str, Any]:
        count = max(2, int(np.ceil((path.end - path.begin) * KNOTS)))
        times = np.linspace(path.begin, path.end, count + 1)
        tips = path.derivatives(times)[0]
        offsets = tips[1:] - tips[0]
        return {
            "schema": "diabolo.scenario/1",
            "seed": self.seed,
            "truth_rate": RATE,
            "steps_per_second": STEPS,
            "diabolo": {
                "mass": self.mass,
                "axial_inertia": self.axial_inertia,
                "axle_radius": self.axle_radius,
            },
            "string": {"length": self.length, "stiffness": self.stiffness, "friction": self.friction},
            "sticks": {"bending_stiffness": self.bending_stiffness, "damping_ratio": 0.8},
            "air": {"drag": self.drag, "magnus": self.magnus},
            "player": {"steers": self.steers},
            "start": {"spin": spin},
            "motion": {
                "left": tips[0, :3].tolist(),
                "right": tips[0, 3:].tolist(),
                "left_stick": STICKS,
                "right_stick": STICKS,
                "elements": [
                    {"type": "hold", "duration": LEAD},
                    {
                        "type": "path",
                        "times": (times[1:] - times[0]).tolist(),
                        "left": offsets[:, :3].tolist(),
                        "right": offsets[:, 3:].tolist(),
                    },
                    {"type": "hold", "duration": tail},
                ],
            },
            **self.extra,
        }

    def model(self, rng: np.random.Generator | None = None) -> Model:
        """What a diagnosis of this plant would say, or with `rng` say within its usual errors."""

        def off(spread: float) -> float:
            return 0.0 if rng is None else float(rng.normal(0.0, spread))

        friction = self.friction + off(0.01)
        parameters = Parameters()
        parameters.string_length = self.length + off(0.002)
        parameters.mass = self.mass
        parameters.axle_radius = self.axle_radius
        parameters.spin_coupling = 0.0
        gain = self.mass * self.axle_radius / self.axial_inertia * (1.0 + off(0.05))
        return Model(
            parameters,
            name="diagnosed",
            string_friction=diabolo.StringFriction(coefficient=max(0.0, friction), spin_gain=gain),
            string_elasticity=diabolo.StringElasticity(compliance=self.length / self.stiffness, damping=10.0),
            stick_flex=diabolo.StickFlex(
                compliance=(1.0 + off(0.05)) / self.bending_stiffness, damping=STICK_DAMPING
            ),
            finite_axle=diabolo.FiniteAxle(radius=self.axle_radius + 0.0008),
            air=diabolo.Air(quadratic_drag=self.drag),
            magnus_lift=diabolo.MagnusLift(coefficient=self.magnus),
        )

    def play(self, path: TipPath, spin: float, tail: float = 0.3) -> Truth:
        """What the plant does when its hands follow the path."""
        with tempfile.TemporaryDirectory() as folder:
            scenario, out, truth = (Path(folder) / name for name in ("s.json", "o.csv", "truth.csv"))
            scenario.write_text(json.dumps(self.scenario(path, spin, tail)))
            done = subprocess.run(
                [self.program, scenario, "--out", out, "--truth", truth], capture_output=True, text=True
            )
            if done.returncode != 0:
                raise RuntimeError(f"the plant refuses: {done.stderr.strip()}")
            with truth.open(newline="") as lines:
                rows = list(csv.DictReader(lines))
        columns = ("time", "x", "y", "z", "vx", "vy", "vz", "spin")
        numbers = np.array([[float(row[name]) for name in columns] for row in rows])
        tips = np.array(
            [
                [float(row[f"{side}_tip_{axis}"]) for side in ("left", "right") for axis in "xyz"]
                for row in rows
            ]
        )
        return Truth(
            numbers[:, 0] - LEAD,
            numbers[:, 1:4],
            numbers[:, 4:7],
            numbers[:, 7],
            tips,
            np.array([row["mode"] for row in rows]),
        )


@dataclass
class Truth:
    """What happened: time since the motion's begin [s], and the diabolo's and the tips' motion."""

    time: NDArray[np.float64]
    position: NDArray[np.float64]
    velocity: NDArray[np.float64]
    spin: NDArray[np.float64]
    tips: NDArray[np.float64]
    mode: NDArray[np.str_]

    def state(self, time: float) -> State:
        """What an observer without noise sees."""
        i = int(np.clip(np.searchsorted(self.time, time), 0, len(self.time) - 1))
        string_state = {"ON_STRING": StringState.ON_STRING, "FLYING": StringState.FLYING}.get(
            str(self.mode[i]), StringState.LOOSE
        )
        return State(self.position[i], self.velocity[i], float(self.spin[i]), string_state)

    def held_at(self, time: float) -> bool:
        """Whether the diabolo is on the string, and below the hands, at that time."""
        i = int(np.clip(np.searchsorted(self.time, time), 0, len(self.time) - 1))
        reaches = self.time[-1] >= time - 0.01
        below = self.position[i, 2] < 0.5 * (self.tips[i, 2] + self.tips[i, 5]) + 0.05
        return bool(reaches and self.mode[i] != "FLYING" and below)
