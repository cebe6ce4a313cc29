# SPDX-License-Identifier: MIT
"""Files of a proof: written whole or not at all, and lines added in one piece."""

from __future__ import annotations

import hashlib
import json
import lzma
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from diabolo.files import whole_file


def digest_of(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def digest_of_text(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def text_of(value: Any) -> str:
    """JSON that is the same for the same value."""
    return json.dumps(value, sort_keys=True, allow_nan=False, separators=(",", ":"))


def write_bytes(path: Path, content: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(path) as part:
        part.write_bytes(content)


def write_text(path: Path, text: str) -> None:
    write_bytes(path, text.encode())


def json_text(value: Any) -> str:
    return json.dumps(value, indent=1, allow_nan=False) + "\n"


def write_json(path: Path, value: Any) -> None:
    write_text(path, json_text(value))


def read_json(path: Path, what: str) -> Any:
    """`what` the file is, for the message where it is not there or not JSON."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise ValueError(f"{path}: there is no such file; expected {what}") from None
    except ValueError as error:
        raise ValueError(f"{path}: not JSON ({error}); expected {what}") from None


def append_line(path: Path, value: Any) -> None:
    """One more JSON line, in one piece."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
    try:
        os.write(handle, (text_of(value) + "\n").encode())
    finally:
        os.close(handle)


def read_lines(path: Path) -> list[Any]:
    """JSON lines; a last line that was cut off is taken out of the file."""
    if not path.exists():
        return []
    text = path.read_text(encoding="utf-8")
    whole = text[: text.rfind("\n") + 1]
    if whole != text:
        write_text(path, whole)
    return _values_of(path, whole)


def write_packed(path: Path, values: Iterable[Any]) -> None:
    """JSON lines, compressed by LZMA (.xz); members keep their order."""
    lines = (json.dumps(value, allow_nan=False, separators=(",", ":")) for value in values)
    text = "".join(line + "\n" for line in lines)
    write_bytes(path, lzma.compress(text.encode(), preset=9 | lzma.PRESET_EXTREME))


def read_packed(path: Path) -> list[Any]:
    try:
        return _values_of(path, lzma.decompress(path.read_bytes()).decode())
    except (lzma.LZMAError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: not compressed by LZMA ({error}); expected a packed record") from None


def _values_of(path: Path, text: str) -> list[Any]:
    values = []
    for number, line in enumerate(text.splitlines(), start=1):
        try:
            values.append(json.loads(line))
        except ValueError as error:
            raise ValueError(f"{path}, line {number}: not JSON ({error})") from None
    return values
