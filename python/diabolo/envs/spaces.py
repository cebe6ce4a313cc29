# SPDX-License-Identifier: MIT
"""What the environments have in common: spaces, models, and options of a reset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Any, TypeAlias

import numpy as np
from gymnasium.spaces import Box

from .._core import (
    Camera,
    HandLimits,
    Model,
    Parameters,
    SeedGrid,
    State,
    StickArm,
    StickMap,
    StringFriction,
    arm_hand_limits,
)
from ..checks import instance_of, list_of, numbers, one_of, shown, whole_number

AnyModels: TypeAlias = Model | Parameters | Sequence[Model | Parameters] | None
AnyTasks: TypeAlias = str | Sequence[str]
"""The name of a task, or of several: each episode draws one, each of them for about as long."""

ACTION = Box(-1.0, 1.0, (6,), np.float32)
"""Shares of the tips' largest accelerations along x, y and z: left, then right."""

OPTIONS = ("state", "goal", "model", "task")
DIFFICULTIES = ("easy", "real", "sealed")


def observation_space(size: int) -> Box[np.float32]:
    """So many numbers that an agent sees: see diabolo.envs.observation_infos()."""
    return Box(-1e3, 1e3, (size,), np.float32)


def tasks_of(given: AnyTasks) -> list[str]:
    """Their names; raises ValueError where one is none."""
    return [given] if isinstance(given, str) else list_of("task", given, (str,), least=1)


def usual_model() -> Model:
    """A string that rubs on the axle, so that the spin can be driven."""
    return Model(Parameters(), name="rubbing", string_friction=StringFriction(coefficient=0.3))


@cache
def sealed_models() -> list[Model]:
    """What half a minute of a diabolo's play leaves open: models drawn by its diagnosis. The diabolo is that
    of the project's plant, a simulator that shares no code with this one."""
    folder = files("diabolo") / "envs" / "sealed"
    names = sorted(path.name for path in folder.iterdir() if path.name.endswith(".json"))
    return [Model.load(str(folder / name)) for name in names]


LIMITS = ("player", "ur5e")


def limits_of(name: str) -> HandLimits:
    """Hands by a name of LIMITS: a player's, or those of the paper's two UR5e."""
    if name not in LIMITS:
        raise ValueError(f"limits: {shown(name)}; expected {' or '.join(LIMITS)}")
    return ur5e_limits() if name == "ur5e" else HandLimits()


@cache
def ur5e_limits() -> HandLimits:
    """Speed [m/s] and acceleration [m/s^2] of tips that two UR5e, where the paper has them, can move in a box
    in front of them without a joint exceeding its own (robot.arm_hand_limits)."""
    arms = [StickArm(side) for side in ("left", "right")]
    left, right = (StickMap(arm, SeedGrid.build(arm)) for arm in arms)
    return arm_hand_limits(left, right)


def models_of(given: AnyModels, difficulty: str | Camera = "easy") -> list[Model]:
    """Those that episodes are played with; each draws one."""
    if difficulty == "sealed":
        if given is not None:
            raise ValueError("model: given, beside the difficulty 'sealed', which has its own; expected None")
        return list(sealed_models())
    if given is None:
        return [usual_model()]
    models = list_of("model", given, (Model, Parameters), least=1)
    return [one if isinstance(one, Model) else Model(one) for one in models]


def camera_of(difficulty: str | Camera) -> Camera | None:
    """What an agent sees by: nothing for "easy", the exact state; a usual Camera for "real" and "sealed"; or
    one's own."""
    if isinstance(difficulty, Camera):
        return difficulty
    if difficulty not in DIFFICULTIES:
        names = ", ".join(repr(one) for one in DIFFICULTIES)
        raise ValueError(f"difficulty: {shown(difficulty)}; expected {names} or a Camera")
    return None if difficulty == "easy" else Camera()


def options_of(given: Mapping[str, Any] | None, models: int, tasks: Sequence[str]) -> dict[str, Any]:
    """The options of a reset, checked: state (a State), goal (numbers), model (which one, a number), task (a
    name, which becomes its number)."""
    if given is not None and not isinstance(given, Mapping):
        raise ValueError(f"options: {shown(given)}; expected a dict of {', '.join(OPTIONS)}")
    options = dict(given or {})
    if unknown := sorted(map(str, options.keys() - {*OPTIONS})):
        raise ValueError(f"options: found {shown(unknown[0])}; expected {', '.join(OPTIONS)}")
    if options.get("state") is not None:
        instance_of("options, state", options["state"], State)
    if options.get("model") is not None:
        options["model"] = whole_number("options, model", options["model"], 0, models - 1)
    if options.get("task") is not None:
        options["task"] = tasks.index(one_of("options, task", options["task"], tuple(tasks)))
    if options.get("goal") is not None:
        goal = numbers("options, goal", options["goal"])
        if goal.ndim > 1 or not np.isfinite(goal).all():
            raise ValueError(f"options, goal: {shown(options['goal'])}; expected finite numbers")
        options["goal"] = np.atleast_1d(goal).tolist()
    return options
