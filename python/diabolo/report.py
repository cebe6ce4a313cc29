# SPDX-License-Identifier: MIT
"""A diagnosis as a page for people: one HTML file, with its figures and a replay inside."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import figures
from ._core import DIAGNOSIS_SCHEMA, Thresholds
from .checks import check_drawing
from .view import Replay, replay_html

if TYPE_CHECKING:
    from jinja2 import Template

LONGEST_BAR = 3.0
"""Of the ladder, in thresholds of physics."""
LEAST_PROBABILITY = 1e-300
"""A p-value below it is told as that."""
FIRST_RECORDINGS = 4
"""So many are shown at once; the others unfold."""

TEMPLATES = Path(__file__).with_name("templates")
WORDS: dict[str, str] = json.loads((TEMPLATES / "words.json").read_text(encoding="utf-8"))


def check(path: str | Path) -> None:
    """Raise ValueError where a report cannot be made for want of a library."""
    check_drawing(path, "jinja2", "plotly")


def report_html(
    result: dict[str, Any], comparison: dict[str, Any] | None = None, replays: Sequence[Replay] = ()
) -> str:
    """The page of a result of schema diabolo.diagnosis/1; what it lacks, the page says in words.

    comparison: of somebody's simulator with the recordings (diabolo.comparison/1), which comes first then.
    replays: of the takes, to show measured beside predicted; the worst one plays.
    """
    check("report")
    if result.get("schema") != DIAGNOSIS_SCHEMA:
        raise ValueError(f"schema: found {result.get('schema')!r}; expected {DIAGNOSIS_SCHEMA!r}")
    thresholds = {**Thresholds().to_dict(), **(result.get("thresholds") or {})}
    horizons = (result.get("fit") or {}).get("horizons_s") or []
    locate = result.get("locate") or {}
    shown = [replay for replay in replays if np.isfinite(replay.errors("base")).any()]
    worst = max(shown, key=lambda replay: _mean_error(replay, "base") or 0.0, default=None)
    page = _template().render(
        result=result,
        simulator=None if comparison is None else _simulator(comparison),
        fit=_fit(result.get("fit") or {}),
        tiles=_tiles(result) if comparison is None else _simulator_tiles(result, comparison),
        effects=[_effect(effect, horizons, _rows(locate, "windows")) for effect in _rows(result, "effects")],
        adequacy=_adequacy(result.get("adequacy") or {}, thresholds["times_noise"]),
        learnt=[_learnt(item, horizons) for item in _rows(result, "learnt")],
        unnamed=[_unnamed(item) for item in _rows(result, "unnamed")],
        differing=[row for item in _rows(result, "differing") for row in _differing(item)],
        replay=None if worst is None else replay_html(worst),
        located=_located(locate, shown, thresholds["physics"]),
        first_located=FIRST_RECORDINGS,
        ladder=_ladder(result, thresholds),
        thresholds=[f"{thresholds[kind]:g}" for kind in ("physics", "measurement")],
        ties=_ties(result, thresholds["worthwhile_odds"]),
        nuisances=[
            [_named(row), quantity(row.get("value"), row.get("unit"), row.get("ci90"))]
            for row in _rows(result, "nuisances")
        ],
        limits=[
            [_named(row), words(row.get("parameter")), _limit(row, _ladder_row(result, row), thresholds)]
            for row in _rows(result, "upper_limits")
        ],
        experiments=[_experiment(row) for row in _rows(result, "next_experiment")],
        takes=_joined(Path(str(row.get("file"))).stem for row in _rows(result, "inputs")),
        inputs=[[row.get("file"), (row.get("sha256") or "")[:16]] for row in _rows(result, "inputs")],
        noise=[
            [
                row.get("recording"),
                quantity(row.get("position_m"), "m"),
                quantity(row.get("spin_rad_s"), "rad/s"),
            ]
            for row in _rows(result, "noise")
        ],
        seconds=quantity(result.get("seconds"), "s"),
    )
    return page.replace("PLOTLY", figures.library(), 1) if 'class="plot"' in page else page


@cache
def _template() -> Template:
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template("diagnosis.html.j2")


# ---- words and numbers ----


def words(key: Any) -> str:
    """A key in plain words."""
    return WORDS.get(str(key), str(key).replace("_", " ")) if key else "not given"


def quantity(value: Any, unit: str | None, interval: Any = None) -> str:
    """A number in a unit that people read, with as many digits as its interval supports."""
    if value is None:
        return "not known"
    ends = [end for end in interval or () if end is not None]
    largest = max(abs(number) for number in (value, *ends))
    factor, shown = _readable(largest, unit or "1")
    largest *= factor
    exponent = math.floor(math.log10(largest)) if largest > 0.0 else 0
    power = exponent if not -3 <= exponent < 6 else 0
    factor /= 10.0**power
    width = abs(ends[1] - ends[0]) / 2.0 if len(ends) == 2 else 0.0
    smallest = width or abs(value) / 10.0
    decimals = 1 - math.floor(math.log10(smallest * factor)) if smallest * factor > 0.0 else 0
    decimals = min(max(decimals, 0), 6)

    def text(number: float | None) -> str:
        if number is None:
            return "open"
        rounded = f"{number * factor:.{decimals}f}"
        if not interval and "." in rounded:
            rounded = rounded.rstrip("0").rstrip(".")
        return rounded.replace("-", "\N{MINUS SIGN}") if float(rounded) else rounded.removeprefix("-")

    both = text(value) + (f" [{text(interval[0])}, {text(interval[1])}]" if interval else "")
    return f"{both}{_power_of_ten(power) if power else ''} {shown}"


def _readable(largest: float, unit: str) -> tuple[float, str]:
    if unit == "m":
        return (1e3, "mm") if largest < 0.1 else (1.0, "m")
    if unit == "s":
        return (1e3, "ms") if largest < 0.1 else (1.0, "s")
    if unit == "rad":
        return 180.0 / math.pi, "deg"
    if unit == "m/N":
        return 1e3, "mm/N"
    return 1.0, "(no unit)" if unit == "1" else unit.replace("^2", "²").replace("*", " ")


def _power_of_ten(power: int) -> str:
    return " \N{MULTIPLICATION SIGN} 10" + str(power).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def probability(p: float | None) -> str:
    if p is None:
        return "not known"
    if p >= 1e-3:
        return f"{p:.2g}"
    if p < LEAST_PROBABILITY:
        return "< 10⁻³⁰⁰"
    digit, power = f"{p:.0e}".split("e")
    return (digit + _power_of_ten(int(power))).replace(" ", "\N{NO-BREAK SPACE}")


def percent(share: float | None) -> str:
    return "not known" if share is None else f"{100.0 * share:.0f} %"


def _rows(parent: dict[str, Any], key: str) -> list[dict[str, Any]]:
    return [row for row in parent.get(key) or [] if row]


def _named(row: dict[str, Any]) -> dict[str, str]:
    """A cell: the name in plain words beside the key."""
    return {"words": words(row.get("name")), "key": row.get("name") or ""}


def _estimates(parent: dict[str, Any], key: str) -> list[str]:
    """Parameters with their values and intervals."""
    return [
        f"{words(row.get('name'))} {quantity(row.get('value'), row.get('unit'), row.get('ci90'))}"
        for row in _rows(parent, key)
    ]


def _joined(parts: Iterable[str]) -> str:
    found = list(parts)
    return " and ".join([", ".join(found[:-1]), found[-1]] if len(found) > 1 else found)


# ---- what the sections say ----


def _fit(fit: dict[str, Any]) -> dict[str, Any]:
    """Errors on held-out data, before and after, and whether they differ."""
    rows = _held_out(fit, ("base_error_m", "augmented_error_m", "improvement_ci95_m", "start_error_m"))
    unused = fit.get("holdout_unused") or []
    left = f" Held out, but without a start that could be compared: {_joined(unused)}." if unused else ""
    if not rows:
        return {
            "sentence": f"There is no held-out error: nothing could be predicted and compared.{left}",
            "rows": [],
            "spin": [],
            "axle": _axle(fit),
            "axle_title": _axle_title(fit),
        }
    horizon, base, augmented, interval, start = rows[-1]
    where = f"On {_held_out_data(fit.get('heldout'))}, the mean position error {quantity(horizon, 's')} ahead"
    windows = f" (at most {fit['windows']} starts)" if fit.get("windows") is not None else ""
    tile = _millimetres(base)
    if augmented is None:
        sentence = f"{where} is {tile}{windows}. There is no corrected simulator to compare with."
    else:
        tile += f" → {_millimetres(augmented)}"
        share = (
            f" ({percent(abs(augmented / base - 1.0))} {'less' if augmented <= base else 'more'})"
            if base
            else ""
        )
        sentence = f"{where} goes from {_millimetres(base)} to {_millimetres(augmented)}{share}{windows}. "
        sentence += _improvement(base - augmented, interval)
        if start is not None:
            sentence += f" The noise of the starts alone would make {_millimetres(start)}."
    tile_label = f"mean held-out error, {quantity(horizon, 's')} ahead"
    return {
        "sentence": sentence + left,
        "rows": _error_table(rows, _millimetres),
        "spin": _error_table(_held_out(fit, SPIN_ERRORS), _radians_per_second),
        "axle": _axle(fit),
        "axle_title": _axle_title(fit),
        "tile": tile,
        "tile_label": tile_label,
        "figure": figures.error_figure(rows),
    }


def _axle(fit: dict[str, Any]) -> list[list[str]]:
    """Of the axle's direction: a row of a table."""
    ahead, base, augmented = (
        fit.get(name) for name in ("axle_ahead_s", "base_axle_error_rad", "augmented_axle_error_rad")
    )
    if not (isinstance(base, int | float) and isinstance(augmented, int | float)):
        return []
    gain = quantity(base - augmented, "rad", fit.get("axle_improvement_ci95_rad"))
    constant = quantity(fit.get("constant_axle_error_rad"), "rad")
    return [[quantity(ahead, "s"), constant, quantity(base, "rad"), quantity(augmented, "rad"), gain]]


