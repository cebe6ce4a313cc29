# SPDX-License-Identifier: MIT
"""Output files: checked before the work, and never left half-written."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

STDOUT = "-"


def check_outputs(outputs: Iterable[str | Path | None], inputs: Iterable[str | Path]) -> None:
    """Raise ValueError, before any work is done, where an output could not be written or is also an input."""
    taken = {}
    for given in inputs:
        path = Path(given)
        taken[path.resolve()] = "read"
        if path.suffix == ".csv":  # a tidy recording's other half
            taken[path.with_suffix(".json").resolve()] = "read"
    for output in outputs:
        if output is None or output == STDOUT:
            continue
        path = Path(output)
        if path.is_dir():
            raise ValueError(f"{path}: a directory; expected the name of a file to write")
        if path.exists() and not path.is_file():
            raise ValueError(f"{path}: a device or a pipe; expected a file ({STDOUT} is standard output)")
        if not path.absolute().parent.is_dir():
            raise ValueError(f"{path}: there is no folder {path.absolute().parent} to write into")
        if path.resolve() in taken:
            raise ValueError(f"{path}: this file is {taken[path.resolve()]} already; choose another name")
        taken[path.resolve()] = "written"


@contextmanager
def whole_file(path: str | Path) -> Iterator[Path]:
    """A temporary name of the same ending, which becomes `path` once all is written to it."""
    final = Path(path)
    temporary = final.with_name(f".{final.stem}.{os.getpid()}.tmp{final.suffix}")
    try:
        yield temporary
        os.replace(temporary, final)
    except OSError as error:
        raise ValueError(f"{final}: cannot be written ({error.strerror})") from error
    finally:
        temporary.unlink(missing_ok=True)


def write_text(path: str | Path, text: str) -> None:
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_json(path: str | Path | None, value: dict[str, Any]) -> None:
    """To a file, to standard output for "-", or nowhere for None."""
    if path is None:
        return
    text = json.dumps(value, indent=2, allow_nan=False) + "\n"
    if path == STDOUT:
        sys.stdout.write(text)
    else:
        write_text(path, text)
