# SPDX-License-Identifier: MIT
"""Many environments, stepped by the compiled core."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, NDArray

from .._core import Arena, Camera, EpisodeStart, HandLimits, State
from ..checks import LARGEST_SEED, MOST_THREADS, list_of, shown, whole_number
from .spaces import ACTION, AnyModels, AnyTasks, camera_of, models_of, observation_space, options_of, tasks_of

Floats = NDArray[np.float32]
MOST_ENVS = 2**20

CORE_MODES = {
    AutoresetMode.NEXT_STEP: "next_step",
    AutoresetMode.SAME_STEP: "same_step",
    AutoresetMode.DISABLED: "disabled",
}


class DiaboloVectorEnv(VectorEnv[Floats, Floats, NDArray[Any]]):
    """As many diabolos as wanted, each an episode of its own; see DiaboloEnv.

    autoreset_mode: what happens to an episode that is over, as in Gymnasium. Under SAME_STEP, infos have its
        last observation as "final_obs".
    copy: False hands out the core's own memory, which the next step overwrites.
    threads: 0 takes all cores. The results do not depend on it.

    Environment i plays what a single one does that is seeded with the seed of the whole plus i.
    """

    def __init__(
        self,
        num_envs: int = 1,
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
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        copy: bool = True,
        threads: int = 0,
        render_mode: str | None = None,
    ) -> None:
        if render_mode is not None:
            raise ValueError(f"render_mode: {render_mode!r}; expected None")
        self.num_envs = whole_number("num_envs", num_envs, 1, MOST_ENVS)
        try:
            mode = AutoresetMode(autoreset_mode)
        except ValueError:
            names = ", ".join(repr(one.value) for one in AutoresetMode)
            raise ValueError(f"autoreset_mode: {shown(autoreset_mode)}; expected one of {names}") from None
        self.metadata = {"render_modes": [], "autoreset_mode": mode}
        self.single_action_space = ACTION
        self.action_space = batch_space(ACTION, self.num_envs)
        models = models_of(model, difficulty)
        self._models, self._mode, self._copy = len(models), mode, copy
        whole_number("threads", threads, 0, MOST_THREADS)
        self._tasks = tasks_of(task)
        arena = Arena(
            self._tasks,
            models,
            self.num_envs,
            period,
            steps,
            CORE_MODES[mode],
            threads,
            limits or HandLimits(),
            camera_of(difficulty),
            list_of("starts", starts, (EpisodeStart,)),
            start_share,
            free_axis,
        )
        self.single_observation_space = observation_space(arena.observations.shape[1])
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self._arena, self._begun = arena, np.zeros(self.num_envs, bool)
        self._observations, self._final = arena.observations, arena.final_observations
        self._rewards = arena.rewards
        self._terminated, self._truncated = arena.terminated.view(bool), arena.truncated.view(bool)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Floats, dict[str, Any]]:
        """Begin episodes: of all, or of those in options["reset_mask"], an array of bool."""
        given = {**options} if isinstance(options, Mapping) else options
        mask = self._mask(given.pop("reset_mask", None) if isinstance(given, dict) else None)
        checked = options_of(given, self._models, self._tasks)
        seeds = self._seeds(seed)
        for i in np.flatnonzero(mask):
            if (own := seeds[i]) is not None:
                self._arena.seed(i, own)
            self._arena.reset(i, **checked)
        self._begun |= mask
        return self._given(self._observations), {}

    def step(
        self, actions: ArrayLike
    ) -> tuple[Floats, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Play a period in all. actions: shape (num_envs, 6)."""
        self._expect_begun("step")
        self._arena.step(actions)
        infos: dict[str, Any] = {}
        if self._mode is AutoresetMode.SAME_STEP:
            over = self._terminated | self._truncated
            if over.any():
                infos = {
                    "final_obs": np.where(over[:, None], self._final, np.float32(0.0)),
                    "_final_obs": over,
                }
        return (
            self._given(self._observations),
            self._given(self._rewards),
            self._given(self._terminated),
            self._given(self._truncated),
            infos,
        )

    def pose(self, i: int) -> tuple[State, NDArray[np.float64], NDArray[np.float64]]:
        """Of environment i: see DiaboloEnv.pose."""
        self._expect_begun("pose")
        return self._arena.pose(whole_number("i", i, 0, self.num_envs - 1))

    def outcomes(self) -> dict[str, NDArray[Any]]:
        """What the episodes have come to, an entry for each: see DiaboloEnv.outcome."""
        self._expect_begun("outcomes")
        each = [self._arena.outcome(i) for i in range(self.num_envs)]
        return {name: np.array([one[name] for one in each]) for name in each[0]}

    def _expect_begun(self, what: str) -> None:
        if not self._begun.all():
            first = int(np.argmin(self._begun))
            raise gymnasium.error.ResetNeeded(f"{what}: called before environment {first} was first reset")

    def _given(self, numbers: NDArray[Any]) -> NDArray[Any]:
        return numbers.copy() if self._copy else numbers

    def _mask(self, given: Any) -> NDArray[np.bool_]:
        if given is None:
            return np.ones(self.num_envs, bool)
        mask = np.asarray(given)
        if mask.shape != (self.num_envs,) or mask.dtype != np.bool_:
            raise ValueError(
                f"options, reset_mask: {shown(given)}; expected bools of the shape ({self.num_envs},)"
            )
        return mask

    def _seeds(self, given: int | Sequence[int | None] | None) -> list[int | None]:
        if given is None:
            if self._begun.all():
                return [None] * self.num_envs
            given = int(np.random.default_rng().integers(2**62))
        if isinstance(given, Sequence | np.ndarray):
            seeds = list(given)
            if len(seeds) != self.num_envs:
                raise ValueError(f"seed: {len(seeds)} seeds; expected {self.num_envs}")
        else:
            first = whole_number("seed", given, 0, LARGEST_SEED)
            seeds = list(range(first, first + self.num_envs))
        return [None if one is None else whole_number("seed", one, 0, 2**64 - 1) for one in seeds]
