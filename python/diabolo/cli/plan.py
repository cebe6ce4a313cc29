# SPDX-License-Identifier: MIT
"""`diabolo plan`: stick motions that make the diabolo do what is wanted."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import files
from .._core import (
    DiaboloProperties,
    DiagnosisResult,
    PlannedPlay,
    Recording,
    RobotLimits,
    SeedGrid,
    StickArm,
    StickMap,
    TipLimits,
    Waypoint,
    played_properties,
    played_recording,
)
from ..enums import StringState
from ..evaluation import DEFAULT_MODELS
from ..formats import load_recording
from ..player import ACTIONS, WANTED, best_guess, model_for, plan_action
from ..view import view_html
from . import plots
from .arguments import add_command, output_name, read_model
from .simulate import check_spin

SCHEMA = "diabolo.plan/1"
RATE = 240.0  # of the recording that is written [Hz]
GOALS = ("height", "sideways", "spin")
JOINT_LIMITS = ("joint_speed", "joint_acceleration", "joint_jerk")
LIMITS = ("speed", "acceleration", "jerk", *JOINT_LIMITS)


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "plan",
        run=run,
        summary="find stick motions for a figure of play",
        text="Find a motion of the stick tips that makes the diabolo do a figure. Write it, with the\n"
        "predicted play, as a tidy recording, a picture and a page.\n\n"
        "exit status: 0 where every goal is reached, 1 where one is missed (the closest plan is written),\n"
        "2 for bad input.",
        example="  diabolo plan throw_and_catch --goal height=0.6 --out throw.csv --html throw.html\n"
        "  diabolo plan throw --model d/model.json --diagnosis d/diagnosis.json --recording TAKE.csv\n"
        "  diabolo plan swing --robots",
    )
    parser.add_argument("action", metavar="ACTION", choices=ACTIONS, help=", ".join(ACTIONS))
    parser.add_argument(
        "--goal",
        metavar="NAME=X",
        action="append",
        default=[],
        help="height: of a throw's apex above the tips, or of a hop [m]; sideways: to the left [m]; "
        "spin: gained by a cycle [rad/s]; may be repeated",
    )
    parser.add_argument(
        "--limit",
        metavar="NAME=X",
        action="append",
        default=[],
        help="of the tips: speed (4 m/s), acceleration (60 m/s^2), jerk (none); with --robots also "
        "joint_speed (2.98 rad/s), joint_acceleration (15 rad/s^2), joint_jerk (500 rad/s^3), of "
        "which plans use 97 %%; may be repeated",
    )
    parser.add_argument(
        "--robots",
        action="store_true",
        help="keep to what two UR5e mounted as in the paper can play: reach, joints, 0.1 m between the arms",
    )
    parser.add_argument(
        "--model",
        metavar="NAME",
        default="consistent",
        help="the model to plan on: consistent (default), paper, published or a model file",
    )
    parser.add_argument(
        "--recording",
        metavar="TAKE.csv",
        help="a take of the set-up: its string length, mass and axle radius, which a diagnosed model "
        "leaves open",
    )
    parser.add_argument(
        "--diagnosis",
        metavar="FILE.json",
        help="what `diabolo diagnose` wrote beside the model: corrects the string's length, and adds the "
        "drag and lift that it estimated but did not claim",
    )
    parser.add_argument("--cycles", metavar="N", type=int, default=1, help="cycles in a row; default 1")
    parser.add_argument(
        "--spin", metavar="W", type=float, default=100.0, help="spin at the start [rad/s]; default 100"
    )
    parser.add_argument(
        "--size", metavar="X", type=float, default=1.0, help="scale of the seed motion; default 1"
    )
    parser.add_argument(
        "--pace", metavar="X", type=float, default=1.0, help="pace of the seed motion; default 1"
    )
    parser.add_argument(
        "--solver", choices=("gradient", "walk"), default="gradient", help="default: gradient"
    )
    parser.add_argument(
        "--seconds", metavar="S", type=float, default=10.0, help="budget of each search [s]; default 10"
    )
    parser.add_argument("--random-seed", metavar="N", type=int, default=1, help="seed of the walk; default 1")
    parser.add_argument(
        "--out", metavar="FILE.csv", type=output_name, help="write tips and diabolo, with FILE.json beside it"
    )
    parser.add_argument("--plot", metavar="FILE", type=output_name, help="draw a picture (.png, .pdf, .svg)")
    parser.add_argument(
        "--html", metavar="FILE", type=output_name, help="write a page that shows it in three dimensions"
    )
    parser.add_argument("--json", metavar="FILE", help="write a summary as JSON; - is standard output")


def run(arguments: argparse.Namespace) -> int:
    """0, or 1 where a goal is missed."""
    out = Path(arguments.out) if arguments.out else None
    if out is not None and out.suffix != ".csv":
        raise ValueError(f"{out}: expected a name that ends in .csv")
    inputs = [arguments.model] if arguments.model not in DEFAULT_MODELS else []
    inputs += [file for file in (arguments.recording, arguments.diagnosis) if file is not None]
    beside = out.with_suffix(".json") if out else None
    files.check_outputs([out, beside, arguments.plot, arguments.html, arguments.json], inputs)
    if arguments.plot:
        plots.check(arguments.plot)
    check_spin(arguments.spin, RATE)
    goals = _numbers("--goal", arguments.goal, GOALS)
    for name in goals:
        those = WANTED["spin_gain" if name == "spin" else name]
        if arguments.action not in those:
            raise ValueError(
                f"--goal {name}: nothing that {arguments.action} can aim at; expected with {', '.join(those)}"
            )
    usual = TipLimits()
    asked = _numbers("--limit", arguments.limit, LIMITS)
    joints = {name.removeprefix("joint_"): asked[name] for name in JOINT_LIMITS if name in asked}
    if joints and not arguments.robots:
        raise ValueError(f"--limit joint_{next(iter(joints))}: counts with --robots only")
    others: Any = _robot_limits(joints) if arguments.robots else None
    limits = TipLimits(
        speed=asked.get("speed", usual.speed),
        acceleration=asked.get("acceleration", usual.acceleration),
        jerk=asked.get("jerk", usual.jerk),
        others=others,
    )
    model = read_model(arguments.model)
    if arguments.recording:
        model = model_for(model, load_recording(arguments.recording))
    if arguments.diagnosis:
        result = DiagnosisResult.load(arguments.diagnosis)
        try:
            model = best_guess(model, result)
        except ValueError as error:
            raise ValueError(f"{arguments.diagnosis}: {error}") from None
    played = plan_action(
        arguments.action,
        model,
        cycles=arguments.cycles,
        spin=arguments.spin,
        size=arguments.size,
        pace=arguments.pace,
        limits=limits,
        solver=arguments.solver,
        seconds=arguments.seconds,
        random_seed=arguments.random_seed,
        height=goals.get("height"),
        sideways=goals.get("sideways"),
        spin_gain=goals.get("spin"),
    )
    found = summary(played, model.name)
    title = out.stem if out else arguments.action
    p = model.parameters
    recording = recording_of(played, title, played_properties(p), p.string_length)
    if out:
        recording.save(out)
    if arguments.plot:
        plots.draw_plan(arguments.plot, played)
    if arguments.html:
        page = view_html(recording, goals=wanted_states(played), note=played.answer)
        files.write_texts({Path(arguments.html): page})
    files.write_json(arguments.json, found)
    if arguments.json != files.STDOUT:
        print(text_of(found))
    return 0 if played.reached else 1


def recording_of(
    played: PlannedPlay, title: str, properties: DiaboloProperties, string_length: float
) -> Recording:
    """The plan as a recording, RATE samples a second."""
    time = np.arange(int(played.time[-1] * RATE + 1e-6) + 1) / RATE
    nearest = np.clip(np.searchsorted(played.time, time), 1, len(played.time) - 1)
    share = (time - played.time[nearest - 1]) / (played.time[nearest] - played.time[nearest - 1])

    def between(rows: NDArray[np.float64]) -> NDArray[np.float64]:
        return rows[nearest - 1] + share[:, None] * (rows[nearest] - rows[nearest - 1])

    tips = played.path.derivatives(np.minimum(time, played.path.end))[0]
    axis = between(played.axis)
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    return played_recording(
        title,
        time,
        tips[:, :3],
        tips[:, 3:],
        between(played.states),
        RATE,
        properties,
        string_length,
        axis,
    )


def wanted_states(played: PlannedPlay) -> list[Waypoint]:
    """The states that were wanted, of the first plan of each kind."""
    wanted: list[Waypoint] = []
    for one in played.wanted:
        wanted += one.waypoints
        if one.final_state is not None:
            wanted.append(one.final_state)
        if one.landing is not None:
            wanted.append(Waypoint(one.landing))
    return wanted


def summary(played: PlannedPlay, model: str) -> dict[str, Any]:
    """The figures, for JSON of the schema diabolo.plan/1."""
    flying = played.string_states == StringState.FLYING
    release = played.path.derivatives(np.array([played.plans[0].path.end]))[0][0]
    above = played.states[:, 2] - 0.5 * (release[2] + release[5])  # the tips at the throw's end
    return {
        "schema": SCHEMA,
        "action": played.action,
        "model": model,
        "reached": played.reached,
        "answer": played.answer,
        "duration_s": float(played.path.end - played.path.begin),
        "planning_s": played.planning_time,
        "spin_rad_s": [float(played.states[0, 6]), float(played.states[-1, 6])],
        "highest_above_tips_m": float(above[flying].max()) if flying.any() else None,
        "flight_s": float(np.sum(np.diff(played.time)[flying[1:]])),
        "plans": [
            {
                "cost": plan.cost,
                "evaluations": plan.evaluations,
                "reached": plan.reached,
                "goals": [
                    {
                        "name": goal.name,
                        "error": goal.error,
                        "tolerance": goal.tolerance,
                        "unit": goal.unit,
                        "reached": goal.reached,
                    }
                    for goal in plan.goals
                ],
                "limits": [
                    {
                        "name": use.name,
                        "value": use.value,
                        "limit": use.limit,
                        "unit": use.unit,
                        "time": use.time,
                    }
                    for use in plan.limits
                    if math.isfinite(use.limit)
                ],
            }
            for plan in played.plans
        ],
    }


def text_of(found: dict[str, Any]) -> str:
    before, after = found["spin_rad_s"]
    text = (
        f"{found['action']}: {found['answer']}; {found['duration_s']:.2f} s of motion planned in "
        f"{1e3 * found['planning_s']:.0f} ms; spin {before:.1f} to {after:.1f} rad/s"
    )
    if found["highest_above_tips_m"] is not None:
        text += (
            f"; flight {found['flight_s']:.2f} s, up to {found['highest_above_tips_m']:.2f} m above the tips"
        )
    return text


def _robot_limits(joints: dict[str, float]) -> RobotLimits:
    """Those of the paper's two arms."""
    arms = [StickArm(side) for side in ("left", "right")]
    left, right = (StickMap(arm, SeedGrid.build(arm)) for arm in arms)
    return RobotLimits(left, right, **joints)


def _numbers(option: str, given: list[str], known: tuple[str, ...]) -> dict[str, float]:
    """NAME=X of an option that may be given again."""
    numbers: dict[str, float] = {}
    for text in given:
        name, _, value = text.partition("=")
        if name not in known:
            raise ValueError(f"{option} {text}: expected NAME=X with one of {', '.join(known)}")
        if name in numbers:
            raise ValueError(f"{option} {text}: {name} is given twice")
        try:
            numbers[name] = float(value)
        except ValueError:
            raise ValueError(f"{option} {text}: '{value}' is no number") from None
        if not math.isfinite(numbers[name]):
            raise ValueError(f"{option} {text}: expected a finite number")
    return numbers
