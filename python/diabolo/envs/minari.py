# SPDX-License-Identifier: MIT
"""Plays as data sets of Minari, for learning from demonstrations (`pip install '.[minari]'`)."""

from __future__ import annotations

import copy
import shutil
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
from gymnasium.envs.registration import EnvSpec
from numpy.typing import NDArray

from .._core import Agent, __version__
from ..checks import check_library, shown
from .playing import Acting, Transition, play, tasks_played
from .spaces import ACTION, observation_space

if TYPE_CHECKING:
    from minari.data_collector import EpisodeBuffer


def record(
    name: str, agent: Acting, episodes: int = 100, *, task: str | None = None, seed: int = 0, **options: Any
) -> dict[str, NDArray[Any]]:
    """Like play(), and write the episodes as a data set of Minari; what they came to.

    name: of the data set, NAMESPACE/NAME-vVERSION, as for minari.load_dataset(). It lies where Minari keeps
    its own, in the folder MINARI_DATASETS_PATH or its default. Its recover_environment() is what was played
    in; where a model, a Camera or others that have no text were given, Minari cannot recover it.

    Raises ValueError about bad input, and where the data set is there already or cannot be written.
    """
    for library in ("minari", "h5py"):
        check_library("a data set of Minari", library, "minari")
    if isinstance(agent, Agent) and agent.corrects:
        raise ValueError(
            "agent: corrects plans, which a data set does not hold; expected one that plays by itself"
        )
    folder = _free(name)
    kept: list[Transition] = []
    options["copy"] = True
    outcomes = play(agent, episodes, task=task, seed=seed, keep=kept.append, **options)
    _write(name, folder, list(_episodes(kept, seed)), _spec(agent, task, options))
    return outcomes


def _free(name: str) -> Path:
    """Where a data set of that name will lie; else raises ValueError."""
    from minari.dataset.minari_dataset import parse_dataset_id
    from minari.storage import get_dataset_path

    try:
        parse_dataset_id(name)
        folder = Path(get_dataset_path(name))
    except (ValueError, TypeError):
        raise ValueError(f"data set {shown(name)}; expected a name such as diabolo/spin-up-v0") from None
    except OSError as error:
        raise ValueError(f"data set {name}: cannot be written ({error.strerror})") from error
    if folder.exists():
        raise ValueError(f"data set {name}: is there; expected another name or version")
    return folder


def _episodes(kept: list[Transition], seed: int) -> Iterator[EpisodeBuffer]:
    """Each episode by itself, up to its end; the first one has the seed, the next one the next."""
    from minari.data_collector import EpisodeBuffer

    whole = Transition._make(np.stack(column) for column in zip(*kept, strict=True))
    ends = (whole.terminated | whole.truncated).argmax(axis=0) + 1
    for i, end in enumerate(ends):
        own = Transition._make(column[:end, i] for column in whole)
        yield EpisodeBuffer(
            id=i,
            seed=seed + i,
            observations=np.concatenate([own.observations, own.after[-1:]]),
            actions=own.actions.clip(-1.0, 1.0),
            rewards=own.rewards,
            terminations=own.terminated,
            truncations=own.truncated,
        )


def _spec(agent: Acting, task: str | None, options: dict[str, Any]) -> EnvSpec:
    """The environment that was played in, alone."""
    own = {name: value for name, value in options.items() if name not in ("copy", "threads", "watch")}
    if isinstance(agent, Agent):
        tasks, _ = tasks_played(agent, task)
        own = {"task": tasks, "period": agent.period, "steps": agent.steps, **own}
        task = tasks if isinstance(tasks, str) else tasks[0]
    spec = copy.deepcopy(gymnasium.spec(f"Diabolo/{task}-v0"))
    spec.kwargs.update({name: value for name, value in own.items() if value is not None})
    return spec


def _write(name: str, folder: Path, episodes: list[EpisodeBuffer], spec: EnvSpec) -> None:
    """All of it, or nothing."""
    from minari import create_dataset_from_buffers

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # it wants an author, and a link to the code
            create_dataset_from_buffers(
                name,
                episodes,
                env=spec,
                observation_space=observation_space(episodes[0].observations.shape[1]),
                action_space=ACTION,
                description=f"{spec.name} of diabolo {__version__}",
                requirements=[f"diabolo=={__version__}"],
            )
    except BaseException as error:
        shutil.rmtree(folder, ignore_errors=True)
        if isinstance(error, OSError):
            raise ValueError(f"data set {name}: cannot be written ({error.strerror})") from error
        raise
