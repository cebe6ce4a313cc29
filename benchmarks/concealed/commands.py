# SPDX-License-Identifier: MIT
"""What the subcommands of `diabolo prove` do."""

from __future__ import annotations

import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import answer, batch, files, page, plant, run, score, seal, tables, tools
from .names import physics_among

ARMS_WITH_ORACLE = ("single", "several", "with_fault", "tie", "outside")


@dataclass(frozen=True)
class Places:
    """Where things are."""

    sources: Path
    """benchmarks/concealed, with the sealed batches and their results."""
    build: Path
    """For recordings and keys."""
    program: Path
    """The plant's."""
    report: run.Report

    def published(self, name: str) -> Path:
        return self.sources / "batches" / f"{name}.json"

    def results(self, name: str, what: str) -> Path:
        return self.sources / "results" / f"{name}{what}"

    def store(self, name: str) -> batch.Store:
        return batch.Store(self.build / name)


def check_name(name: str) -> None:
    """Names become those of files."""
    if not name.replace("_", "").replace("-", "").isalnum():
        raise ValueError(f"batch {name!r}: expected a name of letters, digits, - and _")


def tool_named(name: str) -> tools.Tool:
    if name not in tools.TOOLS:
        raise ValueError(f"--tool {name}: expected one of {', '.join(tools.TOOLS)}")
    return tools.TOOLS[name]


def answers_path(places: Places, name: str, tool: str) -> Path:
    return places.results(name, ".jsonl" if tool == "diagnose" else f".{tool}.jsonl")


def seal_batch(places: Places, name: str, cases: int, jobs: int) -> int:
    check_name(name)
    result = seal.seal(
        name, places.published(name), places.store(name), places.program, cases, jobs, places.report
    )
    print(
        f"{places.published(name)}: {cases} cases sealed at commit {result['commit'][:12]}; "
        f"commit this file, then diabolo prove run {name}"
    )
    return 0


def _is_committed(path: Path) -> bool:
    known = subprocess.run(["git", "ls-files", "--error-unmatch", str(path)], capture_output=True)
    same = subprocess.run(["git", "diff", "--quiet", "HEAD", "--", str(path)], capture_output=True)
    return known.returncode == 0 and same.returncode == 0


def run_batch(places: Places, name: str, tool: str, minutes: float, jobs: int) -> int:
    check_name(name)
    chosen = tool_named(tool)
    sealed = seal.read(places.published(name))
    if not _is_committed(places.published(name)):
        raise ValueError(f"{places.published(name)}: not committed as it is; the seal comes before the run")
    seal.check_tool(sealed["commit"])
    store = places.store(name)
    plant.check_program(places.program)
    results = answers_path(places, name, tool)
    done = run.answers(results)
    batch.make(store, places.program, sealed["seed"], sealed["cases"], True, jobs, places.report, but=done)
    seal.check_recordings(sealed, store, but=done)
    cases = [entry["case"] for entry in sealed["sealed"]]
    own = run.answers(answers_path(places, name, "diagnose")) if tool == "bic" else {}

    def ask(case: str) -> answer.Answer:
        recording = store.recording(case)
        return tools.by_bic(own[case], recording) if case in own else chosen(recording)

    left = run.resume(cases, results, ask, places.report, minutes)
    ending = f"{left} cases are left; run again" if left else f"all done; diabolo prove score {name}"
    print(f"{results}: {len(cases) - left} of {len(cases)} cases; {ending}")
    return 0


def at_work(keys: list[dict[str, Any]]) -> dict[str, list[str]]:
    """The physics of each case that has some."""
    return {key["case"]: physics_among(key["names"]) for key in keys if key["arm"] in ARMS_WITH_ORACLE}


def exchanged(keys: list[dict[str, Any]]) -> dict[str, list[str]]:
    """The other name of each tie."""
    return {
        key["case"]: [name for name in key["tie"] if name not in key["names"]] for key in keys if key["tie"]
    }


