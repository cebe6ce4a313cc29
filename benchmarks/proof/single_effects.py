# SPDX-License-Identifier: MIT
"""Diagnoses recordings of the plant in which one effect at most is at work, and prints what was found.

Not the sealed proof: the effects and their sizes stand below, and the tool was developed with them in sight.
The plant's ideal form has an axle of finite radius and nothing else beyond the consistent model.
"""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
from pathlib import Path
from typing import Any

from diabolo import diagnose, load_recording

from .. import command
from . import plant

# Name expected in the answer, and what departs from the ideal scenario.
CASES: dict[str, dict[str, Any]] = {
    "nothing": {},
    "string_friction": {"string": {"friction": 0.2}},
    "string_elasticity": {"string": {"stiffness": 1015.0, "damping": 6.0}},  # 700 N/m of the path
    "air_drag_quadratic": {"air": {"drag": 0.04}},
    "air_drag_linear": {"air": {"linear_drag": 0.1}},
    "magnus_lift": {"air": {"magnus": 0.0015}},
    "spin_drag": {"air": {"windage": 1e-6}},
    "length_scale": {"camera": {"scale": 1.012}},
    "gravity_tilt": {"camera": {"tilt_deg": 1.5, "tilt_azimuth_deg": 70.0}},
    "time_offset": {"camera": {"diabolo_delay": 0.008}},
    "marker_offset": {"camera": {"centre_offset": [0.006, 0.0015, -0.001]}},
    "stick_tip_offset": {"camera": {"left_tip_offset": [0.004, 0.006, -0.005]}},
    "string_length": {"string_length_error": 0.02},
    "stick_flex": {"sticks": {"bending_stiffness": 250.0, "damping_ratio": 0.5}},
}


def scenario(seed: int, departures: dict[str, Any]) -> dict[str, Any]:
    """Some 20 s of holding, swinging, beating, hopping and throwing."""
    draw = random.Random(seed).uniform
    elements: list[dict[str, Any]] = [
        {"type": "hold", "duration": 0.5},
        {"type": "swing", "amplitude": draw(0.07, 0.12), "frequency": draw(0.6, 0.9), "cycles": 3},
        {"type": "beat", "amplitude": draw(0.04, 0.08), "frequency": draw(1.2, 1.6), "cycles": 4},
        {"type": "hold", "duration": 0.6},
        {"type": "spread", "amplitude": draw(0.05, 0.12), "frequency": draw(0.5, 0.8), "cycles": 2},
        {"type": "fore_aft", "amplitude": draw(0.05, 0.1), "frequency": draw(0.5, 0.7), "cycles": 2},
        {"type": "hop", "count": 3},
        {"type": "hold", "duration": 0.6},
        {"type": "throw", "size": draw(0.9, 1.1)},
        {"type": "hold", "duration": 1.2},
        {"type": "throw"},
        {"type": "hold", "duration": 1.0},
    ]
    result: dict[str, Any] = {
        "schema": "diabolo.scenario/1",
        "base": "ideal",
        "seed": seed,
        "diabolo": {"axle_radius": 0.0065},
        "string": {"radius": 0.0008},
        "start": {"spin": draw(100, 240), "yaw_deg": draw(-3, 3), "pitch_deg": draw(-3, 3)},
        "camera": {
            "white_noise": draw(3e-4, 8e-4),
            "drift_noise": draw(1e-4, 4e-4),
            "attitude_noise": 0.003,
            "dropout_share": 0.02,
        },
        "motion": {
            "left": [0, 0.255, 1.25],
            "right": [0, -0.255, 1.25],
            "left_stick": {"yaw_deg": -8, "pitch_deg": 15},
            "right_stick": {"yaw_deg": 8, "pitch_deg": 15},
            "wander": 0.004,
            "wander_deg": 2,
            "elements": elements,
        },
    }
    for key, value in departures.items():
        result[key] = {**result.get(key, {}), **value} if isinstance(value, dict) else value
    return result


def make_parser() -> argparse.ArgumentParser:
    parser = command.make_parser(
        "benchmarks.proof.single_effects",
        __doc__,
        "  make plant && python -m benchmarks.proof.single_effects",
    )
    plant.add_option(parser)
    parser.add_argument("--seed", type=int, default=100, help="of the first case; default: 100")
    return parser


def act(given: argparse.Namespace) -> int:
    plant.check(given.plant)
    right = 0
    print("| at work | headline | claimed |\n|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for index, (name, departures) in enumerate(CASES.items()):
            take = Path(folder) / "take.csv"
            plant.play(given.plant, scenario(given.seed + index, departures), take)
            answer = diagnose(load_recording(take))
            claims = [
                f"{effect.name} "
                + ", ".join(f"{p.name} {p.value:.3g} {p.ci90}" for p in effect.parameters[:2])
                for effect in answer.effects
            ]
            named = [effect.name for effect in answer.effects]
            right += named == [] if name == "nothing" else named == [name]
            print(f"| {name} | {answer.headline} | {'; '.join(claims)} |", flush=True)
    print(f"{right} of {len(CASES)} answers name what is at work and nothing else")
    return 0


if __name__ == "__main__":
    sys.exit(command.run(make_parser(), act))
