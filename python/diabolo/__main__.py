# SPDX-License-Identifier: MIT
"""`python -m diabolo`, the same as the command `diabolo`."""

import sys

from .cli import main

sys.exit(main())
