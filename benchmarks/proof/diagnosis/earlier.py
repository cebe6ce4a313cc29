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


def text_of(batches: dict[str, Entry]) -> str:
    """One line a batch."""
    lines = [f"{files.text_of(name)}: {files.text_of(one)}" for name, one in batches.items()]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def read(path: Path) -> dict[str, Entry]:
    """By name, in their order; empty where there are none."""
    return dict(files.read_json(path, "the earlier batches")) if path.exists() else {}
