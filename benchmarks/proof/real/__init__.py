# SPDX-License-Identifier: MIT
"""The diagnosis on real takes, with something known hidden from it or added to them."""
