# SPDX-License-Identifier: MIT
"""Moving pictures of the tasks, as SVG that moves by itself, and learning curves."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
from diabolo import StringState
from diabolo.envs import Agent, play, shipped_agent
from diabolo.envs.picture import INK, string_curve
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

FRAMES = 10  # a second; between them the picture is interpolated
LONGEST = 3.0  # [s]
SCALE = 150.0  # pixels a metre
MARGIN = 16  # pixels
MOST_SPIN = 200.0  # of the bar [rad/s]
SOFT = "#9ca3af"

FIGURES: dict[str, list[tuple[str, dict[str, Any]]]] = {
    "Hold": [("stop", {})],
    "Swing": [("swing", {})],
    "SpinUp": [("linear_acceleration", {})],
    "SpinUpCircle": [("circular_acceleration", {})],
    "Hop": [("hop", {"cycles": 2})],
    "Throw": [("throw", {"height": 0.6})],
    "ThrowAndCatch": [("throw_and_catch", {"height": 0.6})],
    "Pass": [("side_throw", {"sideways": -0.8})],
    "Routine": [("linear_acceleration", {}), ("throw_and_catch", {"height": 0.5})],
    "Level": [("stop", {})],
}
"""What the planner plays of a task that has no agent in the package: figures, one after the other."""


@dataclass(frozen=True)
class Play:
    """Moments of a play, FRAMES a second: tips and diabolo, shape (n, 2) to the right and up [m], whether it
    flies, its spin [rad/s], and the string's length [m]."""

    left: NDArray[np.float64]
    right: NDArray[np.float64]
    diabolo: NDArray[np.float64]
    flies: NDArray[np.bool_]
    spin: NDArray[np.float64]
    string_length: float


def played(task: str) -> Play:
    """A play of a task, as caption_of() has it."""
    agent = _agent(task)
    return planned(task) if agent is None else acted(agent)


def caption_of(task: str) -> str:
    """Who plays: the agent of the package, or else the planner."""
    if _agent(task):
        return f"The agent of the package plays: `diabolo play {task}`."
    commands = ", then ".join(f"`{_command(figure, wanted)}`" for figure, wanted in FIGURES[task])
    return f"A figure like the task, by the planner, under wider limits than an agent's: {commands}."


def acted(agent: Agent) -> Play:
    """The beginning of an agent's first episode."""
    poses: list[Any] = []
    play(agent, 1, watch=lambda env: poses.append(env.pose(0)))
    times = np.arange(0.0, min(LONGEST, agent.period * len(poses)), 1.0 / FRAMES)
    shown = [poses[int(time / agent.period)] for time in times]
    states = np.array([[*state.position, *state.velocity, state.spin] for state, _, _ in shown])
    flies = np.array([state.string_state is StringState.FLYING for state, _, _ in shown])
    left, right = (np.array([pose[side] for pose in shown]) for side in (1, 2))
    return _seen(left, right, states, flies)


def planned(task: str) -> Play:
    """The task's figures, as the planner plays them, each from where the one before ends."""
    plays: list[diabolo.PlannedPlay] = []
    for figure, wanted in FIGURES[task]:
        end = plays[-1].states[-1] if plays else None
        start = None if end is None else diabolo.State(end[:3], velocity=end[3:6], spin=end[6])
        plays.append(diabolo.plan_action(figure, start=start, **wanted))
    rows = [np.searchsorted(one.time, np.arange(0.0, one.time[-1], 1.0 / FRAMES)) for one in plays]
    left, right, states, strings = (
        np.concatenate([getattr(one, name)[row] for one, row in zip(plays, rows, strict=True)])
        for name in ("left", "right", "states", "string_states")
    )
    return _seen(left, right, states, strings == StringState.FLYING)


def _agent(task: str) -> Agent | None:
    try:
        return shipped_agent(task)
    except ValueError:
        return None


def _command(figure: str, wanted: dict[str, Any]) -> str:
    options = (
        f"--cycles {value}" if name == "cycles" else f"--goal {name}={value}"
        for name, value in wanted.items()
    )
    return " ".join(["diabolo plan", figure, *options])


def _seen(
    left: NDArray[np.float64],
    right: NDArray[np.float64],
    states: NDArray[np.float64],
    flies: NDArray[np.bool_],
) -> Play:
    """From behind the player: y points to the left."""
    across = [np.stack([-one[:, 1], one[:, 2]], axis=1) for one in (left, right, states)]
    return Play(*across, flies, states[:, 6], diabolo.Parameters().string_length)


# ---- the moving picture ----


