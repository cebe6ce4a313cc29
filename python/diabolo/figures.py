# SPDX-License-Identifier: MIT
"""Figures of the report, drawn by plotly: they zoom, and show their values under the pointer."""

from __future__ import annotations

import base64
import gzip
import math
from collections.abc import Callable, Iterable, Sequence
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np

from .view import Replay

INK = {"base": "#e11d48", "corrected": "#059669", "recorded": "#17202c", "noise of the starts": "#6b7280"}
"""The first two as in the view."""
UNSEEN = "#dfe3e8"
MODE_COLORS = {"ON_STRING": "#3b6ea5", "LOOSE": "#d9a441", "FLYING": "#8e6bb0"}
LEFT_OVER = ["#f1f3f5", "#d8b4fe", "#9333ea", "#3b0764"]
"""From nothing to what is farthest off, as in the view."""
DEVIATIONS = {"z": "base", "z_after": "corrected"}
"""Fields of a window, and what they are of."""
RESIDUALS = {"residual_before_m": "base", "residual_after_m": "corrected", "residual_noise_m": "noise alone"}
AXES = ("forward", "left", "up")
MOST_ROWS = 12_000
"""Of all takes together; more are thinned out."""

Windows = Sequence[dict[str, Any]]
Words = Callable[[Any], str]


class Scale(NamedTuple):
    """What the colours of all takes' heat maps reach to, so that none ends before its data."""

    z: float
    low_m: float
    high_m: float

    @classmethod
    def of(cls, windows: Windows) -> Scale:
        deviations = [
            abs(z) for window in windows for key in DEVIATIONS for z in window.get(key) or [] if z is not None
        ]
        sizes = [window[key] for window in windows for key in RESIDUALS if window.get(key)]
        return cls(max([1.0, *deviations]), min(sizes, default=1e-4), max(sizes, default=1e-2))


@cache
def library() -> str:
    """What draws them in the browser, 5 MB packed into 2."""
    from plotly.offline import get_plotlyjs  # type: ignore[import-untyped]

    return base64.b64encode(gzip.compress(get_plotlyjs().encode(), mtime=0)).decode()


def _drawn(figure: Any, height: int, legend: dict[str, Any] | None = None, **layout: Any) -> str:
    """The figure as JSON that may stand in a script."""
    figure.update_layout(
        template="simple_white",
        height=height,
        margin={"l": 8, "r": 8, "t": 8, "b": 8},
        legend=legend or {"x": 0.03, "y": 1.0},
        **layout,
    )
    figure.update_xaxes(automargin=True)
    figure.update_yaxes(automargin=True)
    text: str = figure.to_json()
    return text.replace("<", "\\u003c")


def error_figure(rows: Sequence[Any]) -> str:
    """Errors on held-out data: horizon [s]; base, corrected, the improvement's interval, noise [m]."""
    from plotly.graph_objects import Figure  # type: ignore[import-untyped]

    figure = Figure()
    sure = [row for row in rows if row[2] is not None and row[3] and None not in row[3]]
    edges = [(row[0], max(row[1] - row[3][1], 0.0)) for row in sure]
    edges += [(row[0], row[1] - row[3][0]) for row in reversed(sure)]
    figure.add_scatter(
        x=[x for x, _ in edges],
        y=[1e3 * y for _, y in edges],
        fill="toself",
        line={"width": 0},
        fillcolor=f"{INK['corrected']}33",
        name="95 % of the improvement",
        mode="lines",
        hoverinfo="skip",
    )
    for name, column, dash in (
        ("base", 1, "dash"),
        ("corrected", 2, "solid"),
        ("noise of the starts", 4, "dot"),
    ):
        known = [row for row in rows if row[column] is not None]
        figure.add_scatter(
            x=[row[0] for row in known],
            y=[1e3 * row[column] for row in known],
            name=name,
            line={"color": INK[name], "dash": dash},
            hovertemplate="%{y:.3~g} mm after %{x:g} s",
        )
    figure.update_xaxes(title="time predicted ahead [s]", rangemode="tozero")
    figure.update_yaxes(title="position error [mm]", rangemode="tozero")
    return _drawn(figure, 340)


