# SPDX-License-Identifier: MIT
"""Lists the proofs."""

from . import __doc__ as proofs

print(proofs, end="")
