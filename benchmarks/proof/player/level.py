# SPDX-License-Identifier: MIT
"""Levelling on the independent plant, whose axle is free.

Its hands raise the spin by cycles of linear acceleration, each planned on the plant's own numbers.

raise   a minute that gains 60 rad/s or more; the axle shall stay within 5 degrees of the heading
back    a tilt of 20 degrees shall be below 5 within 3 s, and stay there
throw   twenty throws and catches in a row, with cycles of acceleration between, shall lose nothing
catch   a throw whose axle is tilted by 20 degrees shall be caught, and be level 3 s after that; also told
        without the nutation that the catch leaves, which nothing on the plant damps

`--by` says who plays: `model`, the linear-quadratic regulator of LevelHands, and `horizon`, LevelHorizon,
both on the plant's numbers; `diagnosis`, LevelHands on what a diagnosis makes of a filmed play; `linear`, a
linear map that is learnt in play; `none`, hands that do not level. Each plant has its own numbers, friction
and groove among them; the hands see its axle three frames late, with half a degree of noise, its true
spin, and whether the string is taut.
"""

from __future__ import annotations

import argparse
import contextlib
import math
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import diabolo
import numpy as np
from diabolo import State, _core
from diabolo.enums import StringState
from numpy.typing import NDArray

from ... import command
from .. import plant as driver
from .level_peers import LEARNS, LinearHands, Shaking, StillHands, diagnosed
from .plant import STICKS, Plant
from .session import GAINS, LIMITS, REACTION, draw

EXAMPLE = """\
  make plant && python -m benchmarks.proof.player.level raise --count 100
  python -m benchmarks.proof.player.level back --count 100 --by horizon --seed 2"""

PERIOD = 0.01
"""Of the hands [s]."""
DELAY = 3
"""Frames of 120 Hz from the axle to what is seen of it."""
NOISE = np.radians(0.5)
"""Of the seen axle's direction [rad]."""
WARM_UP = 0.3  # that the plant hangs before [s]
RAISED = 60.0
"""How much spin a play of `raise` shall gain [rad/s]."""
PLAYS = {"raise": 60.0, "back": 6.0, "throw": 300.0, "catch": 8.0}
"""How long a play lasts at most [s]."""
BY = ("model", "horizon", "diagnosis", "linear", "none")
"""What the hands go by; see above."""
THROWS = 20
HEIGHT = 0.5  # of a throw above the tips [m]
THROWN = 100.0  # a diabolo that spins faster is [rad/s]
LEVEL = 5.0  # [deg]
TILT = 20.0  # that `back` and `catch` begin with [deg]
SOON = 3.0  # [s]
NUTATION = 0.25  # over which a mean leaves none of it [s]
LOST = 0.15  # a diabolo below is [m]
FILMED = 200.0  # a play to diagnose begins with [rad/s]


class FreeAxle(NamedTuple):
    """What a plant's axle and groove are, and how its play begins: spin [rad/s], tilt and yaw [deg]."""

    inertia_ratio: float
    groove_radius: float
    groove_half_width: float
    spin: float
    pitch: float
    yaw: float


def draw_axle(rng: np.random.Generator, tilt: float) -> FreeAxle:
    """Of the plants that the physics' notes allow; tilted one way or the other by `tilt` [deg], or as one
    begins to play, where that is zero."""
    pitch = tilt * rng.choice((-1.0, 1.0)) if tilt else rng.uniform(-3.0, 3.0)
    return FreeAxle(
        float(rng.uniform(1.0, 1.4)),
        float(rng.uniform(0.002, 0.01)),
        float(rng.uniform(0.003, 0.008)),
        float(rng.uniform(60.0, 80.0)),
        float(pitch),
        float(rng.uniform(-3.0, 3.0)),
    )


def model_of(plant: Plant, axle: FreeAxle) -> diabolo.Model:
    """The library's model of the plant with its axle."""
    known = plant.known()
    known.gyroscopic_tilt = diabolo.GyroscopicTilt(
        gain=plant.mass * plant.axle_radius / plant.axial_inertia, inertia_ratio=axle.inertia_ratio
    )
    known.groove = diabolo.Groove(profile_radius=axle.groove_radius, half_width=axle.groove_half_width)
    return known


class Hands:
    """Hands of the live plant that are brought to given tips: places and velocities are its own."""

    def __init__(self, home: NDArray[np.float64]) -> None:
        self.place = home.copy()
        self.velocity = np.zeros(6)

    def towards(self, place: NDArray[np.float64], velocity: NDArray[np.float64]) -> NDArray[np.float64]:
        """Accelerations for a period that end with the wanted velocity and half of the gap closed."""
        drift = place - (self.place + 0.5 * PERIOD * (self.velocity + velocity))
        acceleration = (velocity + 0.25 * drift / PERIOD - self.velocity) / PERIOD
        acceleration = np.clip(acceleration, -60.0, 60.0)
        self.place = self.place + PERIOD * self.velocity + 0.5 * PERIOD**2 * acceleration
        self.velocity = self.velocity + PERIOD * acceleration
        return acceleration


