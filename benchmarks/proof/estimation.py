# SPDX-License-Identifier: MIT
"""How near an estimate comes to plays of the plant, and how often its intervals hold the truth.

Each play has a body, a string and air of its own; the estimator's model is off in each constant by a drawn
amount, and knows neither the string's stretch nor the axle's tilt. Tips are known, as two arms know them.
Forces on the tips are read at 500 Hz with a noise of 0.1 N. The camera sees a position 30 times a second,
50 ms late, with a noise of 5 mm, and misses one in twenty. Every estimate begins from a frame: 10 mm, 0.05
m/s, 2 % of the spin.
"""

from __future__ import annotations

import argparse
import csv
import json
import math
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from diabolo import (
    Air,
    FiniteAxle,
    LandingRestitution,
    MagnusLift,
    Model,
    Parameters,
    SpinLoss,
    State,
    StringFriction,
)
from diabolo.estimate import Estimator, Spread
from diabolo.rotations import first_axes
from numpy.typing import NDArray

from .. import command
from . import plant

RATE = 500  # of forces and steps [Hz]
DURATION = 5.4  # [s]
FORCE_NOISE, CAMERA_NOISE = 0.1, 5e-3  # [N], [m]
CAMERA_RATE, CAMERA_DELAY, CAMERA_DROPOUTS = 30.0, 0.05, 0.05  # [Hz], [s], share
STRING_RADIUS = 8e-4  # the plant's own [m]
SENSORS = ("forces", "tensions", "camera", "camera and tensions", "camera and forces")

Array = NDArray[np.float64]
Element = dict[str, Any]


def _hold(duration: float) -> Element:
    return {"type": "hold", "duration": duration}


MOTIONS: dict[str, Callable[[Callable[[float, float], float]], list[Element]]] = {
    "hold": lambda draw: [_hold(5.5)],
    "swing": lambda draw: [
        _hold(0.4),
        {"type": "swing", "amplitude": draw(0.07, 0.12), "frequency": draw(0.6, 0.9), "duration": 5.0},
    ],
    "beat": lambda draw: [
        _hold(0.4),
        {"type": "beat", "amplitude": draw(0.04, 0.08), "frequency": draw(1.2, 1.6), "duration": 5.0},
    ],
    "circle": lambda draw: [_hold(0.5), {"type": "circular_acceleration", "count": 6}, _hold(1.5)],
    "throw": lambda draw: [_hold(0.5), {"type": "throw", "size": draw(0.9, 1.1)}, _hold(4.0)],
}
HANDS = {"circle": (0.395, -0.109), "throw": (0.255, 0.0)}  # half their distance, the left one's height [m]


def scenario(motion: str, draw: Callable[[float, float], float]) -> dict[str, Any]:
    mass, gyration = draw(0.2, 0.295), draw(0.6, 0.75) * 0.0635
    apart, raised = HANDS.get(motion, (0.3, 0.0))
    return {
        "schema": "diabolo.scenario/1",
        "truth_rate": RATE,
        "duration": DURATION,
        "diabolo": {
            "mass": mass,
            "axial_inertia": mass * gyration**2,
            "axle_radius": draw(0.0055, 0.008),
        },
        "string": {"friction": draw(0.15, 0.35), "stiffness": draw(1000.0, 4000.0)},
        "air": {"drag": draw(0.015, 0.045), "magnus": draw(2e-4, 18e-4), "windage": draw(2e-8, 8e-8)},
        "start": {
            "spin": draw(40.0, 80.0) if motion == "circle" else draw(150.0, 250.0),
            "yaw_deg": draw(-2.0, 2.0),
            "pitch_deg": draw(-2.0, 2.0),
        },
        "motion": {
            "left": [0.0, apart, 1.25 + raised],
            "right": [0.0, -apart, 1.25 - raised],
            "left_stick": {"yaw_deg": -8, "pitch_deg": 15},
            "right_stick": {"yaw_deg": 8, "pitch_deg": 15},
            "wander": 0.003,
            "wander_deg": 2,
            "elements": MOTIONS[motion](draw),
        },
    }


def wrong_model(asked: dict[str, Any], draw: Callable[[float, float], float]) -> Model:
    """What one knows of the plant: its constants, each a little off."""
    body, string, air = asked["diabolo"], asked["string"], asked["air"]

    def off(share: float) -> float:
        return 1.0 + draw(-share, share)

    radius = body["axle_radius"] + STRING_RADIUS
    mass = body["mass"] * off(0.005)
    # What a catch gives back, by the string's share of the critical damping; the plant's damping is 10 N s/m.
    damping = min(0.99, 10.0 / math.sqrt(string["stiffness"] / 1.45 * mass))
    bounce = math.exp(-math.pi * damping / math.sqrt(1.0 - damping**2))
    return Model(
        Parameters(
            string_length=1.45 + draw(-0.002, 0.002),
            mass=mass,
            axle_radius=radius,
            spin_coupling=0.0,
            catch_slack=0.9,
        ),
        string_friction=StringFriction(
            coefficient=string["friction"] * off(0.05),
            spin_gain=body["mass"] * radius / body["axial_inertia"] * off(0.03),
        ),
        finite_axle=FiniteAxle(radius=radius * off(0.05)),
        air=Air(quadratic_drag=air["drag"] * off(0.2)),
        magnus_lift=MagnusLift(coefficient=air["magnus"] * off(0.3)),
        spin_loss=SpinLoss(air=air["windage"] / body["axial_inertia"] * off(0.1)),
        landing_restitution=LandingRestitution(coefficient=bounce * off(0.2)),
    )


