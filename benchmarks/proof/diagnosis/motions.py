# SPDX-License-Identifier: MIT
"""Motions of the hands: drawn mixtures of what players do."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

Element = dict[str, Any]

SHORTEST, LONGEST = 14.0, 20.0  # of a recording [s]


def oscillation(
    generator: np.random.Generator,
    kind: str,
    amplitude: tuple[float, float],
    frequency: tuple[float, float],
    duration: tuple[float, float] = (2.5, 4.5),
) -> Element:
    """A few seconds to and fro."""
    return {
        "type": kind,
        "amplitude": generator.uniform(*amplitude),
        "frequency": generator.uniform(*frequency),
        "duration": generator.uniform(*duration),
    }


def hold(generator: np.random.Generator, least: float = 0.5, most: float = 1.2) -> Element:
    return {"type": "hold", "duration": generator.uniform(least, most)}


def stick_sweep(generator: np.random.Generator) -> Element:
    return {
        "type": "stick_sweep",
        "yaw_deg": generator.uniform(10.0, 30.0),
        "pitch_deg": generator.uniform(5.0, 25.0),
        "frequency": generator.uniform(0.3, 0.6),
        "duration": generator.uniform(3.0, 4.5),
    }


def lively(generator: np.random.Generator, throws: bool = True) -> list[Element]:
    """Some of everything in an order of its own, with two throws and a hop."""
    calm = [
        oscillation(generator, "swing", (0.06, 0.13), (0.6, 0.9)),
        oscillation(generator, "beat", (0.04, 0.09), (1.2, 1.7)),
        oscillation(generator, "spread", (0.05, 0.12), (0.4, 0.8)),
        oscillation(generator, "fore_aft", (0.05, 0.11), (0.4, 0.7)),
        oscillation(generator, "bounce", (0.03, 0.07), (0.6, 1.1)),
        stick_sweep(generator),
    ]
    chosen = [calm[i] for i in generator.permutation(len(calm))[:4]]
    air = [
        {"type": "throw", "size": generator.uniform(0.9, 1.1)},
        {"type": "hop", "count": int(generator.integers(2, 4))},
        {"type": "throw", "size": generator.uniform(0.9, 1.1)},
    ]
    if not throws:
        air = [air[1], oscillation(generator, "bounce", (0.05, 0.09), (1.0, 1.4)), air[1]]
    parts: list[Element] = [hold(generator)]
    for place, element in enumerate(chosen):
        parts += [element, hold(generator, 0.4, 0.8)]
        if place < len(air):
            parts += [air[place], hold(generator, 0.6, 1.2)]
    return parts


def slow(generator: np.random.Generator) -> list[Element]:
    """Swings of one speed: a drag shows, but not how it grows with speed."""
    swing = oscillation(generator, "swing", (0.05, 0.07), (0.55, 0.65), (5.0, 6.0))
    return [hold(generator), swing, hold(generator), swing, hold(generator), swing, hold(generator, 3.0, 4.0)]


def one_direction(generator: np.random.Generator) -> list[Element]:
    """Sticks that never turn, in a geometry that hardly changes."""
    beat = oscillation(generator, "beat", (0.03, 0.06), (1.2, 1.6), (4.0, 5.0))
    bounce = oscillation(generator, "bounce", (0.04, 0.08), (0.7, 1.2), (5.0, 6.0))
    return [
        hold(generator),
        bounce,
        hold(generator),
        beat,
        hold(generator),
        bounce,
        hold(generator, 3.0, 4.0),
    ]


KINDS: dict[str, Callable[[np.random.Generator, bool], list[Element]]] = {
    "lively": lively,
    "slow": lambda generator, throws: slow(generator),
    "one_direction": lambda generator, throws: one_direction(generator),
}
