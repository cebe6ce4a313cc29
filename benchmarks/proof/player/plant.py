# SPDX-License-Identifier: MIT
"""A plant with drawn numbers: it plays planned motions of the tips and its own, truly and as filmed."""

from __future__ import annotations

import csv
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import diabolo
import numpy as np
from diabolo import Model, Parameters, Recording, State, TipPath
from diabolo.enums import StringState
from numpy.typing import ArrayLike, NDArray

from .. import plant

LEAD = 0.3
"""The tips rest so long before the motion, the diabolo hanging [s]."""
KNOTS = 120.0
"""The plant's hands follow a spline through so many poses of the plan a second."""
RATE = 500.0
"""Rows of what happened a second."""
STEPS = 24000
"""Of the plant's integrator a second; its usual 48000 change no figure here and take twice as long."""
PITCH = 15.0  # of the sticks [deg]
STICKS = np.tile([np.cos(np.radians(PITCH)), 0.0, np.sin(np.radians(PITCH))], 2)
"""Directions of both sticks, left over right."""
STICK_DAMPING = 3.0  # of a tip [N s/m]
FORWARD = 0.55  # of the hands [m]
PRACTICE = 30.0
"""Seconds of play that a diagnosis gets."""


class Take(NamedTuple):
    """One of the plant's own figures: spin [rad/s], how far the tips are apart at home [m], how much higher
    the left one is [m], and the elements of the motion."""

    spin: float
    gap: float
    left_higher: float
    elements: list[dict[str, Any]]


def own_takes() -> Iterator[Take]:
    """A swing, hops, an acceleration, and then throws."""

    def hold(duration: float) -> dict[str, Any]:
        return {"type": "hold", "duration": duration}

    def wave(kind: str, amplitude: float, frequency: float, cycles: int) -> dict[str, Any]:
        return {"type": kind, "amplitude": amplitude, "frequency": frequency, "cycles": cycles}

    swing = [hold(0.5), wave("swing", 0.1, 0.75, 4), hold(0.3), wave("beat", 0.06, 1.4, 3), hold(0.4)]
    yield Take(220.0, 0.6, 0.0, swing)
    yield Take(180.0, 0.6, 0.0, [hold(0.5), {"type": "hop", "count": 4}, hold(0.6)])
    yield Take(60.0, 0.486, 0.14, [hold(0.5), {"type": "linear_acceleration", "count": 5}, hold(0.5)])
    bounce = wave("bounce", 0.04, 1.2, 2)
    for k in range(12):
        throw = {"type": "throw", "size": (1.0, 0.95, 1.05)[k % 3]}
        yield Take(150.0 + 10.0 * k, 0.51, 0.0, [hold(0.4), throw, hold(0.6), bounce, hold(0.4)])