@dataclass
class Levelled:
    """What came of a play: times [s], tilt and yaw of the axle against the heading [deg], the heading [deg],
    spin [rad/s], throws that were caught and when the last one was [s], whether the diabolo was lost, and how
    long the hands thought of the axle for a second of play [s]."""

    time: NDArray[np.float64]
    tilt: NDArray[np.float64]
    yaw: NDArray[np.float64]
    heading: NDArray[np.float64]
    spin: NDArray[np.float64]
    caught: int
    caught_at: float
    lost: bool
    thought: float


Tips = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Both tips, left over right: places [m] and velocities [m/s], shape (6,)."""


class Playing:
    """Pieces of play, one planned after the other from what is seen REACTION before it sets in: cycles of
    linear acceleration; and up to `throws` times a throw and its catch, once the spin is above `throws_from`
    [rad/s]."""

    def __init__(self, plant: Plant, spin: float, *, throws: int = 0, throws_from: float = THROWN) -> None:
        self._models, self._length = [plant.known()], plant.length
        self._throws, self._throws_from = throws, throws_from
        left, right = _core.home_pose("linear_acceleration", plant.length)
        start = diabolo.hang_at_rest(self._models[0], left, right, spin, STICKS)
        self._horizon = diabolo.RecedingHorizon(self._models[0], left, right, start, 0.0, STICKS)
        self._piece = "linear_acceleration"
        self.home = np.concatenate([left, right])
        self.caught = 0
        self.caught_at = math.inf

    @property
    def path(self) -> diabolo.TipPath:
        return self._horizon.path

    def at(self, time: float, seen: State) -> Tips:
        """The tips at a time [s], which grows from call to call; `seen` a period before it."""
        # What flies is looked at once it does, and the catch sets in later; else the next piece goes on.
        flies = self._piece == "throw"
        if time > self._horizon.path.end - (0.0 if flies else REACTION):
            self._horizon.observe(time - PERIOD, seen)
            self._go_on(REACTION if flies else 0.0, seen.spin)
        place, velocity = self._horizon.path.derivatives(np.array([time]))[:2]
        return place[0], velocity[0]

    def _go_on(self, later: float, spin: float) -> None:
        seam = self._horizon.seam_at(self._horizon.path.end + later)
        if self._piece == "catch":
            self.caught += 1
            self.caught_at = self._horizon.path.end
        if self._piece == "throw":
            self._piece = "catch"
            action = seam.catch(*_core.home_pose("throw", self._length), self._models[0])
        elif self.caught < self._throws and spin > self._throws_from:
            self._piece = "throw"
            action = self._figure(seam, height=HEIGHT)
        else:
            self._piece = "linear_acceleration"
            action = self._figure(seam, spin_gain=GAINS[self._piece])
        plan = diabolo.plan(
            seam.state,
            seam.joined(action.seed),
            action.goals,
            self._models,
            limits=LIMITS,
            freedom=action.freedom,
        )
        self._horizon.join(seam, plan, seam.time, 0.0)

    def _figure(self, seam: Any, **wanted: float) -> Any:
        home = _core.home_pose(self._piece, self._length)
        return _core.action(self._piece, *home, seam.state, self._length, **wanted)


def scenario(plant: Plant, axle: FreeAxle, home: NDArray[np.float64]) -> dict[str, Any]:
    hold = [{"type": "hold", "duration": WARM_UP}]
    asked = plant.scenario(
        (home[:3].tolist(), home[3:].tolist()), hold, axle.spin, {}, plant.seed, wander=False
    )
    asked["diabolo"] |= groove_of(axle)
    asked["start"] |= {"pitch_deg": axle.pitch, "yaw_deg": axle.yaw}
    return asked


def groove_of(axle: FreeAxle) -> dict[str, float]:
    return {
        "inertia_ratio": axle.inertia_ratio,
        "groove_radius": axle.groove_radius,
        "groove_half_width": axle.groove_half_width,
    }


Levelling: TypeAlias = diabolo.LevelHands | diabolo.LevelHorizon | LinearHands


def hands_that_level(plant: Plant, axle: FreeAxle, by: str) -> Levelling:
    """Hands that have learnt what they shall, by one of BY."""
    home = Playing(plant, axle.spin).home
    if by == "none":
        return StillHands(home, np.zeros((2, 2)), np.zeros(2))
    if by == "linear":
        shaking = Shaking(home, plant.seed)
        play_level(plant, axle._replace(pitch=0.0), "raise", shaking, LEARNS)
        return shaking.learnt(home)
    model = model_of(plant, axle)
    if by == "diagnosis":
        model = diagnosed(plant.program, filmed(plant, axle, home))
    kind = diabolo.LevelHorizon if by == "horizon" else diabolo.LevelHands
    return kind(model, home[:3], home[3:], axle.spin)


def filmed(plant: Plant, axle: FreeAxle, home: NDArray[np.float64]) -> dict[str, Any]:
    """Some seconds of play to learn from: hands to and fro, and one before the other."""
    elements: list[dict[str, Any]] = [
        {"type": "hold", "duration": 0.5},
        {"type": "swing", "amplitude": 0.1, "frequency": 0.7, "cycles": 3},
        {"type": "fore_aft", "amplitude": 0.08, "frequency": 0.6, "cycles": 3},
        {"type": "beat", "amplitude": 0.06, "frequency": 1.3, "cycles": 4},
        {"type": "fore_aft", "amplitude": 0.06, "frequency": 0.9, "cycles": 3},
        {"type": "hold", "duration": 0.5},
    ]
    asked = plant.scenario(
        (home[:3].tolist(), home[3:].tolist()), elements, FILMED, {}, plant.seed, wander=True
    )
    asked["diabolo"] |= groove_of(axle)
    return asked


def play_level(
    plant: Plant,
    axle: FreeAxle,
    what: str,
    level: Levelling,
    longest: float = math.inf,
) -> Levelled:
    """The plant's diabolo in a play of PLAYS, by hands that turn their motion to the axle."""
    rng = np.random.default_rng(plant.seed)
    throws: dict[str, dict[str, Any]] = {
        "throw": {"throws": THROWS},
        "catch": {"throws": 1, "throws_from": 0.0},
    }
    motion = Playing(plant, axle.spin, **throws.get(what, {}))
    hands = Hands(motion.home)
    rows: list[tuple[float, ...]] = []
    looks: list[NDArray[np.float64]] = []
    late = int(np.ceil(DELAY / 120.0 / PERIOD))
    thought = 0.0
    lost = True  # also where a tip touches the axle, which ends the plant's program
    with (
        contextlib.suppress(driver.FailedError),
        driver.LivePlay(plant.program, scenario(plant, axle, motion.home)) as live,
    ):
        for step in range(int(min(PLAYS[what], longest) / PERIOD)):
            moment = live.moment
            if moment.mode == "MISSED" or moment.position[2] < LOST:
                break
            if what == "throw" and motion.caught == THROWS:
                lost = False
                break
            tilt, yaw = angles(moment.axis)
            heading = float(np.degrees(level.heading))
            beside = (yaw - heading + 180.0) % 360.0 - 180.0
            rows.append((step * PERIOD, tilt, beside, heading, moment.spin))
            look = moment.axis + NOISE * rng.standard_normal(3)
            looks.append(look / np.linalg.norm(look))
            began = time.thread_time()
            see(level, looks[max(0, step - late)], moment, step * PERIOD, motion.path)
            thought += time.thread_time() - began
            level.advance(PERIOD)
            seen = as_the_hands_see(moment, level.heading + level.lead, motion.home)
            place, velocity = motion.at((step + 1) * PERIOD, seen)
            tips = level.tips(place[:3], place[3:], velocity[:3], velocity[3:])
            live.push(PERIOD, hands.towards(np.concatenate(tips[:2]), np.concatenate(tips[2:])))
        else:
            lost = False
    times, tilts, yaws, headings, spins = np.array(rows or [(0.0,) * 5]).T
    thought /= max(1, len(rows)) * PERIOD
    return Levelled(times, tilts, yaws, headings, spins, motion.caught, motion.caught_at, lost, thought)


