# SPDX-License-Identifier: MIT
"""Counts how long the sentences of Markdown pages are.

Usage: count_sentences.py PAGE.md ...  [--longest N]

Prints one line for each page: its sentences, their median of words and the share above 30 words. Exits
with 1 when a page has a median above 15 or more than 5 % above 30. Code blocks, tables, headings, HTML,
pictures and the targets of links are left out. An item of a list is a paragraph of its own.
"""

from __future__ import annotations

import argparse
import re
import statistics
import sys
from pathlib import Path

HIGHEST_MEDIAN = 15.0  # words
LONG = 30  # words; a sentence with more is long
HIGHEST_LONG_SHARE = 0.05

FENCE = re.compile(r"^\s*(```|~~~)")
LIST_ITEM = re.compile(r"^\s*([-*+]|\d+[.)])\s+(\[[ xX]\]\s+)?")
LEFT_OUT = re.compile(r"^\s*(#|\||<|>?\s*\[[^\]]+\]:\s)|^\s*([-*_=]\s*){3,}$")
COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
PICTURE = re.compile(r"!\[[^\]]*\](\([^)]*\)|\[[^\]]*\])")
LINK = re.compile(r"\[([^\]]*)\](\([^)]*\)|\[[^\]]*\])")
TAG = re.compile(r"</?[a-zA-Z][^>]*>")
CODE = re.compile(r"`[^`]*`")
# A mark that ends a sentence, what closes behind it, a space, and no small letter after it.
END = re.compile(r"(?<=[.!?])[)\"'*_]*\s+(?![a-z])")
ABBREVIATION = re.compile(r"\b(e\.g|i\.e|cf|vs|Fig|Eq|Sec|No|et al)\.$")


def paragraphs(markdown: str) -> list[str]:
    """Running text of a page, a paragraph or an item of a list each."""
    found: list[list[str]] = [[]]
    in_code = False
    for line in COMMENT.sub("", markdown).splitlines():
        if FENCE.match(line):
            in_code = not in_code
            found.append([])
        elif in_code:
            continue
        elif not line.strip() or LEFT_OUT.match(line):
            found.append([])
        elif item := LIST_ITEM.match(line):
            found.append([line[item.end() :]])
        else:
            found[-1].append(line.strip().removeprefix("> "))
    texts = (TAG.sub("", LINK.sub(r"\1", PICTURE.sub("", " ".join(lines)))) for lines in found)
    return [text for text in texts if count_words(CODE.sub("", text)) > 0]


def sentences(markdown: str) -> list[str]:
    """Sentences of a page's running text; what ends without a full stop is one too."""
    found = []
    for paragraph in paragraphs(markdown):
        carried = ""
        for part in END.split(paragraph):
            carried = f"{carried} {part}".strip()
            if not ABBREVIATION.search(carried):
                found.append(carried)
                carried = ""
        found += [carried] if carried else []
    return [sentence for sentence in found if count_words(sentence) > 0]


def count_words(text: str) -> int:
    """Words separated by space, of which each has a letter or a digit; those of inline code count too."""
    return sum(any(character.isalnum() for character in word) for word in text.split())


def summary(lengths: list[int]) -> tuple[float, float]:
    """Median number of words and share of the sentences above LONG."""
    if not lengths:
        return 0.0, 0.0
    return statistics.median(lengths), sum(length > LONG for length in lengths) / len(lengths)


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description="Count how long the sentences of Markdown pages are.")
    parser.add_argument("pages", nargs="+", type=Path, metavar="PAGE.md")
    parser.add_argument(
        "--longest", type=int, default=0, metavar="N", help="print the N longest of each page"
    )
    options = parser.parse_args(arguments)
    missed = 0
    print(f"{'sentences':>9} {'median':>6} {'above ' + str(LONG):>8}")
    for page in options.pages:
        found = sentences(page.read_text(encoding="utf-8"))
        median, share = summary([count_words(sentence) for sentence in found])
        missed += (fault := median > HIGHEST_MEDIAN or share > HIGHEST_LONG_SHARE)
        print(f"{len(found):9d} {median:6.1f} {share:8.1%} {page}{': too long' if fault else ''}")
        for sentence in sorted(found, key=count_words, reverse=True)[: options.longest]:
            print(f"    {count_words(sentence):3d}: {sentence}")
    if missed:
        print(
            f"expected a median of at most {HIGHEST_MEDIAN:g}, at most {HIGHEST_LONG_SHARE:.0%} above {LONG}"
        )
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
