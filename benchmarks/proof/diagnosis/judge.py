# SPDX-License-Identifier: MIT
"""One answer beside its key."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from . import answer as answers
from . import strangers, told
from .answer import Answer
from .material import is_material
from .names import ANY_MODE, AT_WORK_ANYWAY, LOOSE, ON_STRING, PHYSICS, faults_among, physics_among

Key = dict[str, Any]
HORIZON = 1.0  # after which the gap is compared [s]
SURE = 10.0  # standard deviations from which an effect has to be found


@dataclass(frozen=True)
class Interval:
    """A claimed parameter with its truth."""

    name: str
    parameter: str
    value: float
    low: float
    high: float
    truth: float
    width_ratio: float | None
    """To the width of the interval of who knows what is at work."""

    @property
    def covers(self) -> bool:
        return self.low <= self.truth <= self.high


@dataclass(frozen=True)
class Met:
    """What a law that no name stands for got."""

    verdict: str
    snr: float
    is_placed: bool
    """Whether a word has its mode, and its direction or time."""


@dataclass
class Verdict:
    """All that the scores need to know of a case."""

    case: str
    arm: str
    structure: str
    headline: str
    physics: list[str]
    """Truly at work, the leading one first."""
    faults: list[str]
    tie: list[str]
    outside: str | None
    bad: str | None
    claimed: list[str]
    """Physics, the surest first."""
    claimed_faults: list[str]
    tied: dict[str, list[str]]
    confidence: dict[str, float]
    modes: dict[str, list[str]]
    snr: dict[str, float]
    """By name; without those that the tool does not know."""
    material: dict[str, bool]
    """Whether the physics at work is beyond its floor, where that is known."""
    fault_z: dict[str, float]
    intervals: list[Interval] = field(default_factory=list)
    tie_is_real: bool = False
    """Whether the other name of a tie explains the data as well."""
    closure: float | None = None
    """Share of the gap between base and oracle that the answer closes."""
    says_unnamed: bool = False
    """Whether something without a name is reported; answers before the tenth batch were not asked."""
    met: Met | None = None
    """What a stranger got, where one was at work."""

    @property
    def is_clear_stranger(self) -> bool:
        return self.met is not None and self.met.snr >= SURE

    @property
    def owed(self) -> list[str]:
        """Physics that has to be found, what stands out most first."""
        clear = [name for name, snr in self.snr.items() if snr >= SURE and self.material.get(name)]
        return sorted(clear, key=lambda name: -self.snr[name])

    @property
    def false_physics(self) -> list[str]:
        """Claims of what is not at work, nor tied with what is."""
        at_work = {*self.physics, *self.tie}
        return [name for name in self.claimed if not at_work & {name, *self.tied[name]}]

    @property
    def false_faults(self) -> list[str]:
        """Claims of what is not wrong, nor tied with what is, or with physics at work."""
        at_work = {*self.faults, *self.physics}
        return [name for name in self.claimed_faults if not at_work & {name, *self.tied[name]}]

    def is_in_answer(self, name: str) -> bool:
        """Whether a name, of physics or of a fault, is claimed, or tied with what is."""
        return any(name in (claim, *self.tied[claim]) for claim in (*self.claimed, *self.claimed_faults))

    @property
    def top_is_right(self) -> bool:
        return bool(self.claimed) and self.claimed[0] in self.physics

    @property
    def declares_tie(self) -> bool:
        """Whether the names that cannot be told apart stand in one class."""
        classes = [{claim, *self.tied[claim]} for claim in self.claimed]
        return any(set(self.tie) <= names for names in classes)

    def mode_is_right(self, name: str) -> bool:
        """Whether the modes are where the effect acts. A loose string may tauten within a window."""
        modes, allowed = set(self.modes[name]), set(PHYSICS[name])
        if allowed == set(ANY_MODE):
            return bool(modes)
        return ON_STRING in modes and modes <= allowed | {LOOSE}


def _turned(value: float, towards: float) -> float:
    """The same angle [deg], within half a turn of another."""
    return towards + (value - towards + 180.0) % 360.0 - 180.0


def _parameters(effect: dict[str, Any]) -> dict[str, Any]:
    return {parameter["name"]: parameter for parameter in effect["parameters"]}


def _intervals(key: Key, answer: Answer, oracle: Answer | None) -> list[Interval]:
    found: list[Interval] = []
    best = {} if oracle is None else {effect["name"]: _parameters(effect) for effect in oracle["effects"]}
    for effect in answer["effects"]:
        truths = key["parameters"].get(effect["name"], {}) if effect["name"] in key["names"] else {}
        for name, parameter in _parameters(effect).items():
            truth = truths.get(name)
            if parameter["ci90"] is None or not isinstance(truth, float | int):
                continue
            if name.endswith("azimuth_deg"):
                truth = _turned(truth, parameter["value"])
            low, high = parameter["ci90"]
            known = best.get(effect["name"], {}).get(name)
            known_width = known["ci90"][1] - known["ci90"][0] if known and known["ci90"] else 0.0
            ratio = (high - low) / known_width if known_width > 0.0 else None
            found.append(Interval(effect["name"], name, parameter["value"], low, high, float(truth), ratio))
    return found


def _met(key: Key, answer: Answer, oracle: Answer | None) -> Met | None:
    """Nothing where it is not known how much the stranger stands out."""
    law = strangers.in_case(key)
    if law is None or oracle is None:
        return None
    prefix = key["outside"] + "_"
    z = {rung["name"]: abs(rung["z"] or 0.0) for rung in oracle["ladder"] if rung["name"].startswith(prefix)}
    most = max(z.values(), default=0.0)
    acts = [name.removeprefix(prefix) for name, one in z.items() if one >= 0.5 * most]
    snr = math.hypot(*z.values())
    scenario = key["scenario"]
    frequency = scenario.get("air", {}).get("gust_frequency")
    is_placed = told.is_placed(told.words(answer), law, acts, frequency, scenario["duration"])
    forms = law.names if law.is_form else ()
    beside = [name for name in (*key["names"], *AT_WORK_ANYWAY) if name not in forms]
    return Met(told.verdict(answer, beside), snr, is_placed)


def _closure(key: Key, answer: Answer, oracle: Answer | None) -> float | None:
    """Counts where the base's error is at least half again the oracle's.

    The gap of a stranger is what the oracle lacks without it, and counts where it is sure.
    """
    if oracle is None:
        return None
    augmented = answers.error_after(answer, "augmented", HORIZON)
    best = answers.error_after(oracle, "augmented", HORIZON)
    if augmented is None or best is None:
        return None
    if strangers.in_case(key):
        gap = answers.gap_without(oracle, key["outside"] + "_", HORIZON)
        return 1.0 - (augmented - best) / gap if gap > 0.0 else None
    base = answers.error_after(answer, "base", HORIZON)
    return None if base is None or base < 1.5 * best or base <= best else (base - augmented) / (base - best)


def _tie_is_real(key: Key, oracle: Answer | None, other: Answer | None) -> bool:
    """Whether exchanging the names costs less than three standard deviations' worth."""
    if oracle is None or other is None or len(key["tie"]) != 2:
        return False
    true = answers.significance(oracle, key["names"][0])
    alternative = next(name for name in key["tie"] if name != key["names"][0])
    exchanged = answers.significance(other, alternative)
    return true is not None and exchanged is not None and true**2 - exchanged**2 < 9.0