def oracles(
    places: Places,
    wanted: dict[str, list[str]],
    answers: dict[str, answer.Answer],
    store: batch.Store,
    path: Path,
) -> dict[str, answer.Answer]:
    """Answers of who is told the names, for as much of them as the tool knows."""
    if not tools.can_restrict():
        return {}
    told: dict[str, list[str]] = {}
    for case, names in wanted.items():
        ladder = {rung["name"] for rung in answers.get(case, {}).get("ladder", [])}
        if known := [name for name in names if name in ladder]:
            told[case] = known
    run.resume(list(told), path, lambda case: tools.oracle(store.recording(case), told[case]), places.report)
    return {case: found for case, found in run.answers(path).items() if case in told}


def score_batch(places: Places, name: str, tool: str, jobs: int, json_file: Path | None) -> int:
    """Opens the keys; writes NAME.score.json, or NAME.TOOL.score.json."""
    check_name(name)
    tool_named(tool)
    sealed = seal.read(places.published(name))
    store = places.store(name)
    found = run.answers(answers_path(places, name, tool))
    missing = [entry["case"] for entry in sealed["sealed"] if entry["case"] not in found]
    if missing:
        raise ValueError(f"batch {name}: {len(missing)} cases have no answer; diabolo prove run {name} first")
    plant.check_program(places.program)
    batch.make(store, places.program, sealed["seed"], sealed["cases"], True, jobs, places.report)
    keys = seal.open_keys(sealed, store)
    own = run.answers(answers_path(places, name, "diagnose"))
    best = oracles(places, at_work(keys), own, store, places.results(name, ".oracle.jsonl"))
    others = oracles(places, exchanged(keys), own, store, places.results(name, ".exchanged.jsonl"))
    verdicts = score.judged(keys, found, best, others)
    result = {"batch": name, "tool": tool, "commit": sealed["commit"], **score.summary(verdicts)}
    suffix = ".score.json" if tool == "diagnose" else f".{tool}.score.json"
    files.write_json(places.results(name, suffix), result)
    files.write_text(places.results(name, ".keys.jsonl"), "".join(files.text_of(key) + "\n" for key in keys))
    return _finish(result, json_file)


def write_page(places: Places, name: str, out: Path) -> int:
    check_name(name)
    path = places.results(name, ".score.json")
    result = files.read_json(path, f"the scores (diabolo prove score {name})")
    others = {
        tool: files.read_json(other, "scores")
        for tool in tools.TOOLS
        if (other := places.results(name, f".{tool}.score.json")).exists()
    }
    sealed = seal.read(places.published(name))
    try:
        written = page.write(out, name, sealed, result, others)
    except (KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"{path}: not scores as they are written now ({error!r}); score again") from error
    print("; ".join(str(path) for path in written))
    return 0


def quick(places: Places, cases: int, seed: int, tool: str, jobs: int, json_file: Path | None) -> int:
    """Cases that are not sealed: made, diagnosed and scored at once."""
    chosen = tool_named(tool)
    plant.check_program(places.program)
    store = places.store(f"quick_{seed}_{cases}")
    planned = batch.make(
        store, places.program, seed, cases, plant.knows_chain(places.program), jobs, places.report
    )
    stamp = tools.digest()[:12]
    names = [plan.name for plan in planned]
    results = store.folder / f"{tool}_{stamp}.jsonl"
    _drop_if_older(results, store.folder / "stamp.json")
    run.resume(names, results, lambda case: chosen(store.recording(case)), places.report)
    found = run.answers(results)
    keys = [store.key(case) for case in names]
    own = found
    if tool != "diagnose":
        own = run.answers(store.folder / f"diagnose_{stamp}.jsonl")
    told, other = (store.folder / f"{what}_{stamp}.jsonl" for what in ("oracle", "exchanged"))
    for path in (told, other):
        _drop_if_older(path, store.folder / "stamp.json")
    best = oracles(places, at_work(keys), own, store, told)
    others = oracles(places, exchanged(keys), own, store, other)
    verdicts = score.judged(keys, found, best, others)
    result = {"batch": None, "tool": tool, "seed": seed, **score.summary(verdicts)}
    return _finish(result, json_file)


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
