# SPDX-License-Identifier: MIT
"""Sizes of effects and faults: drawn, never round, from barely visible to strong.

A departure is what a scenario of the plant gets on top of the ideal one; a step is done to the recording
afterwards (see camera_steps.py). A fault's size lies beyond the floor from which a diagnosis has to claim it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

Departure = dict[str, Any]
Step = dict[str, Any]
Sized = tuple[Departure, list[Step]]


def log_uniform(generator: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(generator.uniform(np.log(low), np.log(high))))


def either_sign(generator: np.random.Generator, positive: float = 0.5) -> float:
    return 1.0 if generator.uniform() < positive else -1.0


def merged(scenario: Departure, departure: Departure) -> Departure:
    """The scenario with the departure's members in place of its own."""
    result = dict(scenario)
    for key, value in departure.items():
        result[key] = merged(result.get(key, {}), value) if isinstance(value, dict) else value
    return result


def physics(name: str, generator: np.random.Generator) -> Departure:
    """An effect of a drawn size."""
    return _PHYSICS[name](generator)


def fault(name: str, generator: np.random.Generator) -> Sized:
    """A fault of a drawn size, beyond its floor."""
    return _FAULTS[name](generator)


def stick_flex(generator: np.random.Generator, soft: float = 60.0, stiff: float = 2000.0) -> Departure:
    return {
        "sticks": {
            "bending_stiffness": log_uniform(generator, soft, stiff),
            "tip_mass": generator.uniform(0.008, 0.015),
            "damping_ratio": generator.uniform(0.02, 0.1),
        }
    }


def elasticity(generator: np.random.Generator, soft: float = 300.0, stiff: float = 2e4) -> Departure:
    """A string that gives, by its force per relative stretch [N]."""
    return {
        "string": {
            "stiffness": log_uniform(generator, soft, stiff),
            "damping": log_uniform(generator, 1.5, 20.0),
        }
    }


def _wind(generator: np.random.Generator) -> Departure:
    speed, towards = log_uniform(generator, 0.3, 4.0), generator.uniform(-math.pi, math.pi)
    drag = log_uniform(generator, 0.02, 0.08)
    return {"air": {"wind": [speed * math.cos(towards), speed * math.sin(towards), 0.0], "drag": drag}}


def _wrap(generator: np.random.Generator) -> Departure:
    """Without friction a wrap is only a shorter string."""
    return {"string": {"wraps": 1, "friction": log_uniform(generator, 0.03, 0.06)}}


def _mass(generator: np.random.Generator) -> Departure:
    """The ideal string's damping would let a heavy string bounce on the axle without end."""
    return {
        "string": {"linear_density": log_uniform(generator, 0.0015, 0.01), "stiffness": 4e4, "damping": 5.0}
    }


_PHYSICS: dict[str, Callable[[np.random.Generator], Departure]] = {
    "string_friction": lambda g: {"string": {"friction": log_uniform(g, 0.008, 0.38)}},
    "string_elasticity": elasticity,
    "stick_flex": stick_flex,
    "string_wrap": _wrap,
    "string_mass": _mass,
    "air_drag_linear": lambda g: {"air": {"linear_drag": log_uniform(g, 0.008, 0.4)}},
    "air_drag_quadratic": lambda g: {"air": {"drag": log_uniform(g, 0.008, 0.15)}},
    "wind": _wind,
    "magnus_lift": lambda g: {"air": {"magnus": either_sign(g, 0.75) * log_uniform(g, 2e-4, 6e-3)}},
    "spin_drag": lambda g: {"air": {"windage": log_uniform(g, 1e-8, 2.5e-6)}},
    "axle_drag": lambda g: {"diabolo": {"axle_drag": log_uniform(g, 0.2, 8.0)}},
}


def _delay(generator: np.random.Generator) -> Sized:
    delay = log_uniform(generator, 0.0035, 0.018)
    if generator.uniform() < 0.5:
        return {"camera": {"diabolo_delay": delay}}, []
    return {"camera": {"left_delay": delay, "right_delay": delay}}, []


def _marker(generator: np.random.Generator) -> Sized:
    radius, turn = log_uniform(generator, 0.0008, 0.006), generator.uniform(-math.pi, math.pi)
    axial = either_sign(generator) * log_uniform(generator, 0.0005, 0.02)
    return {"camera": {"centre_offset": [axial, radius * math.cos(turn), radius * math.sin(turn)]}}, []


def _tips(generator: np.random.Generator) -> Sized:
    departure: Departure = {}
    sides = ("left", "right") if generator.uniform() < 0.5 else (("left", "right")[generator.integers(2)],)
    for side in sides:
        direction = generator.normal(size=3)
        size = log_uniform(generator, 0.0045, 0.012)
        departure[f"{side}_tip_offset"] = (size * direction / np.linalg.norm(direction)).tolist()
    return {"camera": departure}, []


def _frame_rate(generator: np.random.Generator) -> Sized:
    return {}, [
        {"step": "frame_rate", "factor": 1.0 + either_sign(generator) * log_uniform(generator, 0.01, 0.05)}
    ]


def _swap(generator: np.random.Generator) -> Sized:
    if generator.uniform() < 0.3:
        return {}, [{"step": "body_swap", "bodies": ["left", "right"], "bursts": [[0.0, 1.0]]}]
    begins = np.sort(generator.uniform(0.05, 0.9, size=int(generator.integers(2, 6))))
    bursts = [[float(begin), float(begin + generator.uniform(0.01, 0.04))] for begin in begins]
    stick = ("left", "right")[generator.integers(2)]
    return {}, [{"step": "body_swap", "bodies": ["diabolo", stick], "bursts": bursts}]


_FAULTS: dict[str, Callable[[np.random.Generator], Sized]] = {
    "gravity_tilt": lambda g: (
        {"camera": {"tilt_deg": log_uniform(g, 0.45, 3.0), "tilt_azimuth_deg": g.uniform(-180.0, 180.0)}},
        [],
    ),
    "length_scale": lambda g: (
        {"camera": {"scale": 1.0 + either_sign(g) * log_uniform(g, 0.0045, 0.025)}},
        [],
    ),
    "time_offset": _delay,
    "marker_offset": _marker,
    "stick_tip_offset": _tips,
    "string_length": lambda g: ({"string_length_error": either_sign(g) * log_uniform(g, 0.006, 0.04)}, []),
    "frame_rate": _frame_rate,
    "filter_lag": lambda g: ({}, [{"step": "filter_lag", "seconds": log_uniform(g, 0.01, 0.06)}]),
    "body_swap": _swap,
    "robot_servo_lag": lambda g: ({}, [{"step": "robot_servo_lag", "seconds": log_uniform(g, 0.015, 0.08)}]),
}

PHYSICS_NAMES, FAULT_NAMES = tuple(_PHYSICS), tuple(_FAULTS)
