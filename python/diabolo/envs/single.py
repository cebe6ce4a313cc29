# SPDX-License-Identifier: MIT
"""One environment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import Arena, Camera, EpisodeStart, HandLimits, State
from ..checks import LARGEST_SEED, list_of, numbers, shown, whole_number
from .picture import picture
from .spaces import ACTION, AnyModels, AnyTasks, camera_of, models_of, observation_space, options_of, tasks_of


class DiaboloEnv(gymnasium.Env[NDArray[np.float32], NDArray[np.float32]]):
    """A diabolo on the string between two tips, whose accelerations are the action.

    task: its name, as in diabolo.envs.TASKS; of several, each episode draws one, and it is seen which.
    model: what it is played with; of several, each episode draws one.
    period: between actions [s]; steps: of the simulation in a period.
    limits: of the tips.
    difficulty: "easy", the exact state is seen; "real", what a Camera() sees; "sealed", that, of models
        that a diagnosis leaves open; or a Camera of one's own.
    starts: what a share of the episodes begins with, start_share of them. With plans (planned_starts) all do,
        and actions are added to a plan's motion.
    free_axis: each episode draws a rigid axle that the string turns, which "Level" does anyhow.
    render_mode: "rgb_array" lets render() draw (`pip install '.[plot]'`).

    Raises ValueError about bad input, also for actions that are not numbers.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 100}  # noqa: RUF012 (an instance's, by Gymnasium's declaration)
    action_space = ACTION

    def __init__(
        self,
        task: AnyTasks = "Hold",
        model: AnyModels = None,
        *,
        period: float = 0.01,
        steps: int = 10,
        limits: HandLimits | None = None,
        difficulty: str | Camera = "easy",
        starts: Sequence[EpisodeStart] = (),
        start_share: float = 0.0,
        free_axis: bool = False,
        render_mode: str | None = None,
    ) -> None:
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode: {shown(render_mode)}; expected 'rgb_array' or None")
        models = models_of(model, difficulty)
        self.render_mode, self._tasks, self._limits = render_mode, tasks_of(task), limits or HandLimits()
        self._lengths = [one.parameters.string_length for one in models]
        self._arena = Arena(
            self._tasks,
            models,
            period=period,
            steps=steps,
            autoreset="disabled",
            limits=self._limits,
            camera=camera_of(difficulty),
            starts=list_of("starts", starts, (EpisodeStart,)),
            start_share=start_share,
            free_axis=free_axis,
        )
        self.observation_space = observation_space(self._arena.observations.shape[1])
        self.metadata = {**self.metadata, "render_fps": round(1.0 / period)}
        arena = self._arena
        self._observation, self._reward = arena.observations[0], arena.rewards
        self._terminated, self._truncated = arena.terminated.view(bool), arena.truncated.view(bool)
        self._action = np.zeros((1, 6), np.float32)
        self._begun = False

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Begin an episode. options: a state, a goal, the number of the model or a task in place of what is
        drawn; of several tasks, a goal needs one."""
        given = options_of(options, len(self._lengths), self._tasks)
        if seed is not None:
            seed = whole_number("seed", seed, 0, LARGEST_SEED)
        super().reset(seed=seed)
        if seed is not None or not self._begun:
            self._arena.seed(0, int(self.np_random_seed if seed is None else seed) % 2**64)
        self._arena.reset(0, **given)
        self._begun = True
        return self._observation.copy(), {}

    def step(self, action: ArrayLike) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Play a period."""
        self._expect_begun("step")
        given: NDArray[Any]
        if type(action) is np.ndarray and action.dtype == np.float32:
            given = action  # as it is, by far the most often
        else:
            given = numbers("action", action)
        if given.shape != (6,):
            raise ValueError(f"action: {shown(given)}; expected six numbers from -1 to 1")
        self._action[0] = given
        self._arena.step(self._action)
        return (
            self._observation.copy(),
            self._reward.item(),
            self._terminated.item(),
            self._truncated.item(),
            {},
        )

    def pose(self) -> tuple[State, NDArray[np.float64], NDArray[np.float64]]:
        """State of the diabolo, left tip and right tip [m]: exactly, whatever an agent sees."""
        self._expect_begun("pose")
        return self._arena.pose(0)

    def outcome(self) -> dict[str, Any]:
        """What the episode has come to: worth (the sum of its rewards), seconds, over, dropped, first_spin
        and spin [rad/s], flights that ended in a catch, apex [m] of the last, level (how long the axle of
        "Level" has been within 5 degrees by now [s]), goal, model, task."""
        self._expect_begun("outcome")
        return dict(self._arena.outcome(0))

    def _expect_begun(self, what: str) -> None:
        if not self._begun:
            raise gymnasium.error.ResetNeeded(f"{what}: called before the first reset")

    def render(self) -> NDArray[np.uint8] | None:
        """What the player sees, RGB, shape (480, 480, 3); None without a render_mode."""
        if self.render_mode is None:
            return None
        state, left, right = self.pose()
        task, length = self.outcome()["task"], self._lengths[self._arena.model_of(0)]
        return picture(task, state, (left, right), self._limits, length)
