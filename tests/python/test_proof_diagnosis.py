# SPDX-License-Identifier: MIT
"""The proof itself is put to the proof: its scorer has to fail tools that know nothing, and broken seals."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from diabolo import FormulaLaws, load_recording

from benchmarks.proof import files
from benchmarks.proof.diagnosis import (
    __main__,
    arms,
    batch,
    breakdown,
    camera_steps,
    commands,
    draw,
    earlier,
    gp,
    intervals,
    judge,
    own_laws,
    page,
    record,
    run,
    score,
    seal,
    strangers,
    tables,
    told,
    tools,
)
from benchmarks.proof.diagnosis.answer import kept
from benchmarks.proof.diagnosis.names import (
    MEASUREMENT,
    NEVER_DRAWN,
    PHYSICS,
    faults_among,
    physics_among,
)

ROOT = Path(__file__).resolve().parents[2]
BATCHES = ROOT / "benchmarks" / "proof" / "diagnosis" / "batches"
PLACE = {"quantity": "position", "mode": "ON_STRING", "direction": "left"}
# Of the file that was published when the batch was sealed, as SHA-256.
DIGEST_OF_FIFTEENTH = "7c431a42cc3fe989eaf446c9e9207c62d531999f037e788f54bba0b9a133ccc4"

SILENT = "strangers met with silence, SNR >= 10"
SWING = load_recording(ROOT / "data" / "recordings" / "swing.csv")
SIZES = {
    "string_friction": {"coefficient": 0.2},
    "air_drag_quadratic": {"coefficient": 0.05},
    "spin_drag": {"coefficient": 0.003},
    "axle_drag": {"rate": 14.0},
}


def effect(
    name: str, *, tied_with: list[str] | None = None, truth: dict[str, float] | None = None
) -> dict[str, Any]:
    """A claim, with intervals about the truth."""
    return {
        "name": name,
        "kind": "physics" if name in PHYSICS else "measurement",
        "material": True,
        "tied_with": tied_with or [],
        "p_value": 1e-9,
        "confidence": 0.99,
        "parameters": [
            {"name": parameter, "value": value, "unit": "1", "ci90": [0.9 * value, 1.1 * value]}
            for parameter, value in (truth or {}).items()
        ],
        "where": {"modes": list(PHYSICS.get(name, ["ON_STRING"]))},
    }


def result(
    effects: list[dict[str, Any]], headline: str = "NAMED", z: float = 30.0, own: tuple[str, ...] = ()
) -> dict[str, Any]:
    """An answer that knows of all names, and of some laws of one's own."""
    names = [*PHYSICS, *MEASUREMENT, *own]
    return {
        "headline": headline if effects else "NOTHING_MISSING",
        "effects": effects,
        "ladder": [
            {"name": name, "estimate": 0.0, "z": z, "size_m": 0.01, "claimed": False} for name in names
        ],
        "fit": {"horizons_s": [1.0], "base_error_m": [0.1], "augmented_error_m": [0.01 if effects else 0.1]},
    }


def key_of(plan: draw.Plan) -> dict[str, Any]:
    drawn = draw.draw(plan)
    return drawn.key({name: SIZES.get(name, {"rate": 0.5}) for name in drawn.content.names})


@pytest.fixture(scope="module")
def keys() -> list[dict[str, Any]]:
    return [key_of(plan) for plan in draw.plans(5, 600)]


def right(key: dict[str, Any]) -> dict[str, Any]:
    """The answer of who has the key."""
    if key["bad"]:
        return result([]) | {"headline": "INSUFFICIENT_DATA"}
    effects = [effect(name, truth=key["parameters"].get(name)) for name in key["names"]]
    if key["tie"]:
        effects = [effect(key["names"][0], tied_with=[n for n in key["tie"] if n != key["names"][0]])]
    if key["arm"] != "strangers":
        return result(effects)
    parts = strangers.parts_of(key["outside"], key["scenario"], SWING)
    learnt = [{"acts": part.acts, "formula": "size", "numbers": []} for part in parts.values()]
    found = result(effects, own=(*parts,)) | {"learnt": learnt}
    found["headline"] = "NAMED" if effects else "UNNAMED_STRUCTURE"
    found["fit"]["augmented_error_m"] = [0.01]
    return found


def oracle_of(key: dict[str, Any]) -> dict[str, Any]:
    """The answer of who was told the names, and the laws without a name."""
    found = right(key)
    if key["arm"] == "strangers":
        names = [rung["name"] for rung in found["ladder"] if rung["name"].startswith(key["outside"] + "_")]
        worse = {"worse_without_ci95_m": [[0.08 / len(names), 0.1 / len(names)]]}
        found["effects"] += [effect(name) | worse for name in names]
    return found


