# SPDX-License-Identifier: MIT
"""The axle's direction a second ahead, on real takes: GyroscopicTilt and Groove beside an axle that stays.

Gain and groove are chosen on the first half of a take, by the median of every third start; with them 90 % of
its starts stay within some angle. The second half says how good both are.
"""

from __future__ import annotations

import argparse
import itertools
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import diabolo
import numpy as np
from diabolo import Model, Parameters, Predictor, State
from diabolo.rotations import first_axes
from numpy.typing import NDArray

from ... import command

EXAMPLE = """\
  python -m benchmarks.proof.real.axle "$DIABOLO_RECORDINGS"/2020-11-12*/*.csv --calibration blue"""
AHEAD = 1.0  # [s]
STEP = 1e-3  # [s]
EVERY = 0.25  # a start [s]
SEEN = 0.7  # share of the frames up to the end that show all
SLOWEST = 30.0  # a spin to start from [rad/s]
GAINS = (1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0)  # [1/m]
PROFILES = (0.0, 0.002, 0.004, 0.006)  # [m]
HALF_WIDTH = 0.006  # of the groove [m]
FRICTION = 0.1
COVERED = 0.9


class Start(NamedTuple):
    """A row of the take, the state there, and the axle AHEAD of it."""

    row: int
    state: State
    later: NDArray[np.float64]


class Take:
    def __init__(self, file: Path, calibration: diabolo.Calibration) -> None:
        recording = diabolo.load_recording(file, calibration=calibration)
        self.name, self._time = recording.name, np.asarray(recording.time)
        self._length = recording.string_length
        axle = first_axes(np.asarray(recording.diabolo_orientation))
        self._axle = axle * np.where(axle[:, :1] < 0.0, -1.0, 1.0)
        tips = np.hstack([recording.left, recording.right])
        known = np.asarray(np.isfinite(np.hstack([tips, axle])).all(axis=1))
        self._tips = np.array(
            [np.interp(self._time, self._time[known], column[known]) for column in tips.T]
        ).T
        self.starts = list(self._starts(recording, known))

    def _starts(self, recording: Any, known: NDArray[np.bool_]) -> Any:
        ahead = round(AHEAD * recording.rate)
        for row in range(0, len(self._time) - ahead, round(EVERY * recording.rate)):
            if known[row : row + ahead + 1].mean() < SEEN or not known[row + ahead]:
                continue
            try:
                state = diabolo.start_state(recording, row)
            except ValueError:  # a dropout close by
                continue
            if abs(state.spin) >= SLOWEST:
                yield Start(row, state, self._axle[row + ahead])

    def error(self, start: Start, gain: float, profile: float) -> float:
        """Angle between the axle that is predicted and the one that is seen [deg]."""
        model = Model(
            Parameters(spin_coupling=0.0, string_length=self._length),
            string_friction=diabolo.StringFriction(coefficient=FRICTION),
            gyroscopic_tilt=diabolo.GyroscopicTilt(gain=gain),
            groove=diabolo.Groove(profile_radius=profile, half_width=HALF_WIDTH if profile else 0.0),
        )
        predictor, s = Predictor(model), start.state
        state = State(s.position, s.velocity, s.spin, s.string_state, axis=s.axis)
        times = self._time[start.row] + STEP * np.arange(round(AHEAD / STEP) + 1)
        tips = np.array([np.interp(times, self._time, column) for column in self._tips.T]).T
        for now, then in itertools.pairwise(tips):
            predictor.step(state, now[:3], now[3:], then[:3], then[3:], STEP)
        return between(state.axis, start.later)


def between(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Angle between two directions [deg]."""
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)))


def run(given: argparse.Namespace) -> int:
    calibration = getattr(diabolo.Calibration, given.calibration)()
    for file in given.takes:
        take = Take(file, calibration)
        if len(take.starts) < 20:
            raise ValueError(
                f"{file}: {len(take.starts)} starts with an axle and a spin; expected 20 at least"
            )
        half = len(take.starts) // 2
        learn, judge = take.starts[: half - round(AHEAD / EVERY)], take.starts[half:]

        def errors(
            starts: list[Start], gain: float, profile: float, take: Take = take
        ) -> NDArray[np.float64]:
            return np.array([take.error(start, gain, profile) for start in starts])

        chosen = min(
            itertools.product(GAINS, PROFILES), key=lambda pair: float(np.median(errors(learn[::3], *pair)))
        )
        within = float(np.quantile(errors(learn, *chosen), COVERED))
        found = errors(judge, *chosen)
        stays = np.array([between(start.state.axis, start.later) for start in judge])
        print(
            f"{take.name}: gain {chosen[0]:g} 1/m, profile {1e3 * chosen[1]:g} mm\n"
            f"{len(judge)} starts of the second half: {np.median(found):.2f} deg in the median, "
            f"{np.median(stays):.2f} for an axle that stays\n"
            f"{np.mean(found <= within):.0%} within {within:.1f} deg, as {COVERED:.0%} of the first half"
        )
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.proof.real.axle", __doc__, EXAMPLE)
    parser.add_argument("takes", metavar="TAKE", nargs="+", type=Path)
    parser.add_argument(
        "--calibration", choices=("published", "blue"), default="published", help="of the takes"
    )
    return command.run(parser, run, arguments)


if __name__ == "__main__":
    sys.exit(main())
