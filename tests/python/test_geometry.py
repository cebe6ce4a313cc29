# SPDX-License-Identifier: MIT
from __future__ import annotations

import pickle

import numpy as np
import pytest
from diabolo import Spheroid, TipMotion
from hypothesis import assume, example, given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray

LENGTH = 1.45
coordinates = st.floats(-2.0, 2.0)
points = hnp.arrays(np.float64, (3,), elements=coordinates)
tips = hnp.arrays(np.float64, (3,), elements=st.floats(-0.4, 0.4))  # never farther apart than the string
LEFT, RIGHT = np.array([0.1, 0.4, 1.0]), np.array([-0.1, -0.3, 1.2])


@given(left=tips, right=tips, point=points)
@example(left=np.zeros(3), right=np.full(3, 1.5e-151), point=np.zeros(3))  # the span's square underflows
def test_closest_points_are_on_the_surface_and_closest(
    left: NDArray[np.float64], right: NDArray[np.float64], point: NDArray[np.float64]
) -> None:
    spheroid = Spheroid(left, right, LENGTH)
    closest = spheroid.closest_point(point)
    assert abs(spheroid.path_length(closest) - LENGTH) < 1e-9
    distance = np.linalg.norm(point - closest)
    assert abs(abs(spheroid.signed_distance(point)) - distance) < 1e-12
    assert (spheroid.signed_distance(point) >= 0.0) == (spheroid.path_length(point) <= LENGTH)
    others = spheroid.radial_point(closest + 0.05 * np.random.default_rng(1).normal(size=(20, 3)))
    assert np.all(np.linalg.norm(point - others, axis=1) >= distance - 1e-9)


@given(point=points)
def test_normals_point_along_the_gradient_of_the_path_length(point: NDArray[np.float64]) -> None:
    spheroid = Spheroid(LEFT, RIGHT, LENGTH)
    assume(spheroid.path_length(point) > spheroid.tip_distance + 1e-3)
    step = 1e-6
    differences = [
        (spheroid.path_length(point + step * axis) - spheroid.path_length(point - step * axis)) / (2.0 * step)
        for axis in np.eye(3)
    ]
    assume(min(np.linalg.norm(point - LEFT), np.linalg.norm(point - RIGHT)) > 1e-2)
    np.testing.assert_allclose(spheroid.path_gradient(point), differences, atol=1e-6)
    normal = spheroid.normal(point)
    np.testing.assert_allclose(np.linalg.norm(normal), 1.0, rtol=1e-12)
    np.testing.assert_allclose(np.cross(normal, differences), 0.0, atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(spheroid.published_normal(point)), 1.0, rtol=1e-12)


def test_many_points_give_what_each_gives_alone() -> None:
    spheroid = Spheroid(LEFT, RIGHT, LENGTH)
    grid = np.random.default_rng(2).uniform(-2.0, 2.0, size=(4, 5, 3))
    for name in ("path_length", "signed_distance"):
        together = getattr(spheroid, name)(grid)
        assert together.shape == (4, 5)
        assert together[2, 3] == getattr(spheroid, name)(grid[2, 3])
    for name in ("closest_point", "radial_point", "normal", "published_normal", "path_gradient"):
        together = getattr(spheroid, name)(grid)
        assert together.shape == (4, 5, 3)
        assert together.flags.c_contiguous and together.dtype == np.float64
        np.testing.assert_array_equal(together[2, 3], getattr(spheroid, name)(grid[2, 3]))
        np.testing.assert_array_equal(together, getattr(spheroid, name)(np.asfortranarray(grid)))


def test_dropouts_stay_dropouts() -> None:
    spheroid = Spheroid(LEFT, RIGHT, LENGTH)
    track = np.array([[0.0, 0.0, 0.5], [np.nan, 0.0, 0.5]])
    assert np.isnan(spheroid.path_length(track)).tolist() == [False, True]
    assert np.isnan(spheroid.closest_point(track)).all(axis=1).tolist() == [False, True]
    with pytest.raises(ValueError, match="points: infinite at row 1; expected finite numbers, or NaN"):
        spheroid.closest_point([[0.0, 0.0, 0.5], [np.inf, 0.0, 0.5]])