def _axle_title(fit: dict[str, Any]) -> str:
    """What the axle's direction was compared on."""
    return f"The axle's direction, on {_held_out_data(fit.get('axle_heldout'))}"


def _held_out_data(heldout: str | None) -> str:
    """What was predicted without being fitted."""
    kinds = {"recordings": "held-out recordings", "blocks": "held-out stretches of the recordings"}
    return kinds.get(heldout or "", "held-out data")


SPIN_ERRORS = (
    "base_spin_error_radps",
    "augmented_spin_error_radps",
    "spin_improvement_ci95_radps",
    "start_spin_error_radps",
)


def _held_out(fit: dict[str, Any], names: Sequence[str]) -> list[tuple[Any, ...]]:
    """Horizon, errors before and after, the improvement's interval, and the starts' noise, where known."""
    horizons = fit.get("horizons_s") or []
    columns = [fit.get(name) or [None] * len(horizons) for name in names]
    rows = zip(horizons, *columns, strict=False)
    return [row for row in rows if None not in row[:2] and row[0] > 0]


def _error_table(rows: Iterable[Sequence[Any]], shown: Callable[..., str]) -> list[list[str]]:
    return [
        [
            quantity(row[0], "s"),
            shown(row[1]),
            shown(row[2]),
            _gain(row, shown),
            shown(row[4]),
        ]
        for row in rows
    ]


