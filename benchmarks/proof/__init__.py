# SPDX-License-Identifier: MIT
"""Proofs of the library on plays whose truth is known or whose truth is real.

From the root of a checkout, with the package installed in its Python (`make plant .venv/.package`):

  python -m benchmarks.proof.diagnosis quick          concealed recordings: drawn, diagnosed, scored
  python -m benchmarks.proof.single_effects           one effect at a time, in plain sight
  python -m benchmarks.proof.player small             plans, played on the independent plant
  python -m benchmarks.proof.robust                   plans for one model and for five, over a spread
  python -m benchmarks.proof.wind_up                  a wind-up with one turn of the string, on the plant
  python -m benchmarks.proof.real.controls TAKE.csv   what is hidden from the simulator of a real take, found
  python -m benchmarks.proof.real.salted TAKE.csv     what is added to a real take, found

Each has a --help. benchmarks/README.md says what each shows and how long it takes.
"""
