# SPDX-License-Identifier: MIT
"""The paper's neural predictor, rebuilt, and a stronger one, beside the simulator, on takes held out.

For each take the networks learn from all the others; rows of one that hold the same play again are left out
too. All begin from the same states (`diabolo.predict`, start "published" for the paper's table and "fair" for
the others), and see the recorded tips.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
import torch
from numpy.typing import NDArray

from .. import command
from .held_out import RATE, distance, horizon_errors, load_at_rate, print_horizons, track_of, with_last_seen
from .networks import PaperNetwork, StrongNetwork, Track, predicted

EXAMPLE = "  python -m benchmarks.learning.predictor FOLDER      # the authors' recordings"
TABLE = {  # the paper's excerpts: last row, and its two figures [m]
    "throw_1": (324, 0.21, 0.57),
    "z_hop_1": (180, 0.07, 0.14),
    "acceleration_1": (180, 0.03, 2.81),
    "circular_accel_stick_motion": (142, 0.11, 0.21),
    "y_swing_2": (902, 0.08, 0.40),
}


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.learning.predictor", __doc__, EXAMPLE)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="the authors' recordings")
    parser.add_argument("--seed", type=int, default=1, help="of what is drawn; default: 1")
    return command.run(parser, _run, arguments)


def _run(arguments: argparse.Namespace) -> int:
    torch.set_num_threads(1)
    takes = {path.stem: load_at_rate(path) for path in sorted(_paths(arguments.folder))}
    table: dict[str, list[float]] = {}
    errors: dict[str, list[NDArray[np.float64]]] = {}
    for name, take in takes.items():
        if "free" in name or "trials" in name:
            continue
        begin = time.monotonic()
        tracks = [_without(track_of(other), take) for key, other in takes.items() if key != name]
        networks = [kind(tracks, arguments.seed) for kind in (PaperNetwork, StrongNetwork)]
        if name in TABLE:
            table[name] = _excerpt(take, TABLE[name][0], networks)
        for label, values in horizon_errors(take, networks, {"consistent": "consistent"}).items():
            errors.setdefault(label, []).append(values)
        print(f"{name}: {time.monotonic() - begin:.0f} s", file=sys.stderr)
    _print_table(table)
    print_horizons(errors)
    return 0


def _paths(folder: Path) -> list[Path]:
    found = [*folder.glob("2020-07-11_*/*.csv"), *folder.glob("2020-09-14*/circular_accel_stick_motion.csv")]
    if not found:
        raise ValueError(f"{folder}: no takes of 2020-07-11; expected the folders of the authors' recordings")
    return found


def _without(track: Track, take: diabolo.Recording) -> Track:
    """The track without rows that hold the play of `take` again."""
    own = {tuple(row) for row in np.round(np.asarray(take.diabolo), 6) if np.isfinite(row).all()}
    states = track.states.copy()
    again = [tuple(row) in own for row in np.round(states[:, :3], 6)]
    states[np.array(again)] = np.nan
    return Track(states, track.tips, track.dt)


def _excerpt(take: diabolo.Recording, last: int, networks: Sequence[Any]) -> list[float]:
    """Mean distances over the paper's excerpt: of the published rules, and of each network."""
    part = take.cut(0, last)
    published = diabolo.predict(part, "published", row=0, start="published")
    true, tips = np.asarray(part.diabolo), with_last_seen(np.hstack([part.left, part.right]))
    start = published.states[:1]
    start = np.where(np.isfinite(start), start, 0.0)
    paths = [published.states[:, :3]]
    paths += [predicted(network, start, tips[None], 1.0 / RATE)[0] for network in networks]
    return [float(np.nanmean(distance(path[1:-1], true[1:-1]))) for path in paths]


def _print_table(table: dict[str, list[float]]) -> None:
    print("\nMean distance over the paper's excerpts [m]:\n")
    print("| excerpt | published | its figure | net, its figure | net, rebuilt | net, strong |")
    print("|---|---|---|---|---|---|")
    for name, (rules, paper, strong) in table.items():
        _, printed, net = TABLE[name]
        print(f"| {name} | {rules:.3f} | {printed} | {net} | {paper:.3f} | {strong:.3f} |")
    if table:
        sums = np.array(list(table.values())).sum(0)
        nets, rules = sum(row[2] for row in TABLE.values()), sum(row[1] for row in TABLE.values())
        print(f"| sum | {sums[0]:.3f} | {rules:.2f} | {nets:.2f} | {sums[1]:.3f} | {sums[2]:.3f} |")


if __name__ == "__main__":
    sys.exit(main())