def see(
    level: Levelling, axis: NDArray[np.float64], moment: driver.Moment, time: float, path: diabolo.TipPath
) -> None:
    """Show the hands the axle, and what else they look at."""
    mode = StringState[moment.mode]
    if isinstance(level, diabolo.LevelHorizon):
        level.see(time, State(moment.position, moment.velocity, moment.spin, mode, axis=axis), path)
    elif isinstance(level, diabolo.LevelHands):
        level.see(axis, moment.spin, mode)
    else:
        level.see(axis, moment.spin)


def as_the_hands_see(moment: driver.Moment, heading: float, home: NDArray[np.float64]) -> State:
    """The diabolo from hands that are turned: as it is before their motion is turned."""
    pivot, c, s = 0.5 * (home[:3] + home[3:]), np.cos(heading), np.sin(heading)
    back = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    place = pivot + back @ (moment.position - pivot)
    return State(place, back @ moment.velocity, moment.spin, StringState[moment.mode])


def angles(axis: NDArray[np.float64]) -> tuple[float, float]:
    """Tilt and yaw of the axle [deg]."""
    return (
        float(np.degrees(np.arctan2(axis[2], np.hypot(axis[0], axis[1])))),
        float(np.degrees(np.arctan2(axis[1], axis[0]))),
    )


