# SPDX-License-Identifier: MIT
"""The estimator from Python: what it takes, what it gives, what it refuses; and forces of rollouts."""

from __future__ import annotations

import math

import numpy as np
import pytest
from diabolo import (
    LandingRestitution,
    Model,
    Parameters,
    State,
    StringElasticity,
    StringFriction,
    TipMotion,
    rollout,
)
from diabolo.estimate import Estimate, Estimator, ProcessNoise, Spread, with_rigid_string

MODEL = Model(Parameters(spin_coupling=0.0), string_friction=StringFriction(coefficient=0.2, spin_gain=3.0))
LEFT, RIGHT = np.array([0.0, 0.3, 1.0]), np.array([0.0, -0.3, 1.0])
HANGING = State([0.0, 0.0, 1.0 - math.sqrt(0.725**2 - 0.3**2)], [0.0] * 3, 100.0, string_state="on_string")
STILL = (np.zeros(3), np.zeros(3))


def estimator(**options: object) -> Estimator:
    return Estimator(MODEL, HANGING, (LEFT, RIGHT), **options)  # type: ignore[arg-type]


def held(one: Estimator, steps: int) -> Estimator:
    for _ in range(steps):
        one.step(LEFT, RIGHT, dt=0.002, velocities=STILL)
    return one


def hanging_forces() -> np.ndarray:
    tips = TipMotion([0.0], [LEFT], [RIGHT])
    found = rollout(
        MODEL, HANGING.to_array()[:7], tips, dt=1e-3, steps=2, string_state="on_string", forces=True
    )
    assert found.forces is not None
    return found.forces[-1]


def test_forces_of_a_rollout_carry_the_weight_and_are_left_out_unless_asked_for():
    forces = hanging_forces()
    assert forces.shape == (2, 3)
    weight = MODEL.parameters.mass * MODEL.parameters.gravity
    # Friction leans the pull, and the diabolo begins to slide: what it accelerates by is not carried.
    assert -forces[:, 2].sum() == pytest.approx(weight, rel=0.03)
    tips = TipMotion([0.0], [LEFT], [RIGHT])
    many = rollout(MODEL, [HANGING.to_array()[:7]] * 3, tips, steps=4, record_every=2, forces=True)
    assert many.forces is not None and many.forces.shape == (3, 2, 2, 3)
    assert rollout(MODEL, HANGING.to_array()[:7], tips, steps=4).forces is None


def test_an_estimate_has_a_state_a_covariance_and_intervals():
    now = held(estimator(spread=Spread(spin=5.0)), 5).now
    assert isinstance(now, Estimate)
    assert now.time == pytest.approx(0.01)
    assert now.covariance.shape == (9, 9)
    assert np.allclose(now.covariance, now.covariance.T)
    assert now.deviations[6] == pytest.approx(5.0, rel=0.01)
    low, high = now.interval(0.9)
    assert (high - low)[6] == pytest.approx(2 * 1.645 * now.deviations[6], rel=1e-3)
    assert sum(now.string_weights.values()) == pytest.approx(1.0)


def test_forces_tensions_and_a_camera_make_it_surer_and_late_ones_count():
    blind = held(estimator(), 100).now.deviations
    pulling = estimator()
    forces = hanging_forces()
    for _ in range(100):
        held(pulling, 1)
        assert pulling.forces(*forces) == "accepted"
    assert pulling.now.deviations[0] < 0.5 * blind[0]
    pulled = held(estimator(), 100)
    assert pulled.tensions(*np.linalg.norm(forces, axis=1)) == "accepted"
    assert pulled.now.deviations[2] <= blind[2]
    seeing = held(estimator(), 100)
    assert seeing.camera(0.1, HANGING.position, axle=[1.0, 0.0, 0.0], spin=101.0) == "accepted"
    assert seeing.now.deviations[0] < 0.6 * blind[0]
    assert 100.0 < seeing.now.state.spin < 101.5
    assert seeing.camera(0.1, HANGING.position) == "duplicate"
    assert seeing.camera(-5.0, HANGING.position) == "too_old"
    assert seeing.camera(5.0, HANGING.position) == "too_new"
    assert seeing.past(50).time == pytest.approx(0.1)


def test_what_cannot_be_used_is_refused_in_a_sentence():
    with pytest.raises(ValueError, match="string_elasticity"):
        Estimator(Model(string_elasticity=StringElasticity.of_stiffness(600.0)), HANGING, (LEFT, RIGHT))
    with pytest.raises(ValueError, match="process noise, spin"):
        estimator(noise=ProcessNoise(spin=0.0))
    with pytest.raises(ValueError, match="start spread, position"):
        estimator(spread=Spread(position=math.nan))
    with pytest.raises(ValueError, match="history"):
        estimator(history=-1)
    for tips in ((LEFT,), None, 0.3, np.array(0.3), "lr"):
        with pytest.raises(ValueError, match=r"tips: .*; expected one of the left and one of the right side"):
            Estimator(MODEL, HANGING, tips)  # type: ignore[arg-type]
    one = held(estimator(history=3), 5)
    with pytest.raises(ValueError, match="dt"):
        one.step(LEFT, RIGHT, dt=0.0, velocities=STILL)
    with pytest.raises(ValueError, match="velocities: None; expected one of the left"):
        one.step(LEFT, RIGHT, dt=0.002, velocities=None)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="camera, noise"):
        one.camera(0.01, [0.0, 0.0, 0.0], noise=0.0)
    with pytest.raises(ValueError, match="position"):
        one.camera(0.01, [0.0, math.nan, 0.0])
    with pytest.raises(ValueError, match="at most 3"):
        one.past(4)
    with pytest.raises(ValueError, match="share"):
        one.now.interval(1.0)


def test_a_model_without_stretch_bounces_at_a_catch_instead():
    elastic = Model(string_elasticity=StringElasticity.of_stiffness(1400.0, 5.0))
    rigid = with_rigid_string(elastic)
    assert rigid.string_elasticity == StringElasticity()
    assert 0.2 < rigid.landing_restitution.coefficient < 0.9
    assert elastic.string_elasticity.compliance > 0.0
    assert with_rigid_string("consistent").landing_restitution == LandingRestitution()
