# SPDX-License-Identifier: MIT
# ruff: noqa: RUF001 (signs of mathematics)
"""The page of a diagnosis. All results here are invented for the tests: no numbers of any real recording."""

from __future__ import annotations

import base64
import copy
import json
import math
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("jinja2")
pytest.importorskip("plotly")

import diabolo
from diabolo import checks, figures, report
from diabolo.report import quantity, report_html
from diabolo.view import LONGEST_REPLAY, Replay, replay_html

DIRECTIONS = [
    ("string_tangent", "ON_STRING", "m/s^2"),
    ("string_binormal", "ON_STRING", "m/s^2"),
    ("spin_on_string", "ON_STRING", "rad/s^2"),
    ("flight_against_v", "FLYING", "m/s^2"),
    ("flight_vertical", "FLYING", "m/s^2"),
    ("flight_axis_x_v", "FLYING", "m/s^2"),
    ("spin_off_string", "FLYING", "rad/s^2"),
]


def invented_windows(recording: str, seconds: float) -> list[dict[str, Any]]:
    windows = []
    for index in range(int(seconds / 0.25)):
        flying = index % 8 in (4, 5, 6)
        mode = "FLYING" if flying else "LOOSE" if index % 8 == 7 else "ON_STRING"
        z = [
            round(1.4 * math.sin(7.1 * index + 3.3 * row) + (5.5 if row == 5 else 0.0), 2)
            if own == mode
            else None
            for row, (_, own, _) in enumerate(DIRECTIONS)
        ]
        windows.append(
            {
                "recording": recording,
                "begin_s": 0.25 * index,
                "end_s": 0.25 * (index + 1),
                "mode": mode,
                "residual_before_m": 0.018 + 0.004 * math.sin(index) if flying else 0.002,
                "residual_after_m": 0.0022 if flying else 0.0018,
                "z": z,
            }
        )
    return windows


def candidate(
    name: str, z: float, estimate: float, unit: str, parameter: str, reason: str = "", kind: str = "physics"
) -> dict[str, Any]:
    return {
        "name": name,
        "kind": kind,
        "estimate": estimate,
        "unit": unit,
        "parameter": parameter,
        "z": z,
        "p_value": min(1.0, 13.0 * math.erfc(abs(z) / math.sqrt(2.0))),
        "position_1s_m": None,
        "size_m": 0.0004 * abs(z),
        "claimed": not reason,
        "reason": reason,
    }


def left_over(quantity: str, base: float, left: float, noise: float, **where: str) -> dict[str, Any]:
    return {
        "quantity": quantity,
        "unit": "m" if quantity == "position" else "rad/s",
        "mode": "ANY",
        "direction": "",
        "recording": "",
        "begin_s": None,
        "end_s": None,
        "ahead_s": None,
        "windows": 40,
        "base": base,
        "left": left,
        "noise": noise,
        "times_noise": left / noise,
        "p_value": 1e-9,
        **where,
    }


