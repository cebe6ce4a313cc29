# SPDX-License-Identifier: MIT
"""The command `diabolo`."""

from __future__ import annotations

import argparse
import os
import re
import signal
import sys
import threading
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any, NoReturn, TextIO

from .. import __version__
from ..checks import RecordingWarning
from ..rollout import RolloutWarning
from . import convert, demo, diagnose, evaluate, info, motion, plan, play, robot, simulate, train, view

DESCRIPTION = """\
Simulate and plan diabolo play, and find out how far a simulation is off.

A recording is a file that holds the motion of the two stick tips and of the diabolo: an export of OptiTrack
Motive, or a tidy CSV with a JSON file beside it.
"""

EXAMPLES = """\
begin here:
  diabolo demo --out demo              diagnose recordings whose physics is concealed; a report and a replay
  diabolo info TAKE.csv                what is in a recording
  diabolo evaluate TAKE.csv            the error of the models on it
  diabolo diagnose TAKE.csv --out out  what physics is missing; a report and a better model
  diabolo plan throw_and_catch         stick motions for a figure of play
"""


NEGATIVE_NUMBER = re.compile(r"-((\d+\.?\d*|\.\d+)(e[-+]?\d+)?|inf|nan)$", re.IGNORECASE)
TERMINATED = 128 + signal.SIGTERM  # the exit status that a shell gives such a program


class Parser(argparse.ArgumentParser):
    """Complains in one sentence, and takes -1e5 for a number."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self._negative_number_matcher = NEGATIVE_NUMBER

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> tuple[Any, list[str]]:
        """Complains of what it does not know itself, so that the help of the command is named."""
        parsed, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(f"unrecognized arguments: {' '.join(unknown)}")
        return parsed, unknown

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message}; see {self.prog} --help\n")

    def _print_message(self, message: str, file: Any = None) -> None:
        if file is sys.stdout:  # where help cannot be printed, main() says so; argparse keeps silent
            print(message, end="", file=file, flush=True)
        else:
            super()._print_message(message, file)


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
    for command in (
        demo,
        evaluate,
        diagnose,
        plan,
        simulate,
        view,
        robot,
        info,
        convert,
        motion,
        train,
        play,
    ):
        command.add_parser(commands)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit status: 0, 1 where a plan misses its goal, 2 for bad input, 3 where
    robots change what is played, 130 after Ctrl-C, 143 after SIGTERM."""
    try:
        with _signals_raise():
            return _run(sys.argv[1:] if arguments is None else arguments)
    except (ValueError, ArithmeticError, OSError) as error:
        if isinstance(error, OSError) and error.filename is None:  # of what is printed
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if isinstance(error, BrokenPipeError):  # such as `diabolo info TAKE.csv | head -1`
            return 0
        return _end(_sentence(error), 2)
    except MemoryError:
        return _end("out of memory; expected fewer or shorter recordings, or fewer starts", 2)
    except RecursionError:
        return _end("nested too deeply; expected a file or expression of a few levels", 2)
    except KeyboardInterrupt:
        return _end("interrupted", 130)
    except _Terminated:
        return _end("terminated", TERMINATED)


def _run(arguments: Sequence[str]) -> int:
    if sys.stdout is None:
        raise ValueError("standard output is closed; there would be nowhere to print to")
    parser = make_parser()
    for given in arguments:
        if given != given.encode(errors="replace").decode():
            parser.error(f"{given!r}: not UTF-8; rename the file to pass it here")
        if "\0" in given:
            parser.error(f"{given!r}: a zero byte in it; expected text, which has none")
    options = arguments[: arguments.index("--")] if "--" in arguments else arguments
    for given in options:
        if re.fullmatch(r"--[^=]+=--", given):
            parser.error(f"{given}: expected a value, and a name that begins so as ./--")
    parsed = parser.parse_args(arguments)
    with warnings.catch_warnings():
        for kind in (RecordingWarning, RolloutWarning):
            warnings.simplefilter("always", kind)
        warnings.showwarning = _WarningsOnce()
        status: int = parsed.run(parsed) or 0
    sys.stdout.flush()
    return status


class _Terminated(BaseException):
    """SIGTERM, as KeyboardInterrupt is Ctrl-C: what is being written is removed on the way out."""


@contextmanager
def _signals_raise() -> Iterator[None]:
    """SIGTERM raises _Terminated; Ctrl-C raises KeyboardInterrupt from now on, see diabolo.quiet_start."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def terminate(number: int, frame: FrameType | None) -> None:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)  # once is enough
        raise _Terminated

    if signal.getsignal(signal.SIGINT) == signal.SIG_DFL:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    before = signal.signal(signal.SIGTERM, terminate)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _end(sentence: str, status: int) -> int:
    if sys.stderr is not None:
        print(f"diabolo: {sentence}", file=sys.stderr)
    return status


class _WarningsOnce:
    """Shows each in a sentence; the filter "once" forgets what was said where a library adds a filter."""

    def __init__(self) -> None:
        self.said: set[str] = set()

    def __call__(
        self,
        message: Warning | str,
        category: type[Warning],
        filename: str,
        lineno: int,
        file: TextIO | None = None,
        line: str | None = None,
    ) -> None:
        sentence = _line(str(message))
        if sys.stderr is None or sentence in self.said:
            return
        self.said.add(sentence)
        with suppress(OSError):  # what is warned of is no reason to lose the result
            print(f"diabolo: warning: {sentence}", file=sys.stderr, flush=True)


def _sentence(error: Exception) -> str:
    if isinstance(error, OSError):
        return _line(f"{error.filename or 'standard output'}: {error.strerror}")
    return _line(str(error))


def _line(text: str) -> str:
    """In one line, without what a terminal would obey."""
    return "".join(c if c.isprintable() else "?" for c in " ".join(text.split()))
