# SPDX-License-Identifier: MIT
"""One environment."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import Arena, HandLimits
from .spaces import ACTION, OBSERVATION, AnyModels, models_of, options_of


class DiaboloEnv(gymnasium.Env[NDArray[np.float32], NDArray[np.float32]]):
    """A diabolo on the string between two tips, whose accelerations are the action.

    task: its name, as in diabolo.envs.TASKS.
    model: what it is played with; of several, each episode draws one.
    period: between actions [s]; steps: of the simulation in a period.
    limits: of the tips.

    Raises ValueError about bad input, also for actions that are not numbers.
    """

    metadata = {"render_modes": []}  # noqa: RUF012 (an instance's, by Gymnasium's declaration)
    action_space = ACTION
    observation_space = OBSERVATION

    def __init__(
        self,
        task: str = "Hold",
        model: AnyModels = None,
        *,
        period: float = 0.01,
        steps: int = 10,
        limits: HandLimits | None = None,
        render_mode: str | None = None,
    ) -> None:
        if render_mode is not None:
            raise ValueError(f"render_mode: {render_mode!r}; expected None")
        models = models_of(model)
        self._models = len(models)
        self._arena = Arena(task, models, 1, period, steps, "disabled", 1, limits or HandLimits())
        arena = self._arena
        self._observation, self._reward = arena.observations[0], arena.rewards
        self._terminated, self._truncated = arena.terminated, arena.truncated
        self._action = np.zeros((1, 6), np.float32)
        self._begun = False

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Begin an episode. options: a state, a goal or the number of the model in place of what is drawn."""
        given = options_of(options, self._models)
        super().reset(seed=seed)
        if seed is not None or not self._begun:
            self._arena.seed(0, int(self.np_random_seed if seed is None else seed) % 2**64)
        self._arena.reset(0, **given)
        self._begun = True
        return self._observation.copy(), {}

    def step(self, action: ArrayLike) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Play a period."""
        if not self._begun:
            raise gymnasium.error.ResetNeeded("step: called before the first reset")
        self._action[0] = action
        self._arena.step(self._action)
        return (
            self._observation.copy(),
            float(self._reward[0]),
            bool(self._terminated[0]),
            bool(self._truncated[0]),
            {},
        )
