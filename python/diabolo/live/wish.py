# SPDX-License-Identifier: MIT
"""What the page asks of a play, and how its text is read."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

from ..checks import shown
from .hands import HOME, REACH

FASTEST_TIME = 2.0
"""Seconds of play in a second of the clock, at most."""


class Wish(NamedTuple):
    """Places of the tips, to the left and up [m], and how fast time goes."""

    left: tuple[float, float] = HOME[0]
    right: tuple[float, float] = HOME[1]
    speed: float = 1.0
    begin: str | None = None
    """'again': hang at rest. 'spin': spin as at the start."""


def wish_of(body: bytes) -> Wish:
    """What a body in JSON asks for; raises ValueError with a sentence where it is no wish."""
    try:
        given = json.loads(body)
    except ValueError:
        raise ValueError("the body is no JSON; expected a wish") from None
    if not isinstance(given, dict) or not given.keys() <= set(Wish._fields):
        raise ValueError(f"{shown(given)}; expected an object with {', '.join(Wish._fields)}")
    wish = Wish(**given)
    if wish.begin not in (None, "again", "spin"):
        raise ValueError(f"begin: {shown(wish.begin)}; expected null, 'again' or 'spin'")
    return Wish(
        _tip("left", wish.left),
        _tip("right", wish.right),
        _within("speed", wish.speed, 0.0, FASTEST_TIME),
        wish.begin,
    )


def _tip(name: str, given: Any) -> tuple[float, float]:
    if not isinstance(given, list | tuple) or len(given) != 2:
        raise ValueError(f"{name}: {shown(given)}; expected two numbers, to the left and up [m]")
    y, z = (_within(name, value, *reach) for value, reach in zip(given, REACH, strict=True))
    return y, z


def _within(name: str, given: Any, low: float, high: float) -> float:
    if isinstance(given, bool) or not isinstance(given, int | float) or not low <= given <= high:
        raise ValueError(f"{name}: {shown(given)}; expected a number from {low:g} to {high:g}")
    return float(given)
