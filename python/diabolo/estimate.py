# SPDX-License-Identifier: MIT
"""Where the diabolo is, by forces on the tips and a camera: docs/estimation.md."""

from __future__ import annotations

import copy
import math
from collections.abc import Sequence
from statistics import NormalDist
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import LandingRestitution, Model, State, StickArm, StickFlex, StringElasticity
from .checks import instance_of, is_several, model_of, number, shown, whole_number
from .enums import StringState

Pair = Sequence[ArrayLike]
"""Of the left and of the right side."""

LONGEST_HISTORY = 100_000


class Spread(NamedTuple):
    """Standard deviations of what is known at the beginning."""

    position: float = 0.02
    """Of each coordinate [m]."""
    velocity: float = 0.1
    """Of each coordinate [m/s]."""
    spin: float = 10.0
    """[rad/s]"""
    axle: float = 0.05
    """[rad]"""


class ProcessNoise(NamedTuple):
    """What the model does not know. The first three are white: their effect grows with the root of time."""

    acceleration: float = 0.05
    """Unknown, of the diabolo [m/s^2/sqrt(Hz)]: [m/s] after a second."""
    spin: float = 2.0
    """Unknown, of the spin [rad/s^2/sqrt(Hz)]."""
    axle: float = 0.02
    """Unknown turning of the axle [rad/s/sqrt(Hz)]."""
    tension: float = 0.05
    """Of a strand's tension, a share of it."""
    direction: float = 4e-3
    """Of a strand [rad]."""
    string_length: float = 3e-3
    """Error and stretch [m]."""
    string_rate: float = 0.1
    """At which the string stretches [m/s]."""


