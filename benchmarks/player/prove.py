# SPDX-License-Identifier: MIT
"""Puts plans to the proof on the independent plant.

    .venv/bin/python benchmarks/player/prove.py throws --plant build/plant/diabolo-plant
    .venv/bin/python benchmarks/player/prove.py cycles --plant build/plant/diabolo-plant

Plants are drawn; the planner gets what a diagnosis would say of each, within its usual errors (`diagnosed`),
or nothing but the length of the string (`consistent`).
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
from diabolo import Freedom, Goals, Model, Parameters, Plan, State, TipLimits, TipPath, _core
from plant import Plant, Truth

REACTION = 0.12
"""From what is seen to the motion that answers it [s]."""
GAINS = {"linear_acceleration": 6.0, "circular_acceleration": 3.0}
"""Wanted of a cycle [rad/s]."""
LIMITS = TipLimits(string_margin=0.004)


def draw(program: Path, rng: np.random.Generator, steers: bool) -> Plant:
    return Plant(
        program,
        friction=float(rng.uniform(0.15, 0.35)),
        bending_stiffness=float(rng.uniform(250.0, 800.0)),
        stiffness=float(rng.uniform(1000.0, 5000.0)),
        drag=float(rng.uniform(0.015, 0.045)),
        magnus=float(rng.uniform(0.0002, 0.0015)),
        length=float(rng.uniform(1.42, 1.47)),
        steers=steers,
        seed=int(rng.integers(1, 1000)),
    )


def plain(plant: Plant) -> Model:
    return Model(Parameters(string_length=plant.length), name="consistent")


class Player:
    """Plans piece by piece for a plant that is played from the beginning each time."""

    def __init__(self, plant: Plant, model: Model, home: Any, spin: float) -> None:
        self.plant, self.model, self.spin = plant, model, spin
        self.left, self.right = home
        still = diabolo.StickSpline([0.0, 0.5], [self.left] * 2, [self.right] * 2).path()
        self.start: State = plant.play(still, spin, 0.1).state(0.0)
        self.begin()

    def begin(self) -> None:
        self.horizon = diabolo.Horizon(self.model, self.left, self.right, self.start, 0.0)
        self.longest_planning = 0.0

    @property
    def path(self) -> TipPath:
        return self.horizon.path

    def add(self, seed: Any, goals: Goals, freedom: Freedom, seam: Any) -> Plan:
        began = time.perf_counter()
        plan = diabolo.plan(seam.state, seed, goals, self.model, limits=LIMITS, freedom=freedom)
        self.longest_planning = max(self.longest_planning, time.perf_counter() - began)
        assert self.horizon.join(seam, plan, seam.time, 0.0)
        return plan

    def throw(self, name: str, height: float, sideways: float, aim: float) -> Plan:
        seam = self.horizon.seam_at(self.path.end)
        action = _core.action(
            name, self.left, self.right, seam.state, self.plant.length, height=height, sideways=sideways
        )
        goals = action.goals
        landing = goals.landing + np.array([0.0, aim, 0.0])
        goals = Goals(apex=height, landing=landing)
        return self.add(seam.joined(action.seed), goals, action.freedom, seam)

    def catch(self, truth: Truth) -> Plan:
        """From what is seen REACTION before the new piece sets in."""
        seen = truth.state(self.path.end)
        self.horizon.observe(self.path.end, seen)
        seam = self.horizon.seam_at(self.path.end + REACTION)
        action = seam.catch(self.left, self.right, self.model)
        return self.add(action.seed, action.goals, action.freedom, seam)


def flight(truth: Truth, path: TipPath) -> tuple[float, float]:
    """Apex above the resting tips, and the sideways place of landing at their height [m]."""
    tips = path.derivatives(np.array([path.end]))[0][0]
    level = 0.5 * (tips[2] + tips[5])
    top = int(truth.position[:, 2].argmax())
    down = top + int(np.argmax(truth.position[top:, 2] <= level))
    return float(truth.position[top, 2] - level), float(truth.position[down, 1])


def throws(program: Path, count: int, kind: str, rng: np.random.Generator) -> None:
    print(
        "plant  throw       asked  first: apex  landing  caught   corrected: apex  landing  caught  plan [ms]"
    )
    results = []
    for i in range(count):
        plant = draw(program, rng, steers=False)
        model = plain(plant) if kind == "consistent" else plant.model(rng)
        name = "throw" if i % 3 < 2 else "side_throw"
        height = float(rng.uniform(0.3, 1.0))
        sideways = 0.0 if name == "throw" else float(rng.uniform(0.1, 0.3))
        spin = float(rng.uniform(100.0, 200.0))
        player = Player(plant, model, _core.home_pose(name, plant.length), spin)
        wanted_apex, wanted_place, aimed_height, aim = height, sideways, height, 0.0
        row: list[Any] = []
        for _ in range(2):
            player.begin()
            apex = place = float("nan")
            try:
                player.throw(name, aimed_height, sideways, aim)
                down = 2.0 * float(np.sqrt(2.0 * (height + 0.1) / 9.81))  # of the flight
                truth = plant.play(player.path, spin, down)
                apex, place = flight(truth, player.path)
                player.catch(truth)
                caught = plant.play(player.path, spin).held_at(player.path.end)
            except (ValueError, RuntimeError) as error:  # nothing flew, or a tip ran into the diabolo
                print(f"  {error}", file=sys.stderr)
                caught = False
            row += [apex, place, caught]
            if np.isfinite(apex):
                aimed_height += wanted_apex - apex
                aim += wanted_place - place
        results.append((wanted_apex, wanted_place, *row))
        first, second = (f"{row[k]:.3f}   {row[k + 1] - sideways:+.3f}   {row[k + 2]!s:6s}" for k in (0, 3))
        print(
            f"{i:5d}  {name:10s}  {height:.2f}   {first}   {second}   {1e3 * player.longest_planning:.0f}",
            flush=True,
        )
    for at, what in ((2, "first throw"), (5, "after one correction")):
        apex = [abs(r[at] / r[0] - 1.0) for r in results]
        place = [abs(r[at + 1] - r[1]) for r in results]
        close, aside = sum(a <= 0.05 for a in apex), sum(p <= 0.05 for p in place)
        caught = sum(bool(r[at + 2]) for r in results)
        print(
            f"{kind}, {what}: height within 5 % in {close} of {count} (median "
            f"{100 * np.nanmedian(apex):.1f} %), landing within 5 cm in {aside} (median "
            f"{100 * np.nanmedian(place):.1f} cm), caught {caught}"
        )


def cycles(plant: Plant, name: str, count: int, kind: str, every: int, rng: Any) -> None:
    model = plain(plant) if kind == "consistent" else plant.model(rng)
    spin = 60.0
    player = Player(plant, model, _core.home_pose(name, plant.length), spin)
    done = 0
    truth = None
    for done in range(count):
        seam = player.horizon.seam_at(player.path.end)
        gain = GAINS[name] if kind == "diagnosed" else None  # without friction no motion gains any
        action = _core.action(name, player.left, player.right, seam.state, plant.length, spin=gain)
        player.add(seam.joined(action.seed), action.goals, action.freedom, seam)
        if (done + 1) % every != 0 and done + 1 < count:
            continue
        truth = plant.play(player.path, spin, 0.2)
        if not truth.held_at(player.path.end):
            break
        seen = player.path.end - REACTION
        player.horizon.observe(seen, truth.state(seen))
    else:
        done = count
    assert truth is not None
    last = truth.spin[int(np.searchsorted(truth.time, min(player.path.end, truth.time[-1]))) - 1]
    if done < count:  # the last look shows since when it was lost
        cycle = player.path.end / (done + 1)
        done = sum(truth.held_at(cycle * (i + 1)) for i in range(done + 1))
    looks = "open loop" if every >= count else f"a look every {every} cycles"
    print(
        f"{name}, {kind}, {looks}: {done} of {count} cycles, "
        f"spin {truth.spin[0]:.0f} to {last:.0f} rad/s, friction {plant.friction:.2f}, planning at most "
        f"{1e3 * player.longest_planning:.0f} ms",
        flush=True,
    )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("what", choices=("throws", "cycles"))
    parser.add_argument("--plant", type=Path, default=Path("build/plant/diabolo-plant"))
    parser.add_argument("--kind", choices=("diagnosed", "consistent"), default="diagnosed")
    parser.add_argument("--count", type=int, default=12, help="plants of throws, cycles of accelerations")
    parser.add_argument("--action", default="linear_acceleration", help="of cycles")
    parser.add_argument("--look-every", type=int, default=1, help="so many cycles")
    parser.add_argument("--plants", type=int, default=3, help="of cycles")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    rng = np.random.default_rng(given.seed)
    if given.what == "throws":
        throws(given.plant, given.count, given.kind, rng)
        return
    for _ in range(given.plants):
        cycles(
            draw(given.plant, rng, steers=True), given.action, given.count, given.kind, given.look_every, rng
        )


if __name__ == "__main__":
    main()
