# SPDX-License-Identifier: MIT
"""The arms of a proof: what may be at work in a case, and how many cases of each there are."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import sizes, strangers

# Of 600 cases.
SHARES: dict[str, int] = {
    "null": 150,
    "faults": 150,
    "single": 130,
    "several": 60,
    "with_fault": 50,
    "tie": 20,
    "outside": 25,
    "bad": 15,
}
CHAIN_SHARE = 0.3  # of the cases, whatever their arm, come from the second plant

_WEIGHTS = {"string_wrap": 0.4, "string_mass": 0.3, "wind": 0.6}
_FAULT_WEIGHTS = {"frame_rate": 0.5, "filter_lag": 0.5, "body_swap": 0.4, "robot_servo_lag": 0.5}
_WITH_IT = {"wind": ["air_drag_quadratic"], "string_wrap": ["string_friction"]}


@dataclass
class Content:
    """What is at work in a case."""

    names: list[str] = field(default_factory=list)
    """True names, the leading one first."""
    departure: dict[str, Any] = field(default_factory=dict)
    steps: list[dict[str, Any]] = field(default_factory=list)
    motion: str = "lively"
    tie: list[str] = field(default_factory=list)
    """Names between which the data cannot decide."""
    outside: str | None = None
    """A law that no name stands for."""
    bad: str | None = None
    """Why nothing can be decided."""

    def add(self, names: list[str], departure: dict[str, Any]) -> None:
        self.names += [name for name in names if name not in self.names]
        self.departure = sizes.merged(self.departure, departure)


def allot(cases: int) -> dict[str, int]:
    """How many cases each arm has: in proportion, and one at least where there are enough."""
    total = sum(SHARES.values())
    least = 1 if cases >= len(SHARES) else 0
    spare = cases - least * len(SHARES)
    exact = {arm: max(0.0, share * cases / total - least) for arm, share in SHARES.items()}
    scale = spare / sum(exact.values()) if spare else 0.0
    counts = {arm: least + int(scale * value) for arm, value in exact.items()}
    by_rest = sorted(exact, key=lambda arm: (int(scale * exact[arm]) - scale * exact[arm], arm))
    for arm in by_rest[: cases - sum(counts.values())]:
        counts[arm] += 1
    return counts


def _choose(
    generator: np.random.Generator, names: list[str], weights: dict[str, float], count: int
) -> list[str]:
    shares = np.array([weights.get(name, 1.0) for name in names])
    return [str(name) for name in generator.choice(names, count, replace=False, p=shares / shares.sum())]


def _add_physics(content: Content, generator: np.random.Generator, count: int) -> None:
    for name in _choose(generator, list(sizes.PHYSICS_NAMES), _WEIGHTS, count):
        content.add([name, *_WITH_IT.get(name, [])], sizes.physics(name, generator))


def _add_faults(content: Content, generator: np.random.Generator, count: int) -> None:
    for name in _choose(generator, list(sizes.FAULT_NAMES), _FAULT_WEIGHTS, count):
        departure, steps = sizes.fault(name, generator)
        content.add([name], departure)
        content.steps += steps


def _several(content: Content, generator: np.random.Generator) -> None:
    _add_physics(content, generator, 2 if generator.uniform() < 0.75 else 3)


def _faults(content: Content, generator: np.random.Generator) -> None:
    _add_faults(content, generator, int(generator.choice([1, 2, 3], p=[0.6, 0.3, 0.1])))


def _with_fault(content: Content, generator: np.random.Generator) -> None:
    _add_physics(content, generator, 1)
    _add_faults(content, generator, 1 if generator.uniform() < 0.7 else 2)


def _tie(content: Content, generator: np.random.Generator) -> None:
    """Sticks that never turn bend as the string stretches; at one speed a drag's growth does not show."""
    if generator.uniform() < 0.6:
        content.tie, content.motion = ["string_elasticity", "stick_flex"], "one_direction"
        soft = generator.uniform() < 0.5
        departure = (
            sizes.elasticity(generator, 250.0, 900.0) if soft else sizes.stick_flex(generator, 90.0, 400.0)
        )
        content.add([content.tie[0 if soft else 1]], departure)
    else:
        content.tie, content.motion = ["air_drag_linear", "air_drag_quadratic"], "slow"
        linear = generator.uniform() < 0.5
        size = sizes.log_uniform(generator, *((0.02, 0.04) if linear else (0.1, 0.2)))
        content.add([content.tie[0 if linear else 1]], {"air": {"linear_drag" if linear else "drag": size}})


def _outside(content: Content, generator: np.random.Generator) -> None:
    content.outside = str(generator.choice(["stribeck", "stiffening", "bearing", "flank", "lay"]))
    if content.outside == "stribeck":
        rise = {"friction_rise": generator.uniform(0.15, 0.4), "stribeck_speed": generator.uniform(0.2, 0.6)}
        content.add(
            ["string_friction"], {"string": {"friction": sizes.log_uniform(generator, 0.02, 0.08), **rise}}
        )
    elif content.outside == "stiffening":
        departure = sizes.elasticity(generator, 200.0, 500.0)
        departure["string"]["stiffening_stretch"] = sizes.log_uniform(generator, 0.008, 0.04)
        content.add(["string_elasticity"], departure)
    elif content.outside == "bearing":
        torque = sizes.log_uniform(generator, 1e-4, 1e-3)
        friction = generator.uniform(0.12, 0.35)
        content.add(
            ["string_friction"], {"string": {"friction": friction}, "diabolo": {"bearing_torque": torque}}
        )
    elif content.outside == "lay":
        twist = generator.uniform(0.2, 0.6) * generator.choice([-1.0, 1.0])
        friction = sizes.log_uniform(generator, 0.05, 0.15)
        content.add(["string_friction"], {"string": {"friction": friction, "lay": twist}})
    else:
        groove = {"groove_radius": 0.005, "groove_half_width": generator.uniform(0.0015, 0.004)}
        rub = {"flank_friction": generator.uniform(0.2, 0.6), "flank_radius": generator.uniform(0.009, 0.015)}
        content.add([], {"diabolo": {**groove, **rub}})


def _bad(content: Content, generator: np.random.Generator) -> None:
    content.bad = str(generator.choice(["too_short", "no_diabolo", "never_taut"]))
    if content.bad == "too_short":
        content.steps.append({"step": "cut", "seconds": generator.uniform(0.8, 2.2)})
    elif content.bad == "no_diabolo":
        content.steps.append({"step": "blank", "after": generator.uniform(0.2, 1.2)})
    else:
        content.departure = {"string_length_error": generator.uniform(0.2, 0.45)}


_MAKERS: dict[str, Callable[[Content, np.random.Generator], None]] = {
    "null": lambda content, generator: None,
    "faults": _faults,
    "single": lambda content, generator: _add_physics(content, generator, 1),
    "several": _several,
    "with_fault": _with_fault,
    "tie": _tie,
    "outside": _outside,
    "bad": _bad,
}


def content_of(arm: str, generator: np.random.Generator) -> Content:
    """What is at work in a case of an arm, or of a kind of strangers."""
    content = Content()
    if stranger := strangers.KINDS.get(arm):
        content.outside = arm
        content.add(list(stranger.names), stranger.draw(generator))
    else:
        _MAKERS[arm](content, generator)
    return content
