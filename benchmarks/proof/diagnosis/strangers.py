# SPDX-License-Identifier: MIT
"""Laws of the plant that no name of the diagnosis stands for: how they are drawn, and as formulas."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from diabolo import Recording, load_recording

from . import sizes
from .names import FLYING, ON_STRING
from .sizes import log_uniform

Scenario = dict[str, Any]


@dataclass(frozen=True)
class Part:
    """size * factor: one direction of a law, see docs/your_law.md."""

    acts: str
    factor: str
    usual: float
    truth: float | None = None
    """Of the size; None where the formula is only near the plant's law."""


@dataclass(frozen=True)
class Stranger:
    """A law that no name stands for."""

    draw: Callable[[np.random.Generator], sizes.Departure]
    depends: str
    """On what it depends: time, place, speed, spin, tension, slip, string, torque, tips."""
    parts: Callable[[Scenario, Recording], list[Part]]
    names: tuple[str, ...] = ()
    """At work with it."""
    is_form: bool = False
    """Whether it is another form of what `names` has; `parts` are then what it does beyond that."""
    modes: tuple[str, ...] = (ON_STRING, FLYING)
    """Where it acts."""


def _rhythm(generator: np.random.Generator, slow: float, fast: float) -> dict[str, float]:
    frequency = log_uniform(generator, slow, fast)
    return {"gust_frequency": frequency, "gust_phase": generator.uniform(-math.pi, math.pi)}


def _gust(generator: np.random.Generator) -> sizes.Departure:
    """Mostly level: what is upright hardly moves a diabolo on its string."""
    direction = generator.normal(size=3) * [1.0, 1.0, 0.5]
    size = log_uniform(generator, 0.12, 0.8)
    push = (size * direction / np.linalg.norm(direction)).tolist()
    return {"air": {"gust": push, **_rhythm(generator, 0.1, 2.5)}}


def _spin_gust(generator: np.random.Generator) -> sizes.Departure:
    size = log_uniform(generator, 3.0, 25.0)
    return {"air": {"spin_gust": size, **_rhythm(generator, 0.05, 0.6)}}


def _pull(generator: np.random.Generator) -> sizes.Departure:
    centre = generator.uniform((-0.6, -0.6, 0.2), (0.6, 0.6, 1.6)).tolist()
    return {"air": {"pull": log_uniform(generator, 0.25, 2.0), "pull_centre": centre}}


def _windage_power(generator: np.random.Generator) -> sizes.Departure:
    power = generator.uniform(0.8, 1.3) if generator.uniform() < 0.5 else generator.uniform(2.8, 3.8)
    return {"air": {"windage": log_uniform(generator, 8e-8, 8e-7), "windage_power": power}}


def _drag_power(generator: np.random.Generator) -> sizes.Departure:
    size = log_uniform(generator, 0.1, 0.4)
    return {"air": {"drag": size, "drag_power": generator.uniform(2.8, 3.9)}}


def _stribeck(generator: np.random.Generator, slow: float = 0.8, fast: float = 3.0) -> sizes.Departure:
    """A spinning axle slips by a metre a second or two."""
    rise = {"friction_rise": generator.uniform(0.15, 0.4), "stribeck_speed": generator.uniform(slow, fast)}
    return {"string": {"friction": log_uniform(generator, 0.02, 0.08), **rise}}


def _stiffening(generator: np.random.Generator, least: float = 0.002, most: float = 0.008) -> sizes.Departure:
    """The weight stretches such a string by some 5 mm."""
    stretch = sizes.elasticity(generator, 200.0, 500.0)
    return sizes.merged(stretch, {"string": {"stiffening_stretch": log_uniform(generator, least, most)}})


def _bearing(generator: np.random.Generator) -> sizes.Departure:
    torque = log_uniform(generator, 1e-4, 1e-3)
    return {"string": {"friction": generator.uniform(0.12, 0.35)}, "diabolo": {"bearing_torque": torque}}


