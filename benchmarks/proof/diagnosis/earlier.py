# SPDX-License-Identifier: MIT
"""The batches before the last: of each its commit, its seed, the hash of its seal, and its scores."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .. import files
from . import seal
from .answer import rounded

Entry = dict[str, Any]
_OF_SEAL = ("commit", "plant", "seed", "cases")
_OF_SCORE = ("name", "value", "hits", "total", "interval", "least", "most", "keeps", "fails")


def entry(sealed: dict[str, Any], result: dict[str, Any]) -> Entry:
    """The hash is that of the file that was published, which the seed makes again."""
    scores = [{name: score[name] for name in _OF_SCORE} for score in result["scores"]]
    return {
        **{name: sealed[name] for name in _OF_SEAL},
        "seal": seal.digest(sealed),
        "scores": rounded(scores),
    }


def write(path: Path, batches: dict[str, Entry]) -> None:
    """A packed line for each batch."""
    files.write_packed(path, ({"batch": name, **one} for name, one in batches.items()))


def read(path: Path) -> dict[str, Entry]:
    """By name, in their order; empty where there are none."""
    lines = files.read_packed(path) if path.exists() else []
    return {line["batch"]: {name: line[name] for name in line if name != "batch"} for line in lines}
