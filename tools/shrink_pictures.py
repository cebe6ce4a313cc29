# SPDX-License-Identifier: MIT
"""Saves the pages' pictures with a palette, at a third of their size: after drawing one anew.

python tools/shrink_pictures.py docs/*.png docs/images/*.png
"""

from __future__ import annotations

import sys
from pathlib import Path

from PIL import Image

COLOURS = 128


def main() -> int:
    for name in sys.argv[1:]:
        before = Path(name).stat().st_size
        with Image.open(name) as picture:
            small = picture.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
        small.save(name, optimize=True)
        print(f"{name}: {before} -> {Path(name).stat().st_size} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
