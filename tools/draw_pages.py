# SPDX-License-Identifier: MIT
"""Draws the diagrams of the pages in docs/: draw_pages.py [models] [robot], by default all of them."""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch
from numpy.typing import NDArray

DOCS = Path(__file__).resolve().parents[1] / "docs"
STRING, DIABOLO, TIP, QUIET = "#c44e00", "#1f5fa8", "#222222", "#777777"

STRING_LENGTH = 1.45  # [m]
TIP_DISTANCE = 0.8  # [m]


def box(axes: Axes, x: float, y: float, title: str, text: str, width: float, height: float) -> None:
    """A rounded box around (x, y) with a title and smaller text below it."""
    corner = (x - width / 2, y - height / 2)
    shape = FancyBboxPatch(corner, width, height, boxstyle="round,pad=0.02", fc="#eef3f9", ec=DIABOLO, lw=1.2)
    axes.add_patch(shape)
    lines = text.count("\n") + 1 if text else 0
    axes.text(x, y + 0.045 * lines, title, ha="center", va="center", weight="bold", size=9)
    axes.text(x, y - 0.055, text, ha="center", va="center", size=7.5, color=TIP)


def arrow(axes: Axes, begin: tuple[float, float], end: tuple[float, float], bend: float = 0.0) -> None:
    style = {"arrowstyle": "-|>", "color": TIP, "lw": 1.2, "connectionstyle": f"arc3,rad={bend}"}
    axes.annotate("", end, begin, arrowprops=style)


def push(axes: Axes, begin: NDArray[np.float64], end: NDArray[np.float64], color: str) -> None:
    """A force at a point."""
    style = {"arrowstyle": "-|>", "color": color, "lw": 2}
    axes.annotate("", (end[0], end[1]), (begin[0], begin[1]), arrowprops=style)


def draw_spheroid(axes: Axes) -> None:
    """A section of the spheroid through both tips, seen from behind the player: y to the left."""
    major, focus = STRING_LENGTH / 2, TIP_DISTANCE / 2
    minor = float(np.sqrt(major**2 - focus**2))
    turn = np.linspace(0.0, 2.0 * np.pi, 400)
    axes.plot(major * np.cos(turn), minor * np.sin(turn), "--", color=QUIET, lw=1)
    point = np.array([major * np.cos(-2.1), minor * np.sin(-2.1)])
    tips = np.array([[-focus, 0.0], [focus, 0.0]])
    for tip, name in zip(tips, ("left tip $l$", "right tip $r$"), strict=True):
        axes.plot(*zip(tip, point, strict=True), color=STRING, lw=2)
        axes.plot(*tip, "o", color=TIP, ms=6)
        axes.text(tip[0], 0.05, name, ha="center", size=9)
    pull = sum(((tip - point) / np.linalg.norm(tip - point) for tip in tips), np.zeros(2))
    push(axes, point, point + 0.17 * pull, STRING)
    axes.text(-0.19, -0.2, r"pull $-T\,\nabla S$", ha="center", size=9, color=STRING)
    push(axes, point, point - [0.0, 0.2], DIABOLO)
    axes.text(point[0] + 0.03, point[1] - 0.17, r"$m\,g$", size=9, color=DIABOLO)
    axes.plot(*point, "o", color=DIABOLO, ms=11)
    axes.text(point[0] - 0.04, point[1] - 0.08, "diabolo $p$", ha="right", size=9, color=DIABOLO)
    axes.plot([-major, major], [0.0, 0.0], ":", color=QUIET, lw=0.8)
    axes.text(0.0, 0.34, "FLYING\nabove the tips' plane", ha="center", va="center", size=8, color=QUIET)
    axes.text(0.27, -0.33, "LOOSE\ninside", ha="center", va="center", size=8, color=QUIET)
    axes.text(
        0.3, -0.76, "ON_STRING on the spheroid:\n$S = |p-l| + |p-r| = L$", ha="center", size=8, color=QUIET
    )
    axes.set_xlim(-0.86, 0.86)
    axes.set_ylim(-0.86, 0.66)
    axes.set_aspect("equal")


