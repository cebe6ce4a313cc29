# SPDX-License-Identifier: MIT
"""Saves the pages' pictures with a palette and no wider than a page shows them: after drawing one anew.

pip install pillow zopfli
python tools/shrink_pictures.py docs/*.png docs/images/*.png
"""

from __future__ import annotations

import sys
from pathlib import Path

import zopfli.png
from PIL import Image

COLOURS = 32
WIDEST = 1092  # pixels


def main() -> int:
    for name in sys.argv[1:]:
        before = Path(name).stat().st_size
        with Image.open(name) as picture:
            full = picture.convert("RGB")
        full.thumbnail((WIDEST, full.height), Image.Resampling.LANCZOS)
        # Of rare colours too, such as a thin line's.
        small = full.quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
        small.save(name)
        Path(name).write_bytes(zopfli.png.optimize(Path(name).read_bytes()))  # the same pixels, a tenth less
        print(f"{name}: {before} -> {Path(name).stat().st_size} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