def test_spheroid_tells_its_measures() -> None:
    spheroid = Spheroid([0.0, 0.3, 0.0], [0.0, -0.3, 0.0], 1.0)
    assert (spheroid.tip_distance, spheroid.semi_major) == (pytest.approx(0.6), 0.5)
    assert spheroid.semi_minor == pytest.approx(0.4)
    np.testing.assert_allclose(spheroid.axis, [0.0, 1.0, 0.0])
    np.testing.assert_allclose(spheroid.center, 0.0)
    assert not spheroid.overstretched
    assert Spheroid([0.0, 0.6, 0.0], [0.0, -0.6, 0.0], 1.0).overstretched


def test_wrong_shapes_say_expected_and_given() -> None:
    spheroid = Spheroid(LEFT, RIGHT, LENGTH)
    with pytest.raises(ValueError, match=r"points: shape \(4, 2\); expected \(\.\.\., 3\)"):
        spheroid.normal(np.zeros((4, 2)))
    with pytest.raises(ValueError, match=r"left: shape \(2,\); expected \(3,\)"):
        Spheroid([0.0, 0.0], RIGHT, LENGTH)
    with pytest.raises(ValueError, match="right: nan at index 1"):
        Spheroid(LEFT, [0.0, np.nan, 0.0], LENGTH)
    with pytest.raises(ValueError, match=r"string_length: .* must be > 0"):
        Spheroid(LEFT, RIGHT, 0.0)


TIMES = np.array([0.0, 0.1, 0.3, 0.4])
TIPS = np.random.default_rng(3).normal(size=(2, 4, 3))


@pytest.mark.parametrize("interpolation", ["held", "linear", "spline"])
def test_tip_motions_go_through_their_poses(interpolation: str) -> None:
    motion = TipMotion(TIMES, TIPS[0], TIPS[1], interpolation)
    left, right, _, _ = motion.at(TIMES)
    np.testing.assert_allclose(left, TIPS[0], atol=1e-14)
    np.testing.assert_allclose(right, TIPS[1], atol=1e-14)
    for time, index in ((-1.0, 0), (9.0, -1)):
        left, _, velocity, _ = motion.at(time)
        np.testing.assert_array_equal(left, TIPS[0][index])
        np.testing.assert_array_equal(velocity, 0.0)
    assert (len(motion), motion.begin, motion.end) == (4, 0.0, 0.4)


@pytest.mark.parametrize("interpolation", ["linear", "spline"])
def test_velocities_of_tips_are_derivatives(interpolation: str) -> None:
    motion = TipMotion(TIMES, TIPS[0], TIPS[1], interpolation)
    times, step = np.array([[0.05, 0.17], [0.22, 0.35]]), 1e-7
    before, after = motion.at(times - step), motion.at(times + step)
    assert motion.at(times)[0].shape == (2, 2, 3)
    for side in (0, 1):
        slope = (after[side] - before[side]) / (2.0 * step)
        np.testing.assert_allclose(motion.at(times)[2 + side], slope, atol=1e-5)


def test_held_tips_stay_until_the_next_pose() -> None:
    motion = TipMotion(TIMES, TIPS[0], TIPS[1], "held")
    np.testing.assert_array_equal(motion.at(0.299999)[0], TIPS[0][1])
    np.testing.assert_array_equal(motion.at(0.2)[2], 0.0)


def test_tip_motions_survive_pickling() -> None:
    motion = pickle.loads(pickle.dumps(TipMotion(TIMES, TIPS[0], TIPS[1], "spline")))
    np.testing.assert_array_equal(motion.times, TIMES)
    np.testing.assert_array_equal(motion.left, TIPS[0])
    np.testing.assert_array_equal(motion.right, TIPS[1])
    assert motion.interpolation == "spline"


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ((TIMES, TIPS[0][:3], TIPS[1]), r"left: shape \(3, 3\); expected \(4, 3\)"),
        ((TIMES[:, np.newaxis], TIPS[0], TIPS[1]), r"times: shape \(4, 1\); expected \(N,\)"),
        ((TIMES * 0.0, TIPS[0], TIPS[1]), "does not come after"),
        ((TIMES, TIPS[0] * np.nan, TIPS[1]), "not finite; fill dropouts first"),
        (([], np.zeros((0, 3)), np.zeros((0, 3))), "at least one"),
        ((TIMES, TIPS[0], TIPS[1], "cubic"), "'cubic'; expected one of 'held', 'linear', 'spline'"),
    ],
)
def test_bad_tip_motions_are_refused(arguments: tuple[object, ...], text: str) -> None:
    with pytest.raises(ValueError, match=text):
        TipMotion(*arguments)  # type: ignore[arg-type]