def _gain(row: Sequence[Any], shown: Callable[..., str]) -> str:
    """What a correction takes off an error, in an error table."""
    if None in row[1:3]:
        return "not known"
    return "too few independent starts" if row[3] is None else shown(row[1] - row[2], row[3])


def _radians_per_second(spin: float | None, interval: Any = None) -> str:
    return quantity(spin, "rad/s", interval)


def _millimetres(length: float | None, interval: Any = None) -> str:
    """For errors, which compare at a glance only in one unit."""
    ends = [None if end is None else 1e3 * end for end in interval] if interval else None
    return quantity(None if length is None else 1e3 * length, "mm", ends)


def _error(value: float | None, unit: str | None) -> str:
    return _millimetres(value) if unit == "m" else quantity(value, unit)


def _improvement(gain: float, interval: Any) -> str:
    if not interval or None in interval:
        return "Too few starts are independent for an interval of the improvement."
    shown = f"The improvement is {_millimetres(gain, interval)}, with its 95 % interval"
    if interval[0] > 0.0:
        return f"{shown}, which excludes zero."
    verdict = "it predicts worse" if interval[1] < 0.0 else "zero is inside, so no improvement is shown"
    return f"{shown}: {verdict}."


def _adequacy(adequacy: dict[str, Any], times_noise: float) -> dict[str, Any]:
    """What is left beside what noise alone would leave: in words, over all, by place, and in time."""
    if adequacy.get("adequate") is None:
        said = "It was not asked how much noise alone would leave."
    elif adequacy["adequate"]:
        said = f"No more is left than {times_noise:g} times what the camera's noise alone would leave."
    else:
        said = "More is left than the camera's noise would leave: something has no explanation yet."
    return {
        "said": said,
        "overall": [_left_over(row) for row in _rows(adequacy, "overall")],
        "places": [[_place(row), *_left_over(row)] for row in _rows(adequacy, "places")],
        "changes": [_change(row) for row in _rows(adequacy, "changes")],
    }


