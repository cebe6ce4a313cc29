# SPDX-License-Identifier: MIT
"""The same job for the library and for MuJoCo: `python -m benchmarks.speed.mujoco.compare`."""