INVENTED: dict[str, Any] = {
    "schema": "diabolo.diagnosis/1",
    "headline": "NAMED",
    "sentence": "The simulator leaves out the sideways lift of the spinning diabolo in flight, and the "
    "recording's frame is tilted by 1.2 deg.",
    "base": "consistent",
    "adequacy": {
        "adequate": False,
        "base_adequate": False,
        "explained": 0.91,
        "spin_explained": None,
        "overall": [left_over("position", 0.012, 0.0014, 0.0006)],
        "places": [left_over("position", 0.015, 0.003, 0.0006, mode="FLYING", direction="left")],
        "changes": [
            {
                "quantity": "acceleration_left",
                "unit": "m/s^2",
                "z": 5.2,
                "size": 0.4,
                "trend_per_s": None,
                "frequency_hz": 0.31,
            },
            {
                "quantity": "string_length",
                "unit": "m",
                "z": 4.4,
                "size": 0.004,
                "trend_per_s": 0.0021,
                "frequency_hz": None,
            },
        ],
    },
    "effects": [
        {
            "name": "magnus_lift",
            "kind": "physics",
            "material": True,
            "tied_with": [],
            "p_value": 1.3e-9,
            "confidence": 0.97,
            "parameters": [
                {"name": "coefficient", "value": 0.0031, "unit": "1/rad", "ci90": [0.0027, 0.0035]}
            ],
            "where": {
                "modes": ["FLYING"],
                "direction": "axis_x_v",
                "intervals": [[1.2, 1.9], [3.0, 3.7], [5.0, 5.7], [7.0, 7.7]],
            },
            "size": {"acceleration_mps2": 0.8, "position_1s_m": 0.031},
        },
        {
            "name": "gravity_tilt",
            "kind": "measurement",
            "material": True,
            "tied_with": [],
            "p_value": 0.0002,
            "confidence": 0.93,
            "parameters": [
                {"name": "angle_deg", "value": 1.21, "unit": "deg", "ci90": [1.02, 1.40]},
                {"name": "azimuth_deg", "value": -41.0, "unit": "deg", "ci90": [-52.0, -30.0]},
            ],
            "where": {"modes": ["ON_STRING", "FLYING"], "direction": None, "intervals": []},
            "size": {"acceleration_mps2": 0.21, "position_1s_m": None},
        },
    ],
    "unnamed": [],
    "differing": [
        {
            "name": "string_friction",
            "kind": "physics",
            "what": "friction of the string",
            "z": 14.2,
            "recordings": [
                {
                    "recording": recording,
                    "parameters": [{"name": "coefficient", "value": value, "unit": "1", "ci90": interval}],
                }
                for recording, value, interval in (
                    ("invented_throw", 0.104, [0.091, 0.117]),
                    ("invented_swing", 0.41, [0.38, 0.44]),
                )
            ],
        }
    ],
    "upper_limits": [
        {"name": "air_drag_linear", "parameter": "rate", "limit95": 0.011, "unit": "1/s"},
        {"name": "air_drag_quadratic", "parameter": "coefficient", "limit95": 0.0062, "unit": "1/m"},
        {"name": "axle_drag", "parameter": "constant", "limit95": None, "unit": "rad/s^2"},
    ],
    "nuisances": [
        {"name": "time_offset", "value": 0.0007, "unit": "s", "ci90": [-0.0002, 0.0016]},
        {"name": "string_length", "value": 1.4523, "unit": "m", "ci90": [1.4511, 1.4535]},
        {"name": "length_scale", "value": 1.0004, "unit": "1", "ci90": [0.9991, 1.0017]},
        {"name": "axle_radius", "value": 0.0061, "unit": "m", "ci90": [0.0052, 0.0070]},
    ],
    "fit": {
        "heldout": "recordings",
        "horizons_s": [0.1, 0.25, 0.5, 1.0],
        "base_error_m": [0.0021, 0.0074, 0.0236, 0.0915],
        "augmented_error_m": [0.0017, 0.0041, 0.0093, 0.0214],
        "improvement_ci95_m": [[0.0001, 0.0007], [0.0022, 0.0044], [0.0112, 0.0174], [0.0590, 0.0812]],
        "start_error_m": [0.0011, 0.0024, 0.0051, 0.0093],
        "base_spin_error_radps": [0.2, 0.4, None, 1.6],
        "augmented_spin_error_radps": [0.2, 0.3, None, 0.5],
        "spin_improvement_ci95_radps": [[-0.05, 0.05], [0.04, 0.16], None, [0.9, 1.3]],
        "start_spin_error_radps": [0.1, 0.1, None, 0.1],
        "axle_heldout": "recordings",
        "axle_ahead_s": 1.0,
        "constant_axle_error_rad": 0.2,
        "base_axle_error_rad": 0.1,
        "augmented_axle_error_rad": 0.01,
        "axle_improvement_ci95_rad": [0.07, 0.11],
        "windows": 412,
    },
    "next_experiment": [
        {
            "motion": "high_throw",
            "what": "a throw as high as can be caught",
            "parts": ["air_drag_linear", "air_drag_quadratic"],
            "odds": 23.4,
            "seconds": 12.0,
        },
        {"motion": "two_spin_directions", "parts": ["magnus_lift"], "odds": None, "seconds": 20.0},
    ],
    "model": "model.json",
    "seconds": 12.3,
    "version": "0.0.0",
    "inputs": [
        {"file": "invented_throw.csv", "sha256": "0123456789abcdef" * 4},
        {"file": "invented_swing.csv", "sha256": "fedcba9876543210" * 4},
    ],
    "ladder": [
        candidate("magnus_lift", 17.2, 0.0031, "1/rad", "coefficient"),
        candidate("gravity_tilt", 6.3, 0.0211, "rad", "angle", kind="measurement"),
        candidate("length_scale", 4.6, 0.0011, "1", "factor", "below the floor of 0.3 %", kind="measurement"),
        candidate("time_offset", 1.3, 0.0007, "s", "seconds", "below the threshold", kind="measurement"),
        candidate("string_friction", 2.1, 0.012, "1", "coefficient", "below the threshold"),
        candidate("string_elasticity", 0.4, 2.0e-6, "m/N", "compliance", "below the threshold"),
        candidate("air_drag_quadratic", -4.9, -0.011, "1/m", "coefficient", "its sign is against physics"),
        candidate("air_drag_linear", 1.1, 0.008, "1/s", "rate", "below the threshold"),
    ],
    "locate": {
        "directions": [{"name": name, "mode": mode, "unit": unit} for name, mode, unit in DIRECTIONS],
        "windows": invented_windows("invented_throw", 14.0) + invented_windows("invented_swing", 9.0),
    },
    "noise": [
        {"recording": "invented_throw", "position_m": 0.00041, "spin_rad_s": 0.6},
        {"recording": "invented_swing", "position_m": 0.00038, "spin_rad_s": 0.5},
    ],
}