def scored(keys: list[dict[str, Any]], answer: Any) -> dict[str, score.Score]:
    """Scores by name; the oracle has the key."""
    answers = {key["case"]: kept(answer(key)) for key in keys}
    asked = [key for key in keys if physics_among(key["names"]) or key["outside"]]
    oracles = {key["case"]: kept(oracle_of(key)) for key in asked}
    others = {key["case"]: kept(result([])) for key in keys if key["tie"]}
    return {found.name: found for found in score.scores(score.judged(keys, answers, oracles, others))}


def failing(scores: dict[str, score.Score]) -> set[str]:
    return {name for name, found in scores.items() if found.fails}


def test_who_has_the_keys_passes(keys: list[dict[str, Any]]) -> None:
    scores = scored(keys, right)
    assert failing(scores) <= {"90 % intervals that cover, physics"}  # they cover always, which is too often
    assert scores["detected, SNR >= 10"].value == 1.0
    assert scores["gap closed after 1 s"].value == pytest.approx(1.0)


def test_always_drag_fails(keys: list[dict[str, Any]]) -> None:
    found = failing(scored(keys, lambda key: result([effect("air_drag_quadratic")])))
    assert {"false physics on nulls", "false physics on faults only", "top name right, SNR >= 10"} <= found
    assert {"truth in the answer or its tie, SNR >= 10", "laws outside the bank misnamed"} <= found


def test_always_abstaining_fails(keys: list[dict[str, Any]]) -> None:
    found = failing(scored(keys, lambda key: result([])))
    assert {
        "detected, SNR >= 10",
        "truth in the answer or its tie, SNR >= 10",
        "gap closed after 1 s",
    } <= found
    assert {"ties declared, SNR >= 10", "two effects both named, SNR >= 10"} <= found
    assert {SILENT, "strangers told, SNR >= 10", "gap of strangers closed after 1 s"} <= found


def test_always_something_unnamed_fails(keys: list[dict[str, Any]]) -> None:
    found = failing(scored(keys, lambda key: result([]) | {"headline": "UNNAMED_STRUCTURE"}))
    assert {"something unnamed on nulls and faults", "strangers told at the right place, SNR >= 10"} <= found
    assert not {SILENT, "strangers told, SNR >= 10"} & found


def test_names_of_what_is_beside_a_stranger_are_silent_about_it(keys: list[dict[str, Any]]) -> None:
    def named(key: dict[str, Any]) -> dict[str, Any]:
        effects = [effect(name, truth=key["parameters"].get(name)) for name in key["names"]]
        return result(effects) | {"adequacy": {"adequate": True}}

    met = [key for key in keys if key["outside"]]
    forms = [key for key in met if strangers.KINDS[key["outside"]].is_form]
    for key in met:
        got = judge.judge(key, kept(named(key)), kept(right(key))).met
        assert got and got.verdict == (told.TAKEN_FOR if key in forms else told.SILENT)
    assert sum(len(key["names"]) > 0 for key in met) > len(forms) > 0


def test_the_bounce_of_a_catch_is_neither_right_nor_wrong(keys: list[dict[str, Any]]) -> None:
    bounces = kept(result([effect("landing_restitution")]) | {"adequacy": {"adequate": True}})
    null = next(key for key in keys if key["arm"] == "null")
    assert not judge.judge(null, bounces, kept(right(null))).false_physics
    alone = next(key for key in keys if key["outside"] and not key["names"])
    got = judge.judge(alone, bounces, kept(right(alone))).met
    assert got and got.verdict == told.SILENT


def test_one_silence_fails_where_strangers_are_few(keys: list[dict[str, Any]]) -> None:
    few = [key for key in keys if key["arm"] == "strangers"][:3]
    assert not {SILENT} & failing(scored(few, right))
    assert {SILENT} <= failing(scored(few, lambda key: result([]) if key is few[0] else right(key)))


def test_a_class_of_everything_fails(keys: list[dict[str, Any]]) -> None:
    found = failing(
        scored(keys, lambda key: result([effect("wind", tied_with=[n for n in PHYSICS if n != "wind"])]))
    )
    assert {"mean size of a class", "classes of more than three", "false physics on nulls"} <= found


