# SPDX-License-Identifier: MIT
"""What is kept of an answer: one JSON line per case, which depends on the case and the tool alone."""

from __future__ import annotations

from typing import Any

Answer = dict[str, Any]

_KEPT_OF_EFFECT = ("name", "kind", "tied_with", "confidence", "worse_without_ci95_m")
_KEPT_OF_PARAMETER = ("name", "value", "ci90")
_KEPT_OF_RUNG = ("name", "z", "size_m")
_KEPT_OF_FIT = ("horizons_s", "base_error_m", "augmented_error_m")
_KEPT_OF_PLACE = ("quantity", "mode", "direction")
_KEPT_OF_CHANGE = ("quantity", "trend_per_s", "frequency_hz")
_KEPT_OF_LEARNT = ("acts", "formula", "numbers")
_PARAMETERS = ("parameters", "numbers")


def rounded(value: Any, digits: int = 4) -> Any:
    """Numbers to so many digits, those of parameters to six: one may lie next to 1."""
    if isinstance(value, float):
        return float(f"{value:.{digits}g}")
    if isinstance(value, dict):
        return {name: rounded(one, 6 if name in _PARAMETERS else digits) for name, one in value.items()}
    if isinstance(value, list):
        return [rounded(member, digits) for member in value]
    return value


def _part(names: tuple[str, ...], of: dict[str, Any]) -> dict[str, Any]:
    return {name: of.get(name) for name in names}


def kept(result: Answer) -> Answer:
    """The part of a result (schema diabolo.diagnosis/1) that the scores are made of, and what has no name."""
    effects = [
        {
            **_part(_KEPT_OF_EFFECT, effect),
            "parameters": [_part(_KEPT_OF_PARAMETER, parameter) for parameter in effect["parameters"]],
            "modes": effect.get("where", {}).get("modes", []),
        }
        for effect in result.get("effects", [])
    ]
    adequacy = result.get("adequacy", {})
    left = {
        "adequate": adequacy.get("adequate"),
        "places": [_part(_KEPT_OF_PLACE, place) for place in adequacy.get("places", [])],
        "changes": [_part(_KEPT_OF_CHANGE, change) for change in adequacy.get("changes", [])],
    }
    return {
        "headline": result["headline"],
        "effects": rounded(effects),
        "unnamed": rounded(result.get("unnamed", [])),
        "learnt": rounded([_part(_KEPT_OF_LEARNT, law) for law in result.get("learnt", [])]),
        "adequacy": rounded(left),
        "ladder": rounded([_part(_KEPT_OF_RUNG, rung) for rung in result.get("ladder", [])]),
        "fit": rounded(_part(_KEPT_OF_FIT, result.get("fit", {}))),
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


def gap_without(answer: Answer, prefix: str, seconds: float) -> float:
    """By how much held-out data is predicted worse without what a prefix names, where that is sure [m]."""
    horizons = answer["fit"]["horizons_s"] or []
    spans = [
        effect["worse_without_ci95_m"][horizons.index(seconds)]
        for effect in answer["effects"]
        if effect["name"].startswith(prefix) and seconds in horizons and effect.get("worse_without_ci95_m")
    ]
    return float(sum(0.5 * (span[0] + span[1]) for span in spans if span and span[0] > 0.0))
