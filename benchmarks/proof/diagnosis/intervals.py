# SPDX-License-Identifier: MIT
"""Intervals of rates and medians, which assume nothing about distributions, and of means."""

from __future__ import annotations

import functools
import math
import statistics
from collections.abc import Callable, Sequence


def at_most(hits: int, total: int, rate: float) -> float:
    """Probability of so many hits or fewer."""
    if hits < 0:
        return 0.0
    if hits >= total or rate <= 0.0:
        return 1.0
    if rate >= 1.0:
        return 0.0
    logs = [
        math.lgamma(total + 1)
        - math.lgamma(k + 1)
        - math.lgamma(total - k + 1)
        + k * math.log(rate)
        + (total - k) * math.log1p(-rate)
        for k in range(hits + 1)
    ]
    return min(1.0, math.fsum(math.exp(value) for value in logs))


def _crossing(falls: Callable[[float], float], level: float) -> float:
    """Where a function that falls from 0 to 1 comes below a level."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if falls(middle) > level else (low, middle)
    return 0.5 * (low + high)


@functools.cache
def clopper_pearson(hits: int, total: int, level: float = 0.95) -> tuple[float, float]:
    """Interval of a rate that covers it with at least the level's probability."""
    if total == 0:
        return 0.0, 1.0
    tail = 0.5 * (1.0 - level)
    low = 0.0 if hits == 0 else _crossing(lambda rate: at_most(hits - 1, total, rate), 1.0 - tail)
    high = 1.0 if hits == total else _crossing(lambda rate: at_most(hits, total, rate), tail)
    return low, high


def median(values: Sequence[float]) -> float | None:
    """The middle value; None of nothing."""
    if not values:
        return None
    ordered, half = sorted(values), len(values) // 2
    return ordered[half] if len(values) % 2 else 0.5 * (ordered[half - 1] + ordered[half])


def median_interval(values: Sequence[float], level: float = 0.95) -> tuple[float, float] | None:
    """Interval of the median between two of the values; None where they are too few."""
    ordered, rank = sorted(values), -1
    while at_most(rank + 1, len(ordered), 0.5) <= 0.5 * (1.0 - level):
        rank += 1
    if rank < 0 or not ordered:
        return None
    return ordered[rank], ordered[len(ordered) - 1 - rank]


def mean_interval(values: Sequence[float]) -> tuple[float, float] | None:
    """95 % of a mean, as if normally distributed; None of fewer than two values."""
    if len(values) < 2:
        return None
    reach = 1.96 * statistics.stdev(values) / math.sqrt(len(values))
    middle = statistics.fmean(values)
    return middle - reach, middle + reach