def draw_states(axes: Axes) -> None:
    size = {"width": 0.26, "height": 0.16}
    box(axes, 0.16, 0.25, "ON_STRING", "the string pulls", **size)
    box(axes, 0.84, 0.25, "LOOSE", "nothing pulls", **size)
    box(axes, 0.5, 0.82, "FLYING", "off the string", **size)
    arrow(axes, (0.31, 0.29), (0.69, 0.29), -0.15)
    arrow(axes, (0.69, 0.21), (0.31, 0.21), -0.15)
    arrow(axes, (0.16, 0.36), (0.36, 0.82), -0.2)
    arrow(axes, (0.78, 0.36), (0.56, 0.72))
    arrow(axes, (0.64, 0.82), (0.86, 0.36), -0.25)
    texts = [
        (0.5, 0.37, "slack > 1 cm"),
        (0.5, 0.11, "the string comes taut"),
        (0.44, 0.57, "slack > 5 cm, above\nand between the tips,\nno wrap"),
        (0.98, 0.71, "falls through the\ntips' plane, tight\nstring under it"),
    ]
    for x, y, text in texts:
        axes.text(x, y, text, ha="center", va="center", size=8)
    axes.set_xlim(0.0, 1.1)
    axes.set_ylim(0.0, 1.0)


def draw_models() -> Figure:
    figure = Figure(figsize=(9.0, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    draw_spheroid(left)
    draw_states(right)
    for axes in (left, right):
        axes.set_axis_off()
    return figure


def draw_robot() -> Figure:
    """From the motion of the tips to the arms, and what each link may refuse or slow down."""
    figure = Figure(figsize=(9.0, 2.5), layout="constrained")
    axes = figure.subplots()
    chain = [
        ("Tips", "a plan or\na recording", "every 2 ms"),
        ("Joints", "seed grid,\nexact tip", "outside the box:\nnot played"),
        ("Limits", "speed,\nacceleration,\njerk", "too fast:\ntime is stretched"),
        ("Blending", "a new motion\njoins midway", "0.2 to 1.6 s"),
        ("Guard", "every setpoint\nis checked", "a fault:\nboth arms brake"),
        ("Arms", "two UR5e,\nservoj", "500 setpoints a second"),
    ]
    for number, (title, text, note) in enumerate(chain):
        x = 0.5 + number
        box(axes, x, 0.62, title, text, width=0.66, height=0.42)
        axes.text(x, 0.2, note, ha="center", va="center", size=8, color=STRING)
        if number:
            arrow(axes, (x - 0.63, 0.62), (x - 0.35, 0.62))
    for begin, end, folder in (
        (1.15, 1.85, "robot/arm"),
        (2.15, 3.85, "robot/motion"),
        (4.15, 5.85, "robot/control"),
    ):
        axes.plot([begin, end], [0.93, 0.93], color=QUIET, lw=1)
        axes.text((begin + end) / 2, 0.96, folder, ha="center", size=8, color=QUIET, family="monospace")
    axes.set_xlim(0.0, 6.0)
    axes.set_ylim(0.08, 1.05)
    axes.set_axis_off()
    return figure


DIAGRAMS = {"models": draw_models, "robot": draw_robot}


def main(names: list[str]) -> int:
    if unknown := [name for name in names if name not in DIAGRAMS]:
        print(f"draw_pages.py: unknown page {unknown[0]}; expected {', '.join(DIAGRAMS)}", file=sys.stderr)
        return 2
    mpl.rcParams["font.family"] = "DejaVu Sans"  # comes with matplotlib
    for name in names or DIAGRAMS:
        DIAGRAMS[name]().savefig(
            DOCS / f"{name}.png", dpi=110, facecolor="white", metadata={"Software": None}
        )
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
