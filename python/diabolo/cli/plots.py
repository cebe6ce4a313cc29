# SPDX-License-Identifier: MIT
"""Pictures; the only module that needs matplotlib."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import Model, PlannedPlay, baseline
from ..checks import check_drawing
from ..enums import StringState
from ..evaluation import ALL_RECORDINGS, Evaluation, HorizonRow, position_errors, predict
from ..excerpt import Excerpt
from ..files import whole_file

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BASELINE_STYLE: dict[str, Any] = {"color": "0.45", "linestyle": "--", "linewidth": 1.5}
MEASURED_STYLE: dict[str, Any] = {"color": "black", "linewidth": 1.8}
LOST = 1.0
"""Position errors beyond this [m] are not drawn: there the prediction has lost the diabolo."""


def check(path: str | Path) -> None:
    """Raise ValueError where there is no matplotlib, or it cannot write such a file."""
    check_drawing(path, "matplotlib")
    if Path(path).suffix not in (".png", ".pdf", ".svg"):
        raise ValueError(f"{path}: expected a name that ends in .png, .pdf or .svg")


def draw_errors(path: str | Path, result: Evaluation, excerpts: list[Excerpt], models: list[Model]) -> None:
    """Error against the time after the start: over many starts, or of the one prediction."""
    figure = _horizon_figure(result) if result.horizons else _first_start_figure(excerpts, models)
    _save(figure, path)


def draw_plan(path: str | Path, played: PlannedPlay) -> None:
    """Planned tips and diabolo, seen from behind the player; heights, and what the tips do, over time."""
    figure, axes = _panels(4, columns=4, width=4.2)
    side, height, speed, acceleration = axes
    time = played.time
    for name, tip, color in (("left", played.left, "tab:red"), ("right", played.right, "tab:blue")):
        side.plot(tip[:, 1], tip[:, 2], color=color, linewidth=1.2, label=f"{name} tip")
        height.plot(time, tip[:, 2], color=color, linewidth=1.0)
    side.plot(played.states[:, 1], played.states[:, 2], label="diabolo", **MEASURED_STYLE)
    for goals in played.wanted:
        for goal in [*goals.waypoints, *([goals.final_state] if goals.final_state else [])]:
            side.plot(goal.position[1], goal.position[2], "o", color="tab:green", ms=6, label="wanted")
    side.set(title="seen from behind the player", xlabel="y, to the left [m]", ylabel="z, up [m]")
    side.set_aspect("equal", adjustable="datalim")
    side.invert_xaxis()
    handles, labels = side.get_legend_handles_labels()
    once = dict(zip(labels, handles, strict=True))
    side.legend(once.values(), once.keys(), fontsize="small")
    height.plot(time, played.states[:, 2], **MEASURED_STYLE)
    flies = played.string_states == StringState.FLYING
    if flies.any():
        flying = np.where(flies, played.states[:, 2], np.nan)
        height.plot(time, flying, color="tab:orange", linewidth=3.0, label="flying")
        height.legend(fontsize="small")
    height.set(title="height", xlabel="time [s]", ylabel="z [m]")
    instants = np.linspace(played.path.begin, played.path.end, 1000)
    motion = played.path.derivatives(instants)
    for name, columns, color in (("left", slice(0, 3), "tab:red"), ("right", slice(3, 6), "tab:blue")):
        speed.plot(instants, np.linalg.norm(motion[1][:, columns], axis=1), color=color, label=f"{name} tip")
        acceleration.plot(instants, np.linalg.norm(motion[2][:, columns], axis=1), color=color)
    for panel, kind in ((speed, "speed"), (acceleration, "acceleration")):
        uses = (use for plan in played.plans for use in plan.limits if use.name == f"left tip {kind}")
        limit = next(uses, None)
        if limit is not None and np.isfinite(limit.limit):
            panel.axhline(limit.limit, color="0.4", linewidth=0.8, linestyle="--", label="limit")
    speed.legend(fontsize="small")
    speed.set(title="speed of the tips", xlabel="time [s]", ylabel="[m/s]")
    acceleration.set(title="acceleration of the tips", xlabel="time [s]", ylabel="[m/s$^2$]")
    title = textwrap.shorten(f"{played.action}: {played.answer}", 300, placeholder=" ...")
    figure.suptitle(textwrap.fill(title, 150), fontsize="medium")
    _save(figure, path)


def _horizon_figure(result: Evaluation) -> Figure:
    names = list(dict.fromkeys(row.recording for row in result.horizons))
    if ALL_RECORDINGS in names:
        names = [ALL_RECORDINGS, *[name for name in names if name != ALL_RECORDINGS]]
    figure, axes = _panels(len(names), share_y=True)
    for panel, name in zip(axes, names, strict=True):
        rows = [row for row in result.horizons if row.recording == name and row.score.model is not None]
        _draw_horizons(panel, rows)
        panel.set(title=name, xlabel="time after the start [s]")
        if panel.get_subplotspec().is_first_col():
            panel.set_ylabel("mean position error [m]")
    axes[0].legend(fontsize="small")
    return figure


def _draw_horizons(panel: Axes, rows: list[HorizonRow]) -> None:
    """On logarithmic axes, where 0.1 s is seen as well as 2 s."""
    from matplotlib.ticker import FormatStrFormatter, LogLocator

    models = list(dict.fromkeys(row.model for row in rows))
    for index, model in enumerate(models):
        beside = 1.04 ** (index - 0.5 * (len(models) - 1))  # so that bars of several models can be told apart
        scores = [row.score for row in rows if row.model == model]
        points = [(s.horizon * beside, s.model) for s in scores if s.model is not None]
        color = _color(model, index)
        panel.plot([h for h, _ in points], [s.mean for _, s in points], "o-", color=color, ms=4, label=model)
        for horizon, summary in points:
            interval = summary.mean_ci95
            if interval is not None:
                panel.plot(
                    [horizon, horizon], [max(interval.low, 1e-4), interval.high], color=color, lw=3, alpha=0.4
                )
    own = [row.score for row in rows if row.model == models[0]] if models else []
    means = [(score.horizon, score.baseline.mean) for score in own if score.baseline is not None]
    panel.plot([h for h, _ in means], [mean for _, mean in means], label="baseline", **BASELINE_STYLE)
    panel.plot([], [], color="0.5", lw=3, alpha=0.4, label="95 % interval")
    panel.set_xscale("log")
    panel.set_yscale("log")
    horizons = sorted({row.score.horizon for row in rows})
    panel.set_xticks(horizons, [f"{h:g}" for h in horizons])
    panel.minorticks_off()
    panel.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    panel.yaxis.set_major_formatter(FormatStrFormatter("%g"))
    panel.grid(alpha=0.25)


def _first_start_figure(excerpts: list[Excerpt], models: list[Model]) -> Figure:
    figure, axes = _panels(len(excerpts))
    for panel, excerpt in zip(axes, excerpts, strict=True):
        take = excerpt.part()
        time = take.time - take.time[0]
        for index, model in enumerate(models):
            error = position_errors(take, predict(take, model))
            panel.plot(time, error, color=_color(model.name, index), label=model.name)
        panel.plot(
            time, np.linalg.norm(baseline(take) - take.diabolo, axis=1), label="baseline", **BASELINE_STYLE
        )
        panel.set(title=take.name, xlabel="time after the start [s]", ylabel="position error [m]")
        panel.set_ylim(0.0, min(panel.get_ylim()[1], LOST))
        panel.grid(alpha=0.25)
    axes[0].legend(fontsize="small")
    return figure


def _panels(
    count: int, columns: int = 3, width: float = 4.2, share_y: bool = False
) -> tuple[Figure, list[Any]]:
    from matplotlib.figure import Figure

    columns = min(columns, count)
    rows = -(-count // columns)
    figure = Figure(figsize=(max(6.4, width * columns), 3.9 * rows), layout="constrained")
    axes = list(figure.subplots(rows, columns, squeeze=False, sharey=share_y).flat)
    for unused in axes[count:]:
        unused.remove()
    return figure, axes[:count]


def _color(model: str, index: int) -> str:
    """The three models by name keep their colours from picture to picture."""
    known = {"published": "tab:orange", "paper": "tab:green", "consistent": "tab:blue"}
    others = ["tab:red", "tab:purple", "tab:brown", "tab:pink", "tab:olive", "tab:cyan"]
    return known.get(model, others[index % len(others)])


def _save(figure: Figure, path: str | Path) -> None:
    with whole_file(path) as temporary:
        figure.savefig(temporary, dpi=130)
