# SPDX-License-Identifier: MIT
"""A play that goes on step by step: hands, diabolo, and what is recorded of them."""

from __future__ import annotations

import json
from array import array

import numpy as np
from numpy.typing import NDArray

from .._core import (
    Model,
    Predictor,
    Recording,
    StepStatus,
    played_orientation,
    played_properties,
    played_recording,
)
from ..enums import StringState
from ..player import hang_at_rest
from ..rollout import FARTHEST
from .hands import Hands, in_plane
from .wish import Wish

DT = 1e-3
"""Length of a step [s]."""
STEPS_PER_SAMPLE = 8
RATE = 1.0 / (DT * STEPS_PER_SAMPLE)
"""Sampling rate of what is recorded [Hz]."""
COLUMNS = 16  # both tips, position, velocity, spin, axis


class Stretch:
    """Samples between one beginning and the next."""

    def __init__(self) -> None:
        self.rows = array("d")
        self.string_states = array("B")

    def __len__(self) -> int:
        return len(self.string_states)


class Play:
    """Begins with a diabolo that hangs at rest and spins by `spin` [rad/s] under hands at home."""

    def __init__(self, model: Model, spin: float) -> None:
        self.model, self.spin = model, spin
        self.predictor = Predictor(model)
        self.hands = Hands(model.parameters.string_length)
        self.properties = played_properties(model.parameters)
        self.wish = Wish()
        self.stretches = 0
        self.longest = self.current = Stretch()
        self.owed = self.turned = 0.0
        self._hang()

    def obey(self, wish: Wish) -> None:
        self.wish = wish
        if wish.begin == "again":
            self._hang()
        elif wish.begin == "spin":
            self.state.spin = self.spin
            self._begin_stretch()

    def advance(self, seconds: float) -> None:
        """Play on for so much of the clock; what is less than a step is owed."""
        self.owed += seconds * self.wish.speed
        wanted = in_plane((self.wish.left, self.wish.right))
        count = round(self.owed // DT)
        self.owed -= count * DT
        pulled = np.zeros(2)
        for _ in range(count):
            try:
                pulled += self._step(wanted).tensions
            except FloatingPointError:  # the model leaves what numbers can hold
                return self._hang()
            if self._is_dropped():
                return self._hang()
            if self.steps % STEPS_PER_SAMPLE == 0:
                self._sample()
        if count:
            self.tensions = pulled / count

    def frame(self) -> str:
        """What the page shows, as JSON: places [m], orientation x, y, z, w, spin [rad/s], tensions [N]."""
        shown = {
            "stretch": self.stretches,
            "time": round(self.steps * DT, 3),
            "left": self.hands.position[0].round(4).tolist(),
            "right": self.hands.position[1].round(4).tolist(),
            "diabolo": self.state.position.round(4).tolist(),
            "orientation": played_orientation(self.state.axis, self.turned).round(4).tolist(),
            "spin": round(self.state.spin, 1),
            "string": StringState(self.state.string_state).name.lower(),
            "tensions": self.tensions.round(2).tolist(),
        }
        return json.dumps(shown, allow_nan=False, separators=(",", ":"))

    def recording(self, name: str) -> tuple[Recording, NDArray[np.uint8]] | None:
        """The longest stretch between two beginnings and its string states; None where nothing was played."""
        longest = max(self.longest, self.current, key=len)
        if len(longest) < 2:
            return None
        rows = np.array(longest.rows[: len(longest) * COLUMNS]).reshape(-1, COLUMNS)
        time = np.arange(len(rows)) / RATE
        take = played_recording(
            name,
            time,
            rows[:, :3],
            rows[:, 3:6],
            rows[:, 6:13],
            RATE,
            self.properties,
            self.model.parameters.string_length,
            rows[:, 13:],
        )
        return take, np.array(longest.string_states, dtype=np.uint8)

    def _step(self, wanted: NDArray[np.float64]) -> StepStatus:
        before, velocities = self.hands.position, self.hands.velocity
        self.hands.follow(wanted, DT)
        after = self.hands.position
        velocities = np.concatenate([velocities, self.hands.velocity])
        time = self.steps * DT
        status = self.predictor.step(
            self.state, before[0], before[1], after[0], after[1], DT, list(velocities), time=time
        )
        self.turned = (self.turned + self.state.spin * DT) % (4.0 * np.pi)
        self.steps += 1
        return status

    def _is_dropped(self) -> bool:
        """Whether it is a string's length below the hands, or far away."""
        position = self.state.position
        depth = self.hands.position[:, 2].min() - position[2]
        return bool(depth > self.model.parameters.string_length or np.abs(position).max() > FARTHEST)

    def _hang(self) -> None:
        """At rest below hands at rest where the pointer wants them."""
        self.hands.rest_at(in_plane((self.wish.left, self.wish.right)))
        left, right = self.hands.position
        self.state = hang_at_rest(self.model, left, right, self.spin)
        self.tensions = np.zeros(2)
        self._begin_stretch()

    def _begin_stretch(self) -> None:
        self.longest = max(self.longest, self.current, key=len)
        self.current = Stretch()
        self.stretches += 1
        self.steps = 0
        self._sample()

    def _sample(self) -> None:
        self.current.rows.extend((*self.hands.position.ravel(), *self.state.to_array(), *self.state.axis))
        self.current.string_states.append(self.state.string_state)