def invented(**changes: Any) -> dict[str, Any]:
    return {**copy.deepcopy(INVENTED), **changes}


class Page(HTMLParser):
    """The page's tags, and its text but for the style."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.pieces: list[str] = []
        self.feed(html)
        assert not self.open, "every tag is closed"
        self.text = " ".join(" ".join(self.pieces).split())

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attributes)))
        if tag not in ("meta", "img", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] not in ("style", "title", "script"):
            self.pieces.append(data)

    def plots(self) -> list[str]:
        """What stands for each figure where it is not seen."""
        return [given["aria-label"] or "" for _, given in self.tags if given.get("class") == "plot"]


def drawn(html: str) -> list[dict[str, Any]]:
    """The figures as plotly takes them."""
    return [json.loads(text) for text in re.findall(r"<script>draw\((.*?)\)</script>", html)]


@pytest.fixture(autouse=True)
def without_library(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its megabytes are looked at in the browser."""
    monkeypatch.setattr(figures, "library", lambda: "")


def test_the_page_gives_the_answer_first_and_its_parts_in_order() -> None:
    text = Page(report_html(invented())).text
    parts = [
        "Physics named NAMED",
        INVENTED["sentence"],
        "mean held-out error, 1 s ahead",
        "On held-out recordings, the mean position error",
        "1 s 1.6 rad/s 0.5 rad/s 1.10 [0.90, 1.30] rad/s 0.1 rad/s",
        "Sideways lift by the spin (Magnus) magnus_lift",
        "friction of the string string_friction invented_throw coefficient 0.104 [0.091, 0.117]",
        "friction of the string string_friction invented_swing coefficient 0.410 [0.380, 0.440]",
        "Strongest: in flight: axle × velocity",
        "Rejected: its sign is against physics",
        "More is left than the camera's noise would leave",
        "position, fitted 12 mm 1.4 mm 0.6 mm 2.3 40",
        "in flight; sideways position, fitted 15 mm 3 mm 0.6 mm 5.0 40",
        "Acceleration sideways 0.4 m/s² comes and goes, 0.31 Hz 5.2",
        "True length of the string 4 mm steadily, by 2.1 mm each second 4.4",
        "no claimed effect is tied",
        "Radius of the axle",
        "below 0.011 1/s",
        "a throw as high as can be caught",
        "invented_throw.csv 0123456789abcdef",
        "0.41 mm",
    ]
    places = [text.find(part) for part in parts]
    assert -1 not in places, parts[places.index(-1)]
    assert places == sorted(places)


def test_held_out_errors_are_in_the_units_of_people() -> None:
    text = Page(report_html(invented())).text
    assert "goes from 91.5 mm to 21.4 mm (77 % less) (at most 412 starts)" in text
    assert "70 [59, 81] mm, with its 95 % interval, which excludes zero" in text


@pytest.mark.parametrize(
    ("interval", "said"),
    [
        ([-0.01, 0.02], "zero is inside, so no improvement is shown"),
        ([-0.02, -0.01], "it predicts worse"),
        (None, "Too few starts are independent for an interval"),
        ([None, 0.02], "Too few starts are independent for an interval"),
    ],
)
def test_an_improvement_that_is_not_sure_is_not_called_one(interval: Any, said: str) -> None:
    fit = {
        "horizons_s": [1.0],
        "base_error_m": [0.09],
        "augmented_error_m": [0.08],
        "improvement_ci95_m": [interval],
    }
    assert said in Page(report_html(invented(fit=fit))).text


