# SPDX-License-Identifier: MIT
"""A plant plays reality; with half of its physics switched off it plays somebody's simulator.

Is all that was switched off named, and nothing else?
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import diabolo
import numpy as np

from . import base, making, sizes
from .draw import CALM, CALMEST, TRIES
from .sizes import either_sign, log_uniform

# Laws that are seen at once; of each group one is at work.
GROUPS: tuple[dict[str, Callable[[np.random.Generator], sizes.Departure]], ...] = (
    {"string_friction": lambda g: {"string": {"friction": log_uniform(g, 0.06, 0.35)}}},
    {
        "stick_flex": lambda g: sizes.stick_flex(g, 90.0, 700.0),
        "string_elasticity": lambda g: sizes.elasticity(g, 300.0, 2500.0),
    },
    {
        "air_drag_linear": lambda g: {"air": {"linear_drag": log_uniform(g, 0.05, 0.3)}},
        "air_drag_quadratic": lambda g: {"air": {"drag": log_uniform(g, 0.04, 0.15)}},
    },
    {"magnus_lift": lambda g: {"air": {"magnus": either_sign(g) * log_uniform(g, 1e-3, 6e-3)}}},
    {
        "spin_drag": lambda g: {"air": {"windage": log_uniform(g, 2e-7, 2e-6)}},
        "axle_drag": lambda g: {"diabolo": {"axle_drag": log_uniform(g, 1.0, 8.0)}},
    },
)
AT_WORK, OFF = 4, 2
FASTEST_LOSS = 12.0  # a diabolo that stands still falls off [rad/s^2]
CLEAN: dict[str, Any] = dict.fromkeys(
    ("white_noise", "drift_noise", "attitude_noise", "dropout_share", "tilt_deg", "diabolo_delay"), 0.0
) | {"scale": 1.0, "left_tip_offset": [0.0] * 3, "right_tip_offset": [0.0] * 3, "centre_offset": [0.0] * 3}


@dataclass(frozen=True)
class Pair:
    """What is at work in reality, and what of it the simulator lacks."""

    real: dict[str, Any]
    simulated: dict[str, Any]
    names: list[str]
    off: list[str]


def draw(seed: int, number: int, attempt: int = 0) -> Pair:
    """The scenarios of a case; another attempt has another motion, and what no motion keeps in play is drawn
    again."""
    generator = np.random.default_rng([seed, number, attempt // TRIES])
    names, departures = [], {}
    for group in generator.choice(len(GROUPS), AT_WORK, replace=False):
        name = str(generator.choice(list(GROUPS[group])))
        names.append(name)
        departures[name] = GROUPS[group][name](generator)
    off = [str(name) for name in generator.choice(names, OFF, replace=False)]
    scenario = base.body_and_camera(np.random.default_rng([seed, number, 0, 1]), "springs")
    kind = "lively" if attempt % TRIES < CALMEST else "slow"
    play = base.play(np.random.default_rng([seed, number, attempt, 2]), kind, attempt % TRIES < CALM)
    spin = play["start"]["spin"]
    play["start"]["spin"] = math.copysign(max(abs(spin), FASTEST_LOSS * play["duration"]), spin)
    scenario = sizes.merged(scenario, play)
    real, simulated = copy.deepcopy(scenario), copy.deepcopy(scenario)
    for name, departure in departures.items():
        real = sizes.merged(real, departure)
        simulated = simulated if name in off else sizes.merged(simulated, departure)
    simulated = sizes.merged(
        simulated, {"camera": CLEAN, "string_length_error": 0.0, "axle_radius_error": 0.0}
    )
    return Pair(real, simulated, names, off)


def make(program: Path, seed: int, number: int, folder: Path) -> tuple[Pair, dict[str, Any]]:
    """Plays both; returns what was drawn and the truth of the real one.

    Raises ValueError where the diabolo is always missed.
    """
    for attempt in range(making.ATTEMPTS):
        pair = draw(seed, number, attempt)
        truth = making.play(program, pair.real, folder / "real.csv")
        if truth is None or making.play(program, pair.simulated, folder / "simulated.csv") is None:
            continue
        frames = making.SHORTEST_SHARE * pair.real["duration"] * pair.real["camera"]["rate"]
        if all(
            len(diabolo.load_recording(folder / f"{name}.csv")) >= frames for name in ("real", "simulated")
        ):
            return pair, truth
    raise ValueError(f"case {number}: the plant missed the diabolo in all of {making.ATTEMPTS} attempts")


def row(pair: Pair, truth: dict[str, Any], comparison: diabolo.Comparison) -> dict[str, Any]:
    """What is told of a case beside what is so."""
    verdicts = {law.name: law.verdict for law in comparison.laws}
    found, inside = [], []
    for law in comparison.laws:
        named = {law.name, *law.tied_with} & set(pair.off)
        if law.verdict not in ("lacks", "too_little") or not named:
            continue
        found += sorted(named)
        known = truth.get(law.name, {})
        first = law.difference[0]
        if first.name in known and first.ci90 and first.ci90.low <= known[first.name] <= first.ci90.high:
            inside.append(law.name)
    return {
        "at_work": pair.names,
        "off": pair.off,
        "found": found,
        "inside": inside,
        "wrong": [
            name
            for name, verdict in verdicts.items()
            if verdict not in ("agrees", "cannot_tell") and name not in found and name not in pair.off
        ],
        "verdicts": verdicts,
        "truth": {name: truth.get(name) for name in pair.names},
        "difference": {law.name: [one.to_dict() for one in law.difference] for law in comparison.laws},
        "sentence": comparison.sentence,
    }


def text_of(rows: list[dict[str, Any]]) -> str:
    """A line for each case, then how many are right."""
    lines = []
    for number, one in enumerate(rows, 1):
        missed = [name for name in one["off"] if name not in one["found"]]
        outside = [name for name in one["found"] if name not in one["inside"]]
        notes = [
            f"{word} {', '.join(names)}"
            for word, names in (("missed", missed), ("size off", outside), ("wrong", one["wrong"]))
            if names
        ]
        lines.append(f"{number:3} off: {', '.join(one['off']):40} {'; '.join(notes) or 'right'}")
    named = sum(set(one["off"]) <= set(one["found"]) for one in rows)
    laws = sum(len(one["off"]) for one in rows)
    lines += [
        "",
        f"all that was switched off is named: {named} of {len(rows)} cases",
        f"its size within the 90 % interval: {sum(len(one['inside']) for one in rows)} of {laws} laws",
        f"something else is said to differ: {sum(bool(one['wrong']) for one in rows)} of {len(rows)} cases",
    ]
    return "\n".join(lines)
