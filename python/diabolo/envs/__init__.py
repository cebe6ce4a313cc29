# SPDX-License-Identifier: MIT
"""Environments for Gymnasium: `gymnasium.make("Diabolo/Hold-v0")` once this is imported.

import gymnasium, diabolo.envs

env = gymnasium.make("Diabolo/SpinUp-v0")
many = gymnasium.make_vec("Diabolo/SpinUp-v0", num_envs=1024, vectorization_mode="vector_entry_point")

For Stable-Baselines3: diabolo.envs.sb3.DiaboloVecEnv. For Minari: diabolo.envs.minari.record.
"""

from __future__ import annotations

from gymnasium.envs.registration import register

from .._core import (
    Agent,
    Camera,
    EpisodeStart,
    HandLimits,
    HandPlan,
    LiveAgent,
    observation_infos,
    task_infos,
)
from .playing import Transition, play, shipped_agent
from .single import DiaboloEnv
from .spaces import ur5e_limits
from .teaching import TAUGHT, hand_plan, planned_starts, taught_starts
from .vector import DiaboloVectorEnv

__all__ = [
    "TASKS",
    "TAUGHT",
    "Agent",
    "Camera",
    "DiaboloEnv",
    "DiaboloVectorEnv",
    "EpisodeStart",
    "HandLimits",
    "HandPlan",
    "LiveAgent",
    "Transition",
    "hand_plan",
    "observation_infos",
    "planned_starts",
    "play",
    "shipped_agent",
    "task_infos",
    "taught_starts",
    "ur5e_limits",
]

TASKS: tuple[str, ...] = tuple(info["name"] for info in task_infos())
"""What can be played, the easy ones first."""

for _task in TASKS:
    register(
        f"Diabolo/{_task}-v0",
        entry_point="diabolo.envs.single:DiaboloEnv",
        vector_entry_point="diabolo.envs.vector:DiaboloVectorEnv",
        kwargs={"task": _task},
    )