def test_swapped_keys_fail(keys: list[dict[str, Any]]) -> None:
    others = {key["case"]: keys[(place + 1) % len(keys)] for place, key in enumerate(keys)}
    found = failing(scored(keys, lambda key: right(others[key["case"]])))
    assert {"false physics on nulls", "false physics on faults only", "detected, SNR >= 10"} <= found


def test_without_an_oracle_nothing_is_said_of_power(keys: list[dict[str, Any]]) -> None:
    verdicts = score.judged(keys, {key["case"]: kept(right(key)) for key in keys}, {})
    scores = {found.name: found for found in score.scores(verdicts)}
    assert scores["detected, SNR >= 10"].value is None
    assert not scores["detected, SNR >= 10"].fails
    assert breakdown.failures(verdicts) == []


@pytest.fixture
def sealed(tmp_path: Path) -> tuple[dict[str, Any], batch.Store]:
    """A batch of made-up recordings."""
    store = batch.Store(tmp_path / "made")
    plans = draw.plans(3, 12)
    for plan in plans:
        files.write_json(store.key_path(plan.name), {**key_of(plan), "attempts": 1})
        files.write_text(store.recording(plan.name), f"time\n{plan.number}\n")
        files.write_text(store.recording(plan.name).with_suffix(".json"), "{}")
    return seal.describe(store, [plan.name for plan in plans], "0" * 40, 3, "plant"), store


def test_a_sound_seal_opens(sealed: tuple[dict[str, Any], batch.Store]) -> None:
    description, store = sealed
    seal.check_recordings(description, store)
    assert [key["case"] for key in seal.open_keys(description, store)] == [
        entry["case"] for entry in description["sealed"]
    ]


def test_a_changed_key_breaks_the_seal(sealed: tuple[dict[str, Any], batch.Store]) -> None:
    description, store = sealed
    key = store.key("case_0004")
    files.write_json(store.key_path("case_0004"), {**key, "names": ["wind"]})
    with pytest.raises(ValueError, match=r"case_0004\.json: not the key that was sealed"):
        seal.open_keys(description, store)


def test_swapped_key_files_break_the_seal(sealed: tuple[dict[str, Any], batch.Store]) -> None:
    description, store = sealed
    one, other = store.key_path("case_0002"), store.key_path("case_0003")
    texts = one.read_text(), other.read_text()
    one.write_text(texts[1])
    other.write_text(texts[0])
    with pytest.raises(ValueError, match="not the key that was sealed"):
        seal.open_keys(description, store)


def test_a_changed_recording_breaks_the_seal(sealed: tuple[dict[str, Any], batch.Store]) -> None:
    description, store = sealed
    store.recording("case_0007").write_text("time\n0\n")
    with pytest.raises(ValueError, match="not the recording that was sealed"):
        seal.check_recordings(description, store)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda batch: batch["sealed"], "schema None"),
        (lambda batch: {**batch, "schema": "other"}, "schema 'other'"),
        (lambda batch: {k: v for k, v in batch.items() if k not in ("seed", "arms")}, "lacks seed, arms"),
        (lambda batch: {**batch, "sealed": [{"case": "case_0001"}]}, r"sealed\[0\]: expected case"),
    ],
)
def test_a_broken_batch_is_told(
    sealed: tuple[dict[str, Any], batch.Store], tmp_path: Path, change: Any, said: str
) -> None:
    files.write_json(tmp_path / "broken.json", change(sealed[0]))
    with pytest.raises(ValueError, match=rf"broken\.json: {said}"):
        seal.read(tmp_path / "broken.json")


def test_a_criterion_alone_claims_whatever_lowers_chi_square(monkeypatch: pytest.MonkeyPatch) -> None:
    rungs = [
        ("wind", "physics", -3.5),
        ("string_length", "measurement", 2.0),
        ("body_swap", "measurement", None),
    ]
    ladder = [{"name": name, "kind": kind, "z": z, "p_value": 0.1} for name, kind, z in rungs]
    fit = {"horizons_s": [1.0], "base_error_m": [0.1], "augmented_error_m": [0.02]}
    found = {"headline": "NOTHING_MISSING", "effects": [], "ladder": ladder, "fit": fit}
    monkeypatch.setattr(tools, "full", lambda path: found)
    monkeypatch.setattr(tools, "load_recording", lambda path: range(1000))  # sqrt(ln 3000) = 2.8
    answer = tools.bic(Path("take.csv"))
    assert [effect["name"] for effect in answer["effects"]] == ["wind"]
    assert answer["headline"] == "NAMED"
    assert set(answer["fit"].values()) == {None}  # it has no model whose errors could be told


