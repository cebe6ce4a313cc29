# SPDX-License-Identifier: MIT
"""Networks and simulators on takes that none learned from: all from the same states, with recorded tips."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import diabolo
import numpy as np
from numpy.typing import NDArray

from .networks import PaperNetwork, StrongNetwork, Track, predicted

HORIZONS = (0.1, 0.25, 0.5, 1.0)
EVERY = 0.1  # [s] between starts
RATE = 120.0
DIVERGED = 1e3  # what is farther off counts as this [m]


def load_at_rate(path: Path) -> diabolo.Recording:
    return at_rate(diabolo.load_recording(path))


def at_rate(take: diabolo.Recording) -> diabolo.Recording:
    return take if abs(take.rate - RATE) < 1.0 else take.resample(RATE)


def track_of(take: diabolo.Recording) -> Track:
    """Velocities from the rows beside, spins from the mean of the two around."""
    place, spin = np.asarray(take.diabolo), np.asarray(take.spin())
    velocity, at = np.full_like(place, np.nan), np.full(len(place), np.nan)
    velocity[1:-1] = 0.5 * RATE * (place[2:] - place[:-2])
    at[1:] = 0.5 * (spin[1:] + spin[:-1])
    return Track(np.column_stack([place, velocity, at]), np.hstack([take.left, take.right]), 1.0 / RATE)


def with_last_seen(tips: NDArray[np.float64]) -> NDArray[np.float64]:
    """Tips with what is not seen as it was last."""
    held = tips.copy()
    for i in range(1, len(held)):
        lost = ~np.isfinite(held[i])
        held[i, lost] = held[i - 1, lost]
    return held


def horizon_errors(
    take: diabolo.Recording,
    networks: Sequence[PaperNetwork | StrongNetwork],
    models: Mapping[str, diabolo.Model | str],
    horizons: Sequence[float] = HORIZONS,
) -> dict[str, NDArray[np.float64]]:
    """Distances after each horizon, (starts, horizons), NaN where nothing is seen."""
    rows = [round(horizon * RATE) for horizon in horizons]
    true, tips = np.asarray(take.diabolo), with_last_seen(np.hstack([take.left, take.right]))
    found: dict[str, list[NDArray[np.float64]]] = {name: [] for name in (*models, "at rest")}
    starts, windows, wanted = [], [], []
    for i in range(0, len(true) - rows[0], round(EVERY * RATE)):
        try:
            simulated = {
                name: diabolo.predict(take, model, row=i, start="fair").states
                for name, model in models.items()
            }
        except ValueError:
            continue
        start = next(iter(simulated.values()))[i]
        if not np.isfinite(start).all():
            continue
        ends = np.array([i + row for row in rows])
        inside = np.minimum(ends, len(true) - 1)
        truth = np.where((ends < len(true))[:, None], true[inside], np.nan)
        for name, states in simulated.items():
            found[name].append(distance(states[inside, :3], truth))
        found["at rest"].append(distance(resting_place(tips[inside]), truth))
        path = tips[i : i + rows[-1] + 1]
        windows.append(np.vstack([path, np.repeat(path[-1:], rows[-1] + 1 - len(path), 0)]))
        starts.append(start)
        wanted.append(truth)
    if not starts:
        return {}
    for network in networks:
        places = predicted(network, np.array(starts), np.array(windows), 1.0 / RATE)
        found[network.name] = [distance(p[rows], t) for p, t in zip(places, wanted, strict=True)]
    return {name: np.array(values) for name, values in found.items()}


def resting_place(tips: NDArray[np.float64], length: float = 1.45) -> NDArray[np.float64]:
    """Where a diabolo rests on a string of that length."""
    left, right = tips[:, :3], tips[:, 3:]
    sag = 0.5 * np.sqrt(np.maximum(0.0, length**2 - np.sum((left - right) ** 2, 1)))
    return 0.5 * (left + right) - np.column_stack([np.zeros((len(sag), 2)), sag])


def distance(places: NDArray[np.float64], true: NDArray[np.float64]) -> NDArray[np.float64]:
    distance = np.linalg.norm(
        np.clip(np.nan_to_num(places, nan=DIVERGED), -DIVERGED, DIVERGED) - true, axis=-1
    )
    return np.asarray(np.minimum(distance, DIVERGED))


def print_horizons(
    errors: Mapping[str, Sequence[NDArray[np.float64]]],
    horizons: Sequence[float] = HORIZONS,
    shown: Sequence[float] = HORIZONS,
) -> None:
    print(f"\nMean (median) distance from starts each {EVERY:g} s of what none learned from [m]:\n")
    if not errors:
        raise ValueError("no start was found in any take; expected takes in which the diabolo is seen")
    names = list(errors)
    print("| after | starts | " + " | ".join(names) + " |")
    print("|---|---|" + "---|" * len(names))
    every = {name: np.concatenate(values) for name, values in errors.items()}
    for horizon in shown:
        k = horizons.index(horizon)
        seen = np.isfinite(every[names[0]][:, k])
        cells = [f"{np.mean(v[seen, k]):.3f} ({np.median(v[seen, k]):.3f})" for v in every.values()]
        print(f"| {horizon:g} s | {np.count_nonzero(seen)} | " + " | ".join(cells) + " |")
