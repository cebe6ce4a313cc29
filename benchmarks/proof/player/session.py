# SPDX-License-Identifier: MIT
"""One draw of the proof: a plant, what the planner knows of it, and what comes of its plans."""

from __future__ import annotations

import json
import tempfile
import time
from itertools import takewhile
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
from diabolo import Freedom, Goals, LadderRow, Model, Parameters, Plan, State, TipLimits, TipPath, _core

from .plant import STICKS, Plant, Played

REACTION = 0.12
"""From what is seen to the motion that answers it [s]."""
GAINS = {"linear_acceleration": 6.0, "circular_acceleration": 3.0}
"""Wanted of a cycle [rad/s]."""
LOOKS = (0.05, 0.1, 0.15, 0.2, 0.25, 0.3)
"""How much sooner the diabolo on its string is looked at, too [s]."""
CYCLES_SPIN = 60.0  # at their begin [rad/s]
LIMITS = TipLimits(string_margin=0.004)
KINDS = ("diagnosed", "guessed", "truth", "consistent", "spread")
"""What the planner knows: the model that `diagnose` made from 30 s of the plant's own play, as it was written
(`diagnosed`) or with its best guess of the air (`guessed`); the plant's own numbers (`truth`); the length of
the string alone, with nothing else at work (`consistent`) or with a spread of all that may be (`spread`)."""


def draw(program: Path, rng: np.random.Generator) -> Plant:
    return Plant(
        program,
        friction=float(rng.uniform(0.15, 0.35)),
        bending_stiffness=float(rng.uniform(250.0, 800.0)),
        stiffness=float(rng.uniform(1000.0, 5000.0)),
        drag=float(rng.uniform(0.015, 0.045)),
        magnus=float(rng.uniform(0.0002, 0.0015)),
        length=float(rng.uniform(1.42, 1.47)),
        seed=int(rng.integers(1, 1000)),
    )


def spread(length: float) -> list[Model]:
    """Models of all that may be with a string of that length, in usual air: the middle, and four corners."""

    def one(friction: float, stick: float, string: float) -> Model:
        return Model(
            Parameters(string_length=length, spin_coupling=0.0),
            name="spread",
            string_friction=diabolo.StringFriction(coefficient=friction, spin_gain=3.4),
            string_elasticity=diabolo.StringElasticity(compliance=length / string, damping=10.0),
            stick_flex=diabolo.StickFlex(compliance=1.0 / stick, damping=3.0),
            air=diabolo.Air(quadratic_drag=0.03),
            magnus_lift=diabolo.MagnusLift(coefficient=8e-4),
        )

    return [
        one(0.225, 430.0, 2200.0),
        one(0.1, 300.0, 1300.0),
        one(0.35, 300.0, 1300.0),
        one(0.1, 700.0, 4000.0),
        one(0.35, 700.0, 4000.0),
    ]


def known(plant: Plant, kind: str, diagnosis: dict[str, Any] | None) -> list[Model]:
    """What the planner plans on."""
    if kind == "consistent":
        return [Model(Parameters(string_length=plant.length), name=kind)]
    if kind == "spread":
        return spread(plant.length)
    if kind == "truth":
        return [plant.known()]
    assert diagnosis is not None
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "model.json"
        file.write_text(json.dumps(diagnosis["model"]))
        model = Model.load(file)
    if kind == "guessed":
        model = diabolo.best_guess(model, [LadderRow(**row) for row in diagnosis["ladder"]])
    return [model]


def diagnosed(plant: Plant) -> dict[str, Any]:
    """What `diabolo diagnose` says of 30 s of the plant's own play."""
    takes = plant.practice()
    began = time.perf_counter()
    found = diabolo.diagnose(takes, threads=1)
    return {
        "recorded_s": sum(float(take.time[-1] - take.time[0]) for take in takes),
        "takes": len(takes),
        "took_s": time.perf_counter() - began,
        "sentence": found.sentence,
        "model": json.loads(diabolo.model_for(found.model, takes[0]).to_json()),
        "ladder": [
            {key: getattr(row, key) for key in ("name", "estimate", "z", "claimed")}
            for row in found.result.ladder
        ],
    }


