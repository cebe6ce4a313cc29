# SPDX-License-Identifier: MIT
"""Where the C++ headers are."""

from pathlib import Path


def get_include() -> str:
    """The folder of the C++ headers that came with the package, for a compiler's -I.

    They need Eigen, and those of diabolo/json need nlohmann's library; `directories.txt` in the folder says
    where these were.
    """
    return str(Path(__file__).with_name("include"))
