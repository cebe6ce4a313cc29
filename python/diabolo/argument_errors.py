# SPDX-License-Identifier: MIT
"""Sentences about arguments that a function of the compiled module does not take."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, NamedTuple

import numpy as np

from . import _core
from .checks import LARGEST_SEED, number, numbers, recording_of, shown, whole_number

NUMBERS = "an array of numbers"
RECORDING = "diabolo._core.Recording"
SEQUENCE = r"(collections\.abc\.Sequence|list)\["


class Parameter(NamedTuple):
    """One of a signature, its type as pybind11 writes it."""

    name: str
    type: str
    required: bool


def sentence(function: str, complaint: str, values: tuple[Any, ...], keywords: Mapping[str, Any]) -> str:
    """Function, argument, what was found and what is expected, from pybind11's list of signatures."""
    signatures = _signatures(complaint)
    if ": incompatible constructor" in complaint:
        values = values[1:]
    problems = [_problem(_parameters(signature), values, keywords) for signature in signatures]
    return f"{function}: " + "; or ".join(dict.fromkeys(problems))


def with_recordings(complaint: str, values: tuple[Any, ...], keywords: Mapping[str, Any]) -> list[Any] | None:
    """All arguments in order, recordings in the place of their files' names; None without such names."""
    for signature in _signatures(complaint):
        parameters = _parameters(signature)
        types = {parameter.name: parameter.type for parameter in parameters}
        names = ["self"] if ": incompatible constructor" in complaint else []
        names += [parameter.name for parameter in _before_star(parameters)]
        given = [*zip(names, values, strict=False), *keywords.items()]
        files = [types.get(name) == RECORDING and isinstance(value, str | PathLike) for name, value in given]
        if any(files) and len(given) == len(values) + len(keywords):
            return [
                recording_of(name, value) if file else value
                for (name, value), file in zip(given, files, strict=True)
            ]
    return None


def _signatures(complaint: str) -> list[str]:
    return re.findall(r"^    \d+\. (.*)$", complaint, re.MULTILINE)


def plain_array(function: str, given: Any, dropouts: bool) -> Any:
    """A masked array as a plain one, masked values as NaN if they are dropouts; else raises ValueError."""
    return np.ma.filled(given.astype(np.float64), np.nan) if dropouts else numbers(function, given)


def _problem(parameters: list[Parameter], values: Sequence[Any], keywords: Mapping[str, Any]) -> str:
    """What is wrong with a call by one signature."""
    anything = any(parameter.name.startswith("**") for parameter in parameters)
    named = [parameter for parameter in parameters if parameter.name[0] not in "*/"]
    positional = _before_star(parameters)
    names = ", ".join(parameter.name for parameter in named if parameter.name != "self") or "none"
    if len(values) > len(positional):
        extra = values[len(positional)]
        return f"one argument too many, {shown(extra)}; expected {names}"
    given = {parameter.name: value for parameter, value in zip(positional, values, strict=False)}
    for name, value in keywords.items():
        if name in given:
            return f"{name}: given twice, at last {shown(value)}; expected once"
        if not anything and all(parameter.name != name for parameter in named):
            return f"{name}: no argument of this name; expected {names}"
        given[name] = value
    for parameter in named:
        if parameter.name not in given:
            if parameter.required:
                return f"{parameter.name}: missing; expected {_expected(parameter.type)}"
        elif not _fits(given[parameter.name], parameter.type):
            label = "" if re.fullmatch(r"arg\d+", parameter.name) else f"{parameter.name}: "
            return f"{label}{shown(given[parameter.name])}; expected {_expected(parameter.type)}"
    return "; ".join(
        f"{parameter.name}: {shown(given[parameter.name])}; expected {_expected(parameter.type)}"
        for parameter in named
        if parameter.name in given and parameter.name != "self"
    )


def _before_star(parameters: list[Parameter]) -> list[Parameter]:
    """Those that may be given by position."""
    result = []
    for parameter in parameters:
        if parameter.name.startswith("*"):
            break
        if parameter.name != "/":
            result.append(parameter)
    return result


def _parameters(signature: str) -> list[Parameter]:
    """Of `(self: A, b: B = 1) -> C` or `A(b: B = 1)`."""
    inside = signature[signature.index("(") + 1 :]
    parameters = []
    for part in _split(inside, ",", closing=True):
        name, _, rest = part.strip().partition(":")
        kind, *default = _split(rest, "=")
        if name:
            parameters.append(Parameter(name.strip(), kind.strip(), not default))
    return parameters