def without_nutation(play: Levelled) -> NDArray[np.float64]:
    """How far the mean axle of NUTATION up to each time was off [deg]."""
    share = np.full(round(NUTATION / PERIOD), PERIOD / NUTATION)
    tilt, yaw = (np.abs(np.convolve(one, share)[: len(one)]) for one in (play.tilt, play.yaw))
    return np.maximum(tilt, yaw)


class Outcome(NamedTuple):
    """Whether one plant's play is what is wanted, what became of it, how far the axle was off from SOON on at
    most and in the median [deg], and how long the hands thought of it for a second of play [s]."""

    well: bool
    said: str
    most: float = math.inf
    median: float = math.inf
    thought: float = math.nan


def outcome(what: str, number: int, given: argparse.Namespace) -> Outcome:
    rng = np.random.default_rng([given.seed, number])
    plant = draw(given.plant, rng)
    axle = draw_axle(rng, TILT if what in ("back", "catch") else 0.0)
    try:
        play = play_level(plant, axle, what, hands_that_level(plant, axle, given.by))
    except ValueError as error:
        return Outcome(False, str(error))
    off = np.maximum(np.abs(play.tilt), np.abs(play.yaw))
    if what == "back":
        well = not play.lost and bool((off[play.time >= SOON] < LEVEL).all())
        then = off[np.searchsorted(play.time, SOON) - 1]
        said = f"tilt {abs(play.tilt[0]):.0f} deg, {then:.1f} after {SOON:g} s"
    elif what == "catch":
        from_then = play.time >= play.caught_at + SOON
        after, mean = off[from_then], without_nutation(play)[from_then]
        well = not play.lost and play.caught == 1 and bool((after < LEVEL).all())
        said = (
            f"{play.caught} caught, off by {after.max(initial=0.0):.1f} deg from {SOON:g} s after it on, "
            f"by {mean.max(initial=0.0):.1f} without nutation"
        )
    elif what == "throw":
        well = not play.lost and play.caught == THROWS
        said = f"{play.caught} throws caught, off by {off.max():.0f} deg at most"
    else:
        gained = float(play.spin.max() - play.spin[0])
        well = not play.lost and bool((off < LEVEL).all()) and gained >= RAISED
        said = f"off by {off.max():.1f} deg at most, {np.median(off):.1f} in the median, {gained:+.0f} rad/s"
    lost = f", lost after {play.time[-1]:.1f} s" if play.lost else ""
    said = f"{said}, hands turned by {np.abs(play.heading).max():.0f} deg{lost}"
    later = off[play.time >= SOON]
    if not len(later):
        return Outcome(well, said, thought=play.thought)
    return Outcome(well, said, float(later.max()), float(np.median(later)), play.thought)


def run(given: argparse.Namespace) -> int:
    driver.check(given.plant)

    def one(number: int) -> Outcome:
        play = outcome(given.what, number, given)
        print(f"plant {number}: {play.said}{'' if play.well else ' - FAILED'}", flush=True)
        return play

    with ThreadPoolExecutor(given.jobs) as pool:
        plays = list(pool.map(one, range(given.first, given.first + given.count)))
    well = sum(play.well for play in plays)
    most, median, thought = np.array([(play.most, play.median, play.thought) for play in plays]).T
    print(
        f"{given.what}, {given.by}: {well} of {given.count}; from {SOON:g} s on off by {np.median(most):.1f} "
        f"deg at most in the median plant, {max(most):.1f} in the worst, by {np.median(median):.2f} in the "
        f"median; {1e3 * np.nanmedian(thought):.1f} ms of thought for a second of play"
    )
    return 0 if well >= given.wanted * given.count else 1


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.proof.player.level", __doc__, EXAMPLE)
    parser.add_argument("what", choices=tuple(PLAYS))
    parser.add_argument("--count", metavar="N", type=int, default=10, help="plants (%(default)s)")
    parser.add_argument("--first", metavar="N", type=int, default=0, help="number of the first (%(default)s)")
    parser.add_argument("--seed", metavar="N", type=int, default=1, help="of the plants (%(default)s)")
    parser.add_argument("--jobs", metavar="N", type=int, default=1, help="plants at once (%(default)s)")
    parser.add_argument(
        "--wanted", metavar="SHARE", type=float, default=0.95,
        help="exit with 1 where fewer are well (%(default)s)",
    )  # fmt: skip
    parser.add_argument("--by", choices=BY, default="model", help="what levels (%(default)s)")
    driver.add_option(parser)
    return command.run(parser, run, arguments)


if __name__ == "__main__":
    sys.exit(main())
