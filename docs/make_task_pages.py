# SPDX-License-Identifier: MIT
"""Writes the pages of the tasks into docs/tasks, from what the code says of them.

    python -m docs.make_task_pages                           # the pages, from the code and the pictures there
    python -m docs.make_task_pages --pictures                # also the moving pictures
    python -m docs.make_task_pages --curve TRAINING ...      # also the curve of folders of `diabolo train`

Needs the package with its `plot` and `envs` extras.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

from diabolo.envs import HandLimits, observation_infos, task_infos
from diabolo.envs.spaces import DIFFICULTIES

from docs.task_pictures import caption_of, draw_curve, played, svg_of

PAGES = Path(__file__).with_name("tasks")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pictures", action="store_true", help="draw the moving pictures anew")
    parser.add_argument(
        "--curve", nargs="+", type=Path, metavar="TRAINING", help="of one task, several seeds"
    )
    arguments = parser.parse_args()
    if arguments.curve:
        settings = json.loads((arguments.curve[0] / "training.json").read_text(encoding="utf-8"))["settings"]
        draw_curve(PAGES / f"{settings['task']}.png", arguments.curve)
    for task in task_infos():
        if arguments.pictures:
            (PAGES / f"{task['name']}.svg").write_text(svg_of(played(task["name"])), encoding="utf-8")
        (PAGES / f"{task['name']}.md").write_text(page_of(task), encoding="utf-8")


def page_of(task: dict[str, Any]) -> str:
    """The page of a task, an entry of task_infos()."""
    name = task["name"]
    parts = [
        f"# {name}",
        "<!-- Written by `python -m docs.make_task_pages`, from the code. -->",
        f"The task is to {task['meaning']}. [Environments](../environments.md) has what all tasks share.",
        f"![{name}]({name}.svg)",
        f"*{caption_of(name)} The bar on the left is the spin.*",
        *_calls(name),
        "## Episode",
        _table(("", "what"), _episode(task)),
        "## Observations",
        _table(("numbers", "name", "unit", "what"), _observations(task)),
        "## Actions",
        _table(("numbers", "name", "unit", "what"), _actions()),
        *_curve(name),
    ]
    return "\n\n".join(parts) + "\n"


def _calls(name: str) -> list[str]:
    difficulties = " or ".join(f'"{one}"' for one in DIFFICULTIES)
    return [
        "## Try it",
        "```python\n"
        "import gymnasium\n"
        "import diabolo.envs\n\n"
        f'env = gymnasium.make("Diabolo/{name}-v0", difficulty="{DIFFICULTIES[0]}")  # {difficulties}\n'
        "observation, info = env.reset(seed=1)\n"
        "observation, reward, terminated, truncated, info = env.step(env.action_space.sample())\n"
        "```",
        f"```\ndiabolo train {name} --out {name}\ndiabolo play {name} --agent {name}/agent.json\n```",
    ]


def _episode(task: dict[str, Any]) -> list[tuple[str, ...]]:
    goals = [
        (f"goal `{one['name']}`", f"{one['low']:g} to {one['high']:g} {one['unit']}, {one['meaning']}")
        for one in task["goal"]
    ]
    low, high = task["spin"]
    return [
        *(goals or [("goal", "none")]),
        ("spin at first", f"{low:g} to {high:g} rad/s"),
        ("reward of a period", task["reward"]),
        ("end", f"after {task['seconds']:g} s; a diabolo that nobody can catch any more ends it and costs 1"),
    ]


def _observations(task: dict[str, Any]) -> list[tuple[str, ...]]:
    """Of the goal, each number by itself."""
    goal: list[dict[str, Any]] = task["goal"]
    rows, first = [], 0
    for info in observation_infos(task["name"]):
        if info["name"] == "goal":
            for number in range(info["size"]):
                unused = {"name": "-", "unit": "1", "meaning": "always 0", "seen_over": 1.0}
                one = goal[number] if number < len(goal) else unused
                unit = one["unit"] if one["seen_over"] == 1.0 else f"{one['seen_over']:g} {one['unit']}"
                rows.append((str(first + number), f"`goal`, {one['name']}", unit, one["meaning"]))
        else:
            rows.append((_span(first, info["size"]), f"`{info['name']}`", info["unit"], info["meaning"]))
        first += info["size"]
    return rows


def _actions() -> list[tuple[str, ...]]:
    unit = f"{HandLimits().acceleration:g} m/s²"
    return [
        (_span(first, 3), side, unit, f"acceleration of the {side} tip along x, y and z, from -1 to 1")
        for first, side in ((0, "left"), (3, "right"))
    ]


def _span(first: int, size: int) -> str:
    return str(first) if size == 1 else f"{first} to {first + size - 1}"


def _curve(name: str) -> list[str]:
    """The learning curve, where one was drawn."""
    if not (PAGES / f"{name}.png").exists():
        return []
    return [
        "## Learning curve",
        f"![Return over control steps]({name}.png)",
        "The mean return of the last 200 episodes. The line is the median of the trainings, the band "
        "their range.",
        "```\n"
        f"for seed in 0 1 2 3 4; do diabolo train {name} --out trainings/$seed --seed $seed; done\n"
        "python -m docs.make_task_pages --curve trainings/*\n```",
    ]


def _table(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", r"\|") for cell in line) + " |" for line in lines)


if __name__ == "__main__":
    main()
