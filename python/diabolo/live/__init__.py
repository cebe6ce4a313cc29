# SPDX-License-Identifier: MIT
"""A play in real time under the pointer: what `diabolo simulate --live` serves."""
