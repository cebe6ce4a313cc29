# SPDX-License-Identifier: MIT
"""Others that level the axle: by a model that was diagnosed, by a linear map that was learnt, and with
hands that calm its nutation.

The first two see the plant play before, and know of its axle nothing else. The map is that of Murooka, Okada
and Inaba ("Diabolo orientation stabilization by learning predictive model for unstable unknown-dynamics
juggling manipulation", IROS 2020): what tilt and yaw do next is linear in what they are and in what the hands
do. Place and string are ignored, as there.
"""

from __future__ import annotations

import tempfile
from collections import deque
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
from diabolo.enums import StringState
from numpy.typing import NDArray

from .. import plant as driver

AHEAD, HORIZON = 0.25, 0.5
"""Over which the map is learnt, and over which it predicts [s]."""
SHAKEN, SHAKES = 0.3, 0.6
"""How far the hands lead to learn it [rad], and how long each time [s]."""
LEARNS = 20.0
"""How long they do [s]."""
STEADY, CALM, LEVEL = 0.5, 0.3, 0.05
"""A turn [rad/s], a lead and an angle of the axle [rad] that cost one, as LevelHands weigh them."""
LATE = 0.03
"""From the axle to what is seen of it [s]."""
NUTES = 0.03
"""A nutation that is calmed [rad]."""
SHAKE = 0.8 * 9.81
"""How hard the hands shake; less than gravity, so that the string stays taut [m/s^2]."""
SWAY, SWAYS = 0.15, 1.0
"""How far they lead to one side and the other meanwhile [rad], and how long both take [s]."""
FULL = 0.1
"""From which lead on they shake in full [rad]."""


def diagnosed(program: Path, scenario: dict[str, Any]) -> diabolo.Model:
    """The model that a diagnosis makes of a filmed play of the plant. Raises ValueError where it has no gain
    that would turn the axle."""
    with tempfile.TemporaryDirectory() as folder:
        take = Path(folder) / "take.csv"
        driver.play(program, scenario, take)
        recording = diabolo.load_recording(take)
    found = diabolo.diagnose([recording], threads=1).model
    if not found.gyroscopic_tilt.gain:
        raise ValueError("the diagnosis has no gain of gyroscopic_tilt")
    return diabolo.model_for(found, recording)


class LinearHands:
    """Hands that are turned as LevelHands are, by a linear map in place of a model's regulator.

    The rates of tilt and of the axle's yaw are `drift` (tilt, beside) + `drive` lead, over the spin; beside
    is the yaw against the heading.
    """

    def __init__(
        self, home: NDArray[np.float64], drift: NDArray[np.float64], drive: NDArray[np.float64]
    ) -> None:
        self._pivot, self._drift, self._drive = 0.5 * (home[:3] + home[3:]), drift, drive
        self.heading = self.lead = 0.0
        self._lead_rate = self._turn = self._wanted_lead = self._wanted_turn = 0.0

    def want(self, lead: float, turn: float) -> None:
        self._wanted_lead, self._wanted_turn = (
            float(np.clip(lead, -0.9, 0.9)),
            float(np.clip(turn, -1.0, 1.0)),
        )

    def see(self, axis: NDArray[np.float64], spin: float) -> None:
        """Take the lead and the turn after which the map predicts the least tilt and yaw, and which cost
        little."""
        tilt = np.arctan2(axis[2], np.hypot(axis[0], axis[1]))
        beside = (np.arctan2(axis[1], axis[0]) - self.heading + np.pi) % (2.0 * np.pi) - np.pi
        now = np.array([tilt, beside])
        later = now + HORIZON * self._drift @ now / spin
        answer = HORIZON * np.array([[self._drive[0] / spin, 0.0], [self._drive[1] / spin, -1.0]])
        rows = np.vstack([answer / LEVEL, np.diag([1.0 / CALM, 1.0 / STEADY])])
        self.want(*np.linalg.lstsq(rows, np.concatenate([-later / LEVEL, [0.0, 0.0]]), rcond=None)[0])

    def advance(self, dt: float, quickness: float = 10.0) -> None:
        fade = np.exp(-quickness * dt)
        gap = self.lead - self._wanted_lead
        pushed = self._lead_rate + quickness * gap
        self.lead = self._wanted_lead + (gap + pushed * dt) * fade
        self._lead_rate = (self._lead_rate - quickness * pushed * dt) * fade
        turn = self._wanted_turn + (self._turn - self._wanted_turn) * fade
        self.heading += 0.5 * (self._turn + turn) * dt
        self._turn = turn

    def tips(
        self,
        left: NDArray[np.float64],
        right: NDArray[np.float64],
        left_velocity: NDArray[np.float64],
        right_velocity: NDArray[np.float64],
    ) -> tuple[NDArray[np.float64], ...]:
        c, s = np.cos(self.heading + self.lead), np.sin(self.heading + self.lead)
        turned = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        rate = np.array([0.0, 0.0, self._turn + self._lead_rate])
        places = [self._pivot + turned @ (tip - self._pivot) for tip in (left, right)]
        velocities = [
            turned @ velocity + np.cross(rate, place - self._pivot)
            for velocity, place in zip((left_velocity, right_velocity), places, strict=True)
        ]
        return (*places, *velocities)


