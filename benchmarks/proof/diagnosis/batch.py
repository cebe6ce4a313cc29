# SPDX-License-Identifier: MIT
"""Where a batch keeps its recordings and keys, and how its cases are made."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Collection, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from .. import files
from . import draw, making

Report = Callable[[str, float], None]


class Store:
    """A folder with the recordings of a batch, and the keys apart from them."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.recordings = folder / "recordings"
        self.keys = folder / "keys"

    def recording(self, case: str) -> Path:
        return self.recordings / f"{case}.csv"

    def key_path(self, case: str) -> Path:
        return self.keys / f"{case}.json"

    def key(self, case: str) -> dict[str, Any]:
        return dict(files.read_json(self.key_path(case), "the key of a case"))

    def digest(self, case: str) -> str:
        """Of a recording's two files. Raises ValueError where they are not there."""
        path = self.recording(case)
        if not path.exists() or not path.with_suffix(".json").exists():
            raise ValueError(f"{path}: there is no such recording; running the batch makes it again")
        return files.digest_of_text(files.digest_of(path) + files.digest_of(path.with_suffix(".json")))

    def make(self, program: Path, plan: draw.Plan) -> None:
        """Makes a case unless it is there. The key comes last, so that a case with a key is whole."""
        if self.key_path(plan.name).exists() and self.recording(plan.name).exists():
            return
        self.recordings.mkdir(parents=True, exist_ok=True)
        with _apart(self.folder / f".{plan.name}") as folder:
            made = folder / f"{plan.name}.csv"
            key = making.make(program, plan, made)
            for part in (made.with_suffix(".json"), made):
                shutil.move(part, self.recordings / part.name)
        files.write_json(self.key_path(plan.name), key)

    def fit_for(self, stamp: dict[str, Any]) -> None:
        """Empties the folder where it holds cases of another seed, plant or way of drawing."""
        path = self.folder / "stamp.json"
        if path.exists() and json.loads(path.read_text(encoding="utf-8")) == stamp:
            return
        for part in (self.recordings, self.keys):
            shutil.rmtree(part, ignore_errors=True)
        files.write_json(path, stamp)


@contextmanager
def _apart(folder: Path) -> Iterator[Path]:
    """A folder to work in, which is gone afterwards."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


DRAWING = ("arms", "base", "camera_steps", "draw", "motions", "sizes", "strangers")
"""Sources that the cases depend on."""


def stamp(program: Path, seed: int, cases: int) -> dict[str, Any]:
    """What the cases depend on."""
    sources = sorted(Path(__file__).parent.glob("*.py"))
    drawing = [path for path in sources if path.stem in DRAWING]
    return {
        "seed": seed,
        "cases": cases,
        "plant": files.digest_of(program),
        "drawing": files.digest_of_text("".join(files.digest_of(path) for path in drawing)),
    }


def make(
    store: Store,
    program: Path,
    seed: int,
    cases: int,
    chain: bool,
    jobs: int,
    report: Report,
    but: Collection[str] = (),
) -> list[draw.Plan]:
    """Makes all cases of a batch, `but` some, that are not there yet; returns what was planned."""
    store.fit_for({**stamp(program, seed, cases), "chain": chain})
    planned = draw.plans(seed, cases, chain)
    make_planned(store, program, [plan for plan in planned if plan.name not in but], jobs, report)
    return planned


def make_planned(store: Store, program: Path, wanted: Sequence[draw.Plan], jobs: int, report: Report) -> None:
    """Makes cases that are not there yet."""
    with ThreadPoolExecutor(jobs) as pool:
        running = [pool.submit(store.make, program, plan) for plan in wanted]
        try:
            for done, future in enumerate(running):
                report(f"making {wanted[done].name}: {done} of {len(wanted)} done", done / len(wanted))
                future.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