def test_a_resumed_run_equals_an_unbroken_one(tmp_path: Path) -> None:
    cases = [f"case_{number:04d}" for number in range(1, 9)]

    def ask(case: str) -> dict[str, Any]:
        if case == "case_0006":
            raise ValueError("a recording that cannot\nbe used")
        return result([effect("wind")], z=float(case[-1]) / 3.0)

    unbroken, broken = tmp_path / "a.jsonl", tmp_path / "b.jsonl"
    assert run.resume(cases, unbroken, ask) == 0
    assert run.resume(cases, broken, ask, minutes=0.0) == len(cases)

    def interrupted(case: str) -> dict[str, Any]:
        if case == "case_0004":
            raise KeyboardInterrupt
        return ask(case)

    with pytest.raises(KeyboardInterrupt):
        run.resume(cases, broken, interrupted)
    with broken.open("a") as file:
        file.write('{"case":"case_0004","ans')  # as the power failed
    assert run.resume(cases, broken, ask) == 0
    assert broken.read_bytes() == unbroken.read_bytes()
    assert run.answers(broken)["case_0006"]["error"] == "a recording that cannot be used"


def test_drawing_is_deterministic() -> None:
    first = [files.text_of(key_of(plan)) for plan in draw.plans(11, 40)]
    assert first == [files.text_of(key_of(plan)) for plan in draw.plans(11, 40)]
    assert first != [files.text_of(key_of(plan)) for plan in draw.plans(12, 40)]


def test_arms_have_their_shares(keys: list[dict[str, Any]]) -> None:
    assert arms.allot(600) == arms.SHARES
    for cases in (1, 7, 8, 24, 100):
        assert sum(arms.allot(cases).values()) == cases
    assert min(arms.allot(8).values()) == 1
    assert arms.SHARES["strangers"] >= 120 and arms.allot(16)["strangers"] >= 2
    assert {key["outside"] for key in keys if key["arm"] == "strangers"} == {*strangers.KINDS}
    assert sum(key["structure"] == "chain" for key in keys) >= 150
    assert {name for key in keys for name in key["names"]} == {*PHYSICS, *MEASUREMENT} - {*NEVER_DRAWN}


def test_arms_leak_into_neither_names_nor_lengths_nor_noise(keys: list[dict[str, Any]]) -> None:
    assert [key["case"] for key in keys] == [f"case_{number:04d}" for number in range(1, 601)]
    places = {arm: [i for i, key in enumerate(keys) if key["arm"] == arm] for arm in arms.SHARES}
    quantities = {
        "place": [float(i) for i in range(len(keys))],
        "length": [key["scenario"]["duration"] for key in keys],
        "noise": [key["scenario"]["camera"]["white_noise"] for key in keys],
        "dropouts": [key["scenario"]["camera"]["dropout_share"] for key in keys],
        "string": [key["scenario"]["string"]["length"] for key in keys],
        "mass": [key["scenario"]["diabolo"]["mass"] for key in keys],
        "spin": [abs(key["scenario"]["start"]["spin"]) for key in keys],
        "chain": [float(key["structure"] == "chain") for key in keys],
    }
    for values in map(np.array, quantities.values()):
        for chosen in places.values():
            error = values.std() / np.sqrt(len(chosen))
            assert abs(values[chosen].mean() - values.mean()) < 4.0 * error
    assert len({key["scenario"]["seed"] for key in keys}) == len(keys)


def test_only_what_is_at_work_is_in_the_key(keys: list[dict[str, Any]]) -> None:
    for key in keys:
        physics, faults = physics_among(key["names"]), faults_among(key["names"])
        assert len(physics) + len(faults) == len(key["names"])
        assert bool(physics) == (key["arm"] in ("single", "several", "with_fault", "tie")) or key["outside"]
        assert bool(faults) == (key["arm"] in ("faults", "with_fault")) or key["outside"]


def test_a_stranger_is_alone_at_work_and_says_where_it_acts() -> None:
    words = {"time", "place", "speed", "spin", "tension", "slip", "string", "torque", "tips"}
    for kind, law in strangers.KINDS.items():
        content = arms.content_of(kind, np.random.default_rng(1))
        assert content.outside == kind and content.names == [*law.names] and not content.steps
        assert sum(len(fields) for fields in content.departure.values()) > 0
        assert {"ON_STRING"} <= {*law.modes} <= {"ON_STRING", "FLYING"}
        assert {*law.depends.split(", ")} <= words
        scenario = draw.draw(draw.Plan(1, 1, kind, "springs")).scenario
        FormulaLaws(strangers.laws_of(strangers.parts_of(kind, scenario, SWING)))  # as a user's own
    assert {word for law in strangers.KINDS.values() for word in law.depends.split(", ")} == words