def _differing(item: dict[str, Any]) -> list[list[Any]]:
    """What each recording, fitted by itself, asks for."""
    return [
        [
            {"words": item.get("what") or words(item.get("name")), "key": item.get("name") or ""},
            alone.get("recording"),
            _estimates(alone, "parameters"),
            _number(item.get("z"), 1),
        ]
        for alone in _rows(item, "recordings")
    ]


def _left_over(row: dict[str, Any]) -> list[Any]:
    sizes = [_error(row.get(name), row.get("unit")) for name in ("base", "left", "noise")]
    ahead = row.get("ahead_s")
    fitted = f"{row.get('quantity')}, fitted" if row.get("quantity") else None
    what = fitted if ahead is None else f"{row.get('quantity')}, held out, {ahead:g} s ahead"
    return [what, *sizes, _number(row.get("times_noise"), 1), _number(row.get("windows"), 0)]


def _number(value: Any, digits: int) -> str:
    return f"{value:.{digits}f}" if isinstance(value, int | float) else "-"


def _place(row: dict[str, Any]) -> str:
    """State of the string, direction and stretch of time, as far as they are known."""
    parts = [] if row.get("mode") in (None, "ANY") else [words(row["mode"])]
    parts += [words(row["direction"])] if row.get("direction") else []
    if row.get("recording"):
        parts.append(
            f"{row['recording']}, {_number(row.get('begin_s'), 1)} to {_number(row.get('end_s'), 1)} s"
        )
    return "; ".join(parts) or "everywhere"


def _change(row: dict[str, Any]) -> list[Any]:
    trend, frequency = row.get("trend_per_s"), row.get("frequency_hz")
    how = (
        f"steadily, by {quantity(trend, row.get('unit'))} each second"
        if trend is not None
        else "comes and goes"
        if frequency is None
        else f"comes and goes, {_number(frequency, 2)} Hz"
    )
    size = quantity(row.get("size"), row.get("unit"))
    return [words(row.get("quantity")), size, how, _number(row.get("z"), 1)]


def _simulator(comparison: dict[str, Any]) -> dict[str, Any]:
    """What a simulator has and lacks, law by law."""
    verdicts = {
        "agrees": "agrees",
        "cannot_tell": "cannot be told",
        "lacks": "lacks it",
        "too_little": "has too little",
        "too_much": "has too much",
        "should_not_have": "should not have it",
    }

    laws = [
        [
            {"words": law["what"], "key": law["name"]},
            verdicts[law["verdict"]],
            _estimates(law, "real") or ["none"],
            _estimates(law, "simulated") or ["none"],
            [] if law["verdict"] in ("agrees", "cannot_tell") else _estimates(law, "difference") or ["none"],
            _sizes(law) or ["-"],
        ]
        for law in _rows(comparison, "laws")
    ]
    names = ("base_error_m", "augmented_error_m", "improvement_ci95_m", "start_error_m")
    errors = _held_out(comparison.get("fit") or {}, names)
    told = {"sentence": comparison["sentence"], "laws": laws, "errors": []}
    if errors:
        ahead, alone, corrected = errors[-1][:3]
        told["errors"] = [row[:4] for row in _error_table(errors, _millimetres)]
        told["tile_label"] = f"your simulator's mean held-out error, {quantity(ahead, 's')} ahead"
        told["tile"] = f"{_millimetres(alone)} → {_millimetres(corrected)}"
    return told


def _tiles(result: dict[str, Any]) -> list[list[Any]]:
    """Beside the held-out error: label and value."""
    return [
        ["effects claimed", len(_rows(result, "effects")) or "none"],
        ["base simulator", result.get("base") or "not given"],
        ["recordings", len(_rows(result, "inputs")) or "not given"],
    ]


