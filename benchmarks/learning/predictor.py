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
from .networks import PaperNetwork, StrongNetwork, Track, predicted

EXAMPLE = "  python -m benchmarks.learning.predictor FOLDER      # the authors' recordings"
TABLE = {  # the paper's excerpts: last row, and its two figures [m]
    "throw_1": (324, 0.21, 0.57),
    "z_hop_1": (180, 0.07, 0.14),
    "acceleration_1": (180, 0.03, 2.81),
    "circular_accel_stick_motion": (142, 0.11, 0.21),
    "y_swing_2": (902, 0.08, 0.40),
}
HORIZONS = (0.1, 0.25, 0.5, 1.0)
EVERY = 0.1  # [s] between starts
RATE = 120.0
DIVERGED = 1e3  # what is farther off counts as this [m]


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.learning.predictor", __doc__, EXAMPLE)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="the authors' recordings")
    parser.add_argument("--seed", type=int, default=1, help="of what is drawn; default: 1")
    return command.run(parser, _run, arguments)


def _run(arguments: argparse.Namespace) -> int:
    torch.set_num_threads(1)
    takes = {path.stem: _read(path) for path in sorted(_paths(arguments.folder))}
    table: dict[str, list[float]] = {}
    errors: dict[str, list[NDArray[np.float64]]] = {}
    for name, take in takes.items():
        if "free" in name or "trials" in name:
            continue
        begin = time.monotonic()
        tracks = [_without(_track(other), take) for key, other in takes.items() if key != name]
        networks = [kind(tracks, arguments.seed) for kind in (PaperNetwork, StrongNetwork)]
        if name in TABLE:
            table[name] = _excerpt(take, TABLE[name][0], networks)
        for label, values in _from_many_starts(take, networks).items():
            errors.setdefault(label, []).append(values)
        print(f"{name}: {time.monotonic() - begin:.0f} s", file=sys.stderr)
    _print_table(table)
    _print_horizons(errors)
    return 0


def _paths(folder: Path) -> list[Path]:
    found = [*folder.glob("2020-07-11_*/*.csv"), *folder.glob("2020-09-14*/circular_accel_stick_motion.csv")]
    if not found:
        raise ValueError(f"{folder}: no takes of 2020-07-11; expected the folders of the authors' recordings")
    return found


def _read(path: Path) -> diabolo.Recording:
    take = diabolo.load_recording(path)
    return take if abs(take.rate - RATE) < 1.0 else take.resample(RATE)


def _track(take: diabolo.Recording) -> Track:
    """Velocities from the rows beside, spins from the mean of the two around."""
    place, spin = np.asarray(take.diabolo), np.asarray(take.spin())
    velocity, at = np.full_like(place, np.nan), np.full(len(place), np.nan)
    velocity[1:-1] = 0.5 * RATE * (place[2:] - place[:-2])
    at[1:] = 0.5 * (spin[1:] + spin[:-1])
    return Track(np.column_stack([place, velocity, at]), np.hstack([take.left, take.right]), 1.0 / RATE)


def _without(track: Track, take: diabolo.Recording) -> Track:
    """The track without rows that hold the play of `take` again."""
    own = {tuple(row) for row in np.round(np.asarray(take.diabolo), 6) if np.isfinite(row).all()}
    states = track.states.copy()
    again = [tuple(row) in own for row in np.round(states[:, :3], 6)]
    states[np.array(again)] = np.nan
    return Track(states, track.tips, track.dt)


def _held(tips: NDArray[np.float64]) -> NDArray[np.float64]:
    """Tips with what is not seen as it was last."""
    held = tips.copy()
    for i in range(1, len(held)):
        lost = ~np.isfinite(held[i])
        held[i, lost] = held[i - 1, lost]
    return held


def _excerpt(take: diabolo.Recording, last: int, networks: Sequence[Any]) -> list[float]:
    """Mean distances over the paper's excerpt: of the published rules, and of each network."""
    part = take.cut(0, last)
    published = diabolo.predict(part, "published", row=0, start="published")
    true, tips = np.asarray(part.diabolo), _held(np.hstack([part.left, part.right]))
    start = published.states[:1]
    start = np.where(np.isfinite(start), start, 0.0)
    paths = [published.states[:, :3]]
    paths += [predicted(network, start, tips[None], 1.0 / RATE)[0] for network in networks]
    return [float(np.nanmean(_distance(path[1:-1], true[1:-1]))) for path in paths]


def _from_many_starts(take: diabolo.Recording, networks: Sequence[Any]) -> dict[str, NDArray[np.float64]]:
    """Distances after each horizon, (starts, horizons), NaN where nothing is seen."""
    rows = [round(horizon * RATE) for horizon in HORIZONS]
    true, tips = np.asarray(take.diabolo), _held(np.hstack([take.left, take.right]))
    found: dict[str, list[NDArray[np.float64]]] = {"consistent": [], "at rest": []}
    starts, windows, wanted = [], [], []
    for i in range(0, len(true) - rows[0], round(EVERY * RATE)):
        try:
            simulated = diabolo.predict(take, "consistent", row=i, start="fair").states
        except ValueError:
            continue
        if not np.isfinite(simulated[i]).all():
            continue
        ends = np.array([i + row for row in rows])
        inside = np.minimum(ends, len(true) - 1)
        truth = np.where((ends < len(true))[:, None], true[inside], np.nan)
        found["consistent"].append(_distance(simulated[inside, :3], truth))
        found["at rest"].append(_distance(_lowest(tips[inside]), truth))
        path = tips[i : i + rows[-1] + 1]
        windows.append(np.vstack([path, np.repeat(path[-1:], rows[-1] + 1 - len(path), 0)]))
        starts.append(simulated[i])
        wanted.append(truth)
    for network in networks:
        places = predicted(network, np.array(starts), np.array(windows), 1.0 / RATE)
        found[network.name] = [_distance(p[rows], t) for p, t in zip(places, wanted, strict=True)]
    return {name: np.array(values) for name, values in found.items()}


def _lowest(tips: NDArray[np.float64], length: float = 1.45) -> NDArray[np.float64]:
    """Where a diabolo rests on a string of that length."""
    left, right = tips[:, :3], tips[:, 3:]
    sag = 0.5 * np.sqrt(np.maximum(0.0, length**2 - np.sum((left - right) ** 2, 1)))
    return 0.5 * (left + right) - np.column_stack([np.zeros((len(sag), 2)), sag])


def _distance(places: NDArray[np.float64], true: NDArray[np.float64]) -> NDArray[np.float64]:
    distance = np.linalg.norm(
        np.clip(np.nan_to_num(places, nan=DIVERGED), -DIVERGED, DIVERGED) - true, axis=-1
    )
    return np.asarray(np.minimum(distance, DIVERGED))


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


def _print_horizons(errors: dict[str, list[NDArray[np.float64]]]) -> None:
    print(f"\nMean (median) distance from starts each {EVERY:g} s on whole takes left out [m]:\n")
    names = list(errors)
    print("| after | starts | " + " | ".join(names) + " |")
    print("|---|---|" + "---|" * len(names))
    every = {name: np.concatenate(values) for name, values in errors.items()}
    for k, horizon in enumerate(HORIZONS):
        seen = np.isfinite(every[names[0]][:, k])
        cells = [f"{np.mean(v[seen, k]):.3f} ({np.median(v[seen, k]):.3f})" for v in every.values()]
        print(f"| {horizon:g} s | {np.count_nonzero(seen)} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    sys.exit(main())
