# SPDX-License-Identifier: MIT
"""Simulation, planning and diagnosis of diabolo play."""

from ._core import __version__

__all__ = ["__version__"]