def test_the_page_stands_alone_and_every_figure_has_words() -> None:
    html = report_html(invented(), replays=[replay()])
    page = Page(html)
    assert not {tag for tag, _ in page.tags} & {"link", "object", "img"}
    assert not re.search(r"(?:src|href)=\"(?!data:)|url\(|@import|https?://", html)
    assert len(page.plots()) == len(drawn(html)) == 1 + 3
    assert all(len(words) > 40 for words in page.plots())
    assert 'name="viewport"' in html and '<html lang="en">' in html


def replay(name: str = "invented_play", seconds: float = 3.0, base_off: float = 0.1) -> Replay:
    """Of a diabolo at rest, with predictions that are off upwards [m]; the first second has none."""
    count = int(100.0 * seconds)
    track, tip = np.tile([0.1, 0.2, 0.7], (count, 1)), np.array([0.0, 0.4, 0.6])
    take = diabolo.Recording(
        np.arange(count) / 100.0 + 50.0, track + tip, track + tip * [1, -1, 1], track, 100.0, name=name
    )
    above = np.where(np.arange(count)[:, None] < 100, np.nan, [0.0, 0.0, 1.0])
    return Replay(take, {"base": track + base_off * above, "corrected": track + 0.002 * above})


def test_every_take_shows_measured_beside_predicted_before_and_after() -> None:
    html = report_html(invented(), replays=[replay("first"), replay("second", base_off=0.2)])
    text = Page(html).text
    assert "first Mean distance in the replay: 100 mm (base), 2 mm (corrected)." in text
    assert "second Mean distance in the replay: 200 mm (base), 2 mm (corrected)." in text
    for figure in drawn(html)[-2:]:
        named = [trace["name"] for trace in figure["data"] if trace.get("type") == "scatter"]
        assert named.count("recorded") == 3 and named.count("base") == named.count("corrected") == 4
        times = figure["data"][-1]["x"]
        seconds = np.frombuffer(base64.b64decode(times["bdata"]), times["dtype"])
        assert seconds[0] == 0.0 and seconds[-1] == pytest.approx(2.99)  # as windows are told


def test_the_take_that_the_base_is_farthest_off_in_is_replayed() -> None:
    replays = [replay("first"), replay("second", base_off=0.2)]
    frames = [given for tag, given in Page(report_html(invented(), replays=replays)).tags if tag == "iframe"]
    assert [frame["srcdoc"] for frame in frames] == [replay_html(replays[1])]


def test_of_a_long_take_the_worst_stretch_is_replayed() -> None:
    long = replay(seconds=3.0 * LONGEST_REPLAY)
    rows = int(100.0 * LONGEST_REPLAY)
    long.predictions["base"][3000:3500] += 1.0
    first, last = long.worst()
    assert last - first + 1 == rows and first <= 3000 and last >= 3499
    assert f"invented_play, from {first / 100:.1f} to {last / 100:.1f} s" in replay_html(long)


def test_a_take_without_predictions_is_not_replayed() -> None:
    nothing = replay(seconds=1.0)
    assert report_html(invented(), replays=[nothing]) == report_html(invented())


def test_colours_mean_the_same_in_all_takes_and_end_at_their_data() -> None:
    result = invented()
    result["locate"]["windows"][0] |= {"z": [-40.0] + [None] * 6, "residual_before_m": 0.4}
    heat = [t for figure in drawn(report_html(result)) for t in figure["data"] if t["type"] == "heatmap"]
    assert [(trace["zmin"], trace["zmax"]) for trace in heat[:2]] == [
        (trace["zmin"], trace["zmax"]) for trace in heat[2:]
    ]
    for trace in heat:
        values = [value for line in trace["z"] for value in line if value is not None]
        assert trace["zmin"] <= min(values) and max(values) <= trace["zmax"]
    assert heat[0]["zmin"] == min(value for line in heat[0]["z"] for value in line if value is not None)
    assert heat[1]["y"] == ["base", "corrected", "noise alone"]


def test_directions_are_mapped_before_and_after() -> None:
    result = invented()
    for window in result["locate"]["windows"]:
        window["z_after"] = [None if z is None else 0.1 * z for z in window["z"]]
    heat = [t for figure in drawn(report_html(result)) for t in figure["data"] if t["type"] == "heatmap"]
    before, after = (np.sinh(np.array(trace["z"], float)) for trace in heat[:2])
    assert heat[0]["zmax"] == heat[1]["zmax"]
    np.testing.assert_allclose(after, 0.1 * before)


