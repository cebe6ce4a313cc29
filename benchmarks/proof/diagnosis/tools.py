# SPDX-License-Identifier: MIT
"""What is put to the proof: the diagnosis, and simpler tools on the same files to compare it with."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import diabolo
from diabolo import diagnose, load_recording

from .. import files
from . import gp, sindy
from .names import MEASUREMENT, PHYSICS

Tool = Callable[[Path], dict[str, Any]]
Laws = Iterable[dict[str, Any]]


def digest() -> str:
    """Of the installed package, so that a batch that was sealed with one tool is not run with another."""
    folder = Path(diabolo.__file__).parent
    parts = sorted([*folder.glob("*.py"), *folder.glob("_core*.so")])
    return files.digest_of_text("".join(f"{part.name} {files.digest_of(part)}\n" for part in parts))


def restricted(path: Path, names: Iterable[str], laws: Laws = ()) -> dict[str, Any]:
    """The diagnosis that may claim nothing but these names, laws of one's own among them."""
    return diagnose(load_recording(path), bank=names, laws=laws).to_dict()


def full(path: Path, laws: Laws = ()) -> dict[str, Any]:
    """The diagnosis as anyone would ask for it."""
    return diagnose(load_recording(path), laws=laws).to_dict()


@functools.cache
def _known_physics(path: Path) -> tuple[str, ...]:
    """Names of physics that the diagnosis knows, by an answer of its own."""
    return tuple(rung["name"] for rung in full(path)["ladder"] if rung["name"] in PHYSICS)


def no_faults(path: Path) -> dict[str, Any]:
    """The diagnosis without faults of measurement: what naming them is worth."""
    return restricted(path, _known_physics(path))


def parameter_fit(path: Path) -> dict[str, Any]:
    """What fitting the simulator's own numbers reaches: lengths, places and clocks, and no physics."""
    return restricted(path, MEASUREMENT)


def bic(path: Path) -> dict[str, Any]:
    """The bank with Schwarz's criterion alone, see `by_bic`."""
    return by_bic(full(path), path)


def _kind_of(name: str) -> str:
    return "measurement" if name in MEASUREMENT else "physics"


def by_bic(result: dict[str, Any], path: Path) -> dict[str, Any]:
    """What the ladder of the diagnosis' own answer leads to by Schwarz's criterion: whatever lowers chi^2 by
    more than the logarithm of the number of data is claimed, however small, and whether or not left-out data
    is predicted better. It fits no model of its own, so that nothing is said of held-out errors."""
    if result["headline"] in ("INSUFFICIENT_DATA", "ERROR"):
        return result
    least = math.sqrt(math.log(3.0 * len(load_recording(path))))
    claimed = [rung for rung in result["ladder"] if rung["z"] is not None and abs(rung["z"]) > least]
    kinds = {_kind_of(rung["name"]) for rung in claimed}
    headline = "NAMED" if "physics" in kinds else "MEASUREMENT_FAULT" if kinds else "NOTHING_MISSING"
    effects = [
        {
            "name": rung["name"],
            "kind": _kind_of(rung["name"]),
            "material": True,
            "tied_with": [],
            "p_value": None,
            "confidence": None,
            "parameters": [],
        }
        for rung in sorted(claimed, key=lambda rung: -abs(rung["z"]))
    ]
    return {**result, "headline": headline, "effects": effects, "fit": dict.fromkeys(result["fit"])}


TOOLS: dict[str, Tool] = {
    "diagnose": full,
    "no_faults": no_faults,
    "parameter_fit": parameter_fit,
    "bic": bic,
    "sindy": sindy.diagnose,
    "gp": gp.diagnose,
}