def _lay(generator: np.random.Generator) -> sizes.Departure:
    twist = generator.uniform(0.2, 0.6) * generator.choice([-1.0, 1.0])
    return {"string": {"friction": log_uniform(generator, 0.05, 0.15), "lay": twist}}


def _flank(generator: np.random.Generator, narrow: float = 0.0002, wide: float = 0.0008) -> sizes.Departure:
    """The axle leans by a few degrees."""
    groove = {"groove_radius": 0.005, "groove_half_width": generator.uniform(narrow, wide)}
    rub = {"flank_friction": generator.uniform(0.2, 0.6), "flank_radius": generator.uniform(0.009, 0.015)}
    return {"diabolo": {**groove, **rub}}


def _one(
    part: str, field: str, least: float, most: float
) -> Callable[[np.random.Generator], sizes.Departure]:
    return lambda generator: {part: {field: log_uniform(generator, least, most)}}


AXES = ("forward", "left", "up")
HEADING, SLIPPING = "tanh(speed / 0.05)", "tanh(slip / 0.01)"  # the plant's signs


def _shares(air: dict[str, Any]) -> str:
    return f"sin({2.0 * math.pi * air['gust_frequency']} * t + {air['gust_phase']})"


def _pulls(scenario: Scenario, recording: Recording) -> list[Part]:
    air = scenario["air"]
    places = zip(AXES, air["pull_centre"], "xyz", strict=True)
    return [Part(axis, f"({centre} - {name})", 0.7, air["pull"]) for axis, centre, name in places]


def _windage(scenario: Scenario, recording: Recording) -> list[Part]:
    truth = scenario["air"]["windage"] / scenario["diabolo"]["axial_inertia"]
    power = scenario["air"]["windage_power"]
    return [Part("spin", f"(1e4 * (abs(spin) / 100)^{power} - spin^2) * tanh(-spin)", 1e-3, truth)]


def _wake(scenario: Scenario, recording: Recording) -> list[Part]:
    """The mean velocity of the tips by its twelve strongest oscillations: a formula has no room for more."""
    rows = np.arange(len(recording))
    known = recording.left_valid & recording.right_valid
    parts = []
    for column, axis in enumerate(AXES):
        tips = 0.5 * (recording.left[:, column] + recording.right[:, column])
        velocity = np.gradient(np.interp(rows, rows[known], tips[known])) * recording.rate
        waves = 2.0 * np.fft.rfft(velocity) / len(rows)
        turning = 2.0 * math.pi * recording.rate / len(rows)
        strongest = np.argsort(-np.abs(waves))[:12]
        terms = (
            f"{abs(waves[k]):.4g} * sin({k * turning:.6g} * t + {np.angle(1j * waves[k]):.4g})"
            for k in strongest
        )
        parts.append(Part(axis, f"({' + '.join(terms)})", 1.0))
    return parts


def _tension(scenario: Scenario, recording: Recording) -> list[Part]:
    """Of two strands that lead as far apart as the hands usually are."""
    aside = scenario["motion"]["left"][1] / (0.5 * scenario["string"]["length"])
    mean = 0.5 * scenario["diabolo"]["mass"] / math.sqrt(1.0 - aside**2)
    return [Part("against", f"{mean} * pull * taut * {HEADING}", 0.1)]


def _flanks(scenario: Scenario, recording: Recording) -> list[Part]:
    body = scenario["diabolo"]
    leans = f"(abs(axis_z) - {body['groove_half_width'] / body['groove_radius']})"
    return [Part("spin", f"taut * pull * abs(axis_z) * (1 + sign({leans})) * tanh(-spin)", 1.0)]


