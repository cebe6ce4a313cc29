# SPDX-License-Identifier: MIT
"""`diabolo simulate --live`: a play in real time, by the clock."""

from __future__ import annotations

import argparse
import time
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .. import files
from .._core import Model, Recording
from .arguments import output_name

if TYPE_CHECKING:
    from ..live.play import Play
    from ..live.server import LiveServer

FRAME = 1.0 / 60.0
"""Time from a frame to the next [s]."""
LONGEST_TURN = 0.05
"""Longest time that is played at once [s]: a machine that falls behind plays slower, and nothing jumps."""
UNWATCHED = 3.0
"""Time without a page after which the play ends [s]; a page that is loaded anew is back before."""
LASTS, LONGEST = 3600.0, 86_400.0
"""How long a play lasts by default, and at most [s]."""


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--port", metavar="N", type=int, help="of a live play, 1 to 65535; default: a free one"
    )
    parser.add_argument(
        "--seconds",
        metavar="S",
        type=float,
        help=f"after which a live play ends, at most {LONGEST:g}; default {LASTS:g}",
    )
    parser.add_argument(
        "--out",
        metavar="FILE.csv",
        type=output_name,
        help="with --live, in place of TIDY.csv: write the longest stretch between two beginnings as a tidy "
        "recording",
    )


def check_options(arguments: argparse.Namespace) -> None:
    """Raise ValueError where one does not fit the others, or is out of its range."""
    ours, others = ("port", "seconds", "out"), ("duration", "calibration", "up", "columns", "topics", "arms")
    for name in others if arguments.live else ours:
        if getattr(arguments, name) is not None:
            kind = "does not belong to --live" if arguments.live else "belongs to --live"
            raise ValueError(f"--{name} {getattr(arguments, name)}: {kind}")
    if not arguments.live:
        return
    if arguments.tidy is not None:
        raise ValueError(f"{arguments.tidy}: expected --out {arguments.tidy} with --live")
    if arguments.json is not None and (arguments.out is None or arguments.json == files.STDOUT):
        raise ValueError(f"--json {arguments.json}: expected a file, and --out FILE.csv, with --live")
    if arguments.port is not None and not 1 <= arguments.port <= 65535:
        raise ValueError(f"--port {arguments.port}: expected 1 to 65535")
    if arguments.seconds is not None and not 0.0 < arguments.seconds <= LONGEST:
        raise ValueError(f"--seconds {arguments.seconds:g}: expected more than 0, at most {LONGEST:g}")


def played(
    arguments: argparse.Namespace, model: Model, spin: float
) -> tuple[str, tuple[Recording, NDArray[np.uint8]] | None]:
    """Why the play ended; what was played and its string states, None where nothing was."""
    from ..live.play import Play

    play = Play(model, spin)
    why = play_live(play, arguments.port or 0, arguments.seconds or LASTS)
    found = play.recording("played" if arguments.out is None else Path(arguments.out).stem)
    if found is None and arguments.out:
        why += f"\n{arguments.out}: not written, since nothing was played"
    return why, found


def play_live(play: Play, port: int, seconds: float) -> str:
    """Serve a page that plays until it is closed, the seconds are over, or Ctrl-C; returns which."""
    from ..live.page import live_html
    from ..live.server import LiveServer

    with LiveServer(port, live_html(play)) as server:
        try:
            print(f"open {server.address} in a browser and play; Ctrl-C ends it", flush=True)
            sentence = _go_on(play, server, seconds)
        except KeyboardInterrupt:
            sentence = "ended by Ctrl-C"
        with suppress(KeyboardInterrupt):  # a second one; what was played is kept
            server.frames.end(sentence)
    return sentence


def _go_on(play: Play, server: LiveServer, seconds: float) -> str:
    """Turn by turn; returns why it ended."""
    begun = last = due = time.monotonic()
    watched = None
    while True:
        now = time.monotonic()
        for wish in server.wishes():
            play.obey(wish)
        if server.frames.listeners:
            watched = now
            play.advance(min(now - last, LONGEST_TURN))
        elif watched is not None and now - watched > UNWATCHED:
            return "the page was closed"
        if now - begun > seconds:
            return f"{seconds:g} s are over"
        server.frames.publish(play.frame())
        last = now
        due = max(due + FRAME, time.monotonic())
        time.sleep(max(0.0, due - time.monotonic()))
