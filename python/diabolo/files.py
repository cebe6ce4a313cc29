# SPDX-License-Identifier: MIT
"""Output files: checked before the work, and never left half-written."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

STDOUT = "-"
ALONE = ("", ".json", ".mcap", ".db3", ".bag", ".c3d", ".tsv")
"""Suffixes of files that are read without a JSON file beside them."""


def check_outputs(
    outputs: Iterable[str | Path | None], inputs: Iterable[str | Path], folder: Path | None = None
) -> None:
    """Raise ValueError, before any work is done, where an output could not be written or is also an input.

    folder: need not be there yet. Nothing is left behind.
    """
    if folder is not None and folder.exists() and not folder.is_dir():
        raise ValueError(f"{folder}: a file; expected a folder")
    taken = {}
    for given in inputs:
        if not str(given):
            raise ValueError("an empty name of a file to read; expected a file")
        path = Path(given)
        taken[_place(path)] = "this file is read"
        if path.suffix.lower() not in ALONE and not path.is_dir():  # a tidy recording's other half
            taken[_place(path.with_suffix(".json"))] = "this file is read"
    for output in outputs:
        if output is None or output == STDOUT:
            continue
        path, place = Path(output), _place(Path(output))
        if path.is_dir():
            raise ValueError(f"{path}: a directory; expected the name of a file to write")
        if path.exists() and not path.is_file():
            raise ValueError(f"{path}: a device or a pipe; expected a file ({STDOUT} is standard output)")
        if path.parent != folder and not place.parent.is_dir():
            raise ValueError(f"{path}: there is no folder {place.parent} to write into")
        if inside := next((read for read in taken if read.is_dir() and place.is_relative_to(read)), None):
            raise ValueError(f"{path}: the folder {inside.name} is read; choose another place")
        if place in taken:
            raise ValueError(f"{path}: {taken[place]}; choose another name")
        taken[place] = "another output has this name"
        with made_folder(place.parent), _said_of(path), _removed(_temporary(place)) as trial:
            trial.touch()


@contextmanager
def made_folder(folder: Path) -> Iterator[None]:
    """A folder, made with its parents; those that were made and end up empty go again."""
    made = [path for path in (folder, *folder.parents) if not path.exists()]
    try:
        with _said_of(folder):
            folder.mkdir(parents=True, exist_ok=True)
        yield
    finally:
        for path in made:
            with suppress(OSError):  # it is not empty, or was never made
                path.rmdir()


@contextmanager
def whole_file(path: str | Path) -> Iterator[Path]:
    """A temporary name of the same ending, which becomes `path`, or what it is a link to, once all is written
    to it."""
    final = _place(Path(path))
    with _said_of(final), _removed(_temporary(final)) as temporary:
        yield temporary
        os.replace(temporary, final)


def write_texts(texts: Mapping[Path, str]) -> None:
    """Several files, which appear together once all are written."""
    with ExitStack() as replacing:
        for path, text in texts.items():
            replacing.enter_context(whole_file(path)).write_text(text, encoding="utf-8")


def write_json(path: str | Path | None, value: dict[str, Any]) -> None:
    """To a file, to standard output for "-", or nowhere for None."""
    if path == STDOUT:
        sys.stdout.write(json_text(value))
    elif path is not None:
        write_texts({Path(path): json_text(value)})


def json_text(value: dict[str, Any]) -> str:
    return json.dumps(value, indent=2, allow_nan=False) + "\n"


def _place(path: Path) -> Path:
    """Where a file is, or what it is a link to."""
    place = Path(os.path.realpath(path))
    with _said_of(path):
        is_link = place.is_symlink()
    if is_link:
        raise ValueError(f"{path}: a symbolic link that leads to itself; expected a file")
    return place


def _temporary(path: Path) -> Path:
    return path.with_name(f".{path.stem}.{os.getpid()}.tmp{path.suffix}")


@contextmanager
def _removed(temporary: Path) -> Iterator[Path]:
    """A name that is free again in the end, whatever ends it: an error, Ctrl-C or SIGTERM."""
    try:
        yield temporary
    finally:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)


@contextmanager
def _said_of(path: Path) -> Iterator[None]:
    """Errors of the system become a sentence about `path`."""
    try:
        yield
    except OSError as error:
        raise ValueError(f"{path}: cannot be written ({error.strerror})") from error
