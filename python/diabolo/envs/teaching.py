# SPDX-License-Identifier: MIT
"""The player as a teacher of agents."""

from __future__ import annotations

from .. import _core
from .._core import EpisodeStart, HandLimits, HandPlan, PlannedPlay
from ..checks import LARGEST_SEED, instance_of, number, one_of, whole_number
from .spaces import AnyModels, AnyTasks, models_of, tasks_of

TAUGHT: tuple[str, ...] = tuple(_core.lessons())
"""Tasks that the player teaches."""
MOST_PLAYS = 10_000


def taught_starts(
    task: AnyTasks,
    model: AnyModels = None,
    *,
    plays: int = 48,
    seed: int = 0,
    limits: HandLimits | None = None,
) -> list[EpisodeStart]:
    """Moments of plays that the player plans, for episodes to begin with (DiaboloVectorEnv, starts).

    So an agent learns a throw from its end: to catch what flies, then to throw it.
    task: one of TAUGHT, or several. plays: of each task, with goals of its ranges, each planned with one of
    the models, in some 0.2 s. The moments are 20 ms apart, from the beginning to the catch, and within the
    hands' limits.
    Raises ValueError about bad input.
    """
    return _starts(task, model, plays, seed, limits, None)


def planned_starts(
    task: AnyTasks,
    model: AnyModels = None,
    *,
    plays: int = 48,
    seed: int = 0,
    limits: HandLimits | None = None,
    period: float = 0.02,
) -> list[EpisodeStart]:
    """Plans of the player's for an agent to correct: episodes begin with them (DiaboloVectorEnv, starts), and
    actions are added to the plan's motion.

    Each start is a play from its beginning. Its goal is what the play aims at, whether it comes to it or not.
    Plays that the hands cannot follow are skipped. period: of the agent [s]. Others as of taught_starts().
    """
    return _starts(task, model, plays, seed, limits, number("period", period))


def _starts(
    task: AnyTasks,
    model: AnyModels,
    plays: int,
    seed: int,
    limits: HandLimits | None,
    period: float | None,
) -> list[EpisodeStart]:
    """Of plans, where there is a period; else moments along plays."""
    names = [one_of("task", name, TAUGHT) for name in tasks_of(task)]
    models = models_of(model)
    whole_number("plays", plays, 1, MOST_PLAYS)
    whole_number("seed", seed, 0, LARGEST_SEED)
    hands = HandLimits() if limits is None else instance_of("limits", limits, HandLimits)
    return [
        start for name in names for start in _core.taught_starts(name, models, plays, seed, hands, period)
    ]


def hand_plan(
    planned: PlannedPlay,
    *,
    string_length: float = 1.45,
    limits: HandLimits | None = None,
    period: float = 0.02,
) -> HandPlan:
    """A play that was planned (diabolo.plan_action), for a LiveAgent to correct.

    It is moved to the middle of the limits' box; .left and .right are the tips then. Where a limit of the
    hands is in its way, it is what they do then. string_length [m]; period: of the agent [s].
    """
    return _core.hand_plan(
        instance_of("planned", planned, PlannedPlay),
        number("string_length", string_length),
        HandLimits() if limits is None else instance_of("limits", limits, HandLimits),
        number("period", period),
    )
