# SPDX-License-Identifier: MIT
"""The command `diabolo`."""

from __future__ import annotations

import argparse
import os
import sys
import warnings
from collections.abc import Sequence
from contextlib import suppress
from typing import NoReturn, TextIO

from .. import __version__
from ..checks import RecordingWarning
from . import convert, demo, diagnose, evaluate, info, plan, prove, robot, simulate, view

DESCRIPTION = """\
Simulate and plan diabolo play, and find out how far a simulation is off.

A recording is a file that holds the motion of the two stick tips and of the diabolo: an export of OptiTrack
Motive, or a tidy CSV with a JSON file beside it.
"""

EXAMPLES = """\
begin here:
  diabolo demo --out demo              diagnose recordings whose physics is concealed; a report and a replay
  diabolo info TAKE.csv                what is in a recording
  diabolo evaluate TAKE.csv            how far the models are off on it
  diabolo diagnose TAKE.csv --out out  what they leave out, and how much better they get with it
  diabolo plan throw_and_catch         stick motions for a figure of play
"""


class Parser(argparse.ArgumentParser):
    """Complains in one sentence."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message}; see {self.prog} --help\n")


def make_parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog="diabolo",
        description=DESCRIPTION,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"diabolo {__version__}")
    commands = parser.add_subparsers(metavar="COMMAND", required=True, parser_class=Parser)
    for command in (demo, evaluate, diagnose, plan, simulate, view, robot, info, convert, prove):
        command.add_parser(commands)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit status: 0, 1 where a plan misses its goal, 2 for bad input, 130
    after Ctrl-C."""
    try:
        if sys.stdout is None:
            raise ValueError("standard output is closed; there would be nowhere to print to")
        parser = make_parser()
        for given in sys.argv[1:] if arguments is None else arguments:
            if given != given.encode(errors="replace").decode():
                parser.error(f"{given!r}: not UTF-8; rename the file to pass it here")
        parsed = parser.parse_args(arguments)
        with warnings.catch_warnings():
            warnings.simplefilter("once", RecordingWarning)
            warnings.showwarning = _show_warning
            status: int = parsed.run(parsed) or 0
        sys.stdout.flush()
    except (ValueError, ArithmeticError, OSError) as error:
        if isinstance(error, OSError) and error.filename is None:  # of what is printed
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if isinstance(error, BrokenPipeError):  # such as `diabolo info TAKE.csv | head -1`
            return 0
        print(f"diabolo: {_sentence(error)}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("diabolo: interrupted", file=sys.stderr)
        return 130
    return status


def _show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """As warnings.showwarning, in a sentence."""
    with suppress(OSError):  # what is warned of is no reason to lose the result
        if sys.stderr is not None:
            print(f"diabolo: warning: {_line(str(message))}", file=sys.stderr, flush=True)


def _sentence(error: Exception) -> str:
    if isinstance(error, OSError):
        return _line(f"{error.filename or 'standard output'}: {error.strerror}")
    return _line(str(error))


def _line(text: str) -> str:
    """In one line, without what a terminal would obey."""
    return "".join(c if c.isprintable() else "?" for c in " ".join(text.split()))
