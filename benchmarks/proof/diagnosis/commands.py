# SPDX-License-Identifier: MIT
"""What the actions of `python -m benchmarks.proof.diagnosis` do."""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from diabolo import compare_simulator

from .. import files, plant
from . import (
    answer,
    batch,
    draw,
    earlier,
    making,
    own_laws,
    page,
    record,
    run,
    score,
    seal,
    simulators,
    strangers,
    tables,
    tools,
)
from .names import physics_among

ARMS_WITH_ORACLE = (*score.WITH_PHYSICS, "tie", "outside")
DIAGNOSE = "diagnose"


@dataclass(frozen=True)
class Places:
    """Where things are."""

    sources: Path
    """The folder of the sealed batches and of the records of those that were scored."""
    build: Path
    """For recordings, keys and answers."""
    program: Path
    """The plant's."""
    report: run.Report

    def published(self, name: str) -> Path:
        return self.sources / "batches" / f"{name}.json"

    def record(self, name: str) -> Path:
        return self.sources / "batches" / f"{name}.jsonl.xz"

    @property
    def earlier(self) -> Path:
        return self.sources / "batches" / "earlier.jsonl.xz"

    def store(self, name: str) -> batch.Store:
        return batch.Store(self.build / name)

    def answers(self, name: str, who: str) -> Path:
        return self.build / name / f"{who}.jsonl"


def check_name(name: str) -> None:
    """Names become those of files."""
    if not name.replace("_", "").replace("-", "").isalnum():
        raise ValueError(f"batch {name!r}: expected a name of letters, digits, - and _")


def tool_named(name: str) -> tools.Tool:
    if name not in tools.TOOLS:
        raise ValueError(f"--tool {name}: expected one of {', '.join(tools.TOOLS)}")
    return tools.TOOLS[name]


def seal_batch(places: Places, name: str, cases: int, jobs: int) -> int:
    check_name(name)
    if places.record(name).exists():
        raise ValueError(f"{places.record(name)}: batch {name} is scored already; choose another name")
    result = seal.seal(
        name, places.published(name), places.store(name), places.program, cases, jobs, places.report
    )
    print(
        f"{places.published(name)}: {cases} cases sealed at commit {result['commit'][:12]}; "
        f"commit this file, then run {name}"
    )
    return 0


def _is_committed(path: Path) -> bool:
    known = subprocess.run(["git", "ls-files", "--error-unmatch", str(path)], capture_output=True)
    same = subprocess.run(["git", "diff", "--quiet", "HEAD", "--", str(path)], capture_output=True)
    return known.returncode == 0 and same.returncode == 0


def run_batch(places: Places, name: str, tool: str, minutes: float, jobs: int) -> int:
    check_name(name)
    chosen = tool_named(tool)
    if places.record(name).exists():
        raise ValueError(f"{places.record(name)}: the keys of batch {name} are open; seal a fresh one")
    sealed = seal.read(places.published(name))
    if not _is_committed(places.published(name)):
        raise ValueError(f"{places.published(name)}: not committed as it is; the seal comes before the run")
    seal.check_tool(sealed["commit"])
    store = places.store(name)
    plant.check(places.program)
    results = places.answers(name, tool)
    done = run.answers(results)
    batch.make(store, places.program, sealed["seed"], sealed["cases"], True, jobs, places.report, but=done)
    seal.check_recordings(sealed, store, but=done)
    cases = [entry["case"] for entry in sealed["sealed"]]
    own = run.answers(places.answers(name, DIAGNOSE)) if tool == "bic" else {}

    def ask(case: str) -> answer.Answer:
        recording = store.recording(case)
        return tools.by_bic(own[case], recording) if case in own else chosen(recording)

    left = run.resume(cases, results, ask, places.report, minutes)
    ending = f"{left} cases are left; run again" if left else f"all done; score {name} comes next"
    print(f"{results}: {len(cases) - left} of {len(cases)} cases; {ending}")
    return 0


def at_work(keys: list[dict[str, Any]]) -> dict[str, list[str]]:
    """The physics of each case that has some, and all names of one with a stranger."""
    physics = {key["case"]: physics_among(key["names"]) for key in keys if key["arm"] in ARMS_WITH_ORACLE}
    return physics | {case: key["names"] for case, key in with_strangers(keys).items()}


