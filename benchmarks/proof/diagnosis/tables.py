# SPDX-License-Identifier: MIT
"""Scores as text and as Markdown."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


def percent(value: float) -> str:
    return f"{100.0 * value:.1f} %"


def bound_of(score: dict[str, Any]) -> str:
    show = percent if score["hits"] is not None else (lambda value: f"{value:.2f}")
    parts = []
    if score["least"] is not None:
        parts.append(f">= {show(score['least'])}")
    if score["most"] is not None:
        parts.append(f"<= {show(score['most'])}")
    return " and ".join(parts)


def row_of(score: dict[str, Any]) -> list[str]:
    """Name, value, interval, of how many, bound, and whether it is kept."""
    if score["value"] is None:
        return [score["name"], "-", "-", "0", bound_of(score), "not measured" if bound_of(score) else ""]
    show = percent if score["hits"] is not None else (lambda value: f"{value:.2f}")
    interval = score["interval"]
    span = "-" if interval is None else f"{show(interval[0])} to {show(interval[1])}"
    hits = f"{score['hits']} of {score['total']}" if score["hits"] is not None else str(score["total"])
    unsure = f"missed, {'too few cases for an' if interval is None else 'within its'} interval"
    kept = {True: "kept", None: "", False: "missed" if score["fails"] else unsure}
    return [score["name"], show(score["value"]), span, hits, bound_of(score), kept[score["keeps"]]]


HEADER = ["score", "value", "95 % interval", "cases", "bound", ""]


def markdown(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = ["| " + " | ".join(row) + " |" for row in [header, *rows]]
    return "\n".join([lines[0], "|" + "---|" * len(header), *lines[1:]])


def plain(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Columns as wide as their widest cell."""
    widths = [max(len(cell) for cell in column) for column in zip(header, *rows, strict=True)]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in [header, ["-" * width for width in widths], *rows]
    ]
    return "\n".join(lines)


def failure_rows(result: dict[str, Any]) -> list[list[str]]:
    return [
        [
            failure["case"],
            failure["arm"],
            failure["plant"],
            ", ".join(failure["truth"]) or "nothing",
            ", ".join(failure["claimed"]) or "nothing",
            "; ".join(failure["wrong"]),
        ]
        for failure in result["failures"]
    ]


FAILURE_HEADER = ["case", "arm", "plant", "at work", "claimed", "what is wrong"]


def kind_rows(result: dict[str, Any]) -> list[list[str]]:
    """What each kind of strangers got, below a header; empty where none was met."""
    rows = result["by_kind"]
    return [[*rows[0]], *([str(cell) for cell in row.values()] for row in rows)] if rows else []


def text_of(result: dict[str, Any]) -> str:
    """Scores and failures for a terminal."""
    scores = plain(HEADER, [row_of(score) for score in result["scores"]])
    if kinds := kind_rows(result):
        scores += "\n\n" + plain(kinds[0], kinds[1:])
    rows = failure_rows(result)
    if not rows:
        return scores + "\n\nevery answer is right in all it says"
    return (
        scores
        + f"\n\n{len(rows)} of {result['cases']} answers are wrong in something\n"
        + plain(FAILURE_HEADER, rows)
    )
