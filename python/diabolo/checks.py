# SPDX-License-Identifier: MIT
"""Arguments that several functions take."""

from __future__ import annotations

import logging
import operator
import os
import warnings
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from importlib import import_module
from itertools import combinations
from pathlib import Path
from typing import Any, TypeAlias, TypeGuard, TypeVar

import numpy as np
from numpy.typing import NDArray

from ._core import FormulaLaws, Model, Recording
from .excerpt import Excerpt

Kind = TypeVar("Kind")

AnyRecording: TypeAlias = Recording | Excerpt | str | os.PathLike[str]
"""A recording, some rows of one, or the name of its file."""

LARGEST_SEED = 2**63 - 1
MOST_CYCLES = 1000  # of a figure in a row
MOST_THREADS = 2**31 - 1
LONGEST_SHOWN = 60
LONGEST_PATH = 4096


def shown(given: object) -> str:
    """What was found, short enough for a sentence."""
    if isinstance(given, np.ndarray):
        kind = "a masked array" if isinstance(given, np.ma.MaskedArray) else "an array"
        return f"{kind} of the shape {given.shape}, {given.dtype}"
    text = " ".join(repr(given).split())
    return text if len(text) <= LONGEST_SHOWN else text[: LONGEST_SHOWN - 3] + "..."


def number(name: str, given: Any) -> float:
    """A number, finite or not; else raises ValueError."""
    with suppress(TypeError, ValueError, OverflowError):
        if np.ndim(given) == 0 and np.asarray(given).dtype.kind not in "SU":
            return float(given)
    raise ValueError(f"{name}: {shown(given)}; expected a number")


def is_several(given: Any) -> TypeGuard[Iterable[Any]]:
    """Whether it holds one thing after another, as no text and no array without an axis does."""
    return (
        isinstance(given, Iterable) and not isinstance(given, str | bytes) and getattr(given, "ndim", 1) > 0
    )


def names_of(name: str, given: Any, example: str) -> list[str]:
    """A list of names; else raises ValueError."""
    if is_several(given):
        names = list(given)
        if all(isinstance(one, str) for one in names):
            return names
    raise ValueError(f"{name}: {shown(given)}; expected a list of names, such as ['{example}']")


def one_of(name: str, given: Any, choices: Iterable[str]) -> str:
    """One of the choices; else raises ValueError."""
    if not isinstance(given, str) or given not in choices:
        raise ValueError(f"{name}: {shown(given)}; expected one of {', '.join(choices)}")
    return given


def numbers(name: str, given: Any) -> NDArray[np.float64]:
    """An array of numbers; else raises ValueError."""
    if isinstance(given, np.ma.MaskedArray) and (masked := int(np.count_nonzero(np.ma.getmaskarray(given)))):
        raise ValueError(f"{name}: {masked} of {given.size} values are masked; expected none")
    try:
        return np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name}: {shown(given)}; expected an array of numbers") from None


def true_or_false(name: str, given: Any) -> bool:
    """`given`, True or False; else raises ValueError."""
    if not isinstance(given, bool):
        raise ValueError(f"{name}: {shown(given)}; expected True or False")
    return given


def whole_number(name: str, given: Any, least: int, most: int) -> int:
    """`given`, a whole number from `least` to `most`; else raises ValueError."""
    with suppress(TypeError, ValueError):
        if np.ndim(given) == 0 and least <= operator.index(given) <= most:
            return operator.index(given)
    raise ValueError(f"{name}: {shown(given)}; expected a whole number from {least} to {most}")


class RecordingWarning(UserWarning):
    """A recording is well formed, but odd; see Recording.warnings()."""


def warn_of(recordings: Iterable[Recording], stacklevel: int = 3) -> None:
    """Warn of what is odd about recordings that something is computed from, of each thing once."""
    sentences = [f"{recording.name}: {text}" for recording in recordings for text in recording.warnings()]
    for sentence in dict.fromkeys(sentences):
        warnings.warn(sentence, RecordingWarning, stacklevel)


def check_distinct(recordings: Sequence[Recording], *, parts: bool) -> None:
    """Raise ValueError where two hold the same samples, or, with `parts`, some that are the same."""
    for a, b in combinations(recordings, 2):
        times, in_a, in_b = np.intersect1d(a.time, b.time, assume_unique=True, return_indices=True)
        least = 2 if parts else max(len(a), len(b))
        if len(times) >= least and all(
            np.array_equal(getattr(a, track)[in_a], getattr(b, track)[in_b], equal_nan=True)
            for track in ("left", "right", "diabolo")
        ):
            raise ValueError(
                f"recordings: {a.title} and {b.title} hold the same {len(times)} samples, from "
                f"{times[0]:g} to {times[-1]:g} s; expected each once, since it would count twice"
            )