def judge(key: Key, answer: Answer, oracle: Answer | None, other: Answer | None = None) -> Verdict:
    """Compares an answer with the truth.

    `oracle` is the answer of who was told what is at work, `other` of who was told a tie's other name.
    """
    physics = physics_among(key["names"])
    claimed = [one for one in answers.claims(answer, "physics") if one["name"] not in AT_WORK_ANYWAY]
    faults = answers.claims(answer, "measurement")
    snr = {name: answers.significance(oracle, name) for name in physics} if oracle else {}
    z = {name: answers.significance(answer, name) for name in faults_among(key["names"])}
    return Verdict(
        case=key["case"],
        arm=key["arm"],
        structure=key["structure"],
        headline=answer["headline"],
        physics=physics,
        faults=faults_among(key["names"]),
        tie=key["tie"],
        outside=key["outside"],
        bad=key["bad"],
        claimed=[effect["name"] for effect in claimed],
        claimed_faults=[effect["name"] for effect in faults],
        tied={effect["name"]: effect["tied_with"] for effect in answer["effects"]},
        confidence={e["name"]: e["confidence"] for e in claimed if e["confidence"] is not None},
        modes={effect["name"]: effect["modes"] for effect in answer["effects"]},
        snr={name: value for name, value in snr.items() if value is not None},
        material={n: found for n in physics if (found := is_material(key, oracle, n)) is not None},
        fault_z={name: value for name, value in z.items() if value is not None},
        intervals=_intervals(key, answer, oracle),
        tie_is_real=_tie_is_real(key, oracle, other),
        closure=_closure(key, answer, oracle),
        says_unnamed="learnt" in answer
        and (answer["headline"] == "UNNAMED_STRUCTURE" or bool(answer["learnt"])),
        met=_met(key, answer, oracle),
    )
