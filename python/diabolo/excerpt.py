# SPDX-License-Identifier: MIT
"""Some rows of a recording."""

from __future__ import annotations

from typing import NamedTuple

from ._core import Recording


class Excerpt(NamedTuple):
    """Some rows of a recording, first and last included; it stands wherever the name of a file does."""

    recording: Recording
    first: int
    last: int

    @property
    def is_whole(self) -> bool:
        """Whether it has all rows."""
        return (self.first, self.last) == (0, len(self.recording) - 1)

    @property
    def name(self) -> str:
        """NAME:FIRST-LAST, or NAME where it is whole."""
        return self.recording.name + ("" if self.is_whole else f":{self.first}-{self.last}")

    def part(self) -> Recording:
        """A recording of these rows alone, under the excerpt's name. Raises ValueError where the recording
        has no such rows."""
        from .checks import excerpt_of  # which knows excerpts

        checked = excerpt_of("Excerpt", self)
        return checked.recording.cut(checked.first, checked.last, name=checked.name)
