# SPDX-License-Identifier: MIT
"""Whether an answer has a word for what no name stands for, and whether the word is at the right place."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

from .names import ANY_MODE, FLYING, LOOSE, ON_STRING
from .strangers import Stranger

SILENT = "silent"
"""Names of what is at work beside the law, or none, and no word of what they leave."""
TOLD = "told"
"""Something is left, and the answer says so."""
TAKEN_FOR = "taken for another"
"""Other names, which leave no more than noise leaves."""
REFUSED = "refused"
"""Nothing can be concluded."""

VERDICTS = (TOLD, TAKEN_FOR, REFUSED, SILENT)

# Direction and modes of what may change in time, or act without a name.
_QUANTITIES = {
    **{f"acceleration_{axis}": (axis, ANY_MODE) for axis in ("forward", "left", "up")},
    "string_tangent": ("along", (ON_STRING,)),
    "string_binormal": ("across", (ON_STRING,)),
    "flight_against_v": ("against", (FLYING,)),
    "flight_vertical": ("up", (FLYING,)),
    "flight_axis_x_v": ("lift", (FLYING,)),
    "spin_on_string": ("spin", (ON_STRING,)),
    "spin_off_string": ("spin", (FLYING, LOOSE)),
    "string_length": ("string", (ON_STRING,)),
    "string_friction": ("friction", (ON_STRING,)),
    "time_offset": ("", ANY_MODE),
}
_IN_WORLD = {
    "along": "left",
    "across": "forward",
    "string": "up",
    "friction": "left",
}  # of a player who faces forward


@dataclass(frozen=True)
class Word:
    """What is said of something without a name."""

    direction: str
    """As laws act, or spin; empty where none is said."""
    modes: tuple[str, ...]
    trends: bool = False
    frequency: float | None = None
    """[Hz]"""


def verdict(answer: dict[str, Any], beside: Collection[str] = ()) -> str:
    """What a law that no name stands for gets from an answer; `beside` is what is at work with it."""
    if answer["headline"] == "INSUFFICIENT_DATA":
        return REFUSED
    if answer["headline"] == "UNNAMED_STRUCTURE" or words(answer):
        return TOLD
    adequate = answer.get("adequacy", {}).get("adequate")
    others = [claim for claim in answer["effects"] if not {claim["name"], *claim["tied_with"]} & {*beside}]
    return TAKEN_FOR if others and adequate else SILENT


def words(answer: dict[str, Any]) -> list[Word]:
    """All that is said of what has no name."""
    adequacy = answer.get("adequacy", {})
    said = [_of_learnt(law) for law in answer.get("learnt", [])]
    for force in answer.get("unnamed", []):
        said.append(Word(*_QUANTITIES.get(force["where"]["direction"], ("", ANY_MODE))))
    for change in adequacy.get("changes", []):
        direction, modes = _QUANTITIES[change["quantity"]]
        said.append(Word(direction, modes, change["trend_per_s"] is not None, change["frequency_hz"]))
    for place in adequacy.get("places", []):
        modes = (place["mode"],) if place["mode"] in ANY_MODE else ANY_MODE
        said.append(Word("spin" if place["quantity"] == "spin" else place["direction"], modes))
    return said


def _of_learnt(law: dict[str, Any]) -> Word:
    on, off = (factor in law["formula"].replace("(1 - taut)", "flying") for factor in ("taut", "flying"))
    modes = (ON_STRING,) if on else (FLYING, LOOSE) if off else ANY_MODE
    frequencies = [number["value"] for number in law["numbers"] if number["name"] == "frequency"]
    trends = not frequencies and bool(re.search(r"\bt\b", law["formula"]))
    return Word(law["acts"], modes, trends, frequencies[0] if frequencies else None)


def is_placed(
    said: list[Word], law: Stranger, acts: Collection[str], frequency: float | None, seconds: float
) -> bool:
    """Whether any word has the law's mode, and its direction or its course in time.

    `acts` are the directions in which it shows, `frequency` [Hz] is the law's where it has one, `seconds` the
    length of the recording: frequencies are told apart to its inverse. A drag may show in any direction.
    """
    directions = {_IN_WORLD.get(one, one) for one in acts}

    def is_right(word: Word) -> bool:
        if not {*word.modes} & {*law.modes} or (word.direction == "spin") != ("spin" in acts):
            return False
        if frequency is None:
            is_timely = "time" in law.depends and word.trends
        else:
            is_timely = word.frequency is not None and abs(word.frequency - frequency) < 1.0 / seconds
        drags = "against" in acts and word.direction in ("forward", "left", "up")
        return is_timely or drags or _IN_WORLD.get(word.direction, word.direction) in directions

    return any(map(is_right, said))
