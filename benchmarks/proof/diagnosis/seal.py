# SPDX-License-Identifier: MIT
"""Sealed batches: what was drawn is fixed by hashes before any tool sees a recording.

The seed is derived from the tool's commit, so that no batch can be chosen; the salts, too, so that who has
the commit can make the batch again and compare.
"""

from __future__ import annotations

import hashlib
import subprocess
from collections.abc import Collection
from pathlib import Path
from typing import Any

from .. import files, plant
from . import arms, batch, making

SCHEMA = "diabolo.concealed_batch/1"
TOOL = ("include", "batch", "python")
GUARDED = (
    "include",
    "batch",
    "python",
    "data/plant",
    "benchmarks/proof/*.py",
    "benchmarks/proof/diagnosis/*.py",
)


def _git(*arguments: str) -> str:
    try:
        done = subprocess.run(["git", *arguments], capture_output=True, text=True)
    except FileNotFoundError:
        raise ValueError("git is not installed; sealing needs the commit of the tool") from None
    if done.returncode != 0:
        raise ValueError(f"git {arguments[0]} failed: {done.stderr.strip() or 'no reason given'}")
    return done.stdout.rstrip()


def commit_of_clean_tree() -> str:
    """The tool's commit. Raises ValueError where the sources differ from it."""
    changed = _git("status", "--porcelain", "--untracked-files=all", "--", *GUARDED).splitlines()
    if changed:
        raise ValueError(
            f"{changed[0][3:].strip()} differs from the commit ({len(changed)} files do); commit first"
        )
    return _git("rev-parse", "HEAD")


def check_tool(commit: str) -> None:
    """Raises ValueError where the tool's sources are no longer those that a batch was sealed with."""
    changed = _git("diff", "--name-only", commit, "--", *TOOL).splitlines()
    changed += _git("ls-files", "--others", "--exclude-standard", "--", *TOOL).splitlines()
    if changed:
        raise ValueError(
            f"{changed[0]} is not as it was when the batch was sealed ({len(changed)} files are not); "
            "seal a fresh one"
        )


def seed_of(commit: str) -> int:
    """The seed that a commit gives."""
    return int(hashlib.sha256(f"concealed {commit}".encode()).hexdigest()[:12], 16)


def salt_of(seed: int, case: str) -> str:
    return hashlib.sha256(f"salt {seed} {case}".encode()).hexdigest()[:32]


def seal_of(key: dict[str, Any], salt: str) -> str:
    """The salted hash of a key."""
    return files.digest_of_text(salt + files.text_of(key))


def describe(
    store: batch.Store, cases: list[str], commit: str, seed: int, plant_digest: str
) -> dict[str, Any]:
    """What is published of a batch before it is run."""
    return {
        "schema": SCHEMA,
        "commit": commit,
        "plant": plant_digest,
        "seed": seed,
        "cases": len(cases),
        "arms": arms.allot(len(cases)),
        "sealed": [
            {
                "case": case,
                "recording": store.digest(case),
                "key": seal_of(store.key(case), salt_of(seed, case)),
            }
            for case in cases
        ],
    }


def seal(
    name: str, published: Path, store: batch.Store, program: Path, cases: int, jobs: int, report: batch.Report
) -> dict[str, Any]:
    """Makes a batch, and writes what is published of it."""
    commit = commit_of_clean_tree()
    if published.exists():
        raise ValueError(f"{published}: a batch {name} is sealed already; choose another name")
    plant.check(program)
    if not making.knows_chain(program):
        raise ValueError(f"{program}: does not know the second plant (structure chain); build it anew")
    seed = seed_of(commit)
    planned = batch.make(store, program, seed, cases, True, jobs, report)
    result = describe(store, [plan.name for plan in planned], commit, seed, files.digest_of(program))
    files.write_json(published, result)
    return result


def checked(path: Path, found: Any) -> dict[str, Any]:
    """A sealed batch as a file holds it. Raises ValueError where it is something else."""
    schema = found.get("schema") if isinstance(found, dict) else None
    if schema != SCHEMA:
        raise ValueError(f"{path}: schema {schema!r}; expected {SCHEMA!r}")
    lacking = [
        field for field in ("commit", "plant", "seed", "cases", "arms", "sealed") if field not in found
    ]
    if lacking:
        raise ValueError(f"{path}: lacks {', '.join(lacking)}; expected a sealed batch")
    for number, entry in enumerate(found["sealed"]):
        if not isinstance(entry, dict) or not {"case", "recording", "key"} <= entry.keys():
            raise ValueError(f"{path}: sealed[{number}]: expected case, recording and key")
    return dict(found)


def read(published: Path) -> dict[str, Any]:
    """A sealed batch."""
    return checked(published, files.read_json(published, "a sealed batch (the action seal writes it)"))


def digest(sealed: dict[str, Any]) -> str:
    """The hash of the file that was published."""
    return files.digest_of_text(files.json_text(sealed))


def check_recordings(sealed: dict[str, Any], store: batch.Store, but: Collection[str] = ()) -> None:
    """Raises ValueError where a recording, `but` of some cases, is not the one that was sealed."""
    for entry in sealed["sealed"]:
        if entry["case"] not in but and store.digest(entry["case"]) != entry["recording"]:
            raise ValueError(f"{store.recording(entry['case'])}: not the recording that was sealed")


def open_keys(sealed: dict[str, Any], store: batch.Store) -> list[dict[str, Any]]:
    """The keys. Raises ValueError where one is not what was sealed."""
    keys = []
    for entry in sealed["sealed"]:
        key = store.key(entry["case"])
        if (
            key["case"] != entry["case"]
            or seal_of(key, salt_of(sealed["seed"], entry["case"])) != entry["key"]
        ):
            raise ValueError(f"{store.key_path(entry['case'])}: not the key that was sealed")
        keys.append(key)
    return keys
