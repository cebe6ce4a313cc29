# SPDX-License-Identifier: MIT
"""Laws of the plant that no name of the diagnosis stands for, and whether an answer has a word for them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import sizes
from .names import FLYING, ON_STRING

SILENT = "silent"
"""NOTHING_MISSING, or names that leave more than noise leaves without a word of it."""
TOLD = "told"
"""Something is left, and the answer says so."""
TAKEN_FOR = "taken for another"
"""Names that leave no more than noise leaves."""
REFUSED = "refused"
"""Nothing can be concluded."""


@dataclass(frozen=True)
class Stranger:
    """A law that no name stands for."""

    draw: Callable[[np.random.Generator], sizes.Departure]
    depends: str
    """On what it depends: time, place, speed, spin, tension, string, tips."""
    names: tuple[str, ...] = ()
    """Of the law that it is another form of."""
    modes: tuple[str, ...] = (ON_STRING, FLYING)
    """Where it acts."""


def _rhythm(generator: np.random.Generator, slow: float, fast: float) -> dict[str, float]:
    frequency = sizes.log_uniform(generator, slow, fast)
    return {"gust_frequency": frequency, "gust_phase": generator.uniform(-math.pi, math.pi)}


def _gust(generator: np.random.Generator) -> sizes.Departure:
    """Mostly level: what is upright hardly moves a diabolo on its string."""
    direction = generator.normal(size=3) * [1.0, 1.0, 0.5]
    size = sizes.log_uniform(generator, 0.12, 0.8)
    push = (size * direction / np.linalg.norm(direction)).tolist()
    return {"air": {"gust": push, **_rhythm(generator, 0.1, 2.5)}}


def _spin_gust(generator: np.random.Generator) -> sizes.Departure:
    size = sizes.log_uniform(generator, 3.0, 25.0)
    return {"air": {"spin_gust": size, **_rhythm(generator, 0.05, 0.6)}}


def _pull(generator: np.random.Generator) -> sizes.Departure:
    centre = generator.uniform((-0.6, -0.6, 0.2), (0.6, 0.6, 1.6)).tolist()
    return {"air": {"pull": sizes.log_uniform(generator, 0.25, 2.0), "pull_centre": centre}}


def _windage_power(generator: np.random.Generator) -> sizes.Departure:
    power = generator.uniform(0.8, 1.3) if generator.uniform() < 0.5 else generator.uniform(2.8, 3.8)
    return {"air": {"windage": sizes.log_uniform(generator, 8e-8, 8e-7), "windage_power": power}}


def _drag_power(generator: np.random.Generator) -> sizes.Departure:
    size = sizes.log_uniform(generator, 0.1, 0.4)
    return {"air": {"drag": size, "drag_power": generator.uniform(2.8, 3.9)}}


def _one(
    part: str, field: str, least: float, most: float
) -> Callable[[np.random.Generator], sizes.Departure]:
    return lambda generator: {part: {field: sizes.log_uniform(generator, least, most)}}


KINDS: dict[str, Stranger] = {
    "gust": Stranger(_gust, "time"),
    "spin_gust": Stranger(_spin_gust, "time"),
    "creep": Stranger(_one("string", "creep", 0.001, 0.006), "string, time", (), (ON_STRING,)),
    "constant_drag": Stranger(_one("air", "constant_drag", 0.06, 0.6), "speed"),
    "drag_power": Stranger(_drag_power, "speed", ("air_drag_quadratic",)),
    "windage_power": Stranger(_windage_power, "spin", ("spin_drag",)),
    "pull": Stranger(_pull, "place"),
    "tip_wake": Stranger(_one("air", "tip_wake", 0.3, 3.0), "tips"),
    "tension_drag": Stranger(_one("diabolo", "tension_drag", 0.04, 0.4), "tension", (), (ON_STRING,)),
}


def verdict(answer: dict[str, Any]) -> str:
    """What a stranger gets from an answer (schema diabolo.diagnosis/1)."""
    headline = answer["headline"]
    if headline == "INSUFFICIENT_DATA":
        return REFUSED
    if headline in ("NOTHING_MISSING", "ERROR"):
        return SILENT
    adequacy = answer.get("adequacy", {})
    left = adequacy.get("places") or adequacy.get("changes") or answer.get("learnt")
    if headline == "UNNAMED_STRUCTURE" or left:
        return TOLD
    return TAKEN_FOR if adequacy.get("adequate") else SILENT


def row(answer: dict[str, Any]) -> dict[str, Any]:
    """What is told of a case."""
    adequacy = answer.get("adequacy", {})
    return {
        "verdict": verdict(answer),
        "headline": answer["headline"],
        "names": [effect["name"] for effect in answer["effects"]],
        "explained": adequacy.get("explained"),
        "sentence": answer["sentence"],
    }


def text_of(rows: list[dict[str, Any]]) -> str:
    """A line for each case, then how many got what."""
    lines = [f"{'law at work':14} {'what it got':18} share explained  answer"]
    for one in rows:
        share = "-" if one["explained"] is None else f"{100.0 * one['explained']:.0f} %"
        lines.append(f"{one['kind']:14} {one['verdict']:18} {share:>15}  {one['sentence']}")
    counts = [
        (what, sum(one["verdict"] == what for one in rows)) for what in (TOLD, TAKEN_FOR, REFUSED, SILENT)
    ]
    return "\n".join([*lines, "", ", ".join(f"{what}: {count} of {len(rows)}" for what, count in counts)])
