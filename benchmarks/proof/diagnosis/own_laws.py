# SPDX-License-Identifier: MIT
"""Laws of a user's own, given to the diagnosis as formulas: named where they are at work, and only there?"""

from __future__ import annotations

import copy
from dataclasses import replace
from pathlib import Path
from typing import Any

from diabolo import load_recording

from . import batch, draw, run, strangers, tables, tools
from .judge import SURE
from .score import Score, plain, rate
from .sizes import merged

KINDS = ("gust", "spin_gust", "creep", "constant_drag", "pull", "tension_drag")
ELSEWHERE = ("null", "single", "faults")
FIRST_ELSEWHERE = 10001  # number of the first case without the law
MOST_DRAWN = 20  # for each case that is wanted


def parts_at_work(plan: draw.Plan, store: batch.Store) -> dict[str, strangers.Part]:
    key = store.key(plan.name)
    return strangers.parts_of(plan.arm, key["scenario"], load_recording(store.recording(plan.name)))


def parts_elsewhere(plan: draw.Plan, kind: str, store: batch.Store) -> dict[str, strangers.Part]:
    """Of a law that is drawn, and not played."""
    departure = strangers.KINDS[kind].draw(plan.generator(3))
    scenario = merged(copy.deepcopy(store.key(plan.name)["scenario"]), departure)
    return strangers.parts_of(kind, scenario, load_recording(store.recording(plan.name)))


def strongest(recording: Path, parts: dict[str, strangers.Part]) -> tuple[str, float]:
    """The part that stands out most for who is told the law alone, and how many standard deviations."""
    ladder = tools.restricted(recording, parts, strangers.laws_of(parts))["ladder"]
    z = {rung["name"]: abs(rung["z"] or 0.0) for rung in ladder if rung["name"] in parts}
    return max(z.items(), key=lambda one: one[1], default=("", 0.0))


def row(recording: Path, kind: str, parts: dict[str, strangers.Part]) -> dict[str, Any]:
    """What is said of the law."""
    answer = tools.full(recording, strangers.laws_of(parts))
    own = [effect for effect in answer["effects"] if effect["name"] in parts]
    sizes = [
        {
            "name": effect["name"],
            "ci90": effect["parameters"][0]["ci90"],
            "truth": parts[effect["name"]].truth,
        }
        for effect in own
    ]
    return {
        "case": recording.stem,
        "kind": kind,
        "claimed": [effect["name"] for effect in own],
        "in_answer": [
            name for effect in answer["effects"] for name in (effect["name"], *effect["tied_with"])
        ],
        "sizes": [one for one in sizes if one["ci90"] and one["truth"] is not None],
        "sentence": answer["sentence"],
    }


def rows_at_work(
    program: Path, store: batch.Store, seed: int, cases: int, report: run.Report
) -> list[dict[str, Any]]:
    """As many cases as are wanted in which the law stands out."""
    rows: list[dict[str, Any]] = []
    for number in range(1, MOST_DRAWN * cases + 1):
        if len(rows) == cases:
            return rows
        plan = draw.Plan(seed, number, KINDS[(number - 1) % len(KINDS)], "springs")
        report(f"{plan.name}, {plan.arm} at work: {len(rows)} of {cases} done", 0.5 * len(rows) / cases)
        store.make(program, plan)
        parts = parts_at_work(plan, store)
        name, snr = strongest(store.recording(plan.name), parts)
        if snr >= SURE:
            found = row(store.recording(plan.name), plan.arm, parts)
            rows.append({**found, "at_work": name, "snr": snr, "named": name in found["in_answer"]})
    raise ValueError(f"only {len(rows)} of {cases} cases have a law that stands out")


def rows_elsewhere(
    program: Path, store: batch.Store, seed: int, cases: int, report: run.Report
) -> list[dict[str, Any]]:
    rows = []
    for done in range(cases):
        plan = draw.Plan(seed, FIRST_ELSEWHERE + done, ELSEWHERE[done % len(ELSEWHERE)], "springs")
        kind = KINDS[done % len(KINDS)]
        report(f"{plan.name}, {kind} not at work: {done} of {cases} done", 0.5 + 0.5 * done / cases)
        store.make(program, plan)
        parts = parts_elsewhere(plan, kind, store)
        rows.append({**row(store.recording(plan.name), kind, parts), "at_work": None})
    return rows


def scores(rows: list[dict[str, Any]]) -> list[Score]:
    """What counts is the rate itself: no interval excuses it."""
    there = [one for one in rows if one["at_work"]]
    sizes = [size for one in there for size in one["sizes"]]
    covers = (size["ci90"][0] <= size["truth"] <= size["ci90"][1] for size in sizes)
    elsewhere = (bool(one["claimed"]) for one in rows if not one["at_work"])
    named = rate("own law named, SNR >= 10", (one["named"] for one in there), least=0.95)
    return [
        replace(named, is_strict=True),
        replace(rate("own law claimed where it is not", elsewhere, most=0.0), is_strict=True),
        rate("sizes within their 90 % intervals", covers),
    ]


def text_of(rows: list[dict[str, Any]]) -> str:
    """The scores, and a line for each case that is wrong."""
    wrong = [
        f"{one['case']} {one['kind']:14} {'missed' if one['at_work'] else 'claimed'}: {one['sentence']}"
        for one in rows
        if (not one["named"] if one["at_work"] else one["claimed"])
    ]
    table = tables.plain(tables.HEADER, [tables.row_of(plain(score)) for score in scores(rows)])
    return "\n".join([table, "", *wrong])