@pytest.mark.parametrize(
    ("headline", "adequacy", "expected"),
    [
        ("NOTHING_MISSING", {"adequate": True}, told.SILENT),
        ("NAMED", {"adequate": True}, told.TAKEN_FOR),
        ("NAMED", {}, told.SILENT),
        ("NAMED", {"adequate": False, "places": [PLACE]}, told.TOLD),
        ("UNNAMED_STRUCTURE", {"adequate": False}, told.TOLD),
        ("INSUFFICIENT_DATA", {}, told.REFUSED),
    ],
)
def test_silence_is_told_from_a_word(headline: str, adequacy: dict[str, Any], expected: str) -> None:
    effects = [effect("wind")] if headline == "NAMED" else []
    answer = {"headline": headline, "adequacy": adequacy, "effects": effects}
    assert told.verdict(answer) == expected


def changing(quantity: str, trend: float | None = None, frequency: float | None = None) -> dict[str, Any]:
    change = {"quantity": quantity, "trend_per_s": trend, "frequency_hz": frequency}
    return {"adequacy": {"changes": [change]}}


@pytest.mark.parametrize(
    ("kind", "acts", "frequency", "answer", "expected"),
    [
        ("gust", ["left"], 0.5, changing("acceleration_left"), True),
        ("gust", ["left"], 0.5, changing("string_tangent", frequency=0.52), True),
        ("gust", ["left"], 0.5, changing("acceleration_up", frequency=0.52), True),
        ("gust", ["left"], 0.5, changing("acceleration_up", frequency=0.7), False),
        ("gust", ["left"], 0.5, changing("spin_on_string", frequency=0.5), False),
        ("creep", ["string"], None, changing("acceleration_forward", trend=0.1), True),
        ("creep", ["string"], None, changing("flight_vertical"), False),
        ("constant_drag", ["against"], None, {"adequacy": {"places": [PLACE]}}, True),
        ("constant_drag", ["against"], None, {"adequacy": {"places": [PLACE | {"direction": ""}]}}, False),
    ],
)
def test_a_word_is_at_its_place(
    kind: str, acts: list[str], frequency: float | None, answer: dict[str, Any], expected: bool
) -> None:
    assert told.is_placed(told.words(answer), strangers.KINDS[kind], acts, frequency, 15.0) is expected


def test_an_own_law_missed_or_claimed_where_it_is_not_fails() -> None:
    size = {"name": "creep_string", "ci90": [1.0, 2.0], "truth": 1.5}
    there = {"case": "a", "kind": "creep", "at_work": "creep_string", "sizes": [size], "sentence": ""}
    elsewhere = {"case": "b", "kind": "creep", "at_work": None, "sizes": [], "sentence": ""}
    for named, claimed, failures in ((True, [], 0), (False, [], 1), (True, ["creep_string"], 1)):
        rows = [{**there, "named": named, "claimed": []}, {**elsewhere, "claimed": claimed}]
        found = own_laws.scores(rows)
        assert sum(one.fails for one in found) == failures
        assert ("missed: " in own_laws.text_of(rows)) is not named and found[-1].value == 1.0


def test_a_gaussian_process_predicts_a_law_and_no_noise() -> None:
    generator = np.random.default_rng(3)
    inputs, times = generator.normal(size=(900, 2)), np.arange(900) / 50.0
    noise = 0.1 * generator.normal(size=900)
    assert gp.explained(inputs, np.sin(2.0 * inputs[:, 0]) + noise, times) > 0.9
    assert gp.explained(inputs, noise, times) < gp.LEAST_SHARE


def recording(rows: int = 400, rate: float = 100.0) -> camera_steps.Tidy:
    time = np.arange(rows) / rate
    columns = {"time": time}
    for place, body in enumerate(camera_steps.BODIES):
        for axis, phase in zip("xyz", (0.0, 1.0, 2.0), strict=True):
            columns[f"{body}_{axis}"] = place + np.sin(2.0 * np.pi * 0.7 * time + phase)
    columns["diabolo_x"][50:60] = np.nan
    return camera_steps.Tidy(columns, {"rate": rate})


