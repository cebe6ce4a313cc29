# SPDX-License-Identifier: MIT
"""Tables of Parquet, with the columns of a tidy CSV or with those of somebody's own."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

from .._core import Recording, RecordingError
from ..checks import shown
from ..files import whole_file
from .bodies import unreadable


def csv_of(path: Path) -> str:
    """The text of a CSV with the same numbers; what is null or NaN is empty."""
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
            if pyarrow.types.is_floating(column.type):
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

    kind = field.type
    numeric = (
        pyarrow.types.is_floating(kind) or pyarrow.types.is_integer(kind) or pyarrow.types.is_decimal(kind)
    )
    return numeric and not set(',"\r\n') & set(field.name)


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
