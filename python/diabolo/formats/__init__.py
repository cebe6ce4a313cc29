# SPDX-License-Identifier: MIT
"""Recordings of other programs: bags of ROS (rosbag2, MCAP, rosbag1), C3D, Parquet, and exports of Vicon and
Qualisys, read and in part written by libraries that are installed by `pip install '.[formats]'`.

What a file names as bodies or points goes through the same calibration, checks and repairs as an export of
Motive; a table of columns through those of a CSV.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from itertools import chain
from pathlib import Path

from .. import _core
from .._core import Calibration, Recording, RecordingError, StickArm
from ..arms import two_arms
from ..checks import AnyRecording, check_library, file_name, instance_of, recording_of, shown
from . import bodies, qualisys, vicon
from .bodies import ROLES, Body

OF_A_CLOCK = "the times are stamps of a clock: they are counted from the first one on"
WRITERS = {".csv": (), ".mcap": ("mcap", "rosbags"), ".parquet": ("pyarrow",), ".rrd": ("rerun",)}
"""The libraries that a recording is written with, by the suffix of its file."""
WRITTEN = tuple(WRITERS)
"""Suffixes of what save_recording() writes."""
WITH_JSON = (".csv", ".parquet")
"""Those of them that have a JSON file beside."""


def load_recording(
    path: str | os.PathLike[str],
    calibration: Calibration | None = None,
    *,
    up: str | None = None,
    columns: str | Mapping[str, str] | None = None,
    topics: str | Mapping[str, str] | None = None,
    arms: Sequence[StickArm] | None = None,
) -> Recording:
    """Read a recording of any kind, told apart by its suffix and its first line.

    CSV files, tidy or Motive's, are read as by Recording.load, with `calibration`, `up` and `columns`. A
    `.parquet` is the same table. Bags (a folder of rosbag2, `.mcap`, `.db3`, `.bag`), `.c3d`, Vicon's CSV of
    objects and Qualisys' TSV of bodies hold bodies or points with names: by default these are the tips and
    the diabolo themselves, in a world frame with z up, told apart by names.
    topics: {"left": NAME, "right": NAME, "diabolo": NAME}, or "left=NAME,...", says which they are.
    arms: the left and the right one, of whose joints a bag may tell instead of the tips (default: the
    paper's). Their sticks are TOPIC:left and TOPIC:right.
    Raises RecordingError with the file, what was found and what was expected, and ValueError where a library
    is not installed. Does not warn: Recording.warnings() lists what is odd, and what computes from it warns.
    """
    path, names, used = file_name("path", path), topics_of(topics), two_arms(arms)
    if calibration is not None:
        instance_of("calibration", calibration, Calibration)
    if not isinstance(up, str | None):
        raise ValueError(f"up: {shown(up)}; expected the name of an axis")
    if not isinstance(columns, str | Mapping | None) or (
        isinstance(columns, Mapping) and not all(isinstance(one, str) for one in chain(*columns.items()))
    ):
        raise ValueError(f"columns: {shown(columns)}; expected time=NAME[UNIT],... or a dict of such names")
    reader = reader_of(path)
    if reader in (None, *NAMED_IN_TEXT):
        _check_text(path)
    if names and reader in (None, "parquet"):
        raise RecordingError(f"{path}: topics are given; expected them of bags, C3D, Vicon or Qualisys only")
    if arms is not None and reader != "bag":
        raise RecordingError(f"{path}: arms are given; expected them of bags only")
    if reader is None:
        return _core.load_recording(path, calibration, up=up, columns=columns)
    if reader == "parquet":
        from . import parquet

        return _core.read_recording(parquet.csv_of(path, columns), path, calibration, up, columns)
    if columns is not None:
        raise RecordingError(f"{path}: columns are mapped, but it is no table; expected --topics")
    return _recording_of_bodies(path, reader, calibration, up, names, used)


def _recording_of_bodies(
    path: Path,
    reader: str,
    calibration: Calibration | None,
    up: str | None,
    names: dict[str, str],
    arms: Sequence[StickArm],
) -> Recording:
    """The recording of a file that holds bodies with names."""
    found, setup, notes = _bodies_of(reader, path, names, arms)
    bodies.check_names(path, found, names)
    names = names or _names_in(calibration, [body.name for body in found])
    time, tracks, of_a_clock = bodies.at_common_times(path, found, names)
    notes += [OF_A_CLOCK] if of_a_clock else []
    used = (calibration or Calibration.plain()).renamed(**names)
    used = used.completed_by(setup) if setup else used
    shown_path = os.fsencode(path).decode(errors="replace")
    return _core.recording_of_bodies(shown_path, time, tracks, notes, used, up)


def _names_in(calibration: Calibration | None, known: list[str]) -> dict[str, str]:
    """The bodies that a calibration names, by their role, where a file has all of them."""
    if calibration is None:
        return {}
    told = json.loads(calibration.to_json())
    found: dict[str, str] = {}
    for role in ROLES:
        body = told[role]["body"]
        named = [one for one in ([body] if isinstance(body, str) else body) if one in known]
        found |= {role: named[0]} if named else {}
    return found if len(found) == len(ROLES) else {}


def save_recording(recording: AnyRecording, path: str | os.PathLike[str]) -> None:
    """Write it as its suffix says: `.csv` (tidy, with JSON beside it), `.mcap` (poses of ROS 2), `.parquet`
    (the tidy table, with JSON beside it), or `.rrd` (to look at in rerun; it is not read again).

    Raises:
        RecordingError: another suffix.
        ValueError: a library is not installed.
    """
    path = file_name("path", path)
    recording = recording_of("recording", recording)
    check_writer(path)
    if path.suffix == ".csv":
        recording.save(path)
    elif path.suffix == ".mcap":
        from . import bag

        bag.save(recording, path)
    elif path.suffix == ".parquet":
        from . import parquet

        parquet.save(recording, path)
    else:
        from . import rrd

        rrd.save(recording, path)


def check_writer(path: str | os.PathLike[str]) -> None:
    """Raise where save_recording() could not write a file of this name.

    Raises:
        RecordingError: its suffix is none of WRITTEN.
        ValueError: a library is not installed.
    """
    path = file_name("path", path)
    if path.suffix not in WRITERS:
        raise RecordingError(f"{path}: expected a name that ends in {', '.join(WRITTEN)}")
    if path.suffix in WITH_JSON:
        _check_text(path)
    for library in WRITERS[path.suffix]:
        check_library(f"writing {path.name}", library, "rerun" if library == "rerun" else "formats")


def _check_text(path: Path) -> None:
    """Raise RecordingError about a name in bytes that are no text."""
    try:
        str(path).encode()
    except UnicodeEncodeError:
        raise RecordingError(f"{str(path)!r}: not UTF-8; expected a name that is") from None


def topics_of(given: str | Mapping[str, str] | None) -> dict[str, str]:
    """Names of bodies by their role, of a mapping or of `left=NAME,right=NAME,diabolo=NAME`."""
    if given is None:
        return {}
    if isinstance(given, str):
        pairs = [item.partition("=") for item in given.split(",")]
        if any(not name for _, _, name in pairs):
            raise RecordingError(f"topics {shown(given)}; expected left=NAME,right=NAME,diabolo=NAME")
        if len({role.strip() for role, _, _ in pairs}) < len(pairs):
            raise RecordingError(f"topics {shown(given)}: a role is named twice; expected each once")
        given = {role.strip(): name.strip() for role, _, name in pairs}
    if not isinstance(given, Mapping):
        raise RecordingError(
            f"topics: {shown(given)}; expected a mapping, or left=NAME,right=NAME,diabolo=NAME"
        )
    if unknown := sorted({*given} - {*ROLES}):
        raise RecordingError(f"topics: found {shown(unknown[0])}; expected {', '.join(ROLES)}")
    for role, name in given.items():
        if not isinstance(name, str):
            raise RecordingError(f"topics: {role}: {shown(name)}; expected a name")
    return dict(given)


NAMED_IN_TEXT = ("c3d", "parquet")
"""Readers whose libraries take no file with a name in other bytes; nor does the core."""
LIBRARIES = {"bag": "rosbags", "c3d": "ezc3d", "parquet": "pyarrow"}
READERS = {".mcap": "bag", ".db3": "bag", ".bag": "bag", ".c3d": "c3d", ".parquet": "parquet"}


def reader_of(path: Path) -> str | None:
    """Which part of this package reads a file: "bag", "c3d", "parquet", "qualisys" or "vicon"; None: the core
    does, or there is none. Raises RecordingError about a folder that is no bag, ValueError where the library
    for it is not installed."""
    if os.path.isdir(path):
        if not (path / "metadata.yaml").exists():
            raise RecordingError(f"{path}: a directory; expected a file, or a bag with its metadata.yaml")
        reader: str | None = "bag"
    else:
        reader = READERS.get(path.suffix.lower())
    if reader is not None and os.path.exists(path):
        if not os.path.isfile(path) and not os.path.isdir(path):
            raise RecordingError(f"{path}: a device or a pipe; expected a file")
        check_library(f"reading {path.name}", LIBRARIES[reader], "formats")
        return reader
    if path.suffix.lower() in (".csv", ".tsv") and os.path.isfile(path):
        with path.open("rb") as file:
            first = file.readline(200).decode("utf-8-sig", "replace")
        if first.startswith("NO_OF_FRAMES"):
            return "qualisys"
        if vicon.title_of(first) in vicon.TITLES:
            return "vicon"
    return None


def _bodies_of(
    reader: str, path: Path, names: Mapping[str, str], arms: Sequence[StickArm]
) -> tuple[list[Body], Calibration | None, list[str]]:
    """The bodies of a file, what it says of string and diabolo, and what was changed."""
    if reader == "bag":
        from . import bag

        wanted = names.values() if len(names) == len(ROLES) else ()
        return bag.read(path, wanted, arms)
    if reader == "c3d":
        from . import c3d

        return c3d.read(path), None, []
    found, notes = qualisys.read(path) if reader == "qualisys" else vicon.read(path)
    return found, None, notes