def test_the_legend_has_every_state_of_the_string() -> None:
    result = invented()
    for window in result["locate"]["windows"]:
        window["mode"] = "ON_STRING"
    bars = [t for figure in drawn(report_html(result)) for t in figure["data"] if t["type"] == "bar"]
    assert [bar["name"] for bar in bars[:3]] == ["on the string", "string slack", "in flight"]
    assert all(len(bar["x"]) > 0 for bar in bars), "plotly names none that is empty"


def test_the_same_result_makes_the_same_page() -> None:
    assert report_html(invented()) == report_html(invented())


HOSTILE = "<script>alert('$x_1$ & \"y\"')</script>"


def hostile(value: Any) -> Any:
    """The same with every text but the fixed names replaced."""
    if isinstance(value, dict):
        return {key: item if key in ("schema",) else hostile(item) for key, item in value.items()}
    if isinstance(value, list):
        return [hostile(item) for item in value]
    return HOSTILE if isinstance(value, str) else value


def test_all_text_is_escaped() -> None:
    item = {
        "law": "x",
        "where": {"modes": ["y"], "direction": "z"},
        "curve": [[0, 1], [1, 2]],
        "explained": 0.8,
    }
    html = report_html(hostile(invented(unnamed=[item])))
    assert "<script>alert" not in html and "&lt;script&gt;" in html
    Page(html)


NOTHING_SAID = [
    "There is no held-out error",
    "No effect is claimed.",
    "Nothing was located",
    "No candidate could be tested.",
    "None: no claimed effect is tied with another.",
    "No properties of the measurement were fitted.",
    "There are no upper limits.",
    "No further experiment is proposed.",
    "There is no model file",
    "The recordings are not given.",
    "The noise is not known.",
]


@pytest.mark.parametrize("emptiness", ["missing", "null", "empty"])
def test_what_a_result_lacks_is_said_in_words(emptiness: str) -> None:
    empty: dict[str, Any] = {"schema": "diabolo.diagnosis/1"}
    if emptiness == "null":
        empty |= dict.fromkeys(INVENTED.keys() - empty.keys())
    if emptiness == "empty":
        empty |= {key: type(value)() for key, value in INVENTED.items() if key != "schema"}
        empty["fit"] = {key: [] for key in INVENTED["fit"]} | {"heldout": None, "windows": None}
        empty["locate"] = {"directions": [], "windows": []}
    page = Page(report_html(empty))
    assert not page.plots()
    for said in NOTHING_SAID:
        assert said in page.text
    assert "None " not in page.text.replace("None: no", "") and "nan" not in page.text


