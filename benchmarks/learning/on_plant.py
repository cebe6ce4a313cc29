# SPDX-License-Identifier: MIT
"""Agents and the player, thrown on the independent plant: who catches.

Each plant has numbers of its own, and a goal: a height and a place. An agent looks 50 times a second, at
the true state or by a camera, and moves the hands of the plant; the player plans once, on a model, and its
plan is played as it is. An agent that corrects plans is added to each of the player's. All
keep to the same limits of the hands, and to the same box. The plants are those of benchmarks.proof.player,
or all near its usual one, on whose play benchmarks.learning.models is based.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
from diabolo import Model, PlannedPlay
from diabolo.envs import Agent, Camera, HandLimits, LiveAgent, hand_plan, shipped_agent
from numpy.typing import NDArray

from .. import command
from ..proof import plant as program
from ..proof.player.plant import FORWARD, Plant
from ..proof.player.session import draw

EXAMPLE = """\
  make plant && python -m benchmarks.learning.on_plant
  python -m benchmarks.learning.on_plant --agent robust/agent.json correction/agent.json --model point.json"""
TASK = "ThrowAndCatch"
SECONDS = 4.0  # that an episode of the task lasts
KEPT = 0.5  # after the catch [s]
TAIL = 1.0  # of still hands, after a plan [s]
SHORTEST = 0.1  # a flight [s]
MIDDLE = np.array([FORWARD, 0.0, 1.25])  # of the player's hands at first [m]
MODES = {"ON_STRING": "on_string", "LOOSE": "loose", "FLYING": "flying"}


Row = tuple[float, str, NDArray[np.float64]]
"""Time [s], mode, and place from the hands' box's centre [m]."""


@dataclass(frozen=True)
class Thrown:
    """What became of a throw: whether it was caught and not lost for half a second, and
    whether it did not fly then; its apex above the hands' box's centre, and where it was caught, from
    that centre to the left [m]."""

    caught: bool
    not_flying: bool
    apex: float
    place: float


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.learning.on_plant", __doc__, EXAMPLE)
    parser.add_argument(
        "--agent", metavar="FILE", nargs="+", type=Path, default=[], help="beside the shipped one"
    )
    parser.add_argument(
        "--model",
        metavar="FILE",
        nargs="+",
        type=Path,
        default=[],
        help="models that the player plans on, too",
    )
    parser.add_argument("--plants", type=int, default=100, metavar="N", help="drawn ones; default: 100")
    parser.add_argument(
        "--height", type=float, metavar="H", help="of all throws [m]; default: drawn, 0.3 to 0.8"
    )
    parser.add_argument(
        "--around",
        type=float,
        metavar="SHARE",
        help="friction, stiffness of sticks and string, drag and lift are within this share of the usual "
        "plant's; default: far apart",
    )
    parser.add_argument(
        "--camera", action="store_true", help="agents see what a camera sees: noise, dropouts, delay"
    )
    parser.add_argument("--seed", type=int, default=1, metavar="N")
    parser.add_argument("--json", type=Path, metavar="FILE", help="each throw, to write")
    program.add_option(parser)
    return command.run(parser, run, arguments)


def run(given: argparse.Namespace) -> int:
    if given.plants < 1 or not (given.height is None or 0.3 <= given.height <= 0.8):
        raise ValueError(
            f"--plants {given.plants}, --height {given.height}; expected 1 or more, and 0.3 to 0.8 m"
        )
    if given.around is not None and not 0.0 <= given.around <= 0.5:
        raise ValueError(f"--around {given.around}; expected 0 to 0.5")
    program.check(given.plant)
    agents = {"shipped agent": shipped_agent(TASK)} | {
        str(path): Agent.load(str(path)) for path in given.agent
    }
    planners = MODELS | {f"player, {path}": partial(own_model, Model.load(str(path))) for path in given.model}
    found: defaultdict[str, list[Thrown]] = defaultdict(list)
    wanted: list[tuple[float, float]] = []
    for number in range(given.plants):
        rng = np.random.default_rng([given.seed, number])
        plant = draw(given.plant, rng) if given.around is None else plant_near(given.plant, given.around, rng)
        spin = float(rng.uniform(60.0, 120.0))
        height = given.height or float(rng.uniform(0.3, 0.8))
        goal = (height, float(rng.uniform(-0.3, 0.3)))
        wanted.append(goal)
        camera = Camera() if given.camera else None
        for name, agent in agents.items():
            if not agent.corrects:
                found[name].append(tried(thrown_by_agent, plant, agent, goal, spin, camera, number))
        for planner, model_for in planners.items():
            planned = planned_on(model_for(plant), goal, spin)
            found[planner].append(tried(thrown_by_player, plant, planned, spin))
            for name, agent in agents.items():
                if agent.corrects:
                    throw = tried(thrown_by_agent, plant, agent, goal, spin, camera, number, planned)
                    found[f"{planner}, with {name}"].append(throw)
        print(f"\rplant {number + 1} of {given.plants}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    print_table(found, np.array(wanted))
    if given.json:
        rows = {name: [vars(one) for one in throws] for name, throws in found.items()}
        given.json.write_text(json.dumps({"goals": wanted, "throws": rows}, indent=1), encoding="utf-8")
    return 0


def plant_near(file: Path, share: float, rng: np.random.Generator) -> Plant:
    """A plant within a share of the usual one; its string, which one can measure, is as long."""
    varied = ("friction", "bending_stiffness", "stiffness", "drag", "magnus")
    usual = Plant(file, seed=int(rng.integers(1, 1000))).facts()
    return Plant(
        file, **usual | {name: usual[name] * rng.uniform(1.0 - share, 1.0 + share) for name in varied}
    )


MODELS = {
    "player, usual model": lambda plant: diabolo.Model(diabolo.Parameters(string_length=plant.length)),
    "player, the plant's own numbers": lambda plant: plant.known(),
}
"""What the player plans on."""


def own_model(model: Model, plant: Plant) -> Model:
    """One of a file, whatever the plant."""
    return model


def tried(throw: Callable[..., Thrown], *given: Any) -> Thrown:
    """A throw; one that the plant gives up on, as where a stick meets the axle, is not caught."""
    try:
        return throw(*given)
    except program.FailedError:
        return Thrown(False, False, float("nan"), float("nan"))


def thrown_by_agent(
    plant: Plant,
    agent: Agent,
    goal: tuple[float, float],
    spin: float,
    camera: Camera | None,
    seed: int,
    planned: PlannedPlay | None = None,
) -> Thrown:
    """An agent's hands on the plant, for an episode; or its correction of a plan."""
    limits = HandLimits()
    aside = np.array([0.0, 0.288, 0.0])  # where an episode begins
    left, right, plan = limits.centre + aside, limits.centre - aside, None
    if planned is not None:
        plan = hand_plan(planned, string_length=plant.length, period=agent.period)
        left, right = plan.left, plan.right
    length = plant.length
    hands = LiveAgent(
        agent, left, right, list(goal), string_length=length, camera=camera, seed=seed, plan=plan
    )
    speeds = np.zeros(6)
    rows: list[Row] = []
    with plant.live(left, right, spin) as play:
        for _ in range(round(SECONDS / agent.period)):
            moment = play.moment
            rows.append((moment.time, moment.mode, moment.position - limits.centre))
            if moment.mode == "MISSED":
                break
            state = diabolo.State(moment.position, moment.velocity, moment.spin, MODES[moment.mode])
            next_speeds = np.concatenate(hands.act(state)[2:])
            play.push(agent.period, (next_speeds - speeds) / agent.period)
            speeds = next_speeds
    return judged(rows)