class Truth(NamedTuple):
    """A play at RATE: N rows."""

    time: Array
    on_string: NDArray[np.bool_]
    position: Array
    velocity: Array
    spin: Array
    axle: Array
    tips: Array
    """Left, right; shape (N, 2, 3)."""
    tip_velocities: Array
    forces: Array


def read_truth(path: Path) -> Truth:
    with path.open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["mode"] != "MISSED"]

    def columns(*names: str) -> Array:
        return np.array([[float(row[name]) for name in names] for row in rows])

    def both(name: str) -> Array:
        return np.stack([columns(*(f"{side}_{name}_{k}" for k in "xyz")) for side in ("left", "right")], 1)

    time, tips = columns("time")[:, 0], both("tip")
    return Truth(
        time,
        np.array([row["mode"] == "ON_STRING" for row in rows]),
        columns("x", "y", "z"),
        columns("vx", "vy", "vz"),
        columns("spin")[:, 0],
        first_axes(columns("qx", "qy", "qz", "qw")),
        tips,
        np.gradient(tips, time, axis=0, edge_order=2),
        both("force"),
    )


class Frame(NamedTuple):
    known: float
    """When it is there [s]."""
    seen: float
    position: Array


def filmed(truth: Truth, generator: np.random.Generator) -> list[Frame]:
    frames = []
    for at in np.arange(0.0, truth.time[-1], 1.0 / CAMERA_RATE):
        row = int(np.searchsorted(truth.time, at))
        if generator.random() >= CAMERA_DROPOUTS:
            seen = truth.position[row] + generator.normal(0.0, CAMERA_NOISE, 3)
            frames.append(Frame(truth.time[row] + CAMERA_DELAY, truth.time[row], seen))
    return frames


class Run(NamedTuple):
    """One play with one set of sensors, at every step."""

    error: Array
    """Of position [m], velocity [m/s] and spin [rad/s], shape (N, 7)."""
    inside: NDArray[np.bool_]
    """The 90 % interval of each holds the truth."""
    on_string: NDArray[np.bool_]
    """As estimated."""


def run(truth: Truth, model: Model, sensors: str, seed: int) -> Run:
    generator = np.random.default_rng(seed)  # the same noise for all sensors
    start = State(
        truth.position[0] + generator.normal(0.0, 0.01, 3),
        truth.velocity[0] + generator.normal(0.0, 0.05, 3),
        truth.spin[0] * (1.0 + generator.normal(0.0, 0.02)),
        string_state="on_string",
        axis=truth.axle[0],
    )
    pulls = truth.forces + generator.normal(0.0, FORCE_NOISE, truth.forces.shape)
    frames = filmed(truth, generator) if "camera" in sensors else []
    spread = Spread(0.01, 0.05, 0.02 * abs(truth.spin[0]), 0.02)
    estimator = Estimator(model, start, truth.tips[0], time=truth.time[0], spread=spread)
    errors, inside, on_string = [], [], []
    for row in range(1, len(truth.time)):
        dt = truth.time[row] - truth.time[row - 1]
        estimator.step(*truth.tips[row], dt=dt, velocities=truth.tip_velocities[row])
        if "forces" in sensors:
            estimator.forces(*pulls[row], noise=FORCE_NOISE)
        if "tensions" in sensors:
            left, right = np.linalg.norm(truth.forces[row], axis=1) + generator.normal(0.0, FORCE_NOISE, 2)
            estimator.tensions(left, right, noise=FORCE_NOISE)
        while frames and frames[0].known <= truth.time[row]:
            frame = frames.pop(0)
            estimator.camera(frame.seen, frame.position, noise=CAMERA_NOISE)
        now = estimator.now
        true = np.concatenate([truth.position[row], truth.velocity[row], truth.spin[row : row + 1]])
        low, high = now.interval(0.9)
        errors.append(now.state.to_array()[:7] - true)
        inside.append((low <= true) & (true <= high))
        on_string.append(now.state.string_state == 0)
    return Run(np.array(errors), np.array(inside), np.array(on_string))


def held_frames(truth: Truth, seed: int) -> Array:
    """How far the last frame is off, as it comes [m]."""
    frames = filmed(truth, np.random.default_rng(seed))
    known = np.array([frame.known for frame in frames])
    last = np.searchsorted(known, truth.time, side="right") - 1
    seen = np.array([frame.position for frame in frames])
    distance: Array = np.linalg.norm(seen[last] - truth.position, axis=1)
    return distance[last >= 0]


