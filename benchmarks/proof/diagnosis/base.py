# SPDX-License-Identifier: MIT
"""The scenario that every case starts from, whatever its arm: drawn bodies, hands, cameras and small faults.

The plant's ideal form with an axle of finite radius, and cameras with the faults that no measurement is
without, each below the floor from which a diagnosis may claim it.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from . import motions
from .sizes import either_sign

RATES = (100.0, 120.0, 150.0)  # of cameras [Hz]
STEPS_PER_SECOND = {"springs": 16000, "chain": None}  # None: the program's own


def _bodies(generator: np.random.Generator) -> dict[str, Any]:
    mass = generator.uniform(0.146, 0.295)
    gyration = generator.uniform(0.6, 0.75) * 0.0635
    return {
        "mass": mass,
        "axial_inertia": mass * gyration**2,
        "inertia_ratio": generator.uniform(1.0, 1.4),
        "axle_radius": generator.uniform(0.0055, 0.008),
    }


def _camera(generator: np.random.Generator) -> dict[str, Any]:
    turn, radius = generator.uniform(-math.pi, math.pi), generator.uniform(2e-5, 3.5e-4)
    late = float(np.clip(generator.normal(0.0, 5e-4), -1.2e-3, 1.2e-3))
    return {
        "rate": float(generator.choice(RATES)),
        "white_noise": generator.uniform(2e-4, 7e-4),
        "drift_noise": generator.uniform(5e-5, 4e-4),
        "drift_time": generator.uniform(0.04, 0.1),
        "attitude_noise": generator.uniform(0.0015, 0.004),
        "dropout_share": generator.uniform(0.005, 0.03),
        "scale": 1.0 + generator.uniform(-0.0015, 0.0015),
        "tilt_deg": generator.uniform(0.0, 0.2),
        "tilt_azimuth_deg": generator.uniform(-180.0, 180.0),
        "left_tip_offset": generator.uniform(-9e-4, 9e-4, size=3).tolist(),
        "right_tip_offset": generator.uniform(-9e-4, 9e-4, size=3).tolist(),
        "centre_offset": [
            generator.uniform(-3.5e-4, 3.5e-4),
            radius * math.cos(turn),
            radius * math.sin(turn),
        ],
        "diabolo_delay": late,
    }


def body_and_camera(generator: np.random.Generator, structure: str) -> dict[str, Any]:
    """All but the motion: what stays when a motion has to be drawn again."""
    result: dict[str, Any] = {
        "schema": "diabolo.scenario/1",
        "base": "ideal",
        "diabolo": _bodies(generator),
        "string": {"length": generator.uniform(1.42, 1.47), "radius": generator.uniform(6e-4, 1e-3)},
        "camera": _camera(generator),
        "player": {"catches": True, "steers": True},
        "string_length_error": generator.uniform(-0.0025, 0.0025),
        "axle_radius_error": float(np.clip(generator.normal(0.0, 2e-4), -5e-4, 5e-4)),
    }
    if structure != "springs":
        result["structure"] = structure
    if steps := STEPS_PER_SECOND[structure]:
        result["steps_per_second"] = steps
    return result


def play(generator: np.random.Generator, kind: str, throws: bool) -> dict[str, Any]:
    """Hands, start and length of one attempt at a motion."""
    half, lean = generator.uniform(0.24, 0.27), generator.uniform(-0.02, 0.02)
    turning = 0.0 if kind == "one_direction" else generator.uniform(1.0, 3.0)
    sticks = {
        side: {"yaw_deg": sign * generator.uniform(3.0, 14.0), "pitch_deg": generator.uniform(8.0, 22.0)}
        for side, sign in (("left_stick", -1.0), ("right_stick", 1.0))
    }
    elements = motions.KINDS[kind](generator, throws)
    return {
        "seed": int(generator.integers(2**40)),
        "duration": generator.uniform(motions.SHORTEST, motions.LONGEST),
        "start": {
            "spin": either_sign(generator) * generator.uniform(130.0, 290.0),
            "yaw_deg": generator.uniform(-3.0, 3.0),
            "pitch_deg": generator.uniform(-3.0, 3.0),
        },
        "motion": {
            "left": [0.0, half, 1.25 + lean],
            "right": [0.0, -half, 1.25 - lean],
            **sticks,
            "wander": generator.uniform(0.003, 0.006),
            "wander_deg": turning,
            "elements": elements,
        },
    }