def callable_or_none(name: str, given: object) -> None:
    if given is not None and not callable(given):
        raise ValueError(f"{name}: {shown(given)}; expected a function")


def model_of(name: str, given: object) -> Model:
    """A model, or the one of that name."""
    if isinstance(given, str):
        try:
            return Model.named(given)
        except ValueError as error:
            raise ValueError(f"{name}: {str(error).removeprefix('model ')}") from None
    if not isinstance(given, Model):
        raise ValueError(f"{name}: {shown(given)}; expected a Model, or 'published', 'paper' or 'consistent'")
    return given


def laws_of(name: str, given: Any) -> FormulaLaws:
    """Laws by formulas: themselves, a list that makes them, or the name of their file."""
    expected = "expected FormulaLaws, a list of laws, or the name of their file"
    try:
        is_file = isinstance(given, str | os.PathLike)
        return FormulaLaws.load(file_name(name, given)) if is_file else FormulaLaws(given)
    except (TypeError, RecursionError):
        raise ValueError(f"{name}: {shown(given)}; {expected}") from None
    except ValueError as error:
        raise ValueError(f"{name}: {str(error).removeprefix(f'{name}: ')}") from None


def file_name(name: str, given: Any) -> Path:
    """The name of a file; else, such as about its content, raises ValueError."""
    with suppress(TypeError):
        text = os.fsdecode(given)
        if "\0" not in text and len(text) <= LONGEST_PATH:
            return Path(text)
    raise ValueError(f"{name}: {shown(given)}; expected the name of a file")


def check_drawing(path: str | os.PathLike[str], *libraries: str) -> None:
    """Raise ValueError where a library is missing that this file is drawn with."""
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # it tells where it caches, in lines of its own
    try:
        for library in libraries:
            import_module(library)
    except ModuleNotFoundError as error:
        raise ValueError(
            f"{path}: to draw it, install {error.name} (pip install '.[plot]' in the project's root)"
        ) from error


def check_library(what: str, library: str, extra: str) -> None:
    """Raise ValueError where an optional library is missing."""
    try:
        import_module(library)
    except ModuleNotFoundError as error:
        raise ValueError(
            f"{what}: needs {error.name} (pip install '.[{extra}]' in the project's root)"
        ) from error


def instance_of(name: str, given: Any, kind: type[Kind]) -> Kind:
    """`given`, of that kind; else raises ValueError."""
    if not isinstance(given, kind):
        raise ValueError(f"{name}: {shown(given)}; expected a {kind.__name__}")
    return given


def _loader() -> Callable[[Any], Recording]:
    """What reads recordings of any kind; it is built on these checks."""
    from .formats import load_recording

    return load_recording


def excerpt_of(name: str, given: Excerpt) -> Excerpt:
    """An excerpt of rows that are there; else raises ValueError."""
    recording = instance_of(f"{name}.recording", given.recording, Recording)
    last = len(recording) - 1
    first = whole_number(f"{name}.first", given.first, 0, last)
    return Excerpt(recording, first, whole_number(f"{name}.last", given.last, first, last))


def recording_of(name: str, given: AnyRecording) -> Recording:
    """A recording, or what its file or an excerpt holds."""
    if isinstance(given, str | os.PathLike):
        return _loader()(file_name(name, given))
    if isinstance(given, Excerpt):
        return excerpt_of(name, given).part()
    return instance_of(name, given, Recording)


def list_of(name: str, given: Any, kinds: tuple[type, ...] = (Recording,), *, least: int = 0) -> list[Any]:
    """One of `kinds`, or `least` or more of them, as a list; the name of a file counts as its recording, an
    excerpt as its part."""
    expected = " or ".join(kind.__name__ for kind in kinds)
    if Recording in kinds:
        expected += ", an Excerpt or the name of a file"

    def one(place: str, item: Any) -> Any:
        if isinstance(item, kinds):
            return item
        if Recording in kinds and isinstance(item, Excerpt | str | os.PathLike):
            return recording_of(place, item)
        raise ValueError(f"{place}: {shown(item)}; expected {expected}")

    if isinstance(given, (*kinds, Excerpt, str, os.PathLike)):
        return [one(name, given)]
    if not is_several(given):
        raise ValueError(f"{name}: {shown(given)}; expected {expected}, one or a list of them")
    several = [one(f"{name}[{index}]", item) for index, item in enumerate(given)]
    if len(several) < least:
        raise ValueError(f"{name}: none; at least one expected")
    return several
