# SPDX-License-Identifier: MIT
"""The scores taken apart: by name, by size, by confidence, and every failure."""

from __future__ import annotations

import itertools
from collections import Counter
from typing import Any

from . import intervals, told
from .judge import SURE, Verdict
from .names import MEASUREMENT, PHYSICS

SNR_EDGES = (0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 14.0, 20.0, 30.0, 50.0, 100.0, float("inf"))
CONFIDENCE_EDGES = (0.0, 0.5, 0.8, 0.9, 0.95, 0.99, 0.999, 1.0)
NOTHING = "nothing"


def _rate(hits: int, total: int) -> dict[str, Any]:
    low, high = intervals.clopper_pearson(hits, total)
    return {"hits": hits, "total": total, "low": low, "high": high}


def confusion(verdicts: list[Verdict]) -> dict[str, dict[str, int]]:
    """What is at work, alone, against the first name that is claimed."""
    table: dict[str, Counter[str]] = {}
    for verdict in verdicts:
        if verdict.arm in ("null", "faults", "single", "tie"):
            truth = verdict.physics[0] if verdict.physics else f"{NOTHING} ({verdict.arm})"
            claimed = verdict.claimed[0] if verdict.claimed else NOTHING
            table.setdefault(truth, Counter())[claimed] += 1
    order = {name: place for place, name in enumerate([*PHYSICS, f"{NOTHING} (null)", f"{NOTHING} (faults)"])}
    return {truth: dict(table[truth]) for truth in sorted(table, key=lambda name: order[name])}


def power(verdicts: list[Verdict]) -> list[dict[str, Any]]:
    """How often an effect beyond its floor is in the answer, by how much it stands out."""
    pairs = [
        (snr, v.is_in_answer(name))
        for v in verdicts
        for name, snr in v.snr.items()
        if not v.outside and v.material.get(name)
    ]
    rows = []
    for low, high in itertools.pairwise(SNR_EDGES):
        inside = [hit for snr, hit in pairs if low <= snr < high]
        upper = None if high == float("inf") else high
        rows.append({"snr": [low, upper], **_rate(sum(inside), len(inside))})
    return rows


def reliability(verdicts: list[Verdict]) -> list[dict[str, Any]]:
    """How often a claimed name is right, by the confidence that was claimed."""
    pairs = [
        (confidence, name in v.physics or name in v.tie)
        for v in verdicts
        for name, confidence in v.confidence.items()
        if not v.outside
    ]
    rows = []
    for low, high in itertools.pairwise(CONFIDENCE_EDGES):
        inside = [(c, right) for c, right in pairs if low <= c < high or (high == 1.0 and c == 1.0)]
        mean = sum(c for c, _ in inside) / len(inside) if inside else None
        rows.append(
            {"confidence": [low, high], "mean": mean, **_rate(sum(r for _, r in inside), len(inside))}
        )
    return rows


def by_name(verdicts: list[Verdict]) -> list[dict[str, Any]]:
    """Each name: how often at work, found, and claimed where it is not; how often its intervals cover."""
    rows = []
    for name in (*PHYSICS, *MEASUREMENT):
        is_physics = name in PHYSICS
        there = [v for v in verdicts if name in (v.physics if is_physics else v.faults) and not v.outside]
        sizes = [(v, (v.snr if is_physics else v.fault_z).get(name)) for v in there]
        clear = [v for v, z in sizes if (name in v.owed if is_physics else z is not None and z >= SURE)]
        false = [v for v in verdicts if name in (v.false_physics if is_physics else v.false_faults)]
        inside = [i.covers for v in there for i in v.intervals if i.name == name]
        rows.append(
            {
                "name": name,
                "cases": len(there),
                "found": sum(v.is_in_answer(name) for v in there),
                "clear": len(clear),
                "clear_found": sum(v.is_in_answer(name) for v in clear),
                "false": len(false),
                "intervals": len(inside),
                "covered": sum(inside),
            }
        )
    return rows


def by_kind(verdicts: list[Verdict]) -> list[dict[str, Any]]:
    """Each kind of strangers: how many cases, how many of them stand out, and what these got."""
    rows = []
    for kind in sorted({v.outside for v in verdicts if v.outside and v.arm != "outside"}):
        cases = [v for v in verdicts if v.outside == kind]
        clear = [v.met for v in cases if v.met and v.is_clear_stranger]
        got = {what: sum(met.verdict == what for met in clear) for what in told.VERDICTS}
        placed = sum(met.verdict == told.TOLD and met.is_placed for met in clear)
        rows.append({"kind": kind, "cases": len(cases), "clear": len(clear), **got, "at its place": placed})
    return rows


def faults_of(verdict: Verdict) -> list[str]:
    """What is wrong with an answer, in words; empty where nothing is."""
    said = [f"false physics {name}" for name in verdict.false_physics]
    if verdict.bad is None and verdict.outside is None:
        said += [f"false fault {name}" for name in verdict.false_faults]
    for name in verdict.physics:
        snr = verdict.snr.get(name)
        if verdict.is_in_answer(name) or verdict.material.get(name) is False or verdict.outside:
            continue
        if snr is None or snr >= SURE:
            said.append(f"missed {name} ({f'SNR {snr:.0f}' if snr is not None else 'SNR not known'})")
    if verdict.claimed and verdict.claimed[0] in verdict.physics:
        said += [
            f"wrong mode of {n}"
            for n in verdict.claimed
            if n in verdict.physics and not verdict.mode_is_right(n)
        ]
    if verdict.tie_is_real and verdict.owed and not verdict.declares_tie:
        said.append("no tie of " + " and ".join(verdict.tie))
    for name in verdict.faults:
        z = verdict.fault_z.get(name)
        if not verdict.is_in_answer(name) and (z is None or z >= SURE):
            said.append(f"missed fault {name} ({'z not known' if z is None else f'z {z:.0f}'})")
    if verdict.bad and verdict.headline != "INSUFFICIENT_DATA":
        said.append(f"bad data not refused ({verdict.bad})")
    if verdict.met and verdict.is_clear_stranger:
        got = verdict.met.verdict
        if got != told.TOLD or not verdict.met.is_placed:
            place = " at another place" if got == told.TOLD else ""
            said.append(f"{got}{place} (SNR {verdict.met.snr:.0f})")
    if verdict.arm in ("null", "faults") and verdict.says_unnamed:
        said.append("something unnamed")
    if verdict.headline == "ERROR":
        said.append("an error instead of an answer")
    return said


def failures(verdicts: list[Verdict]) -> list[dict[str, Any]]:
    """Every answer that is not right in all it says."""
    rows = []
    for verdict in verdicts:
        if said := faults_of(verdict):
            rows.append(
                {
                    "case": verdict.case,
                    "arm": verdict.arm,
                    "plant": verdict.structure,
                    "truth": verdict.physics
                    + verdict.faults
                    + [x for x in (verdict.outside, verdict.bad) if x],
                    "claimed": verdict.claimed + verdict.claimed_faults,
                    "wrong": said,
                }
            )
    return rows


def tables(verdicts: list[Verdict]) -> dict[str, Any]:
    return {
        "by_name": by_name(verdicts),
        "by_kind": by_kind(verdicts),
        "confusion": confusion(verdicts),
        "power": power(verdicts),
        "reliability": reliability(verdicts),
        "failures": failures(verdicts),
    }