def exchanged(keys: list[dict[str, Any]]) -> dict[str, list[str]]:
    """The other name of each tie."""
    return {
        key["case"]: [name for name in key["tie"] if name not in key["names"]] for key in keys if key["tie"]
    }


def with_strangers(keys: list[dict[str, Any]]) -> dict[str, dict[str, Any]]:
    return {key["case"]: key for key in keys if strangers.in_case(key)}


def oracles(
    places: Places,
    keys: list[dict[str, Any]],
    answers: dict[str, answer.Answer],
    store: batch.Store,
    path_of: Callable[[str], Path],
) -> dict[str, dict[str, answer.Answer]]:
    """Answers of who is told what is at work, strangers included, and of who is told a tie's other name."""

    def asked(who: str, wanted: dict[str, list[str]], strange: dict[str, dict[str, Any]]) -> Any:
        names: dict[str, list[str]] = {}
        for case in wanted.keys() & answers.keys():
            ladder = {rung["name"] for rung in answers[case]["ladder"]}
            known = [name for name in wanted[case] if name in ladder]
            if known or case in strange:
                names[case] = known

        def ask(case: str) -> dict[str, Any]:
            recording = store.recording(case)
            laws = strangers.laws_in(strange[case], recording) if case in strange else []
            return tools.restricted(recording, [*names[case], *(law["name"] for law in laws)], laws)

        run.resume(sorted(names), path_of(who), ask, places.report)
        return {case: found for case, found in run.answers(path_of(who)).items() if case in names}

    return {
        record.ORACLE: asked(record.ORACLE, at_work(keys), with_strangers(keys)),
        record.EXCHANGED: asked(record.EXCHANGED, exchanged(keys), {}),
    }


def open_batch(places: Places, name: str, sealed: dict[str, Any], tool: str, jobs: int) -> record.Record:
    """Opens the keys, asks who is told the truth, and keeps the answers of all tools that have all cases."""
    cases = {entry["case"] for entry in sealed["sealed"]}
    found = {who: run.answers(places.answers(name, who)) for who in tools.TOOLS}
    for who in (DIAGNOSE, tool):
        if missing := cases - found[who].keys():
            raise ValueError(f"batch {name}: {len(missing)} cases have no answer of {who}; run {name} first")
    store = places.store(name)
    plant.check(places.program)
    batch.make(store, places.program, sealed["seed"], sealed["cases"], True, jobs, places.report)
    keys = seal.open_keys(sealed, store)
    own = found[DIAGNOSE]
    asked = oracles(places, keys, own, store, lambda who: places.answers(name, who))
    whole = {who: by_case for who, by_case in found.items() if cases <= by_case.keys()}
    opened = record.Record(sealed, keys, whole | asked)
    opened.write(places.record(name))
    places.published(name).unlink(missing_ok=True)  # the record has the seal
    return opened


def score_batch(places: Places, name: str, tool: str, jobs: int, json_file: Path | None) -> int:
    """Opens a batch that was run here; scores one that is recorded already from its record."""
    check_name(name)
    if places.published(name).exists():
        found = open_batch(places, name, seal.read(places.published(name)), tool, jobs)
    else:
        found = record.read(places.record(name))
        cases = found.sealed["cases"]
        print(f"{cases - len(found.not_as_sealed())} of {cases} keys, drawn again, are those sealed")
    if tool not in found.answers:
        raise ValueError(
            f"{places.record(name)}: no answers of {tool}; expected one of {', '.join(found.answers)}"
        )
    return _finish(
        {"batch": name, "tool": tool, "commit": found.sealed["commit"], **found.summary(tool)}, json_file
    )


def write_page(places: Places, name: str, out: Path) -> int:
    check_name(name)
    found = record.read(places.record(name))
    others = {tool: found.summary(tool) for tool in tools.TOOLS if tool != DIAGNOSE and tool in found.answers}
    written = page.write(
        out, name, found.sealed, found.summary(DIAGNOSE), others, earlier.read(places.earlier)
    )
    print("; ".join(str(path) for path in written))
    return 0


def retire_batch(places: Places, name: str) -> int:
    """Keeps of a scored batch its seed, the hash of its seal and its scores; git has the rest."""
    check_name(name)
    found = record.read(places.record(name))
    entry = earlier.entry(found.sealed, found.summary(DIAGNOSE))
    earlier.write(places.earlier, {**earlier.read(places.earlier), name: entry})
    places.record(name).unlink()
    print(f"{places.earlier}: holds {name} now; its record is gone")
    return 0