class Player:
    """Plans piece by piece for a plant that is played from the beginning each time, from what it sees."""

    def __init__(self, plant: Plant, models: list[Model], home: Any, spin: float, *, steers: bool) -> None:
        self.plant, self.models, self.spin, self.steers = plant, models, spin, steers
        self.left, self.right = home
        still = diabolo.StickSpline([0.0, 0.5], [self.left] * 2, [self.right] * 2).path()
        self.start: State = plant.play(still, spin, 0.1).seen_hanging()
        self.begin()

    def begin(self) -> None:
        self.horizon = diabolo.RecedingHorizon(self.models[0], self.left, self.right, self.start, 0.0, STICKS)
        self.longest_planning = 0.0

    @property
    def path(self) -> TipPath:
        return self.horizon.path

    def play(self, tail: float = 0.3) -> Played:
        return self.plant.play(self.path, self.spin, tail, steers=self.steers)

    def add(self, seed: Any, goals: Goals, freedom: Freedom, seam: Any) -> Plan:
        began = time.perf_counter()
        plan = diabolo.plan(seam.state, seed, goals, self.models, limits=LIMITS, freedom=freedom)
        self.longest_planning = max(self.longest_planning, time.perf_counter() - began)
        assert self.horizon.join(seam, plan, seam.time, 0.0)
        return plan

    def observe(self, played: Played, time: float) -> None:
        """What was seen at several instants up to a time, each carried on by the model to the last of them:
        their mean has less of the camera's noise than any."""
        last, state = played.seen(time)
        tips, found = self.path.tips(2e-3), [_numbers(state)]
        for when, seen in (played.seen(time - earlier) for earlier in LOOKS):
            if when >= last:
                continue
            steps = max(1, round((last - when) / 1e-3))
            carried = diabolo.rollout(
                self.models[0],
                _numbers(seen),
                tips,
                begin=when,
                dt=(last - when) / steps,
                steps=steps,
                string_state=seen.string_state,
            )
            found.append(carried.states[-1])
        mean = np.mean(found, axis=0)
        self.horizon.observe(last, State(mean[:3], mean[3:6], float(mean[6]), state.string_state))

    def throw(self, name: str, height: float, sideways: float, aim: float) -> Plan:
        seam = self.horizon.seam_at(self.path.end)
        action = _core.action(
            name, self.left, self.right, seam.state, self.plant.length, height=height, sideways=sideways
        )
        landing = action.goals.landing + np.array([0.0, aim, 0.0])
        return self.add(seam.joined(action.seed), Goals(apex=height, landing=landing), action.freedom, seam)

    def catch(self, played: Played) -> Plan:
        """From what is seen REACTION before the new piece sets in."""
        self.horizon.observe(*played.seen(self.path.end))
        seam = self.horizon.seam_at(self.path.end + REACTION)
        action = seam.catch(self.left, self.right, self.models[0])
        return self.add(action.seed, action.goals, action.freedom, seam)


def throws(
    plant: Plant, number: int, kind: str, rng: np.random.Generator, diagnosis: dict[str, Any] | None = None
) -> dict[str, Any]:
    """A throw of the plant, its catch, and both again with the aim moved by what the first one missed."""
    name = "throw" if number % 3 < 2 else "side_throw"
    height = float(rng.uniform(0.3, 1.0))
    sideways = 0.0 if name == "throw" else float(rng.uniform(0.1, 0.3))
    spin = float(rng.uniform(100.0, 200.0))
    line: dict[str, Any] = {"plant": plant.facts(), "height": height, "sideways": sideways, "spin": spin}
    models = known(plant, kind, diagnosis)
    player = Player(plant, models, _core.home_pose(name, plant.length), spin, steers=False)
    wanted = aim = (height, sideways)
    for which in ("first", "corrected"):
        player.begin()
        apex = place = None
        caught = False
        try:
            player.throw(name, aim[0], sideways, aim[1] - sideways)
            down = 2.0 * float(np.sqrt(2.0 * (height + 0.1) / 9.81))  # of the flight
            played = player.play(down)
            apex, place = played.flight(player.path)
            aim = diabolo.aimed_again(aim, wanted, (apex, place))
            player.catch(played)
            caught = player.play().held_at(player.path.end)
        except (ValueError, RuntimeError) as error:  # nothing flew, or a tip ran into the diabolo
            line[f"{which}_error"] = str(error)
        line[which] = {
            "apex": apex,
            "place": place,
            "caught": caught,
            "planning_s": player.longest_planning,
        }
    return line


def cycles(
    plant: Plant, name: str, count: int, kind: str, every: int, diagnosis: dict[str, Any] | None = None
) -> dict[str, Any]:
    """Cycles of acceleration, each planned from the predicted end of the one before, with a look every so
    many."""
    line: dict[str, Any] = {"plant": plant.facts(), "action": name, "rounds": count, "look_every": every}
    models = known(plant, kind, diagnosis)
    player = Player(plant, models, _core.home_pose(name, plant.length), CYCLES_SPIN, steers=True)
    ends: list[float] = []
    played = None
    for number in range(count):
        seam = player.horizon.seam_at(player.path.end)
        gain = GAINS[name] if kind != "consistent" else None  # without friction no motion gains any
        action = _core.action(name, player.left, player.right, seam.state, plant.length, spin_gain=gain)
        player.add(seam.joined(action.seed), action.goals, action.freedom, seam)
        ends.append(player.path.end)
        if (number + 1) % every != 0 and number + 1 < count:
            continue
        played = player.play(0.2)
        if not played.held_at(player.path.end):
            break
        if number + 1 < count:
            player.observe(played, player.path.end - REACTION)
    assert played is not None
    last = int(np.clip(np.searchsorted(played.time, ends[-1]), 1, len(played.time))) - 1
    line["done"] = sum(1 for _ in takewhile(played.held_at, ends))
    line["end_spin"] = float(played.spin[last])
    line["planning_s"] = player.longest_planning
    return line


def _numbers(state: State) -> np.ndarray[Any, Any]:
    return np.concatenate([state.position, state.velocity, [state.spin]])