@dataclass
class Plant:
    """What the plant is, and the program that simulates it."""

    program: Path
    friction: float = 0.3
    bending_stiffness: float = 400.0
    stiffness: float = 2000.0
    drag: float = 0.028
    magnus: float = 0.0011
    length: float = 1.45
    mass: float = 0.2893
    axial_inertia: float = 5.6e-4
    axle_radius: float = 0.0065
    seed: int = 1
    wraps: int = 0

    def facts(self) -> dict[str, float]:
        """What is true of it."""
        return {name: value for name, value in vars(self).items() if name not in ("program", "wraps")}

    def known(self) -> Model:
        """The library's model of it, with the plant's own numbers."""
        parameters = Parameters(spin_coupling=0.0, mass=self.mass, axle_radius=self.axle_radius)
        parameters.string_length = self.length
        parameters.wraps = self.wraps
        return Model(
            parameters,
            name="truth",
            string_friction=diabolo.StringFriction(
                coefficient=self.friction, spin_gain=self.mass * self.axle_radius / self.axial_inertia
            ),
            string_elasticity=diabolo.StringElasticity(compliance=self.length / self.stiffness, damping=10.0),
            stick_flex=diabolo.StickFlex(compliance=1.0 / self.bending_stiffness, damping=STICK_DAMPING),
            finite_axle=diabolo.FiniteAxle(radius=self.axle_radius + 0.0008),
            air=diabolo.Air(quadratic_drag=self.drag),
            magnus_lift=diabolo.MagnusLift(coefficient=self.magnus),
        )

    def play(self, path: TipPath, spin: float, tail: float = 0.3, *, steers: bool = False) -> Played:
        """What the plant does when its hands follow the path. If it `steers`, its player keeps the axis level
        and forward by setting one hand forward, the other back."""
        count = max(2, int(np.ceil((path.end - path.begin) * KNOTS)))
        times = np.linspace(path.begin, path.end, count + 1)
        tips = path.derivatives(times)[0]
        offsets = tips[1:] - tips[0]
        follow = {
            "type": "path",
            "times": (times[1:] - times[0]).tolist(),
            "left": offsets[:, :3].tolist(),
            "right": offsets[:, 3:].tolist(),
        }
        elements = [{"type": "hold", "duration": LEAD}, follow, {"type": "hold", "duration": tail}]
        home = tips[0, :3].tolist(), tips[0, 3:].tolist()
        return self._run(self.scenario(home, elements, spin, {"steers": steers}, self.seed, wander=False))

    def live(self, left: ArrayLike, right: ArrayLike, spin: float) -> plant.LivePlay:
        """A play whose hands are moved from outside; they begin at `left` and `right` [m]."""
        home = [[float(x) for x in np.asarray(hand)] for hand in (left, right)]
        hold = [{"type": "hold", "duration": LEAD}]
        return plant.LivePlay(self.program, self.scenario(home, hold, spin, {}, self.seed, wander=False))

    def practice(self) -> list[Recording]:
        """PRACTICE seconds of the plant's own player, filmed: figures of play, throws among them, as they
        come; one that loses the diabolo ends there."""
        takes: list[Recording] = []
        for number, (spin, gap, higher, elements) in enumerate(own_takes()):
            home = (
                [FORWARD, 0.5 * gap, 1.25 + 0.5 * higher],
                [FORWARD, -0.5 * gap, 1.25 - 0.5 * higher],
            )
            player = {"steers": True, "catches": True}
            seed = 20 * self.seed + number
            takes.append(self._run(self.scenario(home, elements, spin, player, seed, wander=True)).recording)
            if sum(float(take.time[-1] - take.time[0]) for take in takes) >= PRACTICE:
                break
        return takes

    def scenario(
        self, home: Any, elements: Any, spin: float, player: dict[str, bool], seed: int, *, wander: bool
    ) -> dict[str, Any]:
        """The plant and a play of it: where the hands are at home [m], what they do, and the spin [rad/s]."""
        stick = {"yaw_deg": 0, "pitch_deg": PITCH}
        return {
            "schema": "diabolo.scenario/1",
            "seed": seed,
            "truth_rate": RATE,
            "steps_per_second": STEPS,
            "diabolo": {
                "mass": self.mass,
                "axial_inertia": self.axial_inertia,
                "axle_radius": self.axle_radius,
            },
            "string": {
                "length": self.length,
                "stiffness": self.stiffness,
                "friction": self.friction,
                "wraps": self.wraps,
            },
            "sticks": {"bending_stiffness": self.bending_stiffness, "damping_ratio": 0.8},
            "air": {"drag": self.drag, "magnus": self.magnus},
            "player": player,
            "start": {"spin": spin},
            "motion": {
                "left": home[0],
                "right": home[1],
                "left_stick": stick,
                "right_stick": stick,
                "wander": 0.003 if wander else 0.0,
                "wander_deg": 2 if wander else 0,
                "elements": elements,
            },
        }

    def _run(self, scenario: dict[str, Any]) -> Played:
        with tempfile.TemporaryDirectory() as folder:
            out, truth = Path(folder) / "take.csv", Path(folder) / "truth.csv"
            plant.play(self.program, scenario, out, truth)
            with truth.open(newline="") as lines:
                rows = list(csv.DictReader(lines))
            recording = diabolo.load_recording(out)

        def columns(*names: str) -> NDArray[np.float64]:
            return np.array([[float(row[name]) for name in names] for row in rows])

        tips = columns(*(f"{side}_tip_{axis}" for side in ("left", "right") for axis in "xyz"))
        return Played(
            columns("time")[:, 0] - LEAD,
            columns("x", "y", "z"),
            columns("spin")[:, 0],
            tips,
            np.array([row["mode"] for row in rows]),
            recording,
        )


@dataclass
class Played:
    """What happened: time since the motion's begin [s], the diabolo's and the tips' motion; and as filmed."""

    time: NDArray[np.float64]
    position: NDArray[np.float64]
    spin: NDArray[np.float64]
    tips: NDArray[np.float64]
    mode: NDArray[np.str_]
    recording: Recording

    def seen_hanging(self) -> State:
        """The resting diabolo before the motion, from the camera's frames."""
        rows = self.recording.time < LEAD
        places = np.asarray(self.recording.diabolo)[rows]
        return State(np.nanmean(places, axis=0), np.zeros(3), float(self.spin[0]), StringState.ON_STRING)

    def seen(self, time: float) -> tuple[float, State]:
        """When before `time` a state was seen last, in frames up to there, at most half a second sooner."""
        rows = np.flatnonzero(self.recording.time <= time + LEAD + 1e-9)
        for row in rows[::-1][: int(0.5 * self.recording.rate)]:
            try:
                return float(self.recording.time[row]) - LEAD, diabolo.start_state(self.recording, int(row))
            except ValueError:  # a dropout just before
                continue
        raise ValueError(f"the diabolo was not seen for half a second before {time:.2f} s")

    def flight(self, path: TipPath) -> tuple[float, float]:
        """True apex above the tips at the path's end, and the sideways place of landing there [m]."""
        tips = path.derivatives(np.array([path.end]))[0][0]
        level = 0.5 * (tips[2] + tips[5])
        top = int(self.position[:, 2].argmax())
        down = top + int(np.argmax(self.position[top:, 2] <= level))
        return float(self.position[top, 2] - level), float(self.position[down, 1])

    def held_at(self, time: float) -> bool:
        """Whether the diabolo truly is on the string, and below the hands, at that time."""
        i = int(np.clip(np.searchsorted(self.time, time), 0, len(self.time) - 1))
        reaches = self.time[-1] >= time - 0.01
        below = self.position[i, 2] < 0.5 * (self.tips[i, 2] + self.tips[i, 5]) + 0.05
        return bool(reaches and self.mode[i] != "FLYING" and below)
