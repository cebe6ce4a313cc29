# SPDX-License-Identifier: MIT
"""Our string inside other people's simulators (docs/hosts.md)."""
