# SPDX-License-Identifier: MIT
"""What is kept of an answer: one JSON line per case, which depends on the case and the tool alone."""

from __future__ import annotations

from typing import Any

Answer = dict[str, Any]

_KEPT_OF_EFFECT = ("name", "kind", "material", "tied_with", "p_value", "confidence", "parameters")
_KEPT_OF_RUNG = ("name", "estimate", "z", "size_m", "claimed", "reason")
_KEPT_OF_FIT = ("heldout", "horizons_s", "base_error_m", "augmented_error_m", "windows")


def rounded(value: Any) -> Any:
    """Numbers to six digits."""
    if isinstance(value, float):
        return float(f"{value:.6g}")
    if isinstance(value, dict):
        return {name: rounded(member) for name, member in value.items()}
    if isinstance(value, list):
        return [rounded(member) for member in value]
    return value


def kept(result: Answer) -> Answer:
    """The part of a result (schema diabolo.diagnosis/1) that the scores are made of."""
    effects = [
        {
            **{name: effect.get(name) for name in _KEPT_OF_EFFECT},
            "modes": effect.get("where", {}).get("modes", []),
            "size": effect.get("size", {}),
        }
        for effect in result.get("effects", [])
    ]
    return {
        "headline": result["headline"],
        "effects": rounded(effects),
        "unnamed": rounded(result.get("unnamed", [])),
        "ladder": rounded([{n: rung.get(n) for n in _KEPT_OF_RUNG} for rung in result.get("ladder", [])]),
        "fit": rounded({name: result.get("fit", {}).get(name) for name in _KEPT_OF_FIT}),
    }


def failed(error: Exception) -> Answer:
    """The answer of a tool that gave up: it counts as one that claims nothing."""
    empty = dict.fromkeys(_KEPT_OF_FIT)
    message = " ".join(str(error).split())
    return {"headline": "ERROR", "error": message, "effects": [], "unnamed": [], "ladder": [], "fit": empty}


def claims(answer: Answer, kind: str) -> list[dict[str, Any]]:
    """What is claimed of one kind (physics, measurement), the surest first."""
    return [effect for effect in answer["effects"] if effect["kind"] == kind]


def significance(answer: Answer, name: str) -> float | None:
    """How many standard deviations a name stands out by; None where the tool does not know the name."""
    for rung in answer["ladder"]:
        if rung["name"] == name and rung["z"] is not None:
            return abs(float(rung["z"]))
    return None


def error_after(answer: Answer, which: str, seconds: float) -> float | None:
    """Mean error on data left out [m]; which: base or augmented."""
    horizons, errors = answer["fit"]["horizons_s"], answer["fit"][f"{which}_error_m"]
    if not horizons or not errors or seconds not in horizons:
        return None
    value = errors[horizons.index(seconds)]
    return None if value is None else float(value)
