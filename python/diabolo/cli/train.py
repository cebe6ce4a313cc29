# SPDX-License-Identifier: MIT
"""`diabolo train`: an agent that learns to play."""

from __future__ import annotations

import argparse
import csv
import json
import time
from dataclasses import asdict, fields
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import files
from ..checks import check_library, shown
from .arguments import add_command, add_playing, check_task, output_name, progress_steps, read_model

if TYPE_CHECKING:
    from .._core import Agent, Model
    from ..training import Progress, Settings, Trainer

SCHEMA = "diabolo.training/1"
CHECKPOINT, AGENT, CURVE, SETTINGS = "checkpoint.zip", "agent.json", "progress.csv", "training.json"
KEEP_EVERY = 10.0  # [s]
USUALLY_TAUGHT = 0.7
LARGEST_SEED = 2**32 - 1  # that Stable-Baselines3 takes


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "train",
        run=run,
        summary="train an agent that plays",
        text="Train an agent on a task by PPO (pip install '.[learn]').\n\n"
        "What a reward alone does not lead to, such as a throw, the player teaches: most episodes\n"
        "then begin in the middle of plays that it plans first, in some ten seconds.\n\n"
        "With --corrects the tips move as the player plans it, and the agent adds to that. Of several\n"
        "tasks each episode draws one, and the agent sees which.\n\n"
        "With --teacher it begins with what an agent knows: of another string or diabolo, or of another\n"
        "task. That takes fewer steps than from nothing.\n\n"
        "DIR gets agent.json, which `diabolo play` runs without the training's libraries; progress.csv;\n"
        "and what --resume goes on from. Its files are whole at any time: they are\n"
        "written every ten seconds, between updates, and Ctrl-C loses what came after.",
        example="  diabolo train SpinUp --out spin_up --seconds 120\n"
        "  diabolo train SpinUp --out spin_up --seconds 120 --resume\n"
        "  diabolo train SpinUp --out longer --model longer.json --teacher spin_up/agent.json\n"
        "  diabolo train ThrowAndCatch --corrects --out correction --seconds 300\n"
        "  diabolo train SpinUp ThrowAndCatch --out both --seconds 600\n"
        "  diabolo play SpinUp --agent spin_up/agent.json",
    )
    parser.add_argument(
        "task", metavar="TASK", nargs="+", help="of docs/environments.md: Hold, Swing, SpinUp, ..."
    )
    parser.add_argument("--out", metavar="DIR", required=True, type=output_name, help="folder to write")
    parser.add_argument("--seconds", type=float, metavar="X", help="how long to train; default: 120")
    parser.add_argument("--steps", type=int, metavar="N", help="control steps to train, instead of a time")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="of what is drawn; default: 0")
    parser.add_argument("--envs", type=int, default=256, metavar="N", help="side by side; default: 256")
    parser.add_argument(
        "--taught",
        type=float,
        metavar="SHARE",
        help="of the episodes that begin so; default: 0.7 in tasks that the player knows "
        "(docs/agents.md), else 0",
    )
    parser.add_argument(
        "--corrects",
        action="store_true",
        help="the player's plans are played, and the agent's actions added to them",
    )
    parser.add_argument(
        "--planned-by",
        metavar="NAME",
        nargs="+",
        help="with --corrects: models that the player plans on; default: those that are played with",
    )
    parser.add_argument("--teacher", metavar="FILE", help="an agent's file, whose network it begins with")
    add_playing(parser, "train")
    parser.add_argument("--resume", action="store_true", help="go on with the training in DIR")


