# SPDX-License-Identifier: MIT
"""The string on a body of somebody else's simulator, from Python."""

from __future__ import annotations

import copy
import itertools
import pickle
from pathlib import Path

import diabolo
import numpy as np
import pytest
from diabolo import AttachedString, Model, Parameters, State, StringFriction, TipMotion, rollout
from diabolo.hosts import mujoco as host
from diabolo.robot import StickArm

DT, MASS, INERTIA = 1e-3, 0.2, 5.6e-4
GRAVITY = np.array([0.0, 0.0, -9.80665])


def hung() -> tuple[AttachedString, Model, list[float]]:
    model = Model(Parameters(mass=MASS), name="rubs", string_friction=StringFriction(coefficient=0.2))
    return AttachedString(model, MASS, INERTIA, GRAVITY), model, [0.0, 0.0, 0.7]


def swinging_tips(seconds: float) -> TipMotion:
    t = np.linspace(0.0, seconds, 101)
    sway = 0.05 * (1.0 - np.cos(5.0 * t))
    left = np.stack([sway, np.full_like(t, 0.4), 1.3 + sway], axis=1)
    return TipMotion(t, left, left * [-1.0, -1.0, 1.0], "spline")


def test_a_loop_of_ten_lines_is_a_host() -> None:
    string, model, place = hung()
    tips = swinging_tips(0.5)
    x, v, rate = np.array(place), np.zeros(3), -60.0
    samples = list(zip(*tips.at(np.arange(501) * DT), strict=True))
    for now, after in itertools.pairwise(samples):
        velocities = (*now[2:4], *after[2:4])
        wrench = string.step(x, v, [1, 0, 0], rate, *now[:2], *after[:2], DT, velocities=velocities)
        v = v + DT * (wrench.force / MASS + GRAVITY)
        x = x + DT * v
        rate += DT * wrench.torque[0] / INERTIA
    start = State(place, [0.0, 0.0, 0.0], 60.0, "loose")
    plain = rollout(model, start.to_array(), tips, dt=DT, steps=500, string_state="loose").states[-1]
    assert x == pytest.approx(plain[:3], abs=1e-7)
    assert -rate == pytest.approx(plain[6], abs=1e-3)
    assert wrench.left_tension > 0.0
    # What a tip gets is of the host's step, which is half a step off the predicted one.
    assert np.linalg.norm(wrench.on_left) == pytest.approx(wrench.left_tension, rel=0.03)


def test_what_is_kept_is_saved_and_put_back() -> None:
    string, _, place = hung()
    body = (
        place,
        [0.1, 0, 0],
        [1, 0, 0],
        -60.0,
        [0, 0.4, 1.3],
        [0, -0.4, 1.3],
        [0, 0.4, 1.3],
        [0, -0.4, 1.3],
        DT,
    )
    string.step(*body)
    kept = list(string.memory)
    first = string.step(*body)
    string.memory = kept
    assert string.step(*body).force.tolist() == first.force.tolist()
    assert kept[:3] != [0.0, 0.0, 0.0]
    for clone in (copy.copy(string), copy.deepcopy(string), pickle.loads(pickle.dumps(string))):
        assert clone.memory == string.memory
        assert clone.step(*body).force.tolist() == copy.copy(string).step(*body).force.tolist()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"mass": 0.0}, "both must be positive"),
        ({"axial_inertia": float("nan")}, "both must be positive"),
        ({"gravity": [0, 0]}, "gravity"),
        ({"motion": "leapfrog"}, "motion: 'leapfrog'; expected 'new_velocity' or 'constant_force'"),
    ],
)
def test_a_body_that_is_none_is_refused(changes: dict[str, object], words: str) -> None:
    given = {"model": Model(), "mass": MASS, "axial_inertia": INERTIA} | changes
    with pytest.raises(ValueError, match=words):
        AttachedString(**given)


def test_tips_too_far_apart_are_told() -> None:
    string, _, place = hung()
    for half, told in ((0.4, False), (0.8, True)):
        tips = [0, half, 1.3], [0, -half, 1.3]
        wrench = string.step(place, [0, 0, 0], [1, 0, 0], -60.0, *tips, *tips, DT)
        assert wrench.overstretched is told


def test_a_step_that_cannot_be_is_refused_and_changes_nothing() -> None:
    string, _, place = hung()
    tips = ([0, 0.4, 1.3], [0, -0.4, 1.3], [0, 0.4, 1.3], [0, -0.4, 1.3])
    for body, dt, words in (
        ((place, [0, 0, 0], [2, 0, 0], 0.0), DT, "axle: norm 2"),
        ((place, [0, 0, 0], [0, 0, 0], 0.0), DT, "axle: norm 0"),
        ((place, [0, 0, float("nan")], [1, 0, 0], 0.0), DT, "velocity"),
        ((place, [0, 0, 0], [1, 0, 0], 0.0), 0.0, "dt"),
    ):
        with pytest.raises(ValueError, match=words):
            string.step(*body, *tips, dt)
    with pytest.raises(ValueError, match="axle_rate: inf"):
        string.step(place, [0, 0, 0], [1, 0, 0], float("inf"), *tips, DT)
    assert string.memory == [0.0] * 6 + [1.0, 0.0]
    for memory, words in (([0.0] * 6 + [7.0, 0.0], r"memory\[6\]"), ([0.0] * 6, r"memory: shape \(6,\)")):
        with pytest.raises(ValueError, match=words):
            string.memory = memory


def test_the_headers_come_with_the_package() -> None:
    assert (Path(diabolo.get_include()) / "diabolo" / "hosts" / "attach.hpp").is_file()


def test_the_plugin_s_loader_says_what_it_lacks(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(host.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(RuntimeError, match=r"MuJoCo is not installed; expected it from: pip install"):
        host.build_plugin()
    monkeypatch.setenv("CXX", "no-such-compiler")
    with pytest.raises(RuntimeError, match="no C\\+\\+ compiler 'no-such-compiler'"):
        host._command(tmp_path, host.SOURCE)
    monkeypatch.setenv("CXX", 'g++ "')
    with pytest.raises(RuntimeError, match="No closing quotation"):
        host._command(tmp_path, host.SOURCE)
    for source in ("nope.cpp", Path("nope.cpp")):
        with pytest.raises(RuntimeError, match=r"^nope\.cpp: there is no such file; expected the source"):
            host.build_plugin(source)
    with pytest.raises(ValueError, match="source: 5; expected the name of a file"):
        host.build_plugin(5)


def test_scenes_are_refused_that_cannot_be() -> None:
    assert 'timestep="0.002"' in host.scene(timestep=np.float64(0.002))
    for timestep in (0.0, -1.0, float("inf"), float("nan"), 1e-320, 10**400, "x"):
        with pytest.raises(ValueError, match="timestep: "):
            host.scene(timestep=timestep)
    with pytest.raises(ValueError, match="expected a Model"):
        host.scene("published")
    with pytest.raises(ValueError, match="expected one of the left and one of the right"):
        host.cell([StickArm("left")])


def test_a_cache_that_cannot_be_written_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    monkeypatch.setattr(host, "_command", lambda folder, source: ["c++"])
    monkeypatch.setattr(host.importlib.metadata, "version", lambda name: "4.0.0")
    spec = host.importlib.util.spec_from_file_location("mujoco", tmp_path / "mujoco" / "__init__.py")
    monkeypatch.setattr(host.importlib.util, "find_spec", lambda name: spec)
    with pytest.raises(RuntimeError, match="XDG_CACHE_HOME"):
        host.build_plugin()