class Estimate(NamedTuple):
    """The diabolo at a time, as far as it is known."""

    time: float
    """[s]"""
    state: State
    covariance: NDArray[np.float64]
    """Of position [m], velocity [m/s], spin [rad/s] and the axle's direction [rad], shape (9, 9)."""
    string_weights: dict[StringState, float]
    """How likely the string is on the axle, loose or off it."""
    normalized_innovation_squared: float
    """Squared innovation of the last pulls over its covariance, of each number; 1 is expected."""
    gated: bool
    """Whether a tension failed the innovation gate: the measured ones then move the diabolo, for the model's
    string could not have them."""

    @property
    def deviations(self) -> NDArray[np.float64]:
        """Standard deviations of what the covariance is of, shape (9,)."""
        return np.sqrt(np.diag(self.covariance))

    def interval(self, share: float = 0.9) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Ends of the central intervals that hold position, velocity and spin, each with this probability.

        Two arrays of the shape (7,).
        """
        if not 0.0 < (share := number("share", share)) < 1.0:
            raise ValueError(f"share: {share:g}; expected a number between 0 and 1")
        half = self.deviations[:7] * NormalDist().inv_cdf(0.5 + 0.5 * share)
        centre = self.state.to_array()[:7]
        return centre - half, centre + half


class Estimator:
    """Estimates position, velocity, spin and axle from the tips' motion and from any of: forces on the tips,
    tensions, joint torques of two arms, a camera.

    A square-root unscented Kalman filter whose process is the predictor. Measurements may come late, and in
    any order: it goes back, and the estimate is as if they had come in time.

        estimator = Estimator(model, start, (left, right), history=100)
        estimator.step(left, right, dt=0.002, velocities=(left_velocity, right_velocity))
        estimator.forces(on_left, on_right, noise=0.1)
        estimator.camera(seen_at, position, noise=0.005)
        estimator.now.interval(0.9)

    Each measurement tells what became of it: "accepted"; "too_old", from before the history;
    "too_new", from after the last step; "duplicate", its step has one of that kind.

    Raises ValueError about bad input.
    """

    def __init__(
        self,
        model: Model | str,
        start: State,
        tips: Pair,
        *,
        time: float = 0.0,
        spread: Spread | None = None,
        noise: ProcessNoise | None = None,
        history: int = 100,
    ) -> None:
        """Begin from a state, how sure it is (`spread`), and the tips [m] at that time [s].

        model: its string must neither stretch nor bend its sticks, see `with_rigid_string`.
        history: steps that a late measurement may go back.
        """
        left, right = _pair("tips", tips)
        self._own = _core.Estimator(
            model_of("model", model),
            instance_of("start", start, State),
            left,
            right,
            list(instance_of("spread", spread or Spread(), Spread)),
            list(instance_of("noise", noise or ProcessNoise(), ProcessNoise)),
            number("time", time),
            whole_number("history", history, 0, LONGEST_HISTORY),
        )

    @property
    def now(self) -> Estimate:
        """At the end of the last step."""
        return _estimate(self._own.now())

    def past(self, ago: int) -> Estimate:
        """At the end of the step `ago` steps before the last one, by what is known by now."""
        return _estimate(self._own.past(whole_number("ago", ago, 0, LONGEST_HISTORY)))

    def step(self, left: ArrayLike, right: ArrayLike, *, dt: float, velocities: Pair) -> None:
        """Move on by `dt` [s] to where the tips are at `left` and `right` [m], with `velocities` [m/s]."""
        self._own.step(left, right, *_pair("velocities", velocities), number("dt", dt))

    def forces(
        self, left: ArrayLike, right: ArrayLike, *, noise: float = 0.1, time: float | None = None
    ) -> str:
        """Update by the string's forces on the tips [N], world frame, at the step's end nearest to `time`.

        Without what sticks and arms weigh; `noise` is of each component, `time` by default that of the last
        step.
        """
        return str(self._own.update_by_forces(left, right, number("noise", noise), time))

    def tensions(self, left: float, right: float, *, noise: float = 0.1, time: float | None = None) -> str:
        """Update by the tensions of the strands alone [N]; `noise` and `time` as for `forces`."""
        return str(
            self._own.update_by_tensions(
                number("left", left), number("right", right), number("noise", noise), time
            )
        )

    def torques(
        self,
        arms: Sequence[StickArm],
        joints: Pair,
        torques: Pair,
        *,
        noise: float = 0.2,
        time: float | None = None,
    ) -> str:
        """Update by the string's torques [N m] on the joints [rad] of two `StickArm`, left and right.

        Less what arms, sticks and their motion need. `noise` [N m] is of each joint; `time` as for `forces`.
        """
        return str(self._own.update_by_torques(arms, joints, torques, number("noise", noise), time))

    def camera(
        self,
        time: float,
        position: ArrayLike,
        *,
        noise: float = 5e-3,
        axle: ArrayLike | None = None,
        axle_noise: float = 0.02,
        spin: float | None = None,
        spin_noise: float = 1.0,
    ) -> str:
        """Update by what a camera saw at `time` [s], whenever that becomes known: the position [m] and,
        where it sees them, the axle (a unit vector, noise in [rad]) and the spin [rad/s].
        """
        return str(
            self._own.update_by_camera(
                number("time", time),
                position,
                number("noise", noise),
                axle,
                number("axle_noise", axle_noise),
                spin,
                number("spin_noise", spin_noise),
            )
        )


def with_rigid_string(model: Model | str) -> Model:
    """A model for an `Estimator`: its string does not stretch, and its sticks do not bend.

    A bounce of the string becomes what a catch gives back of it: exp(-pi z / sqrt(1 - z^2)) of its speed, z
    the share of the critical damping. Where the sticks bend, positions are off by as much.
    """
    rigid = copy.copy(model_of("model", model))
    elasticity = rigid.string_elasticity
    if elasticity.compliance > 0.0:
        # Both strands of a hanging diabolo lengthen its path: at most by two for each way down.
        critical = math.sqrt(rigid.parameters.mass / elasticity.compliance)
        damping = min(elasticity.damping / critical, 0.99)
        rigid.landing_restitution = LandingRestitution(
            coefficient=math.exp(-math.pi * damping / math.sqrt(1.0 - damping**2))
        )
    rigid.string_elasticity, rigid.stick_flex = StringElasticity(), StickFlex()
    return rigid


def _estimate(belief: _core.Belief) -> Estimate:
    weights = dict(zip(StringState, belief.string_weights, strict=True))
    return Estimate(
        belief.time,
        belief.state,
        belief.covariance,
        weights,
        belief.normalized_innovation_squared,
        belief.gated,
    )


def _pair(name: str, given: Pair) -> tuple[ArrayLike, ArrayLike]:
    sides = list(given) if is_several(given) else []
    if len(sides) != 2:
        raise ValueError(f"{name}: {shown(given)}; expected one of the left and one of the right side")
    return sides[0], sides[1]
