# SPDX-License-Identifier: MIT
"""Others that level the axle: by a model that was diagnosed, and by a linear map that was learnt.

Both first see the plant play, and know of its axle nothing else. The map is that of Murooka, Okada and Inaba
("Diabolo orientation stabilization by learning predictive model for unstable unknown-dynamics juggling
manipulation", IROS 2020): what tilt and yaw do next is linear in what they are and in what the hands do.
Place and string are ignored, as there.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
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
