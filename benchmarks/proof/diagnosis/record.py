# SPDX-License-Identifier: MIT
"""A scored batch in one small file: its seal, and of keys and answers what the scores are made of."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import files
from . import draw, score, seal
from .answer import Answer

Key = dict[str, Any]
ORACLE, EXCHANGED = "oracle", "exchanged"
_KEPT_OF_KEY = (
    "case",
    "arm",
    "attempts",
    "structure",
    "names",
    "tie",
    "outside",
    "bad",
    "parameters",
)


def kept_of_key(key: Key) -> Key:
    """A key without most of its scenario: the seed draws it again."""
    scenario = key["scenario"]
    kept = {"duration": scenario["duration"], "start": {"spin": scenario["start"]["spin"]}}
    if "gust_frequency" in scenario.get("air", {}):
        kept["air"] = {"gust_frequency": scenario["air"]["gust_frequency"]}
    return {**{name: key[name] for name in _KEPT_OF_KEY}, "scenario": kept}


def _thinned(answer: Answer, names: list[str]) -> Answer:
    """Sizes of effects count in the oracle's answer alone, and so do those that neither stand out nor are at
    work."""
    ladder = [rung for rung in answer["ladder"] if rung["name"] in names or abs(rung["z"] or 0.0) >= 1.0]
    return {**answer, "ladder": [{"name": rung["name"], "z": rung["z"]} for rung in ladder]}


def summary(keys: list[Key], answers: dict[str, dict[str, Answer]], tool: str) -> dict[str, Any]:
    """The scores of a tool."""
    oracles = (answers.get(who, {}) for who in (ORACLE, EXCHANGED))
    return score.summary(score.judged(keys, answers[tool], *oracles))


@dataclass(frozen=True)
class Record:
    """A sealed batch, its keys, and answers by tool and case."""

    sealed: dict[str, Any]
    keys: list[Key]
    answers: dict[str, dict[str, Answer]]
    """Of the tools, and of who was told what is at work (ORACLE) or the other name of a tie (EXCHANGED)."""

    def summary(self, tool: str) -> dict[str, Any]:
        return summary(self.keys, self.answers, tool)

    def not_as_sealed(self) -> list[str]:
        """The cases whose key, drawn again from the seed, is not the recorded one or has not the sealed hash.

        A processor that rounds otherwise may draw another last digit.
        """
        seed = self.sealed["seed"]
        by_case = {key["case"]: key for key in self.keys}
        drawn = draw.plans(seed, self.sealed["cases"], counts=self.sealed["arms"])
        plans = {plan.name: plan for plan in drawn}

        def is_sealed(case: str, hash_of_key: str) -> bool:
            key = by_case[case]
            again = draw.draw(plans[case], key["attempts"] - 1).key(key["parameters"])
            again["attempts"] = key["attempts"]
            opens = seal.seal_of(again, seal.salt_of(seed, case)) == hash_of_key
            return opens and kept_of_key(again) == kept_of_key(key)

        return [one["case"] for one in self.sealed["sealed"] if not is_sealed(one["case"], one["key"])]

    def write(self, path: Path) -> None:
        lines = [self.sealed]
        for key in self.keys:
            found = {who: by[key["case"]] for who, by in self.answers.items() if key["case"] in by}
            names = key["names"]
            found = {who: one if who == ORACLE else _thinned(one, names) for who, one in found.items()}
            lines.append({"key": kept_of_key(key), "answers": found})
        files.write_packed(path, lines)


def read(path: Path) -> Record:
    """Raises ValueError where the file is not there, or holds something else."""
    if not path.exists():
        raise ValueError(f"{path}: there is no such file; `score` writes it once all cases are answered")
    sealed, *lines = files.read_packed(path) or [None]
    answers: dict[str, dict[str, Answer]] = {}
    keys = []
    for number, line in enumerate(lines, start=2):
        if not isinstance(line, dict) or not {"key", "answers"} <= line.keys():
            raise ValueError(f"{path}, line {number}: expected a case with its key and answers")
        keys.append(line["key"])
        for who, found in line["answers"].items():
            answers.setdefault(who, {})[line["key"]["case"]] = found
    return Record(seal.checked(path, sealed), keys, answers)