def run(arguments: argparse.Namespace) -> None:
    for library in ("gymnasium", "stable_baselines3"):
        check_library("diabolo train", library, "learn")
    from ..envs import TASKS, TAUGHT, Agent
    from ..training import Settings, Trainer

    for task in arguments.task:
        check_task(task, TASKS)
    if len(set(arguments.task)) < len(arguments.task):
        raise ValueError(f"TASK {' '.join(arguments.task)}; expected each once")
    if arguments.teacher == "":
        raise ValueError("--teacher '': expected the name of a file")
    seconds = _check_numbers(arguments)
    models = [read_model(name) for name in arguments.model] if arguments.model else None
    planner = [read_model(name) for name in arguments.planned_by] if arguments.planned_by else None
    teacher = Agent.load(arguments.teacher) if arguments.teacher is not None else None
    settings = Settings(
        tuple(arguments.task) if len(arguments.task) > 1 else arguments.task[0],
        arguments.seed,
        arguments.envs,
        difficulty=arguments.difficulty,
        taught=_taught(arguments, TAUGHT),
        models=tuple(_digest(one) for one in models or ()),
        limits=arguments.limits,
        teacher=_digest(teacher) if teacher else "",
        corrects=arguments.corrects,
        planned_by=tuple(_digest(one) for one in planner or ()),
    )
    folder = Path(arguments.out)
    begun = _begun(folder, settings, arguments.resume)
    named = (arguments.teacher, *(arguments.model or []), *(arguments.planned_by or []))
    read = [one for one in named if one and Path(one).exists()]
    files.check_outputs([folder / name for name in (CHECKPOINT, AGENT, CURVE, SETTINGS)], read, folder)
    checkpoint = folder / CHECKPOINT if begun else None
    trainer = Trainer(settings, models, planner=planner, teacher=teacher, checkpoint=checkpoint, begun=begun)
    with files.made_folder(folder), progress_steps() as show:
        keeper = _Keeper(folder, trainer, show, seconds, arguments.steps)
        keeper.keep()  # the folder is taken from here on
        trainer.learn(seconds=seconds, steps=arguments.steps, report=keeper.report)
        keeper.keep()
    print(f"{folder / AGENT}: {_sentence(trainer.progress())}")


def _digest(what: Model | Agent) -> str:
    return sha256(what.to_json().encode()).hexdigest()[:12]


def _check_numbers(arguments: argparse.Namespace) -> float:
    """Raise ValueError about numbers out of their range; how long to train [s]."""
    if arguments.seconds is not None and arguments.steps is not None:
        raise ValueError("--seconds, --steps: both are given; expected one of them")
    for name, value, low, high in (
        ("--seconds", arguments.seconds, 1e-3, 1e7),
        ("--steps", arguments.steps, 1, 2**53),
        ("--envs", arguments.envs, 32, 2**16),
        ("--seed", arguments.seed, 0, LARGEST_SEED),
    ):
        if value is not None and not low <= value <= high:
            raise ValueError(f"{name} {value}; expected {low} to {high}")
    if arguments.steps is not None:
        return float("inf")
    return 120.0 if arguments.seconds is None else float(arguments.seconds)


def _taught(arguments: argparse.Namespace, known: tuple[str, ...]) -> float:
    """The share of episodes that begin in the middle of a play; raises ValueError about a wrong one, and
    about tasks that the player does not know."""
    wanted: float | None = arguments.taught
    tasks = " ".join(arguments.task)
    if wanted is not None and not 0.0 <= wanted <= 1.0:
        raise ValueError(f"--taught {wanted}; expected 0 to 1")
    if arguments.planned_by and not arguments.corrects:
        raise ValueError("--planned-by: given without --corrects; expected both")
    if arguments.corrects:
        if wanted is not None:
            raise ValueError(
                f"--taught {wanted}: beside --corrects, whose episodes begin with the player's plans"
            )
        if unknown := [task for task in arguments.task if task not in known]:
            raise ValueError(
                f"--corrects: the player does not know {unknown[0]}; expected {', '.join(known)}"
            )
        return 0.0
    if not any(task in known for task in arguments.task):
        if wanted:
            raise ValueError(
                f"--taught {wanted}: the player does not teach {tasks}; expected {', '.join(known)}"
            )
        return 0.0
    return USUALLY_TAUGHT if wanted is None else wanted


