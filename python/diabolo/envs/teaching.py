# SPDX-License-Identifier: MIT
"""The player as a teacher of agents."""

from __future__ import annotations

from .. import _core
from .._core import EpisodeStart, HandLimits
from ..checks import LARGEST_SEED, instance_of, one_of, whole_number
from .spaces import AnyModels, models_of

TAUGHT: tuple[str, ...] = tuple(_core.lessons())
"""Tasks that the player teaches."""
MOST_PLAYS = 10_000


def taught_starts(
    task: str, model: AnyModels = None, *, plays: int = 48, seed: int = 0, limits: HandLimits | None = None
) -> list[EpisodeStart]:
    """Moments of plays that the player plans, for episodes to begin with (DiaboloVectorEnv, starts).

    So an agent learns a throw from its end: to catch what flies, then to throw it.
    task: one of TAUGHT. plays: with goals of the task's ranges, each planned with one of the models, in some
    0.2 s. The moments are 20 ms apart, from the beginning to the catch, and within the hands' limits.
    Raises ValueError about bad input.
    """
    return _core.taught_starts(
        one_of("task", task, TAUGHT),
        models_of(model),
        whole_number("plays", plays, 1, MOST_PLAYS),
        whole_number("seed", seed, 0, LARGEST_SEED),
        HandLimits() if limits is None else instance_of("limits", limits, HandLimits),
    )