def planned_on(model: Any, goal: tuple[float, float], spin: float) -> PlannedPlay:
    """The player's plan."""
    own = HandLimits()
    limits = diabolo.TipLimits(
        speed=own.speed, acceleration=own.acceleration, lowest=MIDDLE - own.half, highest=MIDDLE + own.half
    )
    return diabolo.plan_action(
        "throw_and_catch", model, spin=spin, height=goal[0], sideways=goal[1], limits=limits
    )


def thrown_by_player(plant: Plant, planned: PlannedPlay, spin: float) -> Thrown:
    """A plan as the plant's hands play it."""
    played = plant.play(planned.path, spin, tail=TAIL)
    rows = list(zip(played.time, played.mode, played.position - MIDDLE, strict=True))
    if played.time[-1] < planned.path.end - planned.path.begin + 0.9 * TAIL:  # it ends where it misses
        rows.append((played.time[-1], "MISSED", rows[-1][2]))
    return judged(rows)


def judged(rows: Sequence[Row]) -> Thrown:
    """The first flight, and what became of it in the half second after its catch."""
    flight = flight_of(rows)
    if not flight:
        return Thrown(False, False, float("nan"), float("nan"))
    begun, end = flight
    time, _, place = rows[end]
    after = [later for when, later, _ in rows[end:] if when <= time + KEPT]
    lasts = rows[-1][0] >= time + KEPT
    caught = bool("MISSED" not in after and lasts)
    apex = max(height for _, _, (_, _, height) in rows[begun:end])
    return Thrown(caught, caught and after[-1] != "FLYING", float(apex), float(place[1]))


def flight_of(rows: Sequence[Row]) -> tuple[int, int] | None:
    """The rows with which the first flight that counts as one begins and is over."""
    begun = None
    for number, (time, mode, _) in enumerate(rows):
        if mode == "FLYING":
            begun = number if begun is None else begun
        elif begun is not None and time - rows[begun][0] < SHORTEST:
            begun = None
        elif begun is not None:
            return begun, number
    return None


def print_table(found: dict[str, list[Thrown]], wanted: NDArray[np.float64]) -> None:
    print(
        "| who | caught | not flying 0.5 s later | apex off, median | within 10 % | "
        "caught beside the place, median |"
    )
    print("|---|---|---|---|---|---|")
    for name, throws in found.items():
        caught = np.array([one.caught for one in throws])
        apex = np.abs(np.array([one.apex for one in throws]) - wanted[:, 0])
        beside = np.abs(np.array([one.place for one in throws]) - wanted[:, 1])
        cells = [share_cell([one.caught for one in throws]), share_cell([one.not_flying for one in throws])]
        if caught.any():
            near = share_cell(list(caught & (apex < 0.1 * wanted[:, 0])))
            cells += [f"{np.median(apex[caught]):.2f} m", near, f"{np.median(beside[caught]):.2f} m"]
        print(f"| {name} | " + " | ".join(cells) + " |")


def share_cell(hits: Sequence[bool]) -> str:
    low, high = interval(sum(hits), len(hits))
    return f"{sum(hits)} of {len(hits)} ({low:.0%} to {high:.0%})"


def interval(hits: int, count: int) -> tuple[float, float]:
    """Of a share, at 95 % (Wilson 1927)."""
    z = 1.96
    share, more = hits / count, z * z / count
    middle, half = share + more / 2.0, z * np.sqrt(share * (1.0 - share) / count + more / (4.0 * count))
    return float((middle - half) / (1.0 + more)), float((middle + half) / (1.0 + more))


if __name__ == "__main__":
    sys.exit(main())
