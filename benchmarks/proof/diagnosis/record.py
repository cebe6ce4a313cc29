# SPDX-License-Identifier: MIT
"""A scored batch in one small file: of keys and answers what the scores are made of."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import files
from . import score
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
    return {**{name: key[name] for name in _KEPT_OF_KEY}, "scenario": kept}


@dataclass(frozen=True)
class Record:
    """Keys, and answers by tool and case."""

    keys: list[Key]
    answers: dict[str, dict[str, Answer]]
    """Of the tools, and of who was told what is at work (ORACLE) or the other name of a tie (EXCHANGED)."""

    def summary(self, tool: str) -> dict[str, Any]:
        """The scores of a tool."""
        told = (self.answers.get(who, {}) for who in (ORACLE, EXCHANGED))
        return score.summary(score.judged(self.keys, self.answers[tool], *told))

    def write(self, path: Path) -> None:
        lines = []
        for key in self.keys:
            found = {who: by[key["case"]] for who, by in self.answers.items() if key["case"] in by}
            lines.append({"key": kept_of_key(key), "answers": found})
        files.write_packed(path, lines)


def read(path: Path) -> Record:
    """Raises ValueError where the file is not there, or holds something else."""
    if not path.exists():
        raise ValueError(f"{path}: there is no such file; `score` writes it once all cases are answered")
    answers: dict[str, dict[str, Answer]] = {}
    keys = []
    for number, line in enumerate(files.read_packed(path), start=1):
        if not isinstance(line, dict) or not {"key", "answers"} <= line.keys():
            raise ValueError(f"{path}, line {number}: expected a case with its key and answers")
        keys.append(line["key"])
        for who, found in line["answers"].items():
            answers.setdefault(who, {})[line["key"]["case"]] = found
    return Record(keys, answers)