def _simulator_tiles(result: dict[str, Any], comparison: dict[str, Any]) -> list[list[Any]]:
    """The same about somebody's simulator."""
    verdicts = [law["verdict"] for law in _rows(comparison, "laws")]
    differ = [verdict for verdict in verdicts if verdict not in ("agrees", "cannot_tell")]
    return [
        ["laws that differ", len(differ) or "none"],
        ["laws compared", len(verdicts) or "none"],
        ["recordings", len(_rows(result, "inputs")) or "not given"],
    ]


def _effect(effect: dict[str, Any], horizons: list[float], windows: list[dict[str, Any]]) -> list[Any]:
    notes = [str(effect["kind"])] if effect.get("kind") else []
    notes += ["too small to matter"] if effect.get("material") is False else []
    ties = list(filter(None, effect.get("tied_with") or []))
    notes += [f"tied with {_joined(map(words, ties))}: the value may include its effect"] if ties else []
    return [
        {**_named(effect), "notes": notes},
        _estimates(effect, "parameters") or ["none"],
        _where(effect.get("where") or {}, windows),
        _effect_sizes(effect, horizons) or ["not known"],
        probability(effect.get("p_value")),
        "one of a tie" if ties else percent(effect.get("confidence")),
    ]


def _effect_sizes(effect: dict[str, Any], horizons: list[float]) -> list[str]:
    """What was measured without it; else how far it would move a free diabolo."""
    without, size = _without(effect, horizons), dict(effect.get("size") or {})
    if turned := effect.get("axle_worse_without_ci95_rad"):
        low, high = np.degrees(turned)
        without = [f"without it the axle is off by {low:.2g} to {high:.2g} deg more on held-out data"]
    if without:
        size["position_1s_m"] = None
    return [*_sizes(size), *without]


def _without(effect: dict[str, Any], horizons: list[float]) -> list[str]:
    """How much worse held-out data is predicted without it, at the longest horizon that tells."""
    rows = zip(horizons, effect.get("worse_without_ci95_m") or [], strict=False)
    told = [(horizon, interval) for horizon, interval in rows if interval and None not in interval]
    if not told or told[-1][1] == [0.0, 0.0]:
        return []
    horizon, (low, high) = next((row for row in reversed(told) if row[1][0] > 0.0), told[-1])
    sure = "" if low > 0.0 else ", so not shown to help there"
    worse = f"{1e3 * low:.3g} to {1e3 * high:.3g} mm worse after {horizon:g} s"
    return [f"without it {worse} on held-out data{sure}"]


def _sizes(row: dict[str, Any]) -> list[str]:
    sizes = [
        f"{_error(row[key], unit)}{after}"
        for key, unit, after in (
            ("acceleration_mps2", "m/s^2", ""),
            ("size_m", "m", " after 0.5 s"),
            ("position_1s_m", "m", " after 1 s"),
        )
        if row.get(key) is not None
    ]
    share, turn = row.get("spin_share_1s"), row.get("axle_1s_rad")
    sizes += [] if share is None else [f"{percent(share)} of the spin in 1 s"]
    return sizes + ([] if turn is None else [f"turns the axle by {quantity(turn, 'rad')} in 1 s"])


def _where(where: dict[str, Any], windows: Iterable[dict[str, Any]] = ()) -> list[str]:
    lines = [", ".join(words(mode) for mode in where.get("modes") or [])]
    lines += [words(where["direction"])] if where.get("direction") else []
    intervals = [span for span in where.get("intervals") or [] if span and None not in span]
    named = zip(_recordings_of(intervals, list(windows)), intervals, strict=True)
    spans = [f"{name}{begin:.1f} to {end:.1f} s" for name, (begin, end) in named][:3]
    lines += ["; ".join(spans) + (f" and {len(intervals) - 3} more" if len(intervals) > 3 else "")]
    return [line for line in lines if line] or ["everywhere or not known"]


