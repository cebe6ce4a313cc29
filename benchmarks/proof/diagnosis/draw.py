# SPDX-License-Identifier: MIT
"""Draws cases: an arm, what is at work in it, and a scenario for the plant. The same seed draws the same."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import arms, base, sizes

# What the chain of nodes has no law for.
SPRINGS_ALONE = {
    "string": ("wraps", "stiffening_stretch", "friction_rise", "stribeck_speed", "lay", "creep"),
    "diabolo": ("bearing_torque", "flank_friction", "flank_radius", "tension_drag"),
}
LEAST_SPIN, MOST_SPIN = 40.0, 300.0  # at the end and at the start [rad/s]
TRIES = 8  # of a content before another is drawn
CALM, CALMEST = 4, 6  # of them those from which nothing is thrown any more, and all is slow
KEY_SCHEMA = "diabolo.concealed_key/1"


@dataclass(frozen=True)
class Plan:
    """Which arm and which plant a case has (the springs where the chain has no law for what is at work); the
    rest follows from the seed and its number."""

    seed: int
    number: int
    arm: str
    structure: str

    @property
    def name(self) -> str:
        return f"case_{self.number:04d}"

    def generator(self, *streams: int) -> np.random.Generator:
        return np.random.default_rng([self.seed, self.number, *streams])


@dataclass(frozen=True)
class Drawn:
    """A case as the plant is asked for it."""

    plan: Plan
    content: arms.Content
    scenario: dict[str, Any]
    structure: str

    def key(self, parameters: dict[str, Any]) -> dict[str, Any]:
        """The truth; `parameters` by the plant's own account."""
        return {
            "schema": KEY_SCHEMA,
            "case": self.plan.name,
            "arm": self.plan.arm,
            "structure": self.structure,
            "names": self.content.names,
            "tie": self.content.tie,
            "outside": self.content.outside,
            "bad": self.content.bad,
            "parameters": {name: parameters[name] for name in self.content.names if name in parameters},
            "scenario": self.scenario,
            "steps": self.content.steps,
        }


def plans(seed: int, cases: int, with_chain: bool = True, counts: dict[str, int] | None = None) -> list[Plan]:
    """Arms and plants in a drawn order: neither number nor name of a case says what it holds.

    `counts` of the arms are those of `arms.allot` where none are given.
    """
    generator = np.random.default_rng([seed])
    order = [arm for arm, count in (counts or arms.allot(cases)).items() for _ in range(count)]
    drawn = [order[i] for i in generator.permutation(cases)]
    chains = np.zeros(cases, dtype=bool)
    chains[generator.permutation(cases)[: int(np.ceil(arms.CHAIN_SHARE * cases))]] = with_chain
    return [
        Plan(seed, number + 1, arm, "chain" if chain else "springs")
        for number, (arm, chain) in enumerate(zip(drawn, chains, strict=True))
    ]


def _spin_taken(scenario: dict[str, Any]) -> float:
    """What drag and a wrapped string take of the spin [rad/s^2]: a diabolo that stands still falls off."""
    body, string = scenario["diabolo"], scenario["string"]
    taken = float(body.get("axle_drag", 0.0))
    if wraps := string.get("wraps", 0):
        gain = body["mass"] * body["axle_radius"] / body["axial_inertia"]
        angle = 2.6 + 2.0 * math.pi * wraps
        taken += 9.81 * gain * math.tanh(0.5 * string["friction"] * angle)
    return taken


def draw(plan: Plan, attempt: int = 0) -> Drawn:
    """A case. Another attempt has another motion, since a diabolo may be missed, and all else the same; what
    no motion keeps in play is drawn again.
    """
    content = arms.content_of(plan.arm, plan.generator(0, attempt // TRIES))
    chain = not any(
        field in content.departure.get(part, {}) for part, fields in SPRINGS_ALONE.items() for field in fields
    )
    structure = plan.structure if chain else "springs"
    wrapped = content.departure.get("string", {}).get("wraps", 0) > 0  # a throw would unwind it
    scenario = base.body_and_camera(plan.generator(1), structure)
    kind = content.motion if attempt % TRIES < CALMEST else "slow"
    play = base.play(plan.generator(2, attempt), kind, attempt % TRIES < CALM and not wrapped)
    scenario = sizes.merged(scenario, play)
    scenario = sizes.merged(scenario, content.departure)
    spin, least = scenario["start"]["spin"], LEAST_SPIN + _spin_taken(scenario) * scenario["duration"]
    scenario["start"]["spin"] = math.copysign(min(max(abs(spin), least), MOST_SPIN), spin)
    for step in content.steps:
        if step["step"] == "frame_rate":  # filmed at another rate than the file will say
            scenario["camera"]["rate"] /= step["factor"]
    return Drawn(plan, content, scenario, structure)
