# SPDX-License-Identifier: MIT
import re
from importlib import metadata
from pathlib import Path

import diabolo

HEADER = Path(__file__).parents[2] / "include" / "diabolo" / "version.hpp"


def test_version_is_the_one_of_the_header() -> None:
    match = re.search(r'kVersion = "([^"]+)"', HEADER.read_text())
    assert match is not None
    assert diabolo.__version__ == metadata.version("diabolo") == match.group(1)


def test_package_says_that_it_is_typed() -> None:
    assert (Path(diabolo.__file__).parent / "py.typed").is_file()