def _split(text: str, separator: str, *, closing: bool = False) -> list[str]:
    """At a separator outside brackets and quotes; `closing`: as far as the bracket that closes."""
    parts, depth, quote = [""], 0, ""
    for c in text:
        if quote:
            quote = "" if c == quote else quote
        elif c in "'\"":
            quote = c
        elif c in "([{<":
            depth += 1
        elif c in ")]}" or (c == ">" and not parts[-1].endswith("-")):
            depth -= 1
        if depth < 0 and closing:
            break
        if c == separator and depth == 0 and not quote:
            parts.append("")
        else:
            parts[-1] += c
    return parts


def _fits(value: Any, kind: str) -> bool:
    """Whether a value is of a type as pybind11 writes it; of types that are not known here, yes."""
    return any(_fits_one(value, one.strip()) for one in _split(kind, "|"))


def _fits_one(value: Any, kind: str) -> bool:
    inner = _inside(kind)
    if size := _fixed_size(kind):
        return _is_sequence(value) and len(value) == size and _fits(value, inner[0])
    if kind == "None":
        return value is None
    if kind in ("str", "bool"):
        return isinstance(value, (str,) if kind == "str" else (bool, np.bool_))
    if kind in ("float", "typing.SupportsFloat"):
        return _is_taken(lambda: number("", value))
    if kind in ("int", "typing.SupportsInt", "typing.SupportsIndex"):
        return _is_taken(lambda: whole_number("", value, -LARGEST_SEED, LARGEST_SEED))
    if re.match(SEQUENCE, kind):
        return _is_sequence(value) and all(_fits(item, inner[0]) for item in value)
    if "ArrayLike" in kind or "NDArray" in kind or "numpy.ndarray" in kind:
        return _is_array(value, _extents(kind))
    if kind.startswith("diabolo._core."):
        return isinstance(value, getattr(_core, kind.rpartition(".")[2], object))
    if "PathLike" in kind:
        return isinstance(value, str) or hasattr(value, "__fspath__")
    if "Mapping[" in kind:
        return isinstance(value, Mapping) and all(
            _fits(key, inner[0]) and _fits(item, inner[1]) for key, item in value.items()
        )
    if re.match(r"tuple\[", kind):
        return _is_sequence(value) and len(value) == len(inner) and all(map(_fits, value, inner))
    return True


def _is_taken(check: Callable[[], object]) -> bool:
    try:
        check()
    except ValueError:
        return False
    return True


def _is_sequence(value: Any) -> bool:
    return hasattr(value, "__len__") and hasattr(value, "__getitem__") and not isinstance(value, str | dict)


def _is_array(value: Any, extents: list[int]) -> bool:
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        return False
    return not extents or array.size == np.prod(extents)


def _extents(kind: str) -> list[int]:
    """Of a fixed shape, such as "[3, 1]"."""
    found = re.search(r'"\[(\d+(?:, \d+)*)\]"', kind)
    return [int(extent) for extent in found[1].split(", ")] if found else []


def _fixed_size(kind: str) -> int:
    """Of a sequence with so many items, such as "FixedSize(4)"; 0 of others."""
    found = re.search(r', "FixedSize\((\d+)\)"\]$', kind)
    return int(found[1]) if found else 0


def _inside(kind: str) -> list[str]:
    """What stands in the brackets that a type ends with."""
    if not kind.endswith("]"):
        return []
    return [part.strip() for part in _split(kind[kind.index("[") + 1 : -1], ",")]


def _expected(kind: str) -> str:
    """A type in words."""
    texts = dict.fromkeys(_expected_one(one.strip()) for one in _split(kind, "|"))
    if "a number" in texts:
        texts.pop("a whole number", None)
    return " or ".join(texts)


def _expected_one(kind: str) -> str:
    words = {
        "float": "a number",
        "typing.SupportsFloat": "a number",
        "int": "a whole number",
        "typing.SupportsInt": "a whole number",
        "typing.SupportsIndex": "a whole number",
        "str": "a str",
        "bool": "True or False",
        "None": "None",
    }
    if kind in words:
        return words[kind]
    if size := _fixed_size(kind):
        return f"{_expected(_inside(kind)[0])}, {size} of them"
    if re.match(SEQUENCE, kind):
        return f"a list, each {_expected(_inside(kind)[0])}"
    if "ArrayLike" in kind or "NDArray" in kind or "numpy.ndarray" in kind:
        extents = [extent for extent in _extents(kind) if extent != 1]
        return NUMBERS + (f" of the shape ({', '.join(map(str, extents))},)" if extents else "")
    if "PathLike" in kind:
        return "the name of a file"
    if "Mapping[" in kind:
        return "a dict, each {} to {}".format(*map(_expected, _inside(kind)))
    if re.match(r"tuple\[", kind):
        return "a tuple of " + ", ".join(_expected(one) for one in _inside(kind))
    return kind.rpartition(".")[2]
