# SPDX-License-Identifier: MIT
"""Tables of Parquet, with the columns of a tidy CSV or with those of somebody's own."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .._core import Recording, RecordingError
from ..checks import shown
from ..files import whole_file
from .bodies import unreadable

TICKS = {"s": 1e0, "ms": 1e3, "us": 1e6, "ns": 1e9}
"""Of a stamp, a second."""


def csv_of(path: Path, columns: str | Mapping[str, str] | None = None) -> str:
    """The text of a CSV with the same numbers; what is null or NaN is empty. Stamps of date and time are
    seconds from the first row on.

    columns: as of load_recording(), which give a column of such stamps no other unit."""
    import pyarrow
    import pyarrow.compute
    import pyarrow.csv
    import pyarrow.parquet

    try:
        names = pyarrow.parquet.read_schema(path).names
        if twice := sorted({name for name in names if names.count(name) > 1}):
            raise RecordingError(
                f"{path}: two columns are named {shown(twice[0])}; expected names of their own"
            )
        table = pyarrow.parquet.read_table(path)
        table = table.select([one.name for one in table.schema if _is_number(one)])
        if not table.column_names:
            raise RecordingError(
                f"{path}: no column of numbers; it has {', '.join(map(shown, names[:12])) or 'none'}"
            )
        for at, column in enumerate(table.columns):
            if pyarrow.types.is_temporal(column.type):
                _check_unit(path, table.column_names[at], columns)
                table = table.set_column(at, table.column_names[at], _seconds(column))
            elif pyarrow.types.is_floating(column.type):
                empty = pyarrow.scalar(None, column.type)
                seen = pyarrow.compute.if_else(pyarrow.compute.is_nan(column), empty, column)
                table = table.set_column(at, table.column_names[at], seen)
        rows = pyarrow.BufferOutputStream()
        plain = pyarrow.csv.WriteOptions(include_header=False, quoting_style="none")
        pyarrow.csv.write_csv(table, rows, plain)
    except (pyarrow.ArrowException, OSError, UnicodeDecodeError) as error:
        raise unreadable(path, "Parquet", error) from error
    text: bytes = rows.getvalue().to_pybytes()
    return ",".join(table.column_names) + "\n" + text.decode()


def _is_number(field: Any) -> bool:
    """Whether it can be a column of a CSV: numbers, under a name without marks of CSV."""
    import pyarrow

    is_one = ("is_floating", "is_integer", "is_decimal", "is_timestamp", "is_duration")
    fits = any(getattr(pyarrow.types, one)(field.type) for one in is_one)
    return fits and not set(',"\r\n') & set(field.name)


def _seconds(column: Any) -> Any:
    """Stamps as seconds from the first one on."""
    import pyarrow
    import pyarrow.compute

    ticks = column.cast(pyarrow.int64())
    since = pyarrow.compute.subtract(ticks, pyarrow.compute.min(ticks)).cast(pyarrow.float64())
    return pyarrow.compute.divide(since, TICKS[column.type.unit])


def _check_unit(path: Path, name: str, columns: str | Mapping[str, str] | None) -> None:
    """Raise RecordingError where columns give it a unit other than s."""
    given = columns.split(",") if isinstance(columns, str) else [*(columns or {}).values()]
    for item in given:
        told, _, unit = str(item).rpartition("=")[2].strip().partition(f"{name}[")
        if not told and unit not in ("", "s]"):
            raise RecordingError(
                f"{path}: column {shown(name)} has stamps of date and time; expected no unit"
            )


def save(recording: Recording, path: Path) -> None:
    """Write the columns of a tidy recording, and the JSON file that goes with them."""
    import pyarrow
    import pyarrow.csv
    import pyarrow.parquet

    with tempfile.TemporaryDirectory() as folder:
        tidy = Path(folder) / "tidy.csv"
        recording.save(tidy)
        table = pyarrow.csv.read_csv(tidy)
        setup = tidy.with_suffix(".json").read_text(encoding="utf-8")
    numbers = {name: table.column(name).cast(pyarrow.float64()) for name in table.column_names}
    with whole_file(path.with_suffix(".json")) as beside, whole_file(path) as temporary:
        beside.write_text(setup, encoding="utf-8")
        pyarrow.parquet.write_table(pyarrow.table(numbers), temporary)
