# SPDX-License-Identifier: MIT
"""What is put to the proof: the diagnosis, and simpler tools on the same files to compare it with."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any

from diabolo import diagnose, load_recording

from . import sindy
from .names import PHYSICS

Tool = Callable[[Path], dict[str, Any]]


def can_restrict() -> bool:
    """Whether the diagnosis can be told which names to choose from."""
    return "bank" in inspect.signature(diagnose).parameters


def _restricted(path: Path, **options: Any) -> dict[str, Any]:
    if not can_restrict():
        raise ValueError("this version of diabolo.diagnose has no keyword bank; a newer one is needed")
    return diagnose(load_recording(path), **options).to_dict()


def full(path: Path) -> dict[str, Any]:
    """The diagnosis as anyone would ask for it."""
    return diagnose(load_recording(path)).to_dict()


def oracle(path: Path, names: list[str]) -> dict[str, Any]:
    """The diagnosis that is told which physics is at work; measurement stays free."""
    return _restricted(path, bank=names)


def no_faults(path: Path) -> dict[str, Any]:
    """The diagnosis without faults of measurement: what naming them is worth."""
    options: dict[str, Any] = {"bank": list(PHYSICS)}
    if "measurement" in inspect.signature(diagnose).parameters:
        options["measurement"] = False
    return _restricted(path, **options)


TOOLS: dict[str, Tool] = {"diagnose": full, "no_faults": no_faults, "sindy": sindy.diagnose}