class Figures(NamedTuple):
    """Of the plays of one motion with one set of sensors."""

    position: float
    """Median over all times and plays [mm]."""
    position_95: float
    """95th percentile [mm]."""
    velocity: float
    """Median [m/s]."""
    spin: float
    """Median over the plays, after the last step [%]."""
    spin_worst: float
    covered: float
    """Share of the 90 % intervals of all seven numbers that hold the truth [%]."""
    string: float
    """Share of the times at which taut or not is right [%]."""


def figures(plays: list[tuple[Truth, Run]]) -> Figures:
    position = 1e3 * np.concatenate([np.linalg.norm(run.error[:, :3], axis=1) for _, run in plays])
    velocity = np.concatenate([np.linalg.norm(run.error[:, 3:6], axis=1) for _, run in plays])
    spin = [100.0 * abs(run.error[-1, 6]) / abs(truth.spin[-1]) for truth, run in plays]
    right = [np.mean(run.on_string == truth.on_string[1:]) for truth, run in plays]
    return Figures(
        float(np.median(position)),
        float(np.percentile(position, 95)),
        float(np.median(velocity)),
        float(np.median(spin)),
        max(spin),
        100.0 * float(np.mean([run.inside.mean() for _, run in plays])),
        100.0 * float(np.mean(right)),
    )


def play(program: Path, motion: str, number: int, first: int, folder: Path) -> tuple[Truth, Model, int]:
    seed = [first, list(MOTIONS).index(motion), number]
    generator = np.random.default_rng(seed)
    asked = scenario(motion, lambda low, high: float(generator.uniform(low, high)))
    asked["seed"] = number
    plant.play(program, asked, folder / "play.csv", folder / "truth.csv")
    model = wrong_model(asked, lambda low, high: float(generator.uniform(low, high)))
    return read_truth(folder / "truth.csv"), model, int(generator.integers(2**31))


def axle_turned(truth: Truth) -> float:
    """How far the axle has turned from where it was at first, after the last step [degrees]."""
    return math.degrees(math.acos(min(1.0, max(-1.0, float(truth.axle[-1] @ truth.axle[0])))))


def act(arguments: argparse.Namespace) -> int:
    plant.check(arguments.plant)
    print(
        "| motion | sensors | position, median [mm] | 95 % [mm] | velocity [m/s] | spin at the end [%] "
        "| worst [%] | intervals [%] | taut or not [%] |\n|" + "---|" * 9
    )
    everything: dict[str, Any] = {}
    turned: dict[str, list[float]] = {}
    all_runs: dict[str, list[tuple[Truth, Run]]] = {sensors: [] for sensors in SENSORS}
    with tempfile.TemporaryDirectory() as name:
        for motion in MOTIONS:
            plays = [
                play(arguments.plant, motion, number, arguments.seed, Path(name))
                for number in range(arguments.plays)
            ]
            turned[motion] = [axle_turned(truth) for truth, _, _ in plays]
            frames = 1e3 * np.concatenate([held_frames(truth, seed) for truth, _, seed in plays])
            middle, most = np.percentile(frames, [50, 95])
            print(f"| {motion} | last frame | {middle:.1f} | {most:.1f} | | | | | |")
            for sensors in SENSORS:
                runs = [(truth, run(truth, model, sensors, seed)) for truth, model, seed in plays]
                all_runs[sensors] += runs
                everything[f"{motion}, {sensors}"] = show(motion, sensors, figures(runs))
    for sensors, runs in all_runs.items():
        everything[sensors] = show("all", sensors, figures(runs))
    print("\nDegrees by which each play's axle has turned at its end: ", end="")
    print("; ".join(f"{motion} {', '.join(f'{a:.0f}' for a in angles)}" for motion, angles in turned.items()))
    everything["axle turned [degrees]"] = turned
    if arguments.json:
        arguments.json.write_text(json.dumps(everything, indent=2) + "\n", encoding="utf-8")
    return 0


def show(motion: str, sensors: str, found: Figures) -> dict[str, float]:
    print(
        f"| {motion} | {sensors} | {found.position:.1f} | {found.position_95:.1f} | {found.velocity:.3f} "
        f"| {found.spin:.1f} | {found.spin_worst:.1f} | {found.covered:.0f} | {found.string:.0f} |",
        flush=True,
    )
    return found._asdict()


def main() -> int:
    parser = command.make_parser(
        "benchmarks.proof.estimation", __doc__, "  python -m benchmarks.proof.estimation --plays 6"
    )
    plant.add_option(parser)
    parser.add_argument("--plays", metavar="N", type=int, default=6, help="of each motion; default: 6")
    parser.add_argument("--seed", metavar="N", type=int, default=2, help="of the draws; default: 2")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write the figures, too")
    return command.run(parser, act)


if __name__ == "__main__":
    sys.exit(main())