def curve_figure(item: dict[str, Any], curve: Sequence[Any]) -> str:
    """How a law without a name grows."""
    from plotly.graph_objects import Figure

    units = [(item.get(name) or "SI unit").replace("^2", "²") for name in ("scalar_unit", "unit")]
    figure = Figure()
    figure.add_scatter(x=[x for x, _ in curve], y=[y for _, y in curve], line={"color": INK["corrected"]})
    figure.update_xaxes(title=f"{item.get('scalar') or 'argument of the law'} [{units[0]}]")
    figure.update_yaxes(title=f"missing [{units[1]}]")
    return _drawn(figure, 280)


def take_figure(
    windows: Windows, directions: Sequence[str], replay: Replay | None, scale: Scale, rows: int, words: Words
) -> str:
    """One take over time: what is missing, what is left, and measured beside predicted.

    rows: so many of the replay's are drawn at most.
    """
    from plotly.subplots import make_subplots  # type: ignore[import-untyped]

    panels: list[tuple[int, Callable[[Any, int], None]]] = []
    if windows:
        if directions:
            panels += [
                (24 * len(directions), partial(_missing, windows, key, directions, scale))
                for key in DEVIATIONS
                if any(window.get(key) for window in windows)
            ]
        panels += [(20, partial(_modes, windows, words)), (84, partial(_left_over, windows, scale))]
    if replay is not None:
        panels.append((110, partial(_distances, replay, rows)))
        panels += [(90, partial(_measured, replay, rows, axis)) for axis in range(3)]
    heights = [height for height, _ in panels]
    between = 14
    whole = sum(heights) + between * (len(panels) - 1)
    figure = make_subplots(
        rows=len(panels), row_heights=heights, shared_xaxes=True, vertical_spacing=between / whole
    )
    for row, (_, draw) in enumerate(panels, start=1):
        draw(figure, row)
    figure.update_xaxes(title="time [s]", row=len(panels))
    legend = {"orientation": "h", "x": 0.0, "y": 1.0, "yanchor": "bottom"}
    return _drawn(figure, whole + 90, legend, barmode="overlay", bargap=0)


def _spans(windows: Windows) -> list[tuple[float, float]]:
    """From each window's begin to its end, or to the next one's begin."""
    begins = [window["begin_s"] for window in windows]
    ends = [window["end_s"] for window in windows]
    return [
        (begin, min(end, after))
        for begin, end, after in zip(begins, ends, [*begins[1:], math.inf], strict=True)
    ]


def _heat(
    figure: Any,
    row: int,
    windows: Windows,
    rows: dict[str, list[Any]],
    color: Callable[[float], float],
    reach: tuple[float, float],
    ticks: Iterable[float],
    title: str,
    colorscale: Any,
) -> None:
    """Rows of values by window, None where there is none; gaps between windows stay empty."""
    edges, columns = [windows[0]["begin_s"]], []
    for (begin, end), column in zip(_spans(windows), zip(*rows.values(), strict=True), strict=True):
        if begin > edges[-1]:
            edges.append(begin)
            columns.append((None,) * len(rows))
        edges.append(end)
        columns.append(column)
    table = list(zip(*columns, strict=True))
    bottom, top = figure.layout[f"yaxis{row if row > 1 else ''}"].domain
    within = [value for value in ticks if reach[0] <= value <= reach[1]]
    figure.add_heatmap(
        x=edges,
        y=list(rows),
        z=[[None if value is None else color(value) for value in line] for line in table],
        zmin=color(reach[0]),
        zmax=color(reach[1]),
        colorscale=colorscale,
        colorbar={
            "title": title,
            "y": 0.5 * (bottom + top),
            "len": top - bottom,
            "thickness": 12,
            "outlinewidth": 0,
            "tickvals": [color(value) for value in within],
            "ticktext": [f"{value:g}" for value in within],
        },
        customdata=table,
        hovertemplate=f"%{{y}}, %{{x:.2f}} s: %{{customdata:.3~g}}<extra>{title}</extra>",
        row=row,
        col=1,
    )
    unseen = {"fillcolor": UNSEEN, "opacity": 1, "layer": "below", "line_width": 0}
    figure.add_hrect(-0.5, len(rows) - 0.5, row=row, col=1, **unseen)
    figure.update_yaxes(autorange="reversed", ticks="", showline=False, row=row)