def test_commands_and_what_follows_them_with_a_lag_are_inverse() -> None:
    tidy, tau = recording(), 0.05
    before = tidy.columns["left_x"].copy()
    camera_steps.apply([{"step": "robot_servo_lag", "seconds": tau}], tidy)
    again = camera_steps.low_passed(tidy.columns["left_x"], 0.01, tau)
    assert np.abs(tidy.columns["left_x"] - before).max() > 0.1
    assert np.abs(again - before)[40:-10].max() < 5e-4  # of an amplitude of one


def test_a_filter_lags_and_keeps_gaps() -> None:
    tidy = recording()
    before = tidy.columns["diabolo_y"].copy()
    camera_steps.apply([{"step": "filter_lag", "seconds": 0.03}], tidy)
    assert np.isnan(tidy.columns["diabolo_x"]).sum() == 10
    assert np.abs(tidy.columns["diabolo_y"][103:] - before[100:-3]).max() < 0.02  # 30 ms later


def test_swaps_and_rates() -> None:
    tidy = recording()
    left, right_one = tidy.columns["left_y"].copy(), tidy.columns["right_y"].copy()
    swap = {"step": "body_swap", "bodies": ["left", "right"], "bursts": [[0.0, 1.0]]}
    camera_steps.apply([swap, {"step": "frame_rate", "factor": 1.02}], tidy)
    assert np.array_equal(tidy.columns["left_y"], right_one)
    assert np.array_equal(tidy.columns["right_y"], left)
    assert tidy.description["rate"] * tidy.columns["time"][-1] == pytest.approx(399.0)


def test_a_tidy_file_comes_back(tmp_path: Path) -> None:
    tidy = recording(20)
    tidy.write(tmp_path / "take.csv")
    again = camera_steps.Tidy.read(tmp_path / "take.csv")
    for name, values in tidy.columns.items():
        assert np.allclose(again.columns[name], values, atol=5.1e-7, equal_nan=True)
    assert again.description == tidy.description


