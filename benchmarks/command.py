# SPDX-License-Identifier: MIT
"""The command line of every benchmark: help by example, and one sentence where it cannot do its work."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence


def make_parser(module: str, text: str | None, example: str = "") -> argparse.ArgumentParser:
    """A parser for `python -m MODULE`, whose help teaches by example."""
    return argparse.ArgumentParser(
        prog=f"python -m {module}",
        description=text,
        epilog=f"example:\n{example}" if example else None,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )


def run(
    parser: argparse.ArgumentParser,
    act: Callable[[argparse.Namespace], int],
    arguments: Sequence[str] | None = None,
) -> int:
    """Parses and acts; returns the exit status: that of the act, 2 for bad input, 130 after Ctrl-C."""
    try:
        return act(parser.parse_args(arguments))
    except (ValueError, OSError) as error:
        print(f"{parser.prog}: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"{parser.prog}: interrupted", file=sys.stderr)
        return 130
