# SPDX-License-Identifier: MIT
"""Some rows of a recording."""

from __future__ import annotations

from typing import NamedTuple

from ._core import Recording


class Excerpt(NamedTuple):
    """Some rows of a recording, first and last included; it stands wherever a recording does."""

    recording: Recording
    first: int
    last: int

    @property
    def is_whole(self) -> bool:
        """Whether it has all rows."""
        return (self.first, self.last) == (0, len(self.recording) - 1)

    def part(self) -> Recording:
        """A recording of these rows alone, called NAME:FIRST-LAST, or NAME where it is whole."""
        if self.is_whole:
            return self.recording
        name = f"{self.recording.name}:{self.first}-{self.last}"
        return self.recording.cut(self.first, self.last, name=name)