def _missing(
    windows: Windows, key: str, directions: Sequence[str], scale: Scale, figure: Any, row: int
) -> None:
    """What the base alone leaves out, or what is left once it is corrected, direction by direction."""
    values = {
        direction: [dict(enumerate(window.get(key) or [])).get(index) for window in windows]
        for index, direction in enumerate(directions)
    }
    ticks = (-1000, -100, -10, 0, 10, 100, 1000)
    title = f"{DEVIATIONS[key]},<br>z-score"
    _heat(figure, row, windows, values, math.asinh, (-scale.z, scale.z), ticks, title, "RdBu_r")


def _modes(windows: Windows, words: Words, figure: Any, row: int) -> None:
    """A ribbon in the colour of the string's state."""
    for mode, color in MODE_COLORS.items():
        own = [
            span for span, window in zip(_spans(windows), windows, strict=True) if window.get("mode") == mode
        ]
        shown = own or [(math.nan, math.nan)]  # the legend has every state
        figure.add_bar(
            base=[begin for begin, _ in shown],
            x=[end - begin for begin, end in shown],
            y=["state of the string"] * len(shown),
            orientation="h",
            marker={"color": color, "line": {"width": 0}},
            name=words(mode),
            hovertemplate="from %{base:.2f} s",
            row=row,
            col=1,
        )
    figure.update_yaxes(ticks="", showline=False, row=row)


def _left_over(windows: Windows, scale: Scale, figure: Any, row: int) -> None:
    """What is left in each window before and after, and what noise alone would leave."""
    millimetres = {
        name: [1e3 * window[key] if window.get(key) else None for window in windows]
        for key, name in RESIDUALS.items()
    }
    reach = (1e3 * scale.low_m, 1e3 * scale.high_m)
    digits = (1,) if reach[1] > 100.0 * reach[0] else (1, 3)
    ticks = [digit * 10.0**power for power in range(-3, 4) for digit in digits]
    _heat(figure, row, windows, millimetres, math.log10, reach, ticks, "residual [mm]", LEFT_OVER)


def _lines(
    figure: Any, row: int, title: str, replay: Replay, rows: int, tracks: dict[str, Any], unit: str
) -> None:
    """What has a name, over time; the last panel has the legend."""
    time = replay.recording.time - replay.recording.time[0]
    thinned = slice(None, None, -(-len(replay.recording) // rows))
    for name, track in tracks.items():
        figure.add_scatter(
            x=np.asarray(time[thinned], dtype=np.float32),
            y=np.asarray(track[thinned], dtype=np.float32),
            mode="lines",
            name=name,
            legendgroup=name,
            showlegend=title == AXES[-1],
            line={"color": INK[name], "width": 1.4},
            hovertemplate=f"%{{y:.4~g}} {unit}, %{{x:.2f}} s",
            row=row,
            col=1,
        )
    figure.update_yaxes(title=f"{title} [{unit}]", row=row)


def _distances(replay: Replay, rows: int, figure: Any, row: int) -> None:
    """How far predictions are off."""
    tracks = {name: 1e3 * replay.errors(name) for name in replay.predictions}
    _lines(figure, row, "off by", replay, rows, tracks, "mm")


def _measured(replay: Replay, rows: int, axis: int, figure: Any, row: int) -> None:
    """One coordinate as measured, and as predicted before and after."""
    tracks = {**replay.predictions, "recorded": replay.recording.diabolo}
    of_axis = {name: track[:, axis] for name, track in tracks.items()}
    _lines(figure, row, AXES[axis], replay, rows, of_axis, "m")