KINDS: dict[str, Stranger] = {
    "gust": Stranger(
        _gust,
        "time",
        lambda s, _: [
            Part(axis, _shares(s["air"]), 0.3, size)
            for axis, size in zip(AXES, s["air"]["gust"], strict=True)
        ],
    ),
    "spin_gust": Stranger(
        _spin_gust,
        "time, torque",
        lambda s, _: [Part("spin", f"(-1) * {_shares(s['air'])}", 8.0, s["air"]["spin_gust"])],
    ),
    "creep": Stranger(
        _one("string", "creep", 0.001, 0.006),
        "string, time",
        lambda s, _: [Part("string", "t", 0.002, s["string"]["creep"])],
        modes=(ON_STRING,),
    ),
    "constant_drag": Stranger(
        _one("air", "constant_drag", 0.06, 0.6),
        "speed",
        lambda s, _: [Part("against", HEADING, 0.2, s["air"]["constant_drag"])],
    ),
    "drag_power": Stranger(
        _drag_power,
        "speed",
        lambda s, _: [
            Part("against", f"(4 * (speed / 2)^{s['air']['drag_power']} - speed^2)", 0.2, s["air"]["drag"])
        ],
        ("air_drag_quadratic",),
        True,
    ),
    "windage_power": Stranger(_windage_power, "spin, torque", _windage, ("spin_drag",), True),
    "pull": Stranger(_pull, "place", _pulls),
    "tip_wake": Stranger(_one("air", "tip_wake", 0.3, 3.0), "tips", _wake),
    "tension_drag": Stranger(
        _one("diabolo", "tension_drag", 0.04, 0.4), "tension", _tension, modes=(ON_STRING,)
    ),
    "stribeck": Stranger(
        _stribeck,
        "slip",
        lambda s, _: [
            Part("along", f"taut * pull * exp(-(slip / {s['string']['stribeck_speed']})^2) * {SLIPPING}", 0.3)
        ],
        ("string_friction",),
        modes=(ON_STRING,),
    ),
    "stiffening": Stranger(
        _stiffening,
        "string, tension",
        lambda s, _: [Part("string", "pull^2", 1e-5)],
        ("string_elasticity",),
        modes=(ON_STRING,),
    ),
    "bearing": Stranger(
        _bearing,
        "slip, torque",
        lambda s, _: [Part("along", f"taut * {SLIPPING}", 0.3)],
        ("string_friction",),
        modes=(ON_STRING,),
    ),
    "flank": Stranger(_flank, "tension, torque", _flanks, modes=(ON_STRING,)),
    "lay": Stranger(
        _lay,
        "slip",
        lambda s, _: [Part("across", f"taut * pull * {SLIPPING}", 0.1)],
        ("string_friction",),
        modes=(ON_STRING,),
    ),
}
BEFORE_THE_TENTH: dict[str, Callable[[np.random.Generator], sizes.Departure]] = {
    "stribeck": lambda g: _stribeck(g, 0.2, 0.6),
    "stiffening": lambda g: _stiffening(g, 0.008, 0.04),
    "bearing": _bearing,
    "flank": lambda g: _flank(g, 0.0015, 0.004),
    "lay": _lay,
}
"""What was drawn in the batches up to the ninth: most of it too small to stand out."""


def parts_of(kind: str, scenario: Scenario, recording: Recording) -> dict[str, Part]:
    """The directions of a law, by the names of `laws_of`."""
    parts = KINDS[kind].parts(scenario, recording)
    return {f"{kind}_{part.acts}": part for part in parts if part.truth != 0.0}


def laws_of(parts: dict[str, Part]) -> list[dict[str, Any]]:
    """As `diabolo.diagnose(laws=...)` takes them."""
    return [
        {
            "name": name,
            "acts": part.acts,
            "formula": f"size * {part.factor}",
            "numbers": [{"name": "size", "unit": "1", "usual": part.usual, "minimum": -1e3, "maximum": 1e3}],
        }
        for name, part in parts.items()
    ]


def in_case(key: dict[str, Any]) -> Stranger | None:
    """What is at work in a case; nothing in the arm `outside` of earlier batches, which were not asked."""
    return None if key["arm"] == "outside" else KINDS.get(key["outside"])


def laws_in(key: dict[str, Any], recording: Path) -> list[dict[str, Any]]:
    """Of the stranger of a case."""
    return laws_of(parts_of(key["outside"], key["scenario"], load_recording(recording)))