def _recordings_of(intervals: list[Any], windows: list[dict[str, Any]]) -> list[str]:
    """Of each interval the recording whose windows begin and end so; the recordings follow each other."""
    names = list(dict.fromkeys(w.get("recording") or "" for w in windows))
    begun, ended = ({(w.get("recording"), w.get(key)) for w in windows} for key in ("begin_s", "end_s"))
    possible = [
        [k for k, name in enumerate(names) if (name, begin) in begun and (name, end) in ended]
        for begin, end in intervals
    ]
    another = [after[0] < before[1] for before, after in pairwise(intervals)]  # since time goes back
    for i, anew in enumerate(another):
        least = min(possible[i], default=0) + anew
        possible[i + 1] = [k for k in possible[i + 1] if k >= least]
    for i, anew in reversed(list(enumerate(another))):
        most = max(possible[i + 1], default=len(names)) - anew
        possible[i] = [k for k in possible[i] if k <= most]
    return [" or ".join(names[k] for k in those) + (", " if those else "") for those in possible]


def _learnt(item: dict[str, Any], horizons: list[float]) -> dict[str, Any]:
    return {
        "law": item.get("law") or "a law",
        "formula": item.get("formula") or "not given",
        "facts": "; ".join([*_without(item, horizons), *_dependence(item)]),
    }


def _dependence(item: dict[str, Any]) -> list[str]:
    chance = item.get("dependence_p_value")
    if chance is None:
        return []
    gains = [_number(item.get(key), 1) for key in ("gain_by_strength", "gain_permuted")]
    return [
        f"held-out windows gain {gains[0]} in chi^2 by its strength in each, and {gains[1]} by strengths "
        f"exchanged at random (p = {chance:.3g})"
    ]


def _unnamed(item: dict[str, Any]) -> dict[str, Any]:
    curve = [point for point in item.get("curve") or [] if point and None not in point]
    value, deviation, explained = item.get("value"), item.get("deviation"), item.get("explained")
    facts = ["; ".join(_where(item.get("where") or {}))]
    if value is not None:
        around = None if deviation is None else [value - 1.645 * deviation, value + 1.645 * deviation]
        facts.append(quantity(value, item.get("unit"), around) + (" (90 % interval)" if around else ""))
    facts += _sizes(item)
    facts += [] if explained is None else [f"explains {percent(explained)} of what is left over"]
    return {
        "law": item.get("law") or "no law found",
        "facts": "; ".join(facts),
        "figure": figures.curve_figure(item, curve) if curve else None,
    }


def _ladder(result: dict[str, Any], thresholds: dict[str, float]) -> list[dict[str, Any]]:
    """All candidates, the most significant first."""
    longest = LONGEST_BAR * thresholds["physics"]
    noise = max((row.get("position_m") or 0.0 for row in _rows(result, "noise")), default=0.0)
    rows = sorted(_rows(result, "ladder"), key=lambda row: -abs(row.get("z") or 0.0))
    return [
        {
            **_named(row),
            "kind": row.get("kind") or "other",
            "claimed": bool(row.get("claimed")),
            "z": "no z" if row.get("z") is None else f"{abs(row['z']):.1f}",
            "threshold": 100.0 * _threshold(row, thresholds) / longest,
            "bar": 100.0 * min(abs(row.get("z") or 0.0) / longest, 1.0),
            "beyond": abs(row.get("z") or 0.0) > longest,
            "reason": _inseparable(row, thresholds, noise) or _reason(row),
            "facts": [
                f"{words(row.get('parameter'))} {quantity(row.get('estimate'), row.get('unit'))}",
                *_sizes(row),
                f"p {probability(row.get('p_value'))}",
            ],
        }
        for row in rows
    ]


def _threshold(row: dict[str, Any], thresholds: dict[str, float]) -> float:
    return thresholds.get(row.get("kind") or "", thresholds["physics"])


def _reason(row: dict[str, Any]) -> str:
    return row.get("reason") or ("" if row.get("claimed") else "no reason given")


def _inseparable(row: dict[str, Any], thresholds: dict[str, float], noise: float) -> str:
    """That a rejected candidate is not small, but open: a standard deviation of it moves more than noise."""
    z = abs(row.get("z") or 0.0)
    if row.get("claimed") or not 0.0 < z < _threshold(row, thresholds):
        return ""
    is_open = (row.get("size_m") or 0.0) / z > noise > 0.0
    return "not identifiable: what else is fitted has the same effect on the motion" if is_open else ""


def _ladder_row(result: dict[str, Any], limit: dict[str, Any]) -> dict[str, Any]:
    """The candidate that a limit is of."""
    return next((row for row in _rows(result, "ladder") if row.get("name") == limit.get("name")), {})