def svg_of(play: Play) -> str:
    """A picture that moves by itself: string, tips, diabolo, and a bar as long as the spin."""
    every = np.concatenate([play.left, play.right, play.diabolo])
    low, high = every.min(axis=0), every.max(axis=0)
    width, height = np.rint((high - low) * SCALE).astype(int) + 2 * MARGIN

    def at(points: NDArray[np.float64]) -> NDArray[np.int64]:
        across, up = np.rint((points - low) * SCALE).astype(int).T
        return np.stack([across + MARGIN, height - MARGIN - up], axis=1)

    string = [
        f"M{_text(left)}q{_text(a - left)} {_text(middle - left)}q{_text(b - middle)} {_text(right - middle)}"
        for left, a, middle, b, right in zip(*(at(points) for points in _string(play)), strict=True)
    ]
    bar = np.rint(height * np.clip(play.spin / MOST_SPIN, 0.0, 1.0)).astype(int)
    ends = f'<marker id="tip" overflow="visible"><circle r="2" fill="{INK["tips"]}"/></marker>'
    tips = 'marker-start="url(#tip)" marker-end="url(#tip)"'
    paths = [
        ends,
        _moving([f"M2 {height}v{-one}" for one in bar], f'stroke="{SOFT}" stroke-width="4"'),
        _moving(string, f'stroke="{INK["string"]}" stroke-width="2" {tips}'),
        _moving(
            [f"M{_text(one)}h0" for one in at(play.diabolo)],
            f'stroke="{INK["diabolo"]}" stroke-width="18" stroke-linecap="round"',
        ),
    ]
    size = f'viewBox="0 0 {width} {height}" width="{width}" height="{height}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} fill="none" style="background:#fff">'
    return "\n".join([head, *paths, "</svg>"]) + "\n"


def _string(play: Play) -> tuple[NDArray[np.float64], ...]:
    """Five points of two parabolas: end, control, middle, control, end. Taut, they are straight."""
    left, right = play.left, play.right
    middle = play.diabolo.copy()
    controls = [0.5 * (left + middle), 0.5 * (right + middle)]
    for row in np.flatnonzero(play.flies):
        ends = [np.array([0.0, *one[row]]) for one in (left, right)]
        curve = string_curve(*ends, play.string_length)[:, 1:]
        middle[row] = curve[20]
        lowest = 2.0 * middle[row] - 0.5 * (left[row] + right[row])  # where the tangents at the ends meet
        controls[0][row], controls[1][row] = 0.5 * (left[row] + lowest), 0.5 * (right[row] + lowest)
    return left, controls[0], middle, controls[1], right


def _text(point: NDArray[np.int64]) -> str:
    return f"{point[0]} {point[1]}"


def _moving(shapes: list[str], style: str) -> str:
    timing = f'dur="{len(shapes) / FRAMES:.2f}s" repeatCount="indefinite"'
    values = ";".join(shapes).replace(" -", "-")
    return f'<path {style} d="{shapes[0]}"><animate attributeName="d" {timing} values="{values}"/></path>'


# ---- the learning curve ----


def draw_curve(path: Path, folders: list[Path]) -> None:
    """Returns of trainings over their control steps: median, and the range of all."""
    curves = [_curve(folder / "progress.csv") for folder in folders]
    least = max(steps[0] for steps, _ in curves)
    most = min(steps[-1] for steps, _ in curves)
    steps = np.linspace(least, most, 100)
    worth = np.array([np.interp(steps, *curve) for curve in curves])
    figure = Figure(figsize=(4.6, 2.6), layout="constrained")
    axes = figure.subplots()
    axes.fill_between(
        steps / 1e6, worth.min(axis=0), worth.max(axis=0), color=INK["string"], alpha=0.25, lw=0
    )
    axes.plot(steps / 1e6, np.median(worth, axis=0), color=INK["string"], lw=2)
    axes.set(xlabel="control steps [million]", ylabel="mean return", title=f"{len(curves)} trainings")
    axes.grid(alpha=0.25)
    with io.BytesIO() as data:
        figure.savefig(data, format="png", dpi=100, facecolor="white")
        Image.open(data).convert("RGB").quantize(32, dither=Image.Dither.NONE).save(path, optimize=True)


def _curve(path: Path) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Control steps and mean returns, from where the first episodes are over."""
    with path.open(encoding="utf-8", newline="") as file:
        rows = np.array([[float(row["steps"]), float(row["worth"])] for row in csv.DictReader(file)])
    known = rows[np.isfinite(rows[:, 1])]
    return known[:, 0], known[:, 1]
