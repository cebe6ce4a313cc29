# SPDX-License-Identifier: MIT
"""`diabolo robot`: whether two arms can play a plan, and what their seed grids are like."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

import numpy as np

from .. import files
from .._core import (
    SeedGrid,
    StickArm,
    StickMap,
    TipMotion,
    check_plan,
    load_tip_plan,
    recorded_plan,
)
from ..formats import load_recording
from .arguments import add_command, output_name
from .tables import format_table

SAMPLES = 20  # along each side of a grid's box, for the map of speeds
SLOWED = 1.0005  # times the planned duration from which a motion counts as slowed down
STATUS_UNPLAYABLE, STATUS_SLOWED = 1, 3
LARGEST_SHIFT = 100.0  # [m]


def add_parser(commands: Any) -> None:
    parser = commands.add_parser(
        "robot",
        help="see what two UR5e with sticks can play",
        description="What two UR5e with sticks, mounted as in the paper or otherwise, can play.",
        allow_abbrev=False,
    )
    actions = parser.add_subparsers(metavar="ACTION", required=True)
    _add_check(actions)
    _add_grid(actions)


def _add_check(actions: Any) -> None:
    parser = add_command(
        actions,
        "check",
        run=run_check,
        summary="say whether two arms can play a plan, where not and why",
        text="Say whether two arms can play a motion of the stick tips from rest to rest: whether both tips\n"
        "are within reach, how much slower than planned the joints' limits ask for, and how close the arms\n"
        "come. PLAN.csv has the columns time, left_x, left_y, left_z, right_x, right_y, right_z (s, m,\n"
        "world frame: x forward, y left, z up); recordings will do, too.\n\n"
        "exit status: 0 where the arms play it as planned, 1 where they cannot play it, 2 for bad input,\n"
        "3 where they can, but slower: the diabolo will do something else than planned.",
        example="  diabolo robot check plan.csv\n"
        "  diabolo robot check throw_1.csv --shift 0.4 0 0.1 --height 0.75 --spacing 1.05",
    )
    parser.add_argument("plan", metavar="PLAN.csv", help="the motion of the tips")
    _add_mounts(parser)
    parser.add_argument(
        "--shift",
        metavar=("X", "Y", "Z"),
        nargs=3,
        type=float,
        default=[0.0, 0.0, 0.0],
        help="shift of the whole plan [m]",
    )
    parser.add_argument(
        "--speed", metavar="W", type=float, help="limit of the joints [rad/s]; default 0.95 pi"
    )
    parser.add_argument(
        "--acceleration", metavar="A", type=float, help="limit of the joints [rad/s^2]; default 15"
    )
    parser.add_argument("--jerk", metavar="J", type=float, help="limit of the joints [rad/s^3]; default 500")
    parser.add_argument(
        "--clearance",
        metavar="D",
        type=float,
        default=0.10,
        help="least distance between the arms [m]; default 0.1",
    )
    parser.add_argument("--json", metavar="FILE", help="write what was found as JSON; - is standard output")


def _add_grid(actions: Any) -> None:
    parser = add_command(
        actions,
        "grid",
        run=run_grid,
        summary="build an arm's IK seed grid, and print how fast the tip may go",
        text="Build the IK seed grid of an arm over the paper's box, and print how fast the tip may go\n"
        "before a joint exceeds pi rad/s, height by height: in the slowest direction, and along x, y and z.",
        example="  diabolo robot grid right --out right.csv",
    )
    parser.add_argument("side", choices=("left", "right"), help="which arm")
    _add_mounts(parser)
    parser.add_argument("--out", metavar="GRID.csv", type=output_name, help="write the key points")


def _add_mounts(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--height", metavar="H", type=float, default=0.70, help="height of the bases [m]; default 0.7"
    )
    parser.add_argument(
        "--spacing", metavar="S", type=float, default=1.10, help="distance between the bases [m]; default 1.1"
    )
    parser.add_argument(
        "--forward", metavar="X", type=float, default=0.0, help="x of the bases [m]; default 0"
    )


def run_check(arguments: argparse.Namespace) -> int:
    """0, or 1 where the plan cannot be played, 3 where it can, but slower."""
    files.check_outputs([arguments.json], [arguments.plan])
    limits = {
        name: value
        for name in ("speed", "acceleration", "jerk")
        if (value := getattr(arguments, name)) is not None
    }
    if not math.isfinite(arguments.clearance):
        raise ValueError(f"--clearance {arguments.clearance}: expected a finite number")
    motion = _shifted(_read(arguments.plan), arguments.shift)
    found = check_plan(
        _map("left", arguments),
        _map("right", arguments),
        motion,
        least_clearance=arguments.clearance,
        **limits,
    )
    for trouble in found["troubles"]:
        trouble["tip_m"] = trouble["tip_m"].tolist()
    ratio = _ratio(found)
    found["motion_s"] = float(motion.times[-1] - motion.times[0])
    found["slowed"] = None if ratio is None else ratio > SLOWED
    files.write_json(arguments.json, {"schema": "diabolo.robot_check/1", "file": arguments.plan, **found})
    if arguments.json != files.STDOUT:
        print(text_of(arguments.plan, found))
    if not found["playable"]:
        return STATUS_UNPLAYABLE
    return STATUS_SLOWED if found["slowed"] else 0


def run_grid(arguments: argparse.Namespace) -> None:
    files.check_outputs([arguments.out], [])
    solver = _map(arguments.side, arguments)
    grid = solver.grid
    if arguments.out:
        grid.save(arguments.out)
    lower, upper = grid.lower, grid.upper
    axes = [np.linspace(lower[k], upper[k], SAMPLES) for k in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    slowest = solver.slowest_tip_speed(points)  # (x, y, z)
    along = [solver.tip_speed(points, direction) for direction in np.eye(3)]
    misses = np.linalg.norm(solver.arm.tip_position(grid.seed(points)) - points, axis=-1)
    print(
        f"{arguments.side} arm: {' x '.join(map(str, grid.knots))} key points from "
        f"({', '.join(f'{x:.3f}' for x in lower)}) to ({', '.join(f'{x:.3f}' for x in upper)}) m; "
        f"seeds miss the tip by {1e3 * misses.mean():.1f} mm on average, {1e3 * misses.max():.1f} mm at most"
    )
    print(f"steepest: {math.pi / slowest.min():.2f} rad/m\n")
    print("speed of the tip at pi rad/s [m/s], least and median")
    rows = []
    for k in range(0, SAMPLES, 3):
        cells = [f"{axes[2][k]:.3f}"]
        for speed in (level[:, :, k] for level in (slowest, *along)):
            cells += [f"{speed.min():.2f}", f"{np.median(speed):.2f}"]
        rows.append(cells)
    print(format_table(["z [m]", "slowest", "", "along x", "", "along y", "", "along z", ""], rows))


def text_of(name: str, found: dict[str, Any]) -> str:
    ratio = _ratio(found)
    verdict = "can be played" if found["playable"] else "cannot be played"
    if found["playable"] and found["slowed"]:
        verdict += ", but slower than planned: the diabolo will do something else; see diabolo plan --robots"
    lines = [f"{name}: {verdict}"]
    if ratio is not None:
        pace = (
            "as fast as planned"
            if ratio <= SLOWED
            else (
                f"{ratio:.2f} times slower on the whole, {found['worst_factor']:.2f} times "
                f"at {found['worst_at_s']:.2f} s"
            )
        )
        rest = found["as_planned_s"] - found["motion_s"]
        lines.append(
            f"within the limits of the joints {pace}: {found['as_played_s']:.2f} s; planned are "
            f"{found['motion_s']:.2f} s of motion and {rest:.2f} s to start and to stop"
        )
        parts = found["nearest_parts"].replace(" and ", " to ")
        lines.append(f"least clearance: {found['least_clearance_m']:.3f} m, {parts}")
    if found["troubles"]:
        rows = [
            [
                f"{trouble['from_s']:.3f}",
                f"{trouble['to_s']:.3f}",
                trouble["who"],
                ", ".join(f"{x:.3f}" for x in trouble["tip_m"]),
                trouble["why"],
            ]
            for trouble in found["troubles"]
        ]
        lines += ["", format_table(["from [s]", "to [s]", "who", "first tip [m]", "why"], rows)]
    return "\n".join(lines)


def _ratio(found: dict[str, Any]) -> float | None:
    """How many times longer the play takes than the plan; None where a tip is not reached."""
    return None if found["as_played_s"] is None else found["as_played_s"] / found["as_planned_s"]


def _map(side: str, arguments: argparse.Namespace) -> StickMap:
    arm = StickArm(side, height=arguments.height, spacing=arguments.spacing, forward=arguments.forward)
    return StickMap(arm, SeedGrid.build(arm))


def _read(path: str) -> TipMotion:
    if Path(path).is_file():
        with open(path, encoding="utf-8-sig", errors="replace") as file:
            if file.readline(80).lstrip('"').startswith("Format Version"):
                return recorded_plan(load_recording(path))
        if Path(path).with_suffix(".json").is_file():  # a tidy recording, which may have dropouts
            return recorded_plan(load_recording(path))
    return load_tip_plan(path)


def _shifted(motion: TipMotion, shift: list[float]) -> TipMotion:
    if not all(abs(x) <= LARGEST_SHIFT for x in shift):
        raise ValueError(f"--shift {' '.join(map(str, shift))}: expected numbers within {LARGEST_SHIFT:g} m")
    if not any(shift):
        return motion
    return TipMotion(motion.times, motion.left + shift, motion.right + shift, motion.interpolation)
