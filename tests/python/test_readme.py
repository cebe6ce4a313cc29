# SPDX-License-Identifier: MIT
"""The first page: its snippets run, its links lead somewhere, and it stays short."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "README.md").read_text(encoding="utf-8")
MOST_LINES = 120
MOST_BYTES = 1_000_000  # of a picture


def test_the_snippets_do_what_they_say(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)  # one of them writes a file
    names: dict[str, Any] = {}
    snippets = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    assert len(snippets) == 3
    for snippet in snippets:
        exec(snippet, names)
    assert names["answer"].headline == "NAMED"
    assert names["played"].answer == "every goal is reached"
    assert names["diabolo"].Model.load("model.json") == names["answer"].model


def test_links_and_pictures_are_there() -> None:
    links = re.findall(r"\]\(([^)]+)\)", PAGE) + re.findall(r'src="([^"]+)"', PAGE)
    own = [link.partition("#")[0] for link in links if "://" not in link]
    assert len(own) > 20
    assert [link for link in own if not (ROOT / link).exists()] == []
    pictures = [ROOT / link for link in own if link.startswith("docs/images/")]
    assert len(pictures) == 4 and max(picture.stat().st_size for picture in pictures) < MOST_BYTES
    pages = {f"docs/{page.name}" for page in (ROOT / "docs").glob("*.md") if page.name != "README.md"}
    assert pages <= set(own), "a page that nobody finds"


def test_it_fits_a_few_screens() -> None:
    assert len(PAGE.splitlines()) < MOST_LINES
