# SPDX-License-Identifier: MIT
"""How much play a neural predictor needs, and a diagnosis: both learn from the independent plant's play.

The networks of benchmarks.learning.predictor learn from 1, 3, ... minutes, with equally many steps of the
optimiser; a diagnosis takes half a minute. All predict another minute of the plant's play. Each half a minute
has the same figures, never moved alike: more play is not more variety, which favours the networks.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import diabolo
import numpy as np
import torch
from matplotlib.figure import Figure
from numpy.typing import NDArray

from .. import command
from ..proof import plant as program
from ..proof.player.plant import PRACTICE, Plant
from .held_out import at_rate, horizon_errors, print_horizons, track_of
from .networks import PaperNetwork, StrongNetwork, Track

EXAMPLE = "  make plant && python -m benchmarks.learning.scaling --png scaling.png"
MINUTES = (1, 3, 10, 100)
STEPS = {PaperNetwork: 20_000, StrongNetwork: 1_500}
"""Of the optimiser, for any amount of play."""
FINE = tuple(round(0.05 * k, 2) for k in range(1, 21))  # horizons of the figure [s]
HELD_OUT, DIAGNOSED = (501, 502), 500  # seeds of plays that no network learns from


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.learning.scaling", __doc__, EXAMPLE)
    parser.add_argument(
        "--minutes", type=int, nargs="+", default=MINUTES, metavar="N", help="default: 1 3 10 100"
    )
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the networks; default: 1")
    parser.add_argument("--png", type=Path, metavar="FILE", help="error against time, to draw")
    program.add_option(parser)
    return command.run(parser, run, arguments)


def run(given: argparse.Namespace) -> int:
    minutes_given = sorted(set(given.minutes))
    if not 1 <= minutes_given[0] <= minutes_given[-1] <= 200:
        raise ValueError(f"--minutes {given.minutes}; expected 1 to 200")
    if given.png and not (given.png.suffix == ".png" and given.png.parent.is_dir()):
        raise ValueError(f"--png {given.png}; expected a file NAME.png in a folder that is there")
    program.check(given.plant)
    torch.set_num_threads(1)
    plays = [round(60.0 * minutes / PRACTICE) for minutes in minutes_given]
    tracks = played(given.plant, range(1, max(plays) + 1))
    takes = Plant(given.plant, seed=DIAGNOSED).practice()
    found = diabolo.diagnose(takes)
    if found.headline == "INSUFFICIENT_DATA":
        raise ValueError(found.sentence)
    print(f"diagnosed, {PRACTICE:g} s: {found.sentence}")
    models: dict[str, diabolo.Model | str] = {
        "consistent": "consistent",
        "diagnosed": diabolo.model_for(found.model, takes[0]),
        "diagnosed, taut catches only": taut_catcher(diabolo.model_for(found.model, takes[0])),
    }
    networks: list[PaperNetwork | StrongNetwork] = []
    for count, minutes in zip(plays, minutes_given, strict=True):
        for kind, steps in STEPS.items():
            begin = time.monotonic()
            networks.append(kind([one for each in tracks[:count] for one in each], given.seed, steps))
            networks[-1].name = f"{kind.name}, {minutes:g} min"
            print(f"{networks[-1].name}: {time.monotonic() - begin:.0f} s", file=sys.stderr)
    errors: dict[str, list[NDArray[np.float64]]] = {}
    for seed in HELD_OUT:
        for take in Plant(given.plant, seed=seed).practice():
            for name, values in horizon_errors(at_rate(take), networks, models, FINE).items():
                errors.setdefault(name, []).append(values)
    print_horizons(errors, FINE)
    if given.png:
        draw_figure(errors, given.png)
    return 0


def taut_catcher(model: diabolo.Model) -> diabolo.Model:
    """The same, but with the paper's rule for a catch."""
    model.parameters.catch_slack = diabolo.Parameters().catch_slack
    return model


def played(file: Path, seeds: Sequence[int]) -> list[list[Track]]:
    """The plant's own play, filmed, for each seed."""

    def one(seed: int) -> list[Track]:
        return [track_of(at_rate(take)) for take in Plant(file, seed=seed).practice()]

    with ThreadPoolExecutor() as pool:
        found = []
        for tracks in pool.map(one, seeds):
            found.append(tracks)
            print(f"\rplay {len(found)} of {len(seeds)}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return found


def draw_figure(errors: dict[str, list[NDArray[np.float64]]], path: Path) -> None:
    """Median errors against time."""
    figure = Figure(figsize=(8.6, 4.2), layout="constrained")
    axes = figure.subplots()
    looks = {"neural net, rebuilt": "tab:red", "neural net, strong": "tab:blue"}
    for name, values in errors.items():
        kind, _, play = name.rpartition(", ")
        amounts = [one.rpartition(", ")[2] for one in errors if one.startswith(kind + ", ")]
        shade = 0.35 + 0.65 * (amounts.index(play) + 1) / len(amounts) if kind in looks else 1.0
        colour = looks.get(kind) or {"diagnosed": "black", "consistent": "tab:gray"}.get(name, "tab:green")
        line = np.nanmedian(np.concatenate(values), axis=0)
        axes.semilogy(
            FINE, 1e3 * line, color=colour, alpha=shade, ls="-" if kind in looks else "--", label=name
        )
    axes.set(xlabel="time from the start [s]", ylabel="median error [mm]", xlim=(0.0, FINE[-1]))
    axes.grid(visible=True, which="both", alpha=0.2)
    figure.legend(fontsize=8, loc="outside right center")
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    sys.exit(main())
