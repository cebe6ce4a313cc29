# SPDX-License-Identifier: MIT
"""How fast the library is: docs/benchmarks.md holds the figures, benchmarks/README.md the commands."""