class StillHands(LinearHands):
    """Hands that do not turn, whatever they see."""

    def see(self, axis: NDArray[np.float64], spin: float) -> None:
        pass


class Shaking(LinearHands):
    """Hands that lead to one side and the other, to learn from; they keep what they saw."""

    def __init__(self, home: NDArray[np.float64], seed: int) -> None:
        super().__init__(home, np.zeros((2, 2)), np.zeros(2))
        self._rng, self._seen = np.random.default_rng(seed), list[tuple[float, ...]]()

    def see(self, axis: NDArray[np.float64], spin: float) -> None:
        if len(self._seen) % round(SHAKES / 0.01) == 0:
            self.want(self._rng.uniform(-SHAKEN, SHAKEN), 0.0)
        yaw = np.arctan2(axis[1], axis[0])
        self._seen.append((np.arctan2(axis[2], np.hypot(axis[0], axis[1])), yaw, self.lead, spin))

    def learnt(self, home: NDArray[np.float64]) -> LinearHands:
        """By least squares on the change over AHEAD."""
        tilt, yaw, lead, spin = np.array(self._seen).T
        yaw = np.unwrap(yaw)
        step = round(AHEAD / 0.01)
        means = [
            np.convolve(one, np.full(step, 1.0 / step), "valid")[:-1] for one in (tilt, yaw, lead, 1.0 / spin)
        ]
        features = np.column_stack(means[:3]) * means[3][:, None]
        rates = np.column_stack([one[step:] - one[:-step] for one in (tilt, yaw)]) / AHEAD
        found = np.linalg.lstsq(features, rates, rcond=None)[0].T
        return LinearHands(home, found[:, :2], found[:, 2])


class CalmingHands:
    """LevelHands that take the nutation out of the axle.

    A pull tilts the axle by as much as the hands lead. Under a lead they shake up and down with the nutation:
    what pulls harder while the axle goes against the tilt takes from it, each turn a little. The lead sways
    from one side to the other, so that the mean axle stays. The nutation is that part of the seen axle
    which turns with spin / inertia_ratio.
    """

    def __init__(self, model: diabolo.Model, home: NDArray[np.float64], spin: float) -> None:
        self._level = diabolo.LevelHands(model, home[:3], home[3:], spin)
        self._sway = LinearHands(home, np.zeros((2, 2)), np.zeros(2))
        self._ratio = model.gyroscopic_tilt.inertia_ratio
        self._looks: deque[complex] = deque(maxlen=26)
        self._nutation = 0j
        self._rate = spin / self._ratio
        self._phase = self._time = self._share = 0.0
        self._flies = False

    @property
    def heading(self) -> float:
        return self._level.heading

    @property
    def lead(self) -> float:
        return self._level.lead + self._sway.lead

    def see(self, axis: NDArray[np.float64], spin: float, string: StringState) -> None:
        self._level.see(axis, spin, string)
        self._rate = spin / self._ratio
        tilt = np.arctan2(axis[2], np.hypot(axis[0], axis[1]))
        beside = (np.arctan2(axis[1], axis[0]) - self.heading + np.pi) % (2.0 * np.pi) - np.pi
        self._looks.append(complex(tilt, beside))
        swing = self._looks[-1] - np.mean(self._looks)
        then = np.exp(-1j * (self._phase - self._rate * LATE))
        self._nutation += 0.06 * (swing * then - self._nutation)
        calms = abs(self._nutation) > NUTES and string == StringState.ON_STRING
        self._share += 0.06 * (calms - self._share)
        self._flies = string == StringState.FLYING

    def advance(self, dt: float) -> None:
        self._level.advance(dt)
        self._time += dt
        self._phase += self._rate * dt
        turn = 2.0 * np.pi / SWAYS
        self._sway.lead = self._share * SWAY * np.sin(turn * self._time)
        self._sway._lead_rate = self._share * SWAY * turn * np.cos(turn * self._time)

    def tips(self, *motion: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
        left, right, left_velocity, right_velocity = self._sway.tips(*self._level.tips(*motion))
        if not self._flies:
            # A positive gain is that of a pull which tilts the way that the hands lead.
            hard = np.sign(self._level.gains[0, 0]) * np.clip(self.lead / FULL, -1.0, 1.0)
            now = np.exp(1j * (self._phase + np.angle(self._nutation)))
            size = self._share * SHAKE * hard / self._rate
            up = np.array([0.0, 0.0, 1.0])
            left, right = (tip - up * size * now.real / self._rate for tip in (left, right))
            left_velocity, right_velocity = (
                v + up * size * now.imag for v in (left_velocity, right_velocity)
            )
        return left, right, left_velocity, right_velocity