def places_of(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Where anything stands within a result."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [place for key, item in items for place in [(*path, key), *places_of(item, (*path, key))]]


def short() -> dict[str, Any]:
    """One of each, since many pages are made of it."""
    result = invented(unnamed=[{"law": "x", "where": {}, "curve": [[0, 1], [1, 2]], "explained": 0.8}])
    result["locate"]["windows"] = result["locate"]["windows"][:1]
    result["ladder"] = result["ladder"][:1]
    result["effects"] = result["effects"][:1]
    result["effects"][0]["tied_with"] = ["wind"]
    return result


def test_any_single_field_may_be_null(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(figures, "_drawn", lambda figure, height, *_, **__: "{}")  # which takes time
    for section, whole in short().items():
        for place in places_of(whole):
            result = {"schema": "diabolo.diagnosis/1", section: copy.deepcopy(whole)}
            parent = result[section]
            for key in place[:-1]:
                parent = parent[key]
            parent[place[-1]] = None
            try:
                Page(report_html(result))
            except Exception as error:
                pytest.fail(f"null at {section}, {place}: {error!r}")


@pytest.mark.parametrize(
    ("headline", "badge"),
    [
        ("NOTHING_MISSING", "Nothing missing"),
        ("NAMED", "Physics named"),
        ("MEASUREMENT_FAULT", "Measurement fault"),
        ("NUMERICAL", "Numerical artefact"),
        ("TIE", "Tie"),
        ("UNNAMED_STRUCTURE", "Unnamed structure"),
        ("INSUFFICIENT_DATA", "Too little data"),
        ("LATER_HEADLINE", "LATER_HEADLINE"),
    ],
)
def test_every_headline_has_a_badge_and_a_sentence(headline: str, badge: str) -> None:
    page = Page(report_html({"schema": "diabolo.diagnosis/1", "headline": headline}))
    assert page.text.startswith(f"{badge} {headline} ")
    said = re.search(r"<h1>(.*)</h1>", report_html({"schema": "diabolo.diagnosis/1", "headline": headline}))
    assert said and len(said[1]) > 20


def test_a_tie_is_told_once_with_what_would_part_it() -> None:
    effects = copy.deepcopy(INVENTED["effects"])
    effects[0] |= {"name": "air_drag_linear", "tied_with": ["air_drag_quadratic"]}
    effects[1] |= {"name": "air_drag_quadratic", "tied_with": ["air_drag_linear"]}
    text = Page(report_html(invented(headline="TIE", effects=effects))).text
    assert text.count("this data cannot tell them apart. What would: a throw as high as can be caught.") == 1


def test_a_tied_effect_has_no_chance_of_its_own() -> None:
    effects = [INVENTED["effects"][0] | {"tied_with": ["wind"]}, INVENTED["effects"][1]]
    text = Page(report_html(invented(effects=effects))).text
    assert "physics tied with Wind: the value may include its effect coefficient" in text
    assert "one of a tie" in text and "97 %" not in text and "93 %" in text


def test_a_limit_of_what_is_beyond_the_threshold_says_why_it_is_not_claimed() -> None:
    row = candidate("wind", 6.0, 3.98, "m/s", "wind_x", "too small to matter")
    limit = {"name": "wind", "parameter": "wind_x", "limit95": 4.16, "unit": "m/s"}

    def text_of(threshold: float, reason: str | None = row["reason"]) -> str:
        result = invented(ladder=[row | {"reason": reason}], upper_limits=[limit])
        return Page(report_html(result | {"thresholds": {"physics": threshold}})).text

    assert "below 4.16 m/s; the fit gives 3.98 m/s (too small to matter)" in text_of(4.0)
    assert "below 4.16 m/s; the fit gives 3.98 m/s (no reason given)" in text_of(4.0, None)
    assert "below 4.16 m/s" in text_of(6.5) and "the fit gives" not in text_of(6.5)


@pytest.mark.parametrize(
    ("p", "text"), [(0.0, "< 10⁻³⁰⁰"), (4e-297, "4\xa0×\xa010⁻²⁹⁷"), (0.02, "0.02"), (None, "not known")]
)
def test_a_probability_that_is_next_to_nothing_has_a_bound(p: float | None, text: str) -> None:
    assert report.probability(p) == text


def test_errors_are_in_millimetres_however_large() -> None:
    overall = [left_over("position", 0.138, 0.0035, 0.0027) | {"ahead_s": 1.0}]
    effects = [{"name": "string_friction", "size": {"size_m": 0.342}}]
    text = Page(report_html(invented(effects=effects, adequacy={"overall": overall}))).text
    assert "position, held out, 1 s ahead 138 mm 3.5 mm 2.7 mm" in text
    assert "342 mm after 0.5 s" in text


def test_an_unnamed_law_is_shown_with_its_curve() -> None:
    law = "along -v, in flight, |v|^1.4"
    item = {"where": {"modes": ["FLYING"]}, "law": law, "curve": [[0, 0], [2, 0.11]], "explained": 0.8}
    page = Page(report_html(invented(headline="UNNAMED_STRUCTURE", unnamed=[item])))
    assert f"{law} in flight; explains 80 % of what is left over." in page.text
    assert f"Curve of the unnamed law: {law}" in page.plots()


def test_the_curve_of_an_unnamed_law_names_its_axes() -> None:
    item = {"law": "x", "curve": [[0, 1], [1, 2]], "unit": "m/s^2", "scalar": "speed", "scalar_unit": "m/s"}
    layout = json.loads(figures.curve_figure(item, item["curve"]))["layout"]
    titles = [layout[axis]["title"]["text"] for axis in ("xaxis", "yaxis")]
    assert titles == ["speed [m/s]", "missing [m/s²]"]


@pytest.mark.parametrize("chance", [0.005, None])
def test_a_learnt_law_is_told_with_what_exchanged_strengths_gain(chance: float | None) -> None:
    item = {
        "law": "a drag",
        "formula": "size * speed",
        "gain": 300.0,
        "gain_by_strength": 280.0,
        "gain_permuted": 12.5,
        "dependence_p_value": chance,
    }
    text = Page(report_html(invented(learnt=[item]))).text
    said = (
        "held-out windows gain 280.0 in chi^2 by its strength in each, and 12.5 by strengths exchanged at "
        "random (p = 0.005)"
    )
    assert (said in text) == (chance is not None)


def test_an_unnamed_force_is_shown_with_its_size() -> None:
    where = {"direction": "flight_against_v"}
    item = {"where": where, "value": 0.11, "deviation": 0.01, "unit": "m/s^2", "size_m": 0.004}
    text = Page(report_html(invented(unnamed=[item]))).text
    assert "against the velocity; 0.110 [0.094, 0.126] m/s² (90 % interval); 4 mm after 0.5 s." in text


def test_the_size_of_a_spin_effect_is_a_share() -> None:
    size = {"acceleration_mps2": None, "position_1s_m": None, "spin_share_1s": 0.12}
    text = Page(report_html(invented(effects=[{"name": "axle_drag", "size": size}]))).text
    assert "Bearing slows the spin axle_drag" in text and "12 % of the spin in 1 s" in text


def test_the_size_of_what_turns_the_axle_is_an_angle() -> None:
    size = {"acceleration_mps2": None, "position_1s_m": None, "axle_1s_rad": 0.1}
    text = Page(report_html(invented(effects=[{"name": "groove", "size": size}]))).text
    assert "String climbs the groove's flanks groove" in text and "turns the axle by 5.73 deg in 1 s" in text
    assert "The axle's direction, on held-out recordings" in text
    assert "1 s 11.5 deg 5.73 deg 0.573 deg 5.2 [4.0, 6.3] deg" in text


def test_a_comparison_begins_with_the_laws_and_the_errors_of_that_simulator() -> None:
    verdicts = ("lacks", "agrees", "cannot_tell", "should_not_have")
    laws = [{"name": "wind", "what": "wind", "verdict": verdict} for verdict in verdicts]
    comparison: dict[str, Any] = {"sentence": "The simulator lacks wind.", "laws": laws}
    without = Page(report_html(invented(), comparison, [replay()])).text
    tiles, rest = without.split("law by law", 1)
    assert "laws that differ 2 laws compared 4 recordings 2" in tiles
    assert "mm" not in tiles and "consistent" not in tiles, "errors of our preset are none of that simulator"
    assert rest.find("lacks it") < rest.find("Replay:") < rest.find("Does the correction predict better?")
    errors = {"base_error_m": [0.112], "augmented_error_m": [0.008], "improvement_ci95_m": [None]}
    comparison["fit"] = {"horizons_s": [1.0], **errors}
    tiles, rest = Page(report_html(invented(), comparison)).text.split("law by law", 1)
    assert "your simulator's mean held-out error, 1 s ahead 112 mm → 8 mm" in tiles
    assert "1 s 112 mm 8 mm too few independent starts" in rest


def test_a_compared_law_has_the_size_of_its_difference() -> None:
    law = {"name": "gyroscopic_tilt", "what": "the tilt of the axle by the string", "verdict": "lacks"}
    turned = {**law, "size_m": None, "axle_1s_rad": 0.1}
    moved = {**law, "name": "wind", "what": "wind", "size_m": 0.004, "axle_1s_rad": None}
    comparison = {"sentence": "The simulator lacks them.", "laws": [turned, moved]}
    text = Page(report_html(invented(), comparison)).text
    assert "lacks it none none none turns the axle by 5.73 deg in 1 s" in text
    assert "lacks it none none none 4 mm after 0.5 s" in text


def test_says_what_a_claim_is_worth_on_held_out_data() -> None:
    fit = {"horizons_s": [0.5, 1.0]}

    def text_of(intervals: list[list[float] | None]) -> str:
        effects = [{"name": "string_friction", "worse_without_ci95_m": intervals}]
        return Page(report_html(invented(effects=effects, fit=fit))).text

    assert "without it 2 to 5 mm worse after 0.5 s" in text_of([[0.002, 0.005], [-0.001, 0.004]])
    unsure = text_of([[-0.002, 0.005], None])
    assert "without it -2 to 5 mm worse after 0.5 s on held-out data, so not shown to help there" in unsure
    assert "without it" not in text_of([])


def test_places_are_named_with_their_recording() -> None:
    windows = [
        {"recording": name, "begin_s": begin, "end_s": begin + 0.5, "mode": "FLYING", "z": []}
        for name, begin in (
            ("first", 0.0),
            ("first", 0.5),
            ("second", 0.25),
            ("second", 0.75),
            ("third", 0.25),
        )
    ]

    def text_of(*intervals: list[float]) -> str:
        where = {"modes": [], "intervals": list(intervals)}
        result = invented(effects=[{"name": "wind", "where": where}], locate={"windows": windows})
        return Page(report_html(result)).text

    assert "first, 0.0 to 1.0 s; second, 0.2 to 0.8 s; third, 0.2 to 0.8 s" in text_of(
        [0.0, 1.0], [0.25, 0.75], [0.25, 0.75]
    )
    assert "second, 0.2 to 0.8 s; second, 0.8 to 1.2 s" in text_of([0.25, 0.75], [0.75, 1.25])
    assert "second or third, 0.2 to 0.8 s" in text_of([0.25, 0.75])


@pytest.mark.parametrize(
    ("z", "size", "said"),
    [
        (0.2, 0.0003, "not identifiable: what else is fitted has the same effect on the motion"),
        (1.3, 0.0003, "too small"),
        (5.2, 0.02, "too small"),
        (0.2, None, "too small"),
    ],
)
def test_what_is_not_identifiable_is_not_called_small(z: float, size: float | None, said: str) -> None:
    row = candidate("wind", z, 0.1, "m/s", "wind_x", "too small") | {"size_m": size}
    assert f"Rejected: {said}" in Page(report_html(invented(ladder=[row]))).text


def test_many_recordings_unfold() -> None:
    windows = [window for index in range(7) for window in invented_windows(f"take {index}", 1.0)]
    locate = {"directions": INVENTED["locate"]["directions"], "windows": windows}
    page = Page(report_html(invented(locate=locate)))
    assert "3 more recordings" in page.text and len(page.plots()) == 1 + 7


def test_another_schema_is_refused() -> None:
    with pytest.raises(ValueError, match=r"schema: found 'other/1'; expected 'diabolo.diagnosis/1'"):
        report_html({"schema": "other/1"})


@pytest.mark.parametrize("library", ["jinja2", "plotly"])
def test_without_its_libraries_a_sentence_says_so(monkeypatch: pytest.MonkeyPatch, library: str) -> None:
    def absent(name: str) -> None:
        if name == library:
            raise ModuleNotFoundError(name=name)

    monkeypatch.setattr(checks, "import_module", absent)
    with pytest.raises(ValueError, match=rf"out.html: .* install {library} \(pip install '.\[plot\]' "):
        report.check(Path("out.html"))


@pytest.mark.parametrize(
    ("value", "unit", "interval", "text"),
    [
        (0.0007, "s", [-0.0002, 0.0016], "0.70 [−0.20, 1.60] ms"),
        (0.01, "rad", None, "0.573 deg"),
        (1.4523, "m", [1.4511, 1.4535], "1.4523 [1.4511, 1.4535] m"),
        (0.00041, "m", None, "0.41 mm"),
        (3.1e-5, "1/rad", [2.7e-5, 3.5e-5], "3.10 [2.70, 3.50] × 10⁻⁵ 1/rad"),
        (1.0, "1/m", [None, 2.0], "1.00 [open, 2.00] 1/m"),
        (-1e-9, "m/s^2", [-1.0, 1.0], "0.0 [−1.0, 1.0] m/s²"),
        (0.0, "1", None, "0 (no unit)"),
        (None, "m", None, "not known"),
    ],
)
def test_numbers_are_in_readable_units(value: Any, unit: str, interval: Any, text: str) -> None:
    assert quantity(value, unit, interval) == text


def test_odds_of_the_next_experiment_are_told() -> None:
    rows = [
        {"motion": "high_throws", "parts": ["wind"], "odds": odds, "seconds": 20.0}
        for odds in (1.93, 4321.0, 1e6, None)
    ]
    text = Page(report_html(invented(next_experiment=rows))).text
    for told in ("1.93 to 1", "4,321 to 1", "beyond a million to 1", "not told"):
        assert told in text


def test_thresholds_are_those_of_the_result() -> None:
    thresholds = {"physics": 6.5, "measurement": 7.5, "worthwhile_odds": 3.0}
    assert (
        "6.5 for physics and 7.5 for the measurement"
        in Page(report_html(invented(thresholds=thresholds))).text
    )
    assert "4 for physics and 5 for the measurement" in Page(report_html(invented())).text
