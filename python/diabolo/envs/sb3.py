# SPDX-License-Identifier: MIT
"""Many environments as Stable-Baselines3 wants them (`pip install '.[learn]'`)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray
from stable_baselines3.common.vec_env import VecEnv

from .spaces import ACTION, AnyModels, AnyTasks
from .vector import DiaboloVectorEnv


class DiaboloVecEnv(VecEnv):  # type: ignore[misc]
    """For `PPO("MlpPolicy", DiaboloVecEnv(256, "SpinUp"))`. Arguments as of DiaboloVectorEnv.

    An episode that is over begins anew in the same step; its last observation is the info
    "terminal_observation", its return, length and whether it was cut off are told as usual.
    """

    def __init__(
        self, num_envs: int = 1, task: AnyTasks = "Hold", model: AnyModels = None, **options: Any
    ) -> None:
        if taken := {"copy", "autoreset_mode"} & options.keys():
            raise ValueError(f"{min(taken)}: given; expected none, Stable-Baselines3 wants its own")
        self._many = DiaboloVectorEnv(
            num_envs, task, model, autoreset_mode=AutoresetMode.SAME_STEP, **options
        )
        self._actions: NDArray[np.float32] | None = None
        self._return, self._length = np.zeros(num_envs), np.zeros(num_envs, int)
        self.render_mode = None
        super().__init__(num_envs, self._many.single_observation_space, ACTION)

    def reset(self) -> NDArray[np.float32]:
        """Begin episodes of all, with the seeds of seed() where it was called."""
        seeds = self._seeds if any(one is not None for one in self._seeds) else None
        self._reset_seeds()
        self._return[:], self._length[:] = 0.0, 0
        return self._many.reset(seed=seeds)[0]

    def step_async(self, actions: NDArray[np.float32]) -> None:
        """Keep them for step_wait."""
        self._actions = actions

    def step_wait(
        self,
    ) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.bool_], list[dict[str, Any]]]:
        """Play a period in all."""
        if self._actions is None:
            raise ValueError("step_wait: called before step_async")
        observations, rewards, terminated, truncated, seen = self._many.step(self._actions)
        self._return += rewards
        self._length += 1
        over = terminated | truncated
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for i in np.flatnonzero(over):
            infos[i] = {
                "terminal_observation": seen["final_obs"][i],
                "TimeLimit.truncated": bool(truncated[i]),
                "episode": {"r": float(self._return[i]), "l": int(self._length[i])},
            }
        self._return[over], self._length[over] = 0.0, 0
        return observations, rewards.astype(np.float32), over, infos

    def close(self) -> None:
        """Nothing to do."""

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """The same of each."""
        return [getattr(self._many, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Refused: they are one object."""
        raise ValueError(f"{attr_name}: cannot be set of one environment; make a DiaboloVecEnv with it")

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:
        """Refused: they are one object."""
        raise ValueError(f"{method_name}: cannot be called of one environment")

    def env_is_wrapped(self, wrapper_class: type, indices: Any = None) -> list[bool]:
        """None is."""
        return [False for _ in self._get_indices(indices)]

    def get_images(self) -> Sequence[NDArray[np.uint8] | None]:
        """No pictures of many."""
        return [None] * self.num_envs