def quick(places: Places, cases: int, seed: int, tool: str, jobs: int, json_file: Path | None) -> int:
    """Cases that are not sealed: made, diagnosed and scored at once."""
    plant.check(places.program)
    store = places.store(f"quick_{seed}_{cases}")
    planned = batch.make(
        store, places.program, seed, cases, making.knows_chain(places.program), jobs, places.report
    )
    return _ask_and_score(places, store, planned, seed, tool, json_file)


def meet_strangers(
    places: Places, cases: int, seed: int, tool: str, jobs: int, json_file: Path | None
) -> int:
    """Laws that no name stands for, each alone, one kind after the other."""
    plant.check(places.program)
    store = places.store(f"strangers_{seed}_{cases}")
    store.fit_for(batch.stamp(places.program, seed, cases))
    kinds = [*strangers.KINDS]
    planned = [draw.Plan(seed, n + 1, kinds[n % len(kinds)], "springs") for n in range(cases)]
    batch.make_planned(store, places.program, planned, jobs, places.report)
    return _ask_and_score(places, store, planned, seed, tool, json_file)


def _ask_and_score(
    places: Places, store: batch.Store, planned: list[draw.Plan], seed: int, tool: str, json_file: Path | None
) -> int:
    chosen, stamp = tool_named(tool), tools.digest()[:12]

    def answers_of(who: str) -> Path:
        path = store.folder / f"{who}_{stamp}.jsonl"
        _drop_if_older(path, store.folder / "stamp.json")
        return path

    names = [plan.name for plan in planned]
    results = answers_of(tool)
    run.resume(names, results, lambda case: chosen(store.recording(case)), places.report)
    found = run.answers(results)
    keys = [store.key(case) for case in names]
    own = found if tool == DIAGNOSE else run.answers(answers_of(DIAGNOSE))
    asked = oracles(places, keys, own, store, answers_of)
    result = record.summary(keys, {tool: found, **asked}, tool)
    return _finish({"batch": None, "tool": tool, "seed": seed, **result}, json_file)


def give_own_laws(places: Places, cases: int, seed: int, json_file: Path | None) -> int:
    """A user's own laws at work, and not at work; the exit status is 1 where one is missed or claimed too
    often."""
    plant.check(places.program)
    store = places.store(f"own_laws_{seed}")
    store.fit_for(batch.stamp(places.program, seed, 0))
    rows = []
    for ask in (own_laws.rows_at_work, own_laws.rows_elsewhere):
        rows += ask(places.program, store, seed, cases, places.report)
    if json_file is not None:
        files.write_json(json_file, {"seed": seed, "cases": rows})
    print(own_laws.text_of(rows))
    return 1 if any(one.fails for one in own_laws.scores(rows)) else 0


def compare_simulators(places: Places, cases: int, seed: int, json_file: Path | None) -> int:
    """Pairs of plants, the second with half of the physics; the exit status is 1 where all that was switched
    off is named in less than nine of ten."""
    plant.check(places.program)
    rows = []
    for number in range(1, cases + 1):
        places.report(f"pair {number} of {cases}", (number - 1) / cases)
        with tempfile.TemporaryDirectory() as folder:
            pair, truth = simulators.make(places.program, seed, number, Path(folder))
            comparison = compare_simulator(Path(folder) / "real.csv", Path(folder) / "simulated.csv")
        rows.append(simulators.row(pair, truth, comparison))
    if json_file is not None:
        files.write_json(json_file, {"seed": seed, "pairs": rows})
    print(simulators.text_of(rows))
    return 1 if sum(set(one["off"]) <= set(one["found"]) for one in rows) < 0.9 * cases else 0


def _drop_if_older(path: Path, than: Path) -> None:
    """Answers to cases that were made anew since do not count."""
    if path.exists() and path.stat().st_mtime < than.stat().st_mtime:
        path.unlink()


def _finish(result: dict[str, Any], json_file: Path | None) -> int:
    """Prints; returns the exit status."""
    if json_file is not None:
        files.write_json(json_file, result)
    print(tables.text_of(result))
    return 1 if any(entry["fails"] for entry in result["scores"]) else 0
