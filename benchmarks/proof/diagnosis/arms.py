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
    "single": 75,
    "several": 40,
    "with_fault": 30,
    "tie": 20,
    "strangers": 120,
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


def _meet(content: Content, kind: str, departure: sizes.Departure) -> None:
    """A law that no name stands for, and what belongs to it."""
    content.outside = kind
    content.add(list(strangers.KINDS[kind].names), departure)


def _outside(content: Content, generator: np.random.Generator) -> None:
    kind = str(generator.choice([*strangers.BEFORE_THE_TENTH]))
    _meet(content, kind, strangers.BEFORE_THE_TENTH[kind](generator))


def _strangers(content: Content, generator: np.random.Generator) -> None:
    """One of all kinds: half of them alone, the others beside an effect or a fault."""
    kind = str(generator.choice([*strangers.KINDS]))
    _meet(content, kind, strangers.KINDS[kind].draw(generator))
    beside = generator.uniform()
    if beside < 0.25:
        _add_physics_beside(content, generator)
    elif beside < 0.5:
        _add_faults(content, generator, 1)


def _add_physics_beside(content: Content, generator: np.random.Generator) -> None:
    """An effect by which none of the stranger's numbers changes."""

    def is_taken(departure: sizes.Departure) -> bool:
        return any(
            fields.keys() & content.departure.get(part, {}).keys() for part, fields in departure.items()
        )

    names = [n for n in sizes.PHYSICS_NAMES if n not in content.names]
    while True:
        (name,) = _choose(generator, names, _WEIGHTS, 1)
        departure = sizes.physics(name, generator)
        if not is_taken(departure):
            return content.add([name, *_WITH_IT.get(name, [])], departure)


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
    "strangers": _strangers,
    "outside": _outside,
    "bad": _bad,
}


def content_of(arm: str, generator: np.random.Generator) -> Content:
    """What is at work in a case of an arm, or of a kind of strangers."""
    content = Content()
    if arm in strangers.KINDS:
        _meet(content, arm, strangers.KINDS[arm].draw(generator))
    else:
        _MAKERS[arm](content, generator)
    return content
