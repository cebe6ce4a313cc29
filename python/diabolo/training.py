# SPDX-License-Identifier: MIT
"""Training of agents, by the PPO of Stable-Baselines3 (`pip install '.[learn]'`)."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.callbacks import BaseCallback

from ._core import Agent, EpisodeStart
from .envs.sb3 import DiaboloVecEnv
from .envs.spaces import AnyModels, limits_of, models_of, tasks_of
from .envs.teaching import TAUGHT, planned_starts, taught_starts

PPO_OPTIONS: dict[str, Any] = {
    "n_steps": 64,
    "batch_size": 2048,
    "n_epochs": 6,
    "learning_rate": 1e-3,
    "policy_kwargs": {"net_arch": [64, 64], "log_std_init": -0.5},
}
"""Of PPO (Schulman et al., arXiv:1707.06347), for some hundred environments."""
SURE, CAREFUL = -1.5, -2.0  # logs of the spread of actions where a training begins with an agent, with plans
LARGEST_WEIGHT = 1e3  # of a teacher
RECENT = 200  # episodes that the progress looks at


@dataclass(frozen=True)
class Settings:
    """What a training keeps to: the task or several, what is drawn, environments side by side, their period
    [s] and the steps of the simulation in it, and what an agent sees (DiaboloEnv)."""

    task: str | tuple[str, ...]
    seed: int = 0
    envs: int = 256
    period: float = 0.02
    steps: int = 20
    difficulty: str = "easy"
    models: tuple[str, ...] = ()
    """Digests of what is played with, in place of the usual model."""
    taught: float = 0.0
    """Share of the episodes that begin in the middle of a play of the player's (envs.taught_starts)."""
    limits: str = "player"
    """Of the hands: a player's, or "ur5e"."""
    teacher: str = ""
    """Digest of the agent that it begins with."""
    corrects: bool = False
    """Whether its actions are added to plans of the player's (envs.planned_starts)."""
    planned_by: tuple[str, ...] = ()
    """Digests of what plans are of, in place of what is played with."""


@dataclass(frozen=True)
class Progress:
    """How far a training is: control steps, time [s], episodes; means over recent episodes of the sum of
    rewards and of the length [s], NaN where none is over."""

    steps: int = 0
    seconds: float = 0.0
    episodes: int = 0
    worth: float = np.nan
    length: float = np.nan


class Trainer:
    """A learner on many environments. model: what is played with; of several, each episode draws one.

    planner: models that the player plans on, where others than those that are played with.
    teacher: an agent whose network it begins with, trained for this task or for another one, on another
        diabolo or string.
    checkpoint, begun: a file of save(), and how far that was, to go on from.
    Torch keeps to one thread from here on: more wait for each other beside those of the environments.
    """

    def __init__(
        self,
        settings: Settings,
        model: AnyModels = None,
        *,
        planner: AnyModels = None,
        teacher: Agent | None = None,
        checkpoint: Path | None = None,
        begun: Progress | None = None,
    ) -> None:
        if teacher is not None and (teacher.period, teacher.steps) != (settings.period, settings.steps):
            raise ValueError(
                f"teacher: acts every {teacher.period:g} s of {teacher.steps} steps; expected "
                f"{settings.period:g} s of {settings.steps}"
            )
        torch.set_num_threads(1)
        self.settings, self.begun = settings, begun or Progress()
        models = models_of(model, settings.difficulty)
        limits = limits_of(settings.limits)
        tasks = tasks_of(settings.task)
        starts: Sequence[EpisodeStart] = ()
        if settings.corrects:
            starts = planned_starts(
                tasks, planner or models, seed=settings.seed, limits=limits, period=settings.period
            )
        elif settings.taught:
            known = [task for task in tasks if task in TAUGHT]
            starts = taught_starts(known, models, seed=settings.seed, limits=limits)
        env = DiaboloVecEnv(
            settings.envs,
            tasks,
            model,
            period=settings.period,
            steps=settings.steps,
            limits=limits,
            difficulty=settings.difficulty,
            starts=starts,
            start_share=1.0 if settings.corrects else settings.taught,
        )
        if checkpoint is None:
            self.learner = _new_learner(env, settings, teacher)
        else:
            self.learner = _loaded(checkpoint, env)
            env.seed(settings.seed + self.begun.steps)  # episodes that it has not seen
        self._ended: deque[tuple[float, float]] = deque(maxlen=RECENT)
        self._episodes, self._start = self.begun.episodes, time.monotonic()

    def learn(
        self,
        *,
        seconds: float = np.inf,
        steps: int | None = None,
        report: Callable[[Progress], object] = lambda progress: None,
    ) -> None:
        """Go on for `seconds`, or for `steps` control steps. report: is told of each update."""
        self._start = time.monotonic()
        watch = _Watch(self, seconds, report)
        most = 2**53 if steps is None else steps
        self.learner.learn(most, callback=watch, reset_num_timesteps=self.learner.num_timesteps == 0)

    def progress(self) -> Progress:
        """How far it is by now."""
        passed = self.begun.seconds + time.monotonic() - self._start
        worth, length = np.mean(self._ended or [(self.begun.worth, self.begun.length)], axis=0)
        return Progress(self.learner.num_timesteps, passed, self._episodes, float(worth), float(length))

    def see(self, infos: list[dict[str, Any]]) -> None:
        """Take down the episodes that are over."""
        for episode in (info["episode"] for info in infos if "episode" in info):
            self._episodes += 1
            self._ended.append((episode["r"], episode["l"] * self.settings.period))

    def save(self, path: Path) -> None:
        """All that is needed to go on, in a file of Stable-Baselines3."""
        self.learner.save(path)

    def agent(self) -> Agent:
        """The network that acts, by itself."""
        layers = [(one.weight.detach().numpy(), one.bias.detach().numpy()) for one in _acting(self.learner)]
        own = self.settings
        return Agent(own.task, own.period, own.steps, layers, own.corrects)