def _begun(folder: Path, settings: Settings, resume: bool) -> Progress | None:
    """How far the training in a folder is; None where a new one begins."""
    from ..training import Progress, Settings

    path = folder / SETTINGS
    if not resume:
        for name in (SETTINGS, CHECKPOINT, AGENT):
            if (folder / name).exists():
                raise ValueError(f"{folder / name}: is there; expected another folder, or --resume")
        return None
    if not path.exists() or not (folder / CHECKPOINT).exists():
        raise ValueError(f"{folder}: expected {SETTINGS} and {CHECKPOINT} of a training to resume")
    try:
        kept = json.loads(path.read_text(encoding="utf-8"))
        if kept["schema"] != SCHEMA:
            raise ValueError(f"schema {shown(kept['schema'])}; expected {SCHEMA}")
        progress = kept["progress"]
        before = _as_kept(Settings("")) | kept["settings"]  # of an older one, what it did not have
        for name, value in _as_kept(settings).items():
            if before[name] != value:
                both = f"{shown(before[name])} at first, {shown(value)} now"
                raise ValueError(f"{name} {both}; expected the same")
        for one in fields(Progress):
            known = progress[one.name]
            whole = isinstance(known, int) and known >= 0
            if not (whole if one.type == "int" else known is None or isinstance(known, int | float)):
                raise ValueError(f"progress, {one.name} {shown(known)}; expected a number")
        found: dict[str, Any] = {one.name: progress[one.name] for one in fields(Progress)}
        found = {name: float("nan") if value is None else value for name, value in found.items()}
        return Progress(**found)
    except (KeyError, TypeError, AttributeError, json.JSONDecodeError, UnicodeDecodeError):
        raise ValueError(f"{path}: not of the schema {SCHEMA}; expected what a training wrote") from None
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _as_kept(settings: Settings) -> dict[str, Any]:
    """As a file has it."""
    kept: dict[str, Any] = json.loads(files.json_text(asdict(settings)))
    return kept


def _sentence(progress: Progress) -> str:
    done = f"{progress.steps / 1e6:.1f} M control steps, {progress.episodes} episodes"
    if progress.worth != progress.worth:
        return f"{done}, none of them over yet"
    means = f"the mean return is {progress.worth:.2f}, the mean length {progress.length:.1f} s"
    return f"{done}; of the last ones, {means}"


class _Keeper:
    """Shows how far a training is, and keeps it on disk."""

    def __init__(self, folder: Path, trainer: Trainer, show: Any, seconds: float, steps: int | None) -> None:
        self.folder, self.trainer, self.show = folder, trainer, show
        self.seconds, self.steps = seconds, steps
        self.rows = _curve(folder / CURVE, trainer.begun.steps) if trainer.begun.steps else []
        self.kept = time.monotonic()

    def report(self, progress: Progress) -> None:
        exact = (f"{one:.6g}" if isinstance(one, float) else str(one) for one in asdict(progress).values())
        self.rows.append(list(exact))
        begun = self.trainer.begun
        passed, done = progress.seconds - begun.seconds, progress.steps - begun.steps
        share = passed / self.seconds if self.steps is None else done / self.steps
        self.show(f"return {progress.worth:.2f}", min(1.0, share))
        if time.monotonic() - self.kept > KEEP_EVERY:
            self.keep()

    def keep(self) -> None:
        """The checkpoint, then the agent, its curve and how far it is, each once it is whole."""
        progress = self.trainer.progress()
        numbers = {name: None if value != value else value for name, value in asdict(progress).items()}
        state = {"schema": SCHEMA, "settings": asdict(self.trainer.settings), "progress": numbers}
        with files.whole_file(self.folder / CHECKPOINT) as temporary:
            self.trainer.save(temporary)
        files.write_texts(
            {
                self.folder / AGENT: self.trainer.agent().to_json(),
                self.folder / CURVE: _text_of(self.rows),
                self.folder / SETTINGS: files.json_text(state),
            }
        )
        self.kept = time.monotonic()


def _text_of(rows: list[list[str]]) -> str:
    from ..training import Progress

    header = ",".join(one.name for one in fields(Progress))
    return "\n".join([header, *(",".join(row) for row in rows)]) + "\n"


def _curve(path: Path, steps: int) -> list[list[str]]:
    """Rows of a curve, up to where the checkpoint is."""
    if not path.exists():
        return []
    try:
        with path.open(encoding="utf-8", newline="") as file:
            rows = [row for row in list(csv.reader(file))[1:] if row]
        return [row for row in rows if float(row[0]) <= steps]
    except (ValueError, csv.Error) as error:
        raise ValueError(f"{path}: {shown(str(error))}; expected the curve of a training") from None
