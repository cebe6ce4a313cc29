# SPDX-License-Identifier: MIT
"""The independent plant (data/plant): every proof plays on it through this driver of its program."""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

PROGRAM = Path("build/plant/diabolo-plant")
LONGEST_RUN = 1200.0  # [s]


class RefusedError(ValueError):
    """The program cannot play such a scenario."""


class FailedError(ValueError):
    """The program gave up on a scenario, or took too long."""


def add_option(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--plant",
        metavar="FILE",
        type=Path,
        default=PROGRAM,
        help=f"the plant's program, which `make plant` builds; default: {PROGRAM}",
    )


def check(program: Path) -> None:
    """Raises ValueError where the program is not there, or is another one."""
    if not os.access(program, os.X_OK) or program.is_dir():
        raise ValueError(f"{program}: the plant's program is not there; `make plant` builds it")
    try:
        told = subprocess.run([program.absolute(), "--help"], capture_output=True, text=True, timeout=10.0)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ValueError(f"{program}: cannot be run ({error}); expected the plant's program") from error
    if told.returncode != 0 or "--key" not in told.stdout:
        raise ValueError(f"{program}: another program; expected the plant's, which `make plant` builds")


class LivePlay:
    """A play whose hands are moved from here, a period at a time; a context manager.

    It begins as the scenario says; raises what play() does.
    """

    def __init__(self, program: Path, scenario: dict[str, Any]) -> None:
        self._folder = tempfile.TemporaryDirectory()
        asked = Path(self._folder.name) / "scenario.json"
        asked.write_text(json.dumps(scenario), encoding="utf-8")
        self._process = subprocess.Popen(
            [str(program.absolute()), str(asked), "--live"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.moment = self._told()

    def __enter__(self) -> LivePlay:
        return self

    def __exit__(self, *_: object) -> None:
        self._end()

    def push(self, period: float, accelerations: Iterable[float]) -> Moment:
        """Move the hands for a period [s], by constant accelerations, left x, y, z, right x, y, z [m/s^2]."""
        assert self._process.stdin
        self._process.stdin.write(" ".join(f"{x:.12g}" for x in (period, *accelerations)) + "\n")
        self._process.stdin.flush()
        self.moment = self._told()
        return self.moment

    def _end(self) -> str:
        """End the program; what it complained of."""
        if self._process.returncode is None:
            _, self._said = self._process.communicate()
        self._folder.cleanup()
        return self._said

    def _told(self) -> Moment:
        assert self._process.stdout
        words = self._process.stdout.readline().split()
        if len(words) != len(Moment._fields[:2]) + 16:
            said = self._end()
            kind = RefusedError if self._process.returncode == 2 else FailedError
            raise kind(f"the plant: {' '.join(said.split()) or 'it ended'}")
        numbers = np.array([float(word) for word in words[2:]])
        return Moment(
            float(words[0]),
            words[1],
            numbers[:3],
            numbers[3:6],
            float(numbers[6]),
            numbers[7:10],
            numbers[10:13],
            numbers[13:],
        )


class Moment(NamedTuple):
    """What is true at a time [s]: mode (MISSED: play is over), position [m], velocity [m/s], spin [rad/s],
    hands [m] and axle (unit vector, forward)."""

    time: float
    mode: str
    position: NDArray[np.float64]
    velocity: NDArray[np.float64]
    spin: float
    left: NDArray[np.float64]
    right: NDArray[np.float64]
    axis: NDArray[np.float64]


def play(
    program: Path,
    scenario: dict[str, Any],
    out: Path,
    truth: Path | None = None,
    longest: float = LONGEST_RUN,
) -> dict[str, Any]:
    """Plays a scenario; returns what is at work in it, by the names of the diagnosis.

    `out` gets the filmed recording (CSV, with its JSON beside it), `truth` what really happened (CSV). The
    program may take `longest` seconds.
    """
    with tempfile.TemporaryDirectory() as folder:
        asked, key = Path(folder) / "scenario.json", Path(folder) / "key.json"
        asked.write_text(json.dumps(scenario), encoding="utf-8")
        command = [program.absolute(), asked, "--out", out, "--key", key]
        command += [] if truth is None else ["--truth", truth]
        try:
            done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=longest)
        except subprocess.TimeoutExpired:
            raise FailedError(f"the plant took more than {longest:g} s") from None
        said = " ".join(done.stderr.replace(str(asked), "scenario").split())
        if done.returncode == 2:
            raise RefusedError(f"the plant refuses: {said}")
        if done.returncode != 0:
            raise FailedError(f"the plant failed: {said}")
        return dict(json.loads(key.read_text(encoding="utf-8"))["effects"])
