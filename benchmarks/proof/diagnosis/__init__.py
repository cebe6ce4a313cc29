# SPDX-License-Identifier: MIT
"""The diagnosis on concealed data: cases are drawn, sealed, diagnosed, and compared with their keys.

`python -m benchmarks.proof.diagnosis --help` says how. The recordings come from the project's own plant
(data/plant), which shares no code with the library. How to read the figures: docs/proof.md.
"""
