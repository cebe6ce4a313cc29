# SPDX-License-Identifier: MIT
"""`diabolo play`: what an agent does."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .. import files
from ..checks import LARGEST_SEED, check_library
from .arguments import add_command, add_playing, check_task, output_name, read_model
from .tables import format_table

if TYPE_CHECKING:
    from .._core import Agent, Recording, State

    Pose = tuple[State, NDArray[np.float64], NDArray[np.float64]]

SCHEMA = "diabolo.play/1"
COLUMNS = {  # of the table: name, and how a value is shown
    "worth": ("return", "{:.2f}"),
    "seconds": ("seconds", "{:.1f}"),
    "first_spin": ("spin at first [rad/s]", "{:.0f}"),
    "spin": ("spin at the end [rad/s]", "{:.0f}"),
    "flights": ("flights caught", "{:.0f}"),
    "apex": ("apex of the last flight [m]", "{:.2f}"),
    "level": ("level at the end, for [s]", "{:.1f}"),
}


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "play",
        run=run,
        summary="let an agent play, and say how well it does",
        text="Let an agent play episodes of a task side by side, each to its end, and tell what came of it.\n"
        "One that corrects the player's plans gets plans, which are found first.\n"
        "Needs gymnasium (pip install '.[envs]'), and nothing of what trained the agent.",
        example="  diabolo play SpinUp\n"
        "  diabolo play SpinUp --agent spin_up/agent.json --model diagnosis/model.json --difficulty real\n"
        "  diabolo play SpinUp --html spin_up.html\n"
        "  diabolo play SpinUp --episodes 1000 --minari diabolo/spin-up-v0",
    )
    parser.add_argument("task", metavar="TASK", help="one of docs/environments.md: Hold, Swing, SpinUp, ...")
    parser.add_argument(
        "--agent", metavar="FILE", help="what `diabolo train` wrote; default: the agent of the package"
    )
    parser.add_argument("--episodes", type=int, default=100, metavar="N", help="default: 100")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="of what is drawn; default: 0")
    add_playing(parser, "play")
    parser.add_argument("--json", metavar="FILE", type=str, help="write every episode; - for standard output")
    parser.add_argument(
        "--out", metavar="FILE.csv", type=output_name, help="the first episode, a tidy recording"
    )
    parser.add_argument("--html", metavar="FILE.html", type=output_name, help="the same as a page that moves")
    parser.add_argument(
        "--minari",
        metavar="NAME",
        type=output_name,
        help="write every episode as a data set of Minari of that name, such as diabolo/spin-up-v0, into "
        "MINARI_DATASETS_PATH or its default (pip install '.[minari]')",
    )


def run(arguments: argparse.Namespace) -> None:
    check_library("diabolo play", "gymnasium", "envs")
    from .. import envs
    from ..envs.spaces import limits_of
    from ..view import told_before, view_html

    check_task(arguments.task, envs.TASKS)
    for name, value, low, high in (
        ("--episodes", arguments.episodes, 1, 2**20),
        ("--seed", arguments.seed, 0, LARGEST_SEED - 2**20),
    ):
        if not low <= value <= high:
            raise ValueError(f"{name} {value}; expected {low} to {high}")
    if arguments.agent == "":
        raise ValueError("--agent '': expected the name of a file")
    if arguments.out and not arguments.out.endswith(".csv"):
        raise ValueError(f"{arguments.out}: expected a name that ends in .csv")
    outputs = [arguments.out, arguments.html, arguments.json]
    if arguments.out:
        outputs.append(Path(arguments.out).with_suffix(".json"))
    read = [one for one in (arguments.agent, *(arguments.model or [])) if one and Path(one).exists()]
    files.check_outputs(outputs, read)
    agent = envs.Agent.load(arguments.agent) if arguments.agent else envs.shipped_agent(arguments.task)
    options = {
        "task": arguments.task,
        "model": [read_model(name) for name in arguments.model] if arguments.model else None,
        "difficulty": arguments.difficulty,
        "limits": limits_of(arguments.limits) if arguments.limits != "player" else None,
    }
    poses: list[Pose] = []
    played = player_of(arguments.minari)
    outcomes = played(
        agent, arguments.episodes, seed=arguments.seed, watch=lambda env: poses.append(env.pose(0)), **options
    )
    if arguments.out or arguments.html:
        recording = recording_of(agent, poses, outcomes, options)
        if arguments.out:
            recording.save(arguments.out)
        if arguments.html:
            with told_before():  # the spin, which so few samples a second do not tell
                page = view_html(recording)
            files.write_texts({Path(arguments.html): page})
    found = {
        "schema": SCHEMA,
        "task": arguments.task,
        "agent": arguments.agent,
        "models": arguments.model,
        "difficulty": arguments.difficulty,
        "limits": arguments.limits,
        "seed": arguments.seed,
        "episodes": {name: values.tolist() for name, values in outcomes.items()},
    }
    files.write_json(arguments.json, found)
    if arguments.json != files.STDOUT:
        print(text_of(arguments.task, outcomes))


def player_of(name: str | None) -> Callable[..., dict[str, NDArray[Any]]]:
    """What plays, and also records where a data set is named."""
    if name is None:
        from ..envs import play

        return play
    from ..envs.minari import record

    return partial(record, name)


def text_of(task: str, outcomes: dict[str, NDArray[Any]]) -> str:
    """Quantiles over the episodes, and how many were dropped."""
    rows = [
        [title, *(form.format(value) for value in np.quantile(outcomes[name], (0.5, 0.05, 0.95)))]
        for name, (title, form) in COLUMNS.items()
    ]
    table = format_table(["over the episodes", "median", "5 %", "95 %"], rows)
    dropped = outcomes["dropped"]
    return f"{task}: {np.count_nonzero(dropped)} of {len(dropped)} episodes ended with a drop\n\n{table}"


def recording_of(
    agent: Agent, poses: list[Pose], outcomes: dict[str, NDArray[Any]], options: dict[str, Any]
) -> Recording:
    """The first episode, a sample for each period."""
    from .._core import played_properties, played_recording
    from ..envs.spaces import models_of

    poses = poses[: round(outcomes["seconds"][0] / agent.period) + 1]
    states = np.array([[*state.position, *state.velocity, state.spin] for state, _, _ in poses])
    lefts, rights = (np.array([pose[side] for pose in poses]) for side in (1, 2))
    p = models_of(options["model"], options["difficulty"])[outcomes["model"][0]].parameters
    time = agent.period * np.arange(len(poses))
    return played_recording(
        options["task"],
        time,
        lefts,
        rights,
        states,
        1.0 / agent.period,
        played_properties(p),
        p.string_length,
        np.array([state.axis for state, _, _ in poses]),
    )
