# SPDX-License-Identifier: MIT
from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from diabolo import (
    Model,
    Parameters,
    StickFlex,
    StringElasticity,
    TipMotion,
    motions,
    rollout,
    rollout_gradient,
)
from numpy.typing import NDArray

TIPS = motions.swing(1.0)
FEW = TipMotion(
    np.linspace(0.0, 1.0, 9), *(side[:: len(TIPS) // 8][:9] for side in (TIPS.left, TIPS.right)), "spline"
)
START = np.array([0.5, 0.05, 0.42, 0.1, 0.2, 0.0, 100.0])  # the string comes taut on the way
STEPS = 700
SPRING = StringElasticity(compliance=1e-3, damping=2.0)


def final_state(model: Model, initial: NDArray[np.float64], tips: TipMotion) -> NDArray[np.float64]:
    return rollout(model, initial, tips, steps=STEPS, record_every=STEPS).states[-1]


def shifted(name: str, model: Model, index: tuple[int, ...], step: float) -> tuple[Model, Any, TipMotion]:
    """What the rollout depends on, with one component of one input moved by `step`."""
    initial, left, right = START.copy(), FEW.left.copy(), FEW.right.copy()
    changed = Model(**model.to_dict())
    if name in ("position", "velocity"):
        initial[index[0] + (3 if name == "velocity" else 0)] += step
    elif name == "spin":
        initial[6] += step
    elif name in ("left", "right"):
        (left if name == "left" else right)[index] += step
    else:
        effect, _, field = name.rpartition(".")
        fields = getattr(changed, effect) if effect else changed.parameters
        setattr(fields, field, getattr(fields, field) + step)
    return changed, initial, TipMotion(FEW.times, left, right, "spline")


INPUTS = {
    "position": (0,),
    "velocity": (1,),
    "spin": (),
    "left": (3, 2),
    "right": (5, 1),
    "string_length": (),
    "gravity": (),
    "mass": (),
    "axle_radius": (),
    "spin_coupling": (),
    "dissipation_rate": (),
    "string_elasticity.compliance": (),
    "string_elasticity.damping": (),
}


@pytest.mark.parametrize("law", ["rigid", "elastic"])
@pytest.mark.parametrize("name", INPUTS)
def test_derivatives_are_those_of_differences(name: str, law: str) -> None:
    if law == "rigid" and name.startswith("string_elasticity"):
        pytest.skip("a rigid string has no central difference by its compliance")
    model = Model(Parameters(dissipation_rate=0.1), string_elasticity=SPRING if law == "elastic" else None)
    index = INPUTS[name]
    result = rollout_gradient(model, START, FEW, [name], steps=STEPS)
    derivative = result.derivatives[name][(slice(None), *index)]
    step = {"string_elasticity.compliance": 1e-8, "axle_radius": 1e-8}.get(name, 1e-6)
    ends = [final_state(*shifted(name, model, index, sign * step)) for sign in (1.0, -1.0)]
    difference = (ends[0] - ends[1]) / (2.0 * step)
    np.testing.assert_allclose(
        derivative, difference, rtol=2e-4, atol=2e-5 * (1.0 + np.abs(difference).max())
    )
    if name not in ("mass", "spin", "axle_radius", "spin_coupling"):
        assert np.abs(derivative[:6]).max() > 1e-3


def test_the_value_is_that_of_the_rollout() -> None:
    result = rollout_gradient(Parameters(), START, FEW, ["mass"], steps=STEPS)
    np.testing.assert_allclose(result.state, final_state(Model(), START, FEW), atol=1e-9)
    assert result.string_state.name == "ON_STRING"


def test_sticks_bend_in_the_gradient_as_in_the_rollout() -> None:
    sticks = (np.tile(stick, (len(FEW), 1)) for stick in ([0.8, 0.6, 0.0], [0.0, -0.6, 0.8]))
    pointed = TipMotion(FEW.times, FEW.left, FEW.right, "spline", *sticks)
    model = Model(stick_flex=StickFlex(compliance=5e-3, damping=2.0))
    result = rollout_gradient(model, START, pointed, ["mass"], steps=STEPS)
    np.testing.assert_allclose(result.state, final_state(model, START, pointed), atol=1e-9)
    assert np.abs(result.state - final_state(model, START, FEW)).max() > 1e-3


def test_shapes_and_threads() -> None:
    names = ["position", "velocity", "spin", "left", "right", "string_length"]
    one, two = (rollout_gradient(Parameters(), START, FEW, names, steps=STEPS, threads=n) for n in (1, 2))
    shapes = {name: derivative.shape for name, derivative in one.derivatives.items()}
    assert shapes == {
        "position": (7, 3),
        "velocity": (7, 3),
        "spin": (7,),
        "left": (7, 9, 3),
        "right": (7, 9, 3),
        "string_length": (7,),
    }
    for name in names:
        np.testing.assert_array_equal(one.derivatives[name], two.derivatives[name])


def test_free_flight_has_the_derivatives_of_its_formula() -> None:
    result = rollout_gradient(
        Parameters(),
        [0.5, 0.0, 3.0, 0.0, 0.0, 0.0, 50.0],
        TIPS,
        ["velocity", "gravity"],
        steps=400,
        string_state="flying",
    )
    np.testing.assert_allclose(result.derivatives["velocity"][:3], 0.4 * np.eye(3), atol=1e-12)
    np.testing.assert_allclose(result.derivatives["velocity"][3:6], np.eye(3), atol=1e-12)
    np.testing.assert_allclose(result.derivatives["gravity"][:6], [0, 0, -0.08, 0, 0, -0.4], atol=1e-12)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"with_respect_to": ["masss"]}, "'masss'; expected position, velocity, spin, left, right"),
        ({"initial": START[np.newaxis]}, r"initial: shape \(1, 7\); expected \(7,\)"),
        ({"dt": -1.0}, "dt: -1"),
        ({"steps": -1}, "steps: -1"),
        ({"threads": -2}, "threads: -2"),
    ],
)
def test_bad_input_is_named(change: dict[str, Any], text: str) -> None:
    arguments: dict[str, Any] = {"initial": START, "with_respect_to": ["mass"], "steps": 10, **change}
    with pytest.raises(ValueError, match=text):
        rollout_gradient(Parameters(), arguments.pop("initial"), TIPS, **arguments)


def test_what_is_not_finite_does_not_travel_on() -> None:
    with pytest.raises(FloatingPointError, match="not finite"):
        rollout_gradient(
            Parameters(),
            [0, 0, 0, 1e308, 0, 0, 0],
            TIPS,
            ["mass"],
            dt=0.02,
            steps=1000,
            string_state="flying",
        )
