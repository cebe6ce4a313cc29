# SPDX-License-Identifier: MIT
"""Arguments that several functions take."""

from __future__ import annotations

import warnings
from collections.abc import Iterable
from typing import Any, SupportsIndex, TypeVar

from ._core import Model, Recording

Kind = TypeVar("Kind")

LARGEST_SEED = 2**63 - 1
MOST_THREADS = 2**31 - 1


def whole_number(name: str, given: object, least: int, most: int) -> int:
    """`given`, a whole number from `least` to `most`; else raises ValueError."""
    if not isinstance(given, SupportsIndex) or not least <= given.__index__() <= most:
        raise ValueError(f"{name}: {given!r}; expected a whole number from {least} to {most}")
    return given.__index__()


class RecordingWarning(UserWarning):
    """A recording is well formed, but odd; see Recording.warnings()."""


def warn_of(recordings: Iterable[Recording], stacklevel: int = 3) -> None:
    """Warn of what is odd about recordings that something is computed from."""
    for recording in recordings:
        for sentence in recording.warnings():
            warnings.warn(f"{recording.name}: {sentence}", RecordingWarning, stacklevel)


def callable_or_none(name: str, given: object) -> None:
    if given is not None and not callable(given):
        raise ValueError(f"{name}: {given!r}; expected a function")


def model_of(name: str, given: object) -> Model:
    """A model, or the one of that name."""
    if isinstance(given, str):
        return Model.named(given)
    if not isinstance(given, Model):
        raise ValueError(f"{name}: {given!r}; expected a Model, or 'published', 'paper' or 'consistent'")
    return given


def instance_of(name: str, given: Any, kind: type[Kind]) -> Kind:
    """`given`, of that kind; else raises ValueError."""
    if not isinstance(given, kind):
        raise ValueError(f"{name}: {given!r}; expected a {kind.__name__}")
    return given


def list_of(name: str, given: Any, kinds: tuple[type, ...] = (Recording,)) -> list[Any]:
    """One of `kinds`, or any number of them, as a list."""
    expected = " or ".join(kind.__name__ for kind in kinds)
    if isinstance(given, kinds):
        return [given]
    if isinstance(given, str) or not isinstance(given, Iterable):
        raise ValueError(f"{name}: {given!r}; expected {expected}, one or a list of them")
    items = list(given)
    for index, item in enumerate(items):
        if not isinstance(item, kinds):
            raise ValueError(f"{name}[{index}]: {item!r}; expected {expected}")
    return items
