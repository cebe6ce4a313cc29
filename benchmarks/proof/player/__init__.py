# SPDX-License-Identifier: MIT
"""Plans of the player, played on the independent plant: `python -m benchmarks.proof.player --help`."""
