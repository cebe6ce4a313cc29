# SPDX-License-Identifier: MIT
"""The end of a file of MCAP: its checksums, and what is done where the end is missing."""

from __future__ import annotations

import mmap
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any
from zlib import crc32

from .._core import RecordingError
from ..checks import check_library
from .bodies import unreadable

MAGIC = b"\x89MCAP0\r\n"
"""What a file begins and ends with."""
CUT = "the file is cut off, as by a recorder that was killed: it is read up to there"


@contextmanager
def whole(path: Path) -> Iterator[tuple[Path, list[str]]]:
    """A bag, or a temporary one without what is cut off at the end of a file of MCAP, and a note of that.

    Raises RecordingError where a file of MCAP is not what its checksums say. Those of chunks are left to who
    reads them."""
    files = sorted(path.glob("*.mcap")) if path.is_dir() else [path] if path.suffix == ".mcap" else []
    for file in files:
        check_library(f"reading {file.name}", "mcap", "formats")
        if not _is_cut(file):
            _check_sums(file)
    if files == [path] and _is_cut(path):
        with tempfile.TemporaryDirectory() as folder:
            kept = Path(folder) / path.name
            _copy_whole_records(path, kept)
            try:
                yield kept, [CUT]
            except RecordingError as error:
                raise RecordingError(f"{error}; the file is cut off") from error
    else:
        yield path, []


def _is_cut(path: Path) -> bool:
    with path.open("rb") as file:
        begin = file.read(len(MAGIC))
        file.seek(max(0, path.stat().st_size - len(MAGIC)))
        return begin == MAGIC and file.read() != MAGIC


def _check_sums(path: Path) -> None:
    """Of the data, of the summary behind them, and of the footer."""
    from mcap.records import DataEnd, Footer

    try:
        with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
            foot = len(content) - len(MAGIC) - _size_of(Footer(0, 0, 0))
            footer = _record_at(file, foot, Footer)
            summary = footer.summary_start or foot
            end = summary - _size_of(DataEnd(0))
            sums = (
                (_record_at(file, end, DataEnd).data_section_crc, 0, end),
                (footer.summary_crc, summary, len(content) - len(MAGIC) - 4),
            )
            for told, first, last in sums:
                if told and crc32(memoryview(content)[first:last]) != told:
                    raise ValueError(f"bytes {first} to {last} are not what their checksum says")
    except Exception as error:  # of files or records: whatever a broken file leads to
        raise unreadable(path, "a bag of ROS", error) from error


def _copy_whole_records(path: Path, kept: Path) -> None:
    """The records up to the one that is cut, and an end without a summary."""
    from mcap.data_stream import RecordBuilder
    from mcap.records import DataEnd, Footer
    from mcap.stream_reader import StreamReader

    with path.open("rb") as file:
        end = 0
        with suppress(Exception):  # whatever a record that is cut leads to
            for _ in StreamReader(file, emit_chunks=True).records:
                end = file.tell()
        file.seek(0)
        closing = RecordBuilder()
        DataEnd(0).write(closing)
        Footer(0, 0, 0).write(closing)
        kept.write_bytes(file.read(end) + closing.end() + MAGIC)


def _record_at(file: IO[bytes], at: int, kind: type[Any]) -> Any:
    """The record of this kind; raises ValueError where another one stands there."""
    from mcap.stream_reader import StreamReader

    file.seek(at)
    found = next(StreamReader(file, skip_magic=True).records)
    if not isinstance(found, kind):
        raise ValueError(f"no {kind.__name__} at byte {at}")
    return found


def _size_of(record: Any) -> int:
    from mcap.data_stream import RecordBuilder

    built = RecordBuilder()
    record.write(built)
    return int(built.count)