def test_intervals_of_rates() -> None:
    # Clopper and Pearson, Biometrika 26 (1934); the ends without hits and without misses have closed forms.
    assert intervals.clopper_pearson(0, 20) == pytest.approx((0.0, 1.0 - 0.025**0.05), abs=1e-9)
    assert intervals.clopper_pearson(20, 20) == pytest.approx((0.025**0.05, 1.0), abs=1e-9)
    low, high = intervals.clopper_pearson(7, 20)
    assert 1.0 - intervals.at_most(6, 20, low) == pytest.approx(0.025, abs=1e-9)
    assert intervals.at_most(7, 20, high) == pytest.approx(0.025, abs=1e-9)
    assert intervals.median_interval([1.0, 2.0, 3.0]) is None
    assert intervals.median_interval(list(range(100))) == (39, 60)  # the 40th and the 61st


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (
            ["quick", "--plant", "nothing"],
            "nothing: the plant's program is not there; `make plant` builds it",
        ),
        (["quick", "--plant", "/bin/true"], "/bin/true: another program; expected the plant's"),
        (["quick", "--plant", __file__], f"{__file__}: the plant's program is not there"),
        (["quick", "--cases", "0"], "--cases: 0; expected a whole number from 1 to 9999"),
        (["quick", "--tool", "guess"], "--tool guess: expected one of diagnose, no_faults"),
        (["run", "never-sealed"], "never-sealed.json: there is no such file; expected a sealed batch"),
        (["run", "fifteenth"], "the keys of batch fifteenth are open; seal a fresh one"),
        (["seal", "fifteenth"], "batch fifteenth is scored already; choose another name"),
        (["score", "never-sealed"], "never-sealed.jsonl.xz: there is no such file; `score` writes it"),
        (["score", "fifteenth", "--tool", "parameter_fit"], "no answers of parameter_fit"),
        (["seal", "../elsewhere"], "expected a name of letters"),
        (["run", "fifteenth", "--minutes", "nan"], "--minutes: nan; expected more than 0"),
        (["run", "fifteenth", "--minutes", "-1"], "--minutes: -1.0; expected more than 0"),
        (["page", "fifteenth", "--out", "nowhere/page.md"], "nowhere/page.md: there is no folder"),
    ],
)
def test_the_command_says_what_is_missing(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    arguments: list[str],
    complaint: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert __main__.main(arguments) == 2
    error = capsys.readouterr().err
    assert error.startswith("python -m benchmarks.proof.diagnosis: ")
    assert complaint in error and error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_the_product_does_not_know_the_proof() -> None:
    package = Path(tools.diabolo.__file__).parent
    assert not [path for path in package.rglob("*.py") if "benchmarks" in path.read_text(encoding="utf-8")]


@pytest.fixture
def fifteenth(tmp_path: Path) -> commands.Places:
    """Of a copy of the batches."""
    shutil.copytree(BATCHES, tmp_path / "batches")
    return commands.Places(tmp_path, tmp_path / "build", tmp_path / "no plant", run.silent)


def test_the_last_batch_scored_again_from_its_record_gives_its_page(
    fifteenth: commands.Places, tmp_path: Path
) -> None:
    assert commands.write_page(fifteenth, "fifteenth", tmp_path / "proof.md") == 0
    assert (tmp_path / "proof.md").read_text() == (ROOT / "docs" / "proof.md").read_text()


def test_a_record_that_is_not_what_was_sealed_is_told(
    fifteenth: commands.Places, capsys: pytest.CaptureFixture[str]
) -> None:
    found = record.read(fifteenth.record("fifteenth"))
    closed = set(found.not_as_sealed())
    assert len(closed) < 60  # none, but where the processor rounds otherwise
    changed = [key for key in found.keys if key["case"] not in closed and key["parameters"]][:2]
    changed[0]["names"] = [*changed[0]["names"], "wind"]
    next(iter(changed[1]["parameters"].values())).clear()
    assert set(found.not_as_sealed()) == closed | {key["case"] for key in changed}
    found.write(fifteenth.record("fifteenth"))
    commands.score_batch(fifteenth, "fifteenth", "diagnose", 1, None)
    told = capsys.readouterr().out.splitlines()[0]
    assert told == f"{128 - len(closed)} of 130 keys, drawn again, are those sealed"


def test_a_retired_batch_keeps_its_scores(fifteenth: commands.Places) -> None:
    scores = record.read(fifteenth.record("fifteenth")).summary("diagnose")["scores"]
    assert commands.retire_batch(fifteenth, "fifteenth") == 0
    assert [path.name for path in fifteenth.earlier.parent.iterdir()] == ["earlier.jsonl.xz"]
    batches = earlier.read(fifteenth.earlier)
    assert [*batches][-2:] == ["fourteenth", "fifteenth"]
    assert batches["fifteenth"]["seal"] == DIGEST_OF_FIFTEENTH
    assert [score["hits"] for score in batches["fifteenth"]["scores"]] == [score["hits"] for score in scores]
    with pytest.raises(ValueError, match=r"fifteenth\.jsonl\.xz: there is no such file"):
        commands.score_batch(fifteenth, "fifteenth", "diagnose", 1, None)


def test_scoring_opens_a_batch_once_and_records_it(
    sealed: tuple[dict[str, Any], batch.Store], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    description, store = sealed
    places = commands.Places(tmp_path, tmp_path, tmp_path / "no plant", run.silent)
    files.write_json(places.published("made"), description)
    monkeypatch.setattr(commands.plant, "check", lambda program: None)
    monkeypatch.setattr(commands.batch, "make", lambda *arguments, **options: [])  # all is there
    keys = {entry["case"]: store.key(entry["case"]) for entry in description["sealed"]}
    monkeypatch.setattr(commands.tools, "restricted", lambda path, names, laws: right(keys[path.stem]))
    monkeypatch.setattr(commands.strangers, "laws_in", lambda key, recording: [])
    with pytest.raises(ValueError, match="batch made: 12 cases have no answer of diagnose; run made first"):
        commands.score_batch(places, "made", "diagnose", 1, None)
    run.resume([*keys], places.answers("made", "diagnose"), lambda case: right(keys[case]))
    run.resume([*keys], places.answers("made", "sindy"), lambda case: result([]))
    commands.score_batch(places, "made", "diagnose", 1, tmp_path / "first.json")
    assert not places.published("made").exists()
    commands.score_batch(places, "made", "diagnose", 1, tmp_path / "again.json")
    scored = files.read_json(tmp_path / "first.json", "scores")
    assert scored == files.read_json(tmp_path / "again.json", "scores")
    detected = next(one for one in scored["scores"] if one["name"] == "detected, SNR >= 10")
    assert detected["hits"] == detected["total"] == sum(k["arm"] in score.WITH_PHYSICS for k in keys.values())
    assert record.read(places.record("made")).answers.keys() == {"diagnose", "sindy", "oracle", "exchanged"}


def test_a_record_comes_back(keys: list[dict[str, Any]], tmp_path: Path) -> None:
    keys = [{**key, "attempts": 1} for key in keys[:40]]
    answers = {"diagnose": {key["case"]: kept(right(key)) for key in keys}, "oracle": {}}
    answers["oracle"] = {key["case"]: kept(right(key)) for key in keys if physics_among(key["names"])}
    sealed = {"schema": seal.SCHEMA, "commit": "0" * 40, "plant": "", "seed": 5, "cases": 40, "arms": {}}
    whole = record.Record({**sealed, "sealed": []}, keys, answers)
    whole.write(tmp_path / "one.jsonl.xz")
    again = record.read(tmp_path / "one.jsonl.xz")
    assert again.summary("diagnose") == whole.summary("diagnose")
    assert again.sealed == whole.sealed
    (tmp_path / "one.jsonl.xz").write_text("{}")
    with pytest.raises(ValueError, match=r"one\.jsonl\.xz: not compressed by LZMA"):
        record.read(tmp_path / "one.jsonl.xz")
    files.write_packed(tmp_path / "one.jsonl.xz", [{"case": 1}])
    with pytest.raises(
        ValueError, match=r"one\.jsonl\.xz: schema None; expected 'diabolo.concealed_batch/1'"
    ):
        record.read(tmp_path / "one.jsonl.xz")
    files.write_packed(tmp_path / "one.jsonl.xz", [whole.sealed, {"case": 1}])
    with pytest.raises(ValueError, match=r"one\.jsonl\.xz, line 2: expected a case with its key"):
        record.read(tmp_path / "one.jsonl.xz")


def test_a_score_is_json(keys: list[dict[str, Any]]) -> None:
    verdicts = score.judged(keys, {key["case"]: kept(right(key)) for key in keys}, {})
    text = json.dumps(score.summary(verdicts), allow_nan=False)
    assert json.loads(text)["schema"] == "diabolo.proof/1"


def test_page_and_table_hold_scores_and_failures(keys: list[dict[str, Any]], tmp_path: Path) -> None:
    drag = {key["case"]: kept(result([effect("air_drag_quadratic")])) for key in keys}
    summary = score.summary(score.judged(keys, drag, {}))
    sealed = {"commit": "0" * 40, "arms": arms.allot(len(keys))}
    written = page.write(
        tmp_path / "proof.md", "one", sealed, {**summary, "commit": "0" * 40}, {"sindy": summary}, {}
    )
    text = (tmp_path / "proof.md").read_text()
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(path.name for path in written)
    assert "\n`python -m benchmarks.proof.diagnosis page one` made this page.\n" in text
    assert "| false physics on nulls | 100.0 % |" in text
    assert (
        text.count("false physics air_drag_quadratic")
        == tables.text_of(summary).count("false physics air")
        > 400
    )


def test_what_is_below_its_floor_is_not_owed(keys: list[dict[str, Any]]) -> None:
    key = next(key for key in keys if key["names"] == ["magnus_lift"])
    oracle = kept(right(key))
    assert judge.judge(key, kept(result([])), oracle).owed == ["magnus_lift"]
    small = {**oracle, "ladder": [{**rung, "size_m": 5e-4} for rung in oracle["ladder"]]}
    assert judge.judge(key, kept(result([])), small).owed == []
    faint = {**oracle, "ladder": [{**rung, "z": 9.0} for rung in oracle["ladder"]]}
    assert judge.judge(key, kept(result([])), faint).owed == []
    spin = next(key for key in keys if key["names"] == ["axle_drag"])
    assert judge.judge(spin, kept(result([])), kept(right(spin))).owed == ["axle_drag"]
    slight = {**spin, "parameters": {"axle_drag": {"rate": 0.1}}}
    assert judge.judge(slight, kept(result([])), kept(right(spin))).owed == []


def test_a_tie_that_the_data_break_is_not_owed(keys: list[dict[str, Any]]) -> None:
    key = next(key for key in keys if key["tie"])
    oracle, other = kept(right(key)), kept(result([], z=29.9))
    assert judge.judge(key, oracle, oracle, other).tie_is_real
    assert not judge.judge(key, oracle, oracle, kept(result([], z=29.0))).tie_is_real


def test_the_interval_of_a_mean_is_of_the_values_spread() -> None:
    assert intervals.mean_interval([1.0]) is None
    assert intervals.mean_interval([2.0, 2.0, 2.0]) == (2.0, 2.0)
    low, high = intervals.mean_interval([1.0, 3.0] * 50) or (0.0, 0.0)
    assert 0.5 * (low + high) == pytest.approx(2.0)
    assert high - low == pytest.approx(2.0 * 1.96 * 0.1, rel=0.01)
