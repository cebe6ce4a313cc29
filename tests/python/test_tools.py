# SPDX-License-Identifier: MIT
"""The counting of sentences: what counts as one, and which pages it refuses. The lengths of functions."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest


def program(name: str) -> ModuleType:
    path = Path(__file__).resolve().parents[2] / "tools" / f"{name}.py"
    specification = importlib.util.spec_from_file_location(name, path)
    assert specification is not None and specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


check_tree, count_sentences = program("check_tree"), program("count_sentences")

PAGE = """# A heading is no sentence. It is not.

One sentence of six words here. Another ends after `code`: it
goes on [over a line](https://example.org/a.b.c?words=many).

| a table | is none |
|---|---|
| not. | this. |

- an item
- [ ] another item, e.g. this one. And a second sentence

![no picture](a.png)

```
no code. None.
```
<img src="a.png">
"""


def test_sentences_are_those_of_running_text() -> None:
    assert count_sentences.sentences(PAGE) == [
        "One sentence of six words here.",
        "Another ends after `code`: it goes on over a line.",
        "an item",
        "another item, e.g. this one.",
        "And a second sentence",
    ]


def test_words_have_a_letter_or_a_digit() -> None:
    assert count_sentences.count_words("p' = p + v dt, - at 2.7 m/s.") == 7


@pytest.mark.parametrize(
    ("lengths", "status"),
    [([15] * 20, 0), ([16] * 20, 1), ([10] * 19 + [31], 0), ([10] * 18 + [31, 31], 1)],
)
def test_a_page_of_long_sentences_is_refused(
    lengths: list[int], status: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "page.md"
    page.write_text(" ".join("Word" + " word" * (length - 1) + "." for length in lengths))
    assert count_sentences.main([str(page)]) == status
    assert ("page.md: too long" in capsys.readouterr().out) == bool(status)


def test_a_long_function_is_told() -> None:
    lines = ["def short() -> None:", *["    pass"] * 79, "def long() -> None:", *["    pass"] * 80]
    told = check_tree.check_python_file("a.py", lines)
    assert told == ["a.py:81: long has 81 lines; expected at most 80"]
