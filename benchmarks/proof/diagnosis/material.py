# SPDX-License-Identifier: MIT
"""Which effects are large enough that a diagnosis owes their names (the floors of its claims)."""

from __future__ import annotations

from typing import Any

import numpy as np

from .answer import Answer

SMALLEST_REACH = 1e-3  # after half a second, in the most affected tenth of the windows [m]
SMALLEST_SPIN_SHARE, SPIN_TIME = 0.05, 10.0  # lost within so long, at the rate of the moment [s]
MARGIN = 1.25  # beyond the floor, since sizes are only estimated
OF_SPIN = ("spin_drag", "axle_drag")


def spin_share(key: dict[str, Any], name: str) -> float:
    """Share of the spin that an effect takes, in the most affected tenth of the recording."""
    scenario = key["scenario"]
    times = np.linspace(0.0, scenario["duration"], 200)
    start = abs(scenario["start"]["spin"])
    if name == "spin_drag":
        coefficient = key["parameters"][name]["coefficient"]
        shares = coefficient * start / (1.0 + coefficient * start * times)
    else:
        rate = key["parameters"][name]["rate"]
        shares = rate / np.maximum(10.0, start - rate * times)
    return SPIN_TIME * float(np.quantile(shares, 0.9))


def is_material(key: dict[str, Any], oracle: Answer | None, name: str) -> bool | None:
    """Whether an effect at work is beyond its floor; None where that is not known."""
    if name in OF_SPIN:
        return spin_share(key, name) > MARGIN * SMALLEST_SPIN_SHARE
    sizes = {rung["name"]: rung["size_m"] for rung in oracle["ladder"]} if oracle else {}
    size = sizes.get(name)
    return None if size is None else size > MARGIN * SMALLEST_REACH