def _limit(limit: dict[str, Any], candidate: dict[str, Any], thresholds: dict[str, float]) -> str:
    """How large an effect may be that is not claimed."""
    if limit.get("limit95") is None:
        return "no limit: this data cannot show it"
    below = "below " + quantity(limit["limit95"], limit.get("unit"))
    if abs(candidate.get("z") or 0.0) < _threshold(candidate, thresholds):
        return below
    fitted = quantity(candidate.get("estimate"), candidate.get("unit"))
    return f"{below}; the fit gives {fitted} ({_reason(candidate)})"


def _ties(result: dict[str, Any], worthwhile: float) -> list[str]:
    """Every class of explanations that this data cannot tell apart, once, and what would."""
    classes = {
        frozenset([effect.get("name") or "", *filter(None, effect["tied_with"])]): None
        for effect in _rows(result, "effects")
        if effect.get("tied_with")
    }
    sentences = []
    for names in classes:
        listed = _joined(f"{words(name)} ({name})" for name in sorted(names))
        parting = [
            _motion(row)
            for row in _rows(result, "next_experiment")
            if len(names & set(row.get("parts") or [])) > 1 and (row.get("odds") or math.inf) >= worthwhile
        ]
        would = f" What would: {_joined(parting)}." if parting else ""
        sentences.append(f"{listed} predict the same here; this data cannot tell them apart.{would}")
    return sentences


def _motion(row: dict[str, Any]) -> str:
    return row.get("what") or words(row.get("motion"))


def _experiment(row: dict[str, Any]) -> list[Any]:
    parts = row.get("parts") or []
    return [
        _motion(row),
        [f"{words(part)} ({part})" for part in parts] or ["not given"],
        quantity(row.get("seconds"), "s"),
        _odds(row.get("odds")),
    ]


def _odds(odds: float | None) -> str:
    if odds is None:
        return "not told"
    return (
        "beyond a million to 1" if odds >= 1e6 else f"{odds:,.3g} to 1" if odds < 1e3 else f"{odds:,.0f} to 1"
    )


# ---- over time ----


def _located(locate: dict[str, Any], replays: Sequence[Replay], threshold: float) -> list[dict[str, Any]]:
    """Of each recording: a figure of what is missing and left by time, and what it shows in words."""
    directions = [_direction(direction) for direction in _rows(locate, "directions")]
    windows: dict[str, list[dict[str, Any]]] = {}
    for window in _rows(locate, "windows"):
        if window.get("begin_s") is not None and window.get("end_s") is not None:
            windows.setdefault(window.get("recording") or "recording", []).append(window)
    by_name = {replay.recording.name: replay for replay in replays}
    names = list(dict.fromkeys([*windows, *by_name]))
    scale = figures.Scale.of([window for own in windows.values() for window in own])
    located = []
    for name in names:
        own = sorted(windows.get(name, []), key=lambda window: window["begin_s"])
        said = [_strongest(own, directions, threshold)] if own else []
        if name in by_name:
            before, after = (_millimetres(_mean_error(by_name[name], key)) for key in ("base", "corrected"))
            said.append(f"Mean distance in the replay: {before} (base), {after} (corrected).")
        rows = -(-figures.MOST_ROWS // len(names))
        figure = figures.take_figure(own, directions, by_name.get(name), scale, rows, words)
        located.append({"recording": name, "said": " ".join(said), "figure": figure})
    return located


def _mean_error(replay: Replay, name: str) -> float | None:
    """Of its predictions, over all their rows [m]; nothing where there are none."""
    errors = replay.errors(name)
    known = errors[np.isfinite(errors)]
    return float(known.mean()) if len(known) else None


def _strongest(windows: list[dict[str, Any]], directions: list[str], threshold: float) -> str:
    cells = [
        (abs(z), direction, window["begin_s"])
        for window in windows
        for z, direction in zip(window.get("z") or [], directions, strict=False)
        if z is not None
    ]
    if not cells:
        return "No direction could be tested here."
    z, direction, begin = max(cells, key=lambda cell: cell[0])
    if z > threshold:
        return f"Strongest: {direction}, {z:.1f} standard deviations at {begin:.1f} s."
    return f"Nothing beyond {threshold:g} standard deviations; the most is {z:.1f}, {direction}."


def _direction(direction: dict[str, Any]) -> str:
    return f"{words(direction.get('mode'))}: {words(direction.get('name'))}"
