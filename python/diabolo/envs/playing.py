# SPDX-License-Identifier: MIT
"""What agents do in environments."""

from __future__ import annotations

from collections.abc import Callable
from importlib.resources import files
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from .._core import Agent, EpisodeStart
from ..checks import one_of, shown
from .spaces import AnyModels, AnyTasks, models_of
from .teaching import planned_starts
from .vector import DiaboloVectorEnv

Acting: TypeAlias = Agent | Callable[[NDArray[np.float32]], Any]
"""An agent, or a function that gives actions (n, 6) of observations (n, k)."""


class Transition(NamedTuple):
    """A period of n episodes side by side: what was seen (n, k), done (n, 6), and came of it, `after` being
    what is seen next. Of an episode that was over before, nothing is meant by it."""

    observations: NDArray[np.float32]
    actions: NDArray[np.float32]
    rewards: NDArray[np.float64]
    terminated: NDArray[np.bool_]
    truncated: NDArray[np.bool_]
    after: NDArray[np.float32]


def shipped_agent(task: str) -> Agent:
    """The agent that comes with the package; else raises ValueError."""
    folder = files("diabolo") / "agents"
    names = sorted(
        path.name.removesuffix(".json") for path in folder.iterdir() if path.name.endswith(".json")
    )
    if task not in names:
        raise ValueError(f"task: {shown(task)} has no agent in the package; expected {', '.join(names)}")
    return Agent.load(str(folder / f"{task}.json"))


def tasks_played(agent: Agent, task: str | None) -> tuple[AnyTasks, str | None]:
    """What environments have where an agent plays a task, or all of its own; and the one of several that each
    episode is of. An agent of one task may play another one. Raises ValueError."""
    if len(agent.tasks) == 1:
        return task or agent.tasks[0], None
    return agent.tasks, None if task is None else one_of("task", task, tuple(agent.tasks))


def _plans(
    agent: Agent, tasks: AnyTasks, model: AnyModels, seed: int, options: dict[str, Any]
) -> list[EpisodeStart]:
    """Of all tasks, for the models and within the limits that are played with."""
    models, limits = models_of(model, options.get("difficulty", "easy")), options.get("limits")
    return planned_starts(tasks, models, seed=seed, limits=limits, period=agent.period)


def play(
    agent: Acting,
    episodes: int = 100,
    *,
    task: str | None = None,
    model: AnyModels = None,
    seed: int = 0,
    watch: Callable[[DiaboloVectorEnv], object] = lambda env: None,
    keep: Callable[[Transition], object] = lambda transition: None,
    **options: Any,
) -> dict[str, NDArray[Any]]:
    """Play episodes side by side, each to its end; what they came to, an entry for each (DiaboloEnv.outcome).

    task: the agent's own, unless one is given; of several, each episode draws one. watch: is shown the
    environments at first and after each period; those that are over stay as they ended. keep: is given each
    period, such as a list's append. options: of DiaboloVectorEnv; period and steps are the agent's, and one
    that corrects plans gets some of the player's where there are no starts. Raises ValueError about bad
    input.
    """
    act: Callable[[NDArray[np.float32]], Any]
    if isinstance(agent, Agent):
        (tasks, drawn), act = tasks_played(agent, task), agent.act
        options = {"period": agent.period, "steps": agent.steps, **options}
        if agent.corrects and "starts" not in options:
            options |= {"starts": _plans(agent, tasks, model, seed, options), "start_share": 1.0}
    elif callable(agent) and task is not None:
        (tasks, drawn), act = (task, None), agent
    else:
        raise ValueError(f"agent: {shown(agent)}; expected an Agent, or a function together with a task")
    if "autoreset_mode" in options:
        raise ValueError("autoreset_mode: given; expected none, each episode is played once")
    env = DiaboloVectorEnv(episodes, tasks, model, autoreset_mode=AutoresetMode.DISABLED, **options)
    observations, _ = env.reset(seed=seed, options={"task": drawn})
    watch(env)
    over = np.zeros(episodes, bool)
    while not over.all():
        actions = np.asarray(act(observations), np.float32)
        after, rewards, terminated, truncated, _ = env.step(actions)
        keep(Transition(observations, actions, rewards, terminated, truncated, after))
        observations, over = after, over | terminated | truncated
        watch(env)
    return env.outcomes()
