# SPDX-License-Identifier: MIT
"""The end of a file of MCAP: its checksums, and what is done where the end is missing."""

from __future__ import annotations

import mmap
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any
from zlib import crc32

from .._core import RecordingError
from ..checks import check_library
from .bodies import unreadable

MAGIC = b"\x89MCAP0\r\n"
"""What a file begins and ends with."""
FOOTER = b"\2\x14" + bytes(7)
"""What the footer begins with: its kind, and how many bytes follow."""
END = len(FOOTER) + 0x14 + len(MAGIC)
"""How many bytes a file ends with that does not lack its end."""
CUT = "the file is cut off, as by a killed recorder, or goes on behind its end: whole records are read"
TOO_SHORT = "the file is cut off within its first chunk of messages; expected one at least"


@contextmanager
def whole(path: Path) -> Iterator[tuple[Path, list[str]]]:
    """A bag as libraries take it, and a note of what is cut off: itself, or a temporary one, where a file of
    MCAP lacks its end, or a suffix is in capitals.

    Raises RecordingError where a file of MCAP is not what its checksums say. Those of chunks are left to who
    reads them."""
    files = sorted(file for file in path.iterdir() if file.is_file()) if path.is_dir() else [path]
    cut = [file for file in files if file.suffix.lower() == ".mcap" and _is_cut(file)]
    if not cut and (path.is_dir() or path.suffix.islower()):
        yield path, []
        return
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file in files:
            kept = folder / (file.name if path.is_dir() else file.stem + file.suffix.lower())
            if file in cut:
                if _copy_whole_records(file, kept) == 0 and file == path:
                    raise RecordingError(f"{path}: {TOO_SHORT}")
            else:
                kept.symlink_to(file.resolve())
        try:
            yield folder if path.is_dir() else kept, [CUT] if cut else []
        except RecordingError as error:
            raise RecordingError(f"{error}; the file is cut off" if cut else str(error)) from error


def _is_cut(path: Path) -> bool:
    """Whether a file of MCAP does not end as one. If it does, it is what its checksums say."""
    check_library(f"reading {path.name}", "mcap", "formats")
    with path.open("rb") as file:
        begin = file.read(len(MAGIC))
        if begin != MAGIC:
            found = f"it begins with {begin!r}" if begin else "it is empty"
            raise unreadable(path, "a bag of ROS", ValueError(f"{found}; expected the mark of MCAP"))
        file.seek(max(len(MAGIC), path.stat().st_size - END))
        end = file.read()
    if len(end) < END or not (end.startswith(FOOTER) and end.endswith(MAGIC)):
        return True
    _check_sums(path)
    return False


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


def _copy_whole_records(path: Path, kept: Path) -> int:
    """The records up to the one that is cut, with an index: without one, libraries want messages in order.
    Returns how many messages are among them: those of a chunk are cut off with it."""
    from mcap.records import Channel, Header, Message, Metadata, Schema
    from mcap.writer import CompressionType, Writer

    schemas, channels, messages = {0: 0}, dict[int, int](), 0
    try:
        with path.open("rb") as file, kept.open("wb") as copy:
            writer = Writer(copy, compression=CompressionType.NONE)
            records = _whole_records(file)
            header = next(records, Header("ros2", ""))
            writer.start(header.profile, header.library)
            for one in records:
                if isinstance(one, Message):
                    channel = channels[one.channel_id]
                    writer.add_message(channel, one.log_time, one.data, one.publish_time, one.sequence)
                    messages += 1
                elif isinstance(one, Schema) and one.id not in schemas:
                    schemas[one.id] = writer.register_schema(one.name, one.encoding, one.data)
                elif isinstance(one, Channel) and one.id not in channels:
                    told = one.topic, one.message_encoding, schemas[one.schema_id], one.metadata
                    channels[one.id] = writer.register_channel(*told)
                elif isinstance(one, Metadata):
                    writer.add_metadata(one.name, one.metadata)
            writer.finish()
    except Exception as error:  # of files or records: whatever a broken file leads to
        raise unreadable(path, "a bag of ROS", error) from error
    return messages


def _whole_records(file: IO[bytes]) -> Iterator[Any]:
    """Those of the data, up to the one in which the file ends."""
    from mcap.records import DataEnd
    from mcap.stream_reader import CRCValidationError, StreamReader

    try:
        for record in StreamReader(file, validate_crcs=True).records:
            if isinstance(record, DataEnd):
                return
            yield record
    except CRCValidationError:
        raise
    except Exception:  # whatever a record that is cut leads to
        if file.read(1):
            raise


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
