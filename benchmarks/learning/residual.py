# SPDX-License-Identifier: MIT
"""A residual on top of named physics, beside the laws that a diagnosis names and learns, on takes held out.

Each plant has one law that no name stands for, or nothing that is missing. It plays some takes; all but the
last are learnt from, the last is predicted from fair starts.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import diabolo
import numpy as np
from diabolo import Model, Recording
from numpy.typing import NDArray

from .. import command
from ..proof import plant
from ..proof.diagnosis import draw, making, strangers

EXAMPLE = "  python -m benchmarks.learning.residual --plant build/plant/diabolo-plant"
AHEAD = 0.5  # [s]
EVERY = 0.2  # between starts [s]
HARM = 1e-3  # [m]
NULL = "null"
COLUMNS = ("base", "residual", "diagnosis", "both")
Errors = dict[str, NDArray[np.float64]]


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.learning.residual", __doc__, EXAMPLE)
    plant.add_option(parser)
    parser.add_argument("--seed", type=int, default=5, help="of the plants; default: 5")
    parser.add_argument("--nulls", type=int, default=6, help="plants without such a law; default: 6")
    parser.add_argument(
        "--laws", nargs="+", choices=[*strangers.KINDS], default=[*strangers.KINDS], help="default: all"
    )
    parser.add_argument("--each", type=int, default=1, help="plants with each law; default: 1")
    parser.add_argument("--takes", type=int, default=5, help="of each plant; default: 5")
    parser.add_argument("--budget", type=float, default=1e9, help="of a diagnosis [s]; default: all it needs")
    return command.run(parser, _run, arguments)


def _run(given: argparse.Namespace) -> int:
    plant.check(given.plant)
    if given.takes < 2:
        raise ValueError(f"--takes {given.takes}; expected 2 or more, of which one is held out")
    numbered = [(i + 1, NULL) for i in range(given.nulls)]
    for law in given.laws:  # the same plants, whichever laws are asked for
        numbered += [(1000 * (1 + [*strangers.KINDS].index(law)) + i, law) for i in range(given.each)]
    print(f"Median distance {AHEAD:g} s after starts each {EVERY:g} s on a take held out [mm]:\n")
    print("| law | starts | " + " | ".join(COLUMNS) + " | worst by the residual |")
    print("|---|---|" + "---|" * (len(COLUMNS) + 1))
    found: dict[str, list[Errors]] = {"null": [], "strangers": []}
    for number, kind in numbered:
        begin = time.monotonic()
        takes = _takes(given, draw.Plan(given.seed, number, kind, "springs"))
        if len(takes) < 2:
            print(f"{kind}: the plant missed the diabolo in all but {len(takes)} takes", file=sys.stderr)
            continue
        errors = _compare(takes[:-1], takes[-1], given.budget)
        found["null" if kind == NULL else "strangers"].append(errors)
        _print_row(kind, errors)
        print(f"{kind}: {time.monotonic() - begin:.0f} s", file=sys.stderr)
    for name, several in found.items():
        if several:
            _print_row(f"all {name}", {c: np.concatenate([errors[c] for errors in several]) for c in COLUMNS})
    return 0


def _takes(given: argparse.Namespace, plan: draw.Plan) -> list[Recording]:
    """What one plant plays: the same bodies and the same law, drawn motions."""
    takes: list[Recording] = []
    with tempfile.TemporaryDirectory() as folder:
        for attempt in range(draw.TRIES):
            drawn, out = draw.draw(plan, attempt), Path(folder) / f"take_{attempt}.csv"
            if len(takes) == given.takes or making.play(given.plant, drawn.scenario, out) is None:
                continue
            take = diabolo.load_recording(out)
            if len(take) >= making.SHORTEST_SHARE * drawn.scenario["duration"] * take.rate:
                takes.append(take)
    return takes


def _compare(learnt_from: list[Recording], held_out: Recording, budget: float) -> Errors:
    diagnosed = diabolo.diagnose(learnt_from, budget=budget).model
    models = {
        "base": Model.consistent(),
        "residual": diabolo.fit_residual(learnt_from).model,
        "diagnosis": diagnosed,
        "both": diabolo.fit_residual(learnt_from, diagnosed).model,
    }
    errors = {name: _errors(held_out, model) for name, model in models.items()}
    seen = np.isfinite(list(errors.values())).all(0)
    return {name: values[seen] for name, values in errors.items()}


def _errors(take: Recording, model: Model) -> NDArray[np.float64]:
    """Start by start; NaN where nothing can be compared."""
    ahead, result = round(AHEAD * take.rate), []
    for row in range(0, len(take) - ahead, round(EVERY * take.rate)):
        part = take.cut(0, row + ahead)
        try:
            predicted = diabolo.predict(part, model, row=row, start="fair")
        except ValueError:
            result.append(np.nan)
            continue
        result.append(float(diabolo.position_errors(part, predicted)[-1]))
    return np.array(result)


def _print_row(name: str, errors: Errors) -> None:
    medians = " | ".join(f"{1e3 * np.median(errors[column]):.1f}" for column in COLUMNS)
    worse = errors["residual"] - errors["base"]
    harmed = np.count_nonzero(worse > HARM)
    told = f"{1e3 * worse.max():.1f}, {harmed} by over {1e3 * HARM:g}"
    print(f"| {name} | {len(worse)} | {medians} | {told} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
