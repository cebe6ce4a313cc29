# SPDX-License-Identifier: MIT
"""C3D files of motion capture: points, and rotations where there are some."""

from __future__ import annotations

import struct
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._core import RecordingError
from ..checks import shown
from ..rotations import quaternions
from .bodies import METRES, Body, check_rate, even_stamps, seen_points, unreadable

LONGEST_READ = 60.0  # [s]


def read(path: Path) -> list[Body]:
    """Each labelled point, and each labelled rotation (a 4 x 4 matrix) as a body with an orientation."""
    check_whole(path)
    found = _contents(path)
    rate, first, unit = float(found["rate"]), float(found["first"]), str(found["unit"])
    rotation_rate = float(found["rotation_rate"])
    scale = METRES.get(unit.strip().lower())
    if scale is None:
        raise RecordingError(f"{path}: POINT:UNITS {shown(unit)}; expected {', '.join(METRES)}")
    check_rate(path, rate)
    check_rate(path, rotation_rate)
    points, rotations = found["points"], found["rotations"]
    stamps = even_stamps(points.shape[2], rate, first)
    bodies = [
        Body(str(label), stamps, seen_points(points[:3, i].T * scale))
        for i, label in enumerate(found["labels"][: points.shape[1]])
    ]
    stamps = even_stamps(rotations.shape[3], rotation_rate, first * rotation_rate / rate)
    for i, label in enumerate(found["rotation_labels"][: rotations.shape[2]]):
        matrices = np.moveaxis(rotations[:, :, i], -1, 0)
        places, turns = seen_points(matrices[:, :3, 3] * scale), quaternions(matrices[:, :3, :3])
        bodies.append(Body(str(label), stamps, places, turns))
    return bodies


def check_whole(path: Path) -> None:
    """Raise RecordingError where a file is shorter than its header says (numbers of the Intel kind)."""
    with path.open("rb") as file:
        header = file.read(512)
        if len(header) < 512 or header[1] != 0x50:
            raise RecordingError(f"{path}: cannot be read as C3D (it does not begin as one)")
        file.seek(512 * max(0, header[0] - 1) + 3)
        if file.read(1) != b"T":  # 84: Intel
            return
    points, analog, first, last, _, scale, start = struct.unpack_from("<HHHHHfH", header, 2)
    frames, size = last - first + 1, 4 if scale < 0.0 else 2
    wanted = 512 * (start - 1) + frames * (4 * points + analog) * size
    if last < 65535 and path.stat().st_size < wanted:
        raise RecordingError(f"{path}: {path.stat().st_size} bytes; expected {wanted}, as its header says")


def _contents(path: Path) -> dict[str, NDArray[Any]]:
    """What the library finds. It runs in a process of its own, which a broken file may end or stall."""
    with tempfile.TemporaryDirectory() as folder:
        kept = Path(folder) / "found.npz"
        program = "import sys; from diabolo.formats.c3d import keep_contents; keep_contents(*sys.argv[1:])"
        try:
            done = subprocess.run(
                [sys.executable, "-c", program, str(path), str(kept)],
                capture_output=True,
                text=True,
                timeout=LONGEST_READ,
            )
        except subprocess.TimeoutExpired as error:
            raise unreadable(path, "C3D", TimeoutError(f"no end in {LONGEST_READ:g} s")) from error
        if done.returncode != 0 or not kept.exists():
            why = (done.stderr.strip().splitlines() or ["the library ended"])[-1]
            raise unreadable(path, "C3D", RuntimeError(why))
        with np.load(kept) as found:
            return dict(found)


def keep_contents(path: str, kept: str) -> None:
    """Write what a file holds as arrays: what _contents() runs."""
    import ezc3d

    file = ezc3d.c3d(path)
    group, header = file["parameters"]["POINT"], file["header"]["points"]
    rotations, labels, rate = _rotations(file, float(header["frame_rate"]))
    np.savez(
        kept,
        points=np.asarray(file["data"]["points"]),
        labels=np.array(group["LABELS"]["value"], str),
        unit=(group["UNITS"]["value"] or ["mm"])[0],
        rate=float(header["frame_rate"]),
        first=int(header["first_frame"]),
        rotations=rotations,
        rotation_labels=np.array(labels, str),
        rotation_rate=rate,
    )


def _rotations(file: Any, rate: float) -> tuple[NDArray[np.float64], list[str], float]:
    """Shape (4, 4, bodies, frames), their labels, and how many a second."""
    group, data = file["parameters"].get("ROTATION"), file["data"].get("rotations")
    if group is None or data is None or "LABELS" not in group or 0 in np.shape(data):
        return np.zeros((4, 4, 0, 0)), [], rate
    own = group["RATE"]["value"] if "RATE" in group else []
    return np.asarray(data), list(group["LABELS"]["value"]), float(own[0]) if len(own) else rate
