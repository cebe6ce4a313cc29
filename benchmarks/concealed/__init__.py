# SPDX-License-Identifier: MIT
"""Proof of the diagnosis on concealed data: cases are drawn, sealed, diagnosed, and compared with their keys.

`diabolo prove` runs it. The recordings come from the project's own plant (data/plant), which shares no code
with the library. How to read the figures: docs/proof.md.
"""
