# SPDX-License-Identifier: MIT
"""Messages of ROS 2 that are alike, read at once: their serialisation (CDR) has each number at its place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .messages import POINT, POSE, POSE_WITH_COVARIANCE

FLOATS = {POINT: (3, 3), POSE: (7, 7), POSE_WITH_COVARIANCE: (43, 7)}
"""How many follow the header, by the type of a message, and how many of them are place and orientation."""
LITTLE_ENDIAN = 0x100
"""The first four bytes, as one number."""


@dataclass(frozen=True, eq=False)
class Alike:
    """What n messages say: stamps [ns], numbers as in messages.Row, one message a row, and frames."""

    stamps: NDArray[np.int64]
    numbers: NDArray[np.float64]
    frames: set[str]


def read_alike(kind: str, messages: Sequence[bytes]) -> Alike | None:
    """What messages of a type say; None where they are not alike in layout, or it is not one of FLOATS."""
    if kind not in FLOATS:
        return None
    count, used = FLOATS[kind]
    name = int.from_bytes(messages[0][12:16], "little")  # of the frame, with a zero at its end
    begin = 4 + (12 + name + 7) // 8 * 8  # numbers lie at multiples of eight bytes after the first four
    if name == 0 or {len(one) for one in messages} != {begin + 8 * count}:
        return None
    layout: Any = {
        "names": ("order", "sec", "nanosec", "name", "frame", "numbers"),
        "formats": ("<u4", "<i4", "<u4", "<u4", f"S{name}", f"({count},)<f8"),
        "offsets": (0, 4, 8, 12, 16, begin),
    }
    table = np.frombuffer(b"".join(messages), np.dtype(layout))
    if (table["order"] != LITTLE_ENDIAN).any() or (table["name"] != name).any():
        return None
    stamps = table["sec"].astype(np.int64) * 10**9 + table["nanosec"]
    frames = {one.decode() for one in {*table["frame"].tolist()}}
    return Alike(stamps, table["numbers"][:, :used], frames)