def _new_learner(env: DiaboloVecEnv, settings: Settings, teacher: Agent | None) -> PPO:
    """One that knows nothing, or what its teacher knows."""
    network = dict(PPO_OPTIONS["policy_kwargs"])
    if settings.corrects or teacher:
        network["log_std_init"] = CAREFUL if settings.corrects else SURE
    if teacher:
        _check_teacher(teacher, env.observation_space.shape[0])
        sizes = [len(bias) for _, bias in teacher.layers[:-1]]
        network["net_arch"] = {"pi": sizes, "vf": network["net_arch"]}
    options = PPO_OPTIONS | {"policy_kwargs": network}
    learner = PPO("MlpPolicy", env, seed=settings.seed, device="cpu", **options)
    if teacher:
        with torch.no_grad():
            for layer, (weights, bias) in zip(_acting(learner), teacher.layers, strict=True):
                layer.weight.copy_(torch.from_numpy(weights))
                layer.bias.copy_(torch.from_numpy(bias))
    return learner


def _check_teacher(teacher: Agent, seen: int) -> None:
    """Raise ValueError about one whose network does not fit `seen` numbers, or is none of a trained agent."""
    if (known := teacher.layers[0][0].shape[1]) != seen:
        raise ValueError(f"teacher: sees {known} numbers; expected {seen}, as this training does")
    if max(np.abs(numbers).max() for layer in teacher.layers for numbers in layer) > LARGEST_WEIGHT:
        raise ValueError(f"teacher: weights beyond {LARGEST_WEIGHT:g}; expected those of a trained agent")


def _acting(learner: PPO) -> list[torch.nn.Linear]:
    """The layers of the network that acts, in their order."""
    policy = learner.policy
    hidden = [one for one in policy.mlp_extractor.policy_net if isinstance(one, torch.nn.Linear)]
    return [*hidden, policy.action_net]


def _loaded(checkpoint: Path, env: DiaboloVecEnv) -> PPO:
    """A learner as save() left it; else raises ValueError."""
    try:
        return PPO.load(checkpoint, env=env, device="cpu")
    except Exception as error:  # of zip, pickle, torch or what it asserts: whatever a broken file leads to
        raise ValueError(
            f"{checkpoint}: cannot be read ({type(error).__name__}); expected a training's checkpoint"
        ) from error


class _Watch(BaseCallback):  # type: ignore[misc]
    """Tells of each update, and ends the training when its time is over."""

    def __init__(self, trainer: Trainer, seconds: float, report: Callable[[Progress], object]) -> None:
        super().__init__()
        self._trainer, self._report = trainer, report
        self._end = time.monotonic() + seconds

    def _on_step(self) -> bool:
        self._trainer.see(self.locals["infos"])
        return time.monotonic() < self._end

    def _on_rollout_end(self) -> None:
        self._report(self._trainer.progress())
