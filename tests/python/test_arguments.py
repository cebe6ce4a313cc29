# SPDX-License-Identifier: MIT
"""What holds for the arguments and objects of every function: sentences, masks, copies, short texts."""

from __future__ import annotations

import copy
import inspect
import pickle
import re
import subprocess
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import diabolo
import numpy as np
import pytest
from diabolo import Parameters, Recording, State, TipMotion, robot

HELD = TipMotion([0.0], [[0.0, 0.3, 0.0]], [[0.0, -0.3, 0.0]])
LONG = "x" * 10_000
NO_AXIS = (np.array("x"), np.array(object()))
MASKED = np.ma.masked_greater(np.arange(7.0), 5.5)


# ---- sentences ----


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: State("here"), "State: position: 'here'; expected an array of numbers"),
        (lambda: State(), "State: position: missing; expected an array of numbers"),
        (
            lambda: State([0.0, 0.0, 0.0], speed=1.0),
            "State: speed: no argument of this name; expected position, velocity, spin, string_state, axis",
        ),
        (lambda: State(*range(9)), "State: one argument too many, 7; expected position, velocity, spin,"),
        (
            lambda: State([0.0, 0.0, 0.0], position=[0.0, 0.0, 0.0]),
            "State: position: given twice, at last [0.0, 0.0, 0.0]; expected once",
        ),
        (lambda: setattr(State([0.0, 0.0, 0.0]), "spin", "fast"), "State.spin: 'fast'; expected a number"),
        (
            lambda: diabolo.Predictor(3),
            "Predictor: parameters: 3; expected Parameters; or model: 3; expected Model",
        ),
        (
            lambda: diabolo.Predictor(Parameters()).step(
                State([0.0, 0.0, 0.0]), *[np.zeros((99, 3))] * 4, dt="1 ms"
            ),
            "Predictor.step: dt: '1 ms'; expected a number",
        ),
        (
            lambda: diabolo.Waypoint(np.zeros((99, 99))),
            "Waypoint: position: an array of the shape (99, 99), float64; expected an array of numbers of "
            "the shape (3,)",
        ),
        (
            lambda: TipMotion([0.0], [[0.0, 0.3, 0.0]], [[0.0, -0.3, 0.0]], 3),
            "TipMotion: interpolation: 3; expected a str",
        ),
        (
            lambda: diabolo.baseline(np.zeros(999)),
            "baseline: recording: an array of the shape (999,), float64;",
        ),
        (
            lambda: diabolo.Predictor(Parameters()).step(
                State([0.0, 0.0, 0.0]), *[np.zeros(3)] * 4, dt=1e-3, velocities=[np.zeros(3)] * 3
            ),
            "Predictor.step: velocities: [array([0., 0., 0.]), array([0., 0., 0.]), array([0., 0.,...; "
            "expected a list, each an array of numbers, 4 of them or None",
        ),
        (lambda: diabolo.Goals(waypoints=[3]), "Goals: waypoints: [3]; expected a list, each Waypoint"),
        (lambda: robot.StickMap(1, 2), "StickMap: arm: 1; expected StickArm"),
        (lambda: State([0.0, 0.0, 0.0], spin=10**400), "State: spin: 1000000000"),
        (lambda: State([10**400, 0.0, 0.0]), "State: position: [1000000000"),
        (lambda: diabolo.plan_action("hop", spin_gain=10**400), "plan_action: spin_gain: 1000000000"),
    ],
)
def test_an_argument_that_does_not_fit_is_named(call: Callable[[], Any], sentence: str) -> None:
    with pytest.raises(TypeError) as error:
        call()
    assert str(error.value).startswith(sentence)
    assert "\n" not in str(error.value) and len(str(error.value)) < 200


def test_a_method_of_a_recording_names_its_argument(played: Recording) -> None:
    with pytest.raises(TypeError, match=r"^Recording\.cut: first: 1\.5; expected a whole number$"):
        played.cut(1.5, 3)  # type: ignore[arg-type]


def test_arrays_are_not_printed_whole() -> None:
    many: Any = np.zeros((1000, 3))
    for call in (
        lambda: diabolo.rollout(Parameters(), [0.0] * 7, HELD, steps=many),
        lambda: diabolo.evaluate([many]),
        lambda: diabolo.plan_action("hop", many),
        lambda: Parameters(mass=many),
        lambda: State([0.0, 0.0, 0.0], string_state=many),
    ):
        with pytest.raises((ValueError, TypeError), match=r"an array of the shape \([\d, ]+\), float64; exp"):
            call()


def good_calls(take: Recording) -> dict[str, tuple[Callable[..., Any], dict[str, Any]]]:
    """Every public function of the package with arguments that it takes."""
    at = {"left": [0.0, 0.3, 1.0], "right": [0.0, -0.3, 1.0]}
    spline = diabolo.StickSpline([0.0, 0.5], *(np.tile(tip, (2, 1)) for tip in at.values()))
    goals = diabolo.Goals(final_state=diabolo.Waypoint([0.0, 0.0, 0.5]))
    run = {"model": Parameters(), "initial": [0.0] * 7, "tips": HELD, "steps": 1}
    play = diabolo.plan_action("hop", seconds=0.05)
    predicted = diabolo.predict(take, "paper")
    return {
        "rollout": (diabolo.rollout, run),
        "rollout_gradient": (diabolo.rollout_gradient, run),
        "evaluate": (diabolo.evaluate, {"recordings": take, "models": "paper", "starts_every": 0.5}),
        "predict": (diabolo.predict, {"recording": take}),
        "position_errors": (diabolo.position_errors, {"recording": take, "predicted": predicted}),
        "diagnose": (diabolo.diagnose, {"recordings": take}),
        "plan": (diabolo.plan, {"start": State(at["left"]), "seed": spline, "goals": goals, "seconds": 0.01}),
        "plan_action": (diabolo.plan_action, {"name": "hop", "seconds": 0.01}),
        "hang_at_rest": (diabolo.hang_at_rest, {"model": "consistent", **at}),
        "success_rate": (diabolo.success_rate, {"play": play, "models": [diabolo.Model()]}),
        "model_for": (diabolo.model_for, {"model": "consistent", "recording": take}),
        "best_guess": (diabolo.best_guess, {"model": diabolo.Model(), "result": []}),
        "view_html": (diabolo.view_html, {"recording": take}),
    }


def test_every_argument_of_every_function_is_named(played: Recording) -> None:
    missed = []
    for name, (function, good) in good_calls(played).items():
        for argument in inspect.signature(function).parameters:
            for wrong in (object(), [object()], "nonsense", 10**400, LONG, *NO_AXIS):
                if isinstance(wrong, str) and argument in ("note", "title"):
                    continue  # any text will do
                if wrong == "nonsense" and argument.startswith(("recording", "holdout")):
                    continue  # a file that is not there
                try:
                    function(**{**good, argument: wrong})
                    missed.append((name, argument, wrong, "was taken"))
                except (ValueError, TypeError) as error:
                    text = str(error)
                    if argument not in text or "\n" in text or len(text) > 250:
                        missed.append((name, argument, wrong, text))
    assert not missed


@pytest.mark.parametrize("wrong", [10**400, [10**400] * 7, LONG], ids=["int", "list", "text"])
@pytest.mark.parametrize("argument", ["initial", "axis", "dt", "begin", "string_state"])
def test_what_fits_no_float_is_named(argument: str, wrong: Any) -> None:
    arguments: dict[str, Any] = {"model": Parameters(), "initial": [0.0] * 7, "tips": HELD, "steps": 1}
    with pytest.raises(ValueError, match=f"^{argument}: ") as error:
        diabolo.rollout(**{**arguments, argument: wrong})
    assert len(str(error.value)) < 150


# ---- objects that __init__ has not made ----

EVERY_CLASS = """
import copy, pickle
from diabolo import _core
classes = [value for value in vars(_core).values() if type(value).__name__ == "pybind11_type"]
assert len(classes) > 40
path = _core.StickSpline([0.0, 1.0], [[0.0, 0.3, 1.0]] * 2, [[0.0, -0.3, 1.0]] * 2).path()
for one in classes:
    raw = one.__new__(one)
    uses = [repr, copy.copy, copy.deepcopy, pickle.dumps, len, lambda raw: raw == raw, lambda raw: raw(path)]
    uses += [lambda raw, name=name: getattr(raw, name) for name in dir(one)]
    methods = ("to_dict", "to_json", "path", "to_array")
    uses += [lambda raw, name=name: getattr(raw, name)() for name in methods]
    refused = 0
    for use in uses:
        try:
            use(raw)
        except (TypeError, AttributeError) as error:
            refused += "__init__ has run" in str(error)
        except pickle.PicklingError:
            pass
    assert refused > 0, one
    try:
        _core.limit_uses(raw, raw, raw)
    except TypeError:
        pass
try:
    _core.Goals(waypoints=[_core.Waypoint.__new__(_core.Waypoint)])
except TypeError as error:
    assert "__init__ has run" in str(error)
print("survived")
"""


def test_no_class_of_the_module_crashes_where_init_has_not_run() -> None:
    done = subprocess.run([sys.executable, "-c", EVERY_CLASS], capture_output=True, text=True)
    assert done.stdout == "survived\n", done.stderr[-2000:]


# ---- masks ----


def test_masked_samples_of_a_recording_are_dropouts(played: Recording) -> None:
    mask = np.zeros((len(played), 3), dtype=bool)
    mask[10, 1] = mask[20] = True
    masked = np.ma.masked_array(played.diabolo, mask)
    made = Recording(played.time, played.left, played.right, masked, played.rate)
    by_name = Recording(played.time, played.left, right=played.right, diabolo=masked, rate=played.rate)
    for one in (made, by_name):
        assert np.flatnonzero(~one.diabolo_valid).tolist() == [10, 20]
        np.testing.assert_array_equal(one.diabolo[11], played.diabolo[11])


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: diabolo.rollout(Parameters(), MASKED, HELD, steps=1), "initial: 1 of 7 values are masked"),
        (lambda: TipMotion(MASKED, np.zeros((7, 3)), np.ones((7, 3))), "TipMotion: 1 of 7 values are masked"),
        (lambda: setattr(State([0.0, 0.0, 0.0]), "axis", MASKED[4:]), "State.axis: 1 of 3 values are masked"),
    ],
)
def test_masked_values_are_refused_elsewhere(call: Callable[[], Any], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        call()


def test_a_mask_that_hides_nothing_is_no_matter() -> None:
    assert State(np.ma.masked_array([1.0, 2.0, 3.0])).position.tolist() == [1.0, 2.0, 3.0]


# ---- copies ----


def state_of(value: Any) -> Any:
    """What can be compared of an object whose class has no __eq__."""
    if isinstance(value, diabolo.Calibration):
        return value.to_json()
    names = [name for name in dir(type(value)) if isinstance(getattr(type(value), name), property)]
    return repr([_plain(getattr(value, name)) for name in names])


def _plain(value: Any) -> Any:
    if isinstance(value, list):
        return [_plain(item) for item in value]
    if isinstance(value, diabolo.Waypoint):
        return state_of(value)
    return value.tolist() if isinstance(value, np.ndarray) else value


@pytest.mark.parametrize(
    "value",
    [
        diabolo.Waypoint([1.0, 2.0, 3.0], [4.0, 5.0, 6.0], 0.5, 0.25, 0.125),
        diabolo.Goals(
            waypoints=[diabolo.Waypoint([1.0, 2.0, 3.0])],
            final_state=diabolo.Waypoint([0.0, 0.0, 1.0]),
            spin=3.0,
            spin_weight=0.5,
            taut=0.1,
        ),
        diabolo.Goals(apex=0.4, landing=[0.1, 0.2, 0.3]),
        diabolo.TipLimits(speed=3.0, jerk=900.0, lowest=[-1.0, -1.0, 0.0]),
        diabolo.LimitUse("speed", 1.0, 2.0, "m/s", 0.5, -0.5),
        diabolo.Freedom(forward=True, reach=0.3),
        diabolo.StickSpline([0.0, 1.0], np.zeros((2, 3)), np.ones((2, 3)), start=(np.ones(6), np.zeros(6))),
        diabolo.DiaboloProperties.green(),
        diabolo.Calibration.published(),
        diabolo.Calibration.blue(),
        Parameters.published(mass=0.3),
        diabolo.MagnusLift(coefficient=1e-3),
        diabolo.Model(Parameters.paper(), name="mine", string_mass=diabolo.StringMass(linear_density=1e-3)),
        State([1.0, 2.0, 3.0], spin=5.0),
        HELD,
    ],
    ids=lambda value: type(value).__name__,
)
def test_what_is_handed_over_can_be_copied_and_pickled(value: Any) -> None:
    for other in (copy.copy(value), copy.deepcopy(value), pickle.loads(pickle.dumps(value))):
        assert type(other) is type(value) and other is not value
        assert state_of(other) == state_of(value)


def test_goals_of_an_action_keep_their_weights() -> None:
    goals = diabolo.plan_action("hop", seconds=0.01).wanted[0]
    path = diabolo.StickSpline(
        [0.0, 0.5], np.tile([0.0, 0.3, 1.0], (2, 1)), np.tile([0.0, -0.3, 1.0], (2, 1))
    )
    start = diabolo.hang_at_rest("consistent", [0.0, 0.3, 1.0], [0.0, -0.3, 1.0])
    copied = pickle.loads(pickle.dumps(goals))
    costs = [
        diabolo._core.plan_cost([diabolo.Model()], start, path, each, diabolo.TipLimits())
        for each in (goals, copied)
    ]
    assert costs[0] == costs[1] > 0.0


def test_limits_with_a_function_are_copied_but_not_pickled() -> None:
    limits = diabolo.TipLimits(others=lambda path: [diabolo.LimitUse("mine", 2.0, 1.0, "m", 0.0, 1.0)])
    path = diabolo.StickSpline(
        [0.0, 1.0], np.tile([0.0, 0.3, 1.0], (2, 1)), np.tile([0.0, -0.3, 1.0], (2, 1))
    ).path()
    for other in (copy.copy(limits), copy.deepcopy(limits)):
        assert "mine" in [use.name for use in diabolo._core.limit_uses(path, other, 1.45)]
    with pytest.raises(TypeError, match="others is a function, which cannot be pickled"):
        pickle.dumps(limits)


def test_limits_of_robots_are_pickled_with_their_arms() -> None:
    arms = [robot.StickArm(side, height=0.72, spacing=1.08) for side in ("left", "right")]
    maps = [robot.StickMap(arm, robot.SeedGrid.build(arm)) for arm in arms]
    limits = diabolo.TipLimits(others=robot.RobotLimits(*maps, speed=2.0, least_clearance=0.2, share=0.9))
    path = diabolo.StickSpline(
        [0.0, 0.5, 1.0], [[0.7, 0.5, 1.3], [0.7, 0.55, 1.4], [0.7, 0.5, 1.3]], [[0.7, -0.5, 1.3]] * 3
    ).path()
    expected, *others = (
        [state_of(use) for use in diabolo._core.limit_uses(path, each, 1.45)]
        for each in (limits, copy.deepcopy(limits), pickle.loads(pickle.dumps(limits)))
    )
    assert len(expected) > 12
    assert others == [expected, expected]
    joints, faults = maps[0].solve([0.7, 0.5, 1.3])
    again = pickle.loads(pickle.dumps(maps[0]))
    np.testing.assert_array_equal(again.solve([0.7, 0.5, 1.3])[0], joints)
    assert faults == 0 and again.arm.side == "left"


# ---- texts ----


@pytest.mark.parametrize(
    ("parameters", "text"),
    [
        (Parameters(), "Parameters()"),
        (Parameters(string_length=1.3), "Parameters(string_length=1.3)"),
        (Parameters.paper(), "Parameters.paper()"),
        (Parameters.published(mass=0.3, planar=True), "Parameters.published(mass=0.3, planar=True)"),
    ],
)
def test_parameters_tell_what_differs_from_their_preset(parameters: Parameters, text: str) -> None:
    assert repr(parameters) == text
    assert eval(text, {"Parameters": Parameters}) == parameters


def test_a_rollout_tells_samples_duration_and_end() -> None:
    one = diabolo.rollout(Parameters(), [0.0, 0.0, -0.66, 0.0, 0.0, 0.0, 100.0], HELD, steps=500)
    assert repr(one).startswith(
        "<Rollout: 500 samples to 0.5 s, ends at (0.000, 0.000, -0.660) m, 0.00 m/s, "
    )
    assert repr(one).endswith(" rad/s, on_string>")
    many = diabolo.rollout(Parameters(), [[0.0, 0.0, -0.66, 0.0, 0.0, 0.0, 100.0]] * 3, HELD, steps=500)
    assert repr(many).startswith("<Rollout: 3 rollouts of 500 samples to 0.5 s, the first ends at (0.000, ")


# ---- names of files ----


def test_an_excerpt_does_for_a_recording(played: Recording) -> None:
    excerpt, whole = diabolo.Excerpt(played, 60, 180), diabolo.Excerpt(played, 0, len(played) - 1)
    assert whole.part().name == played.name and excerpt.part().name == f"{played.name}:60-180"
    np.testing.assert_array_equal(
        diabolo.predict(excerpt).states, diabolo.predict(played.cut(60, 180)).states
    )
    parts = [diabolo.Excerpt(played, 0, 40), diabolo.Excerpt(played, 30, 80)]
    with pytest.warns(diabolo.RecordingWarning, match="'played:30-80' overlaps 'played:0-40' by 11 samples"):
        diabolo.diagnose(parts)
    row = diabolo.evaluate(diabolo.Excerpt(played, np.int64(60), np.int64(180)), "paper").rows[0]
    assert row.frames == (60, 180) and row.recording == played.name and type(row.frames[0]) is int


@pytest.mark.parametrize("use", [diabolo.diagnose, diabolo.evaluate, diabolo.Excerpt.part])
def test_a_wrong_excerpt_is_told(played: Recording, use: Callable[[Any], Any]) -> None:
    for recording, last, words in (
        (played, 999, ".last: 999; expected a whole number from 60 to 480"),
        (cast(Any, "played.csv"), 100, ".recording: 'played.csv'; expected a Recording"),
    ):
        with pytest.raises(ValueError, match=re.escape(words)) as told:
            use(diabolo.Excerpt(recording, 60, last))
        assert str(told.value).split(".")[0] in ("recordings", "Excerpt")


@pytest.mark.parametrize("kind", [str, Path], ids=["str", "Path"])
def test_the_name_of_a_file_does_for_its_recording(
    tmp_path: Path, played: Recording, kind: Callable[[Path], Any]
) -> None:
    played.save(tmp_path / "played.csv")
    file = kind(tmp_path / "played.csv")
    loaded = Recording.load(tmp_path / "played.csv")
    assert diabolo.evaluate(file, "paper").rows[0].error == diabolo.evaluate(loaded, "paper").rows[0].error
    assert diabolo.evaluate([file, loaded.cut(0, 300)], "paper").rows[0].recording == "played"
    predicted = diabolo.predict(file, "paper")
    np.testing.assert_array_equal(predicted.states, diabolo.predict(loaded, "paper").states)
    np.testing.assert_array_equal(
        diabolo.position_errors(file, predicted), diabolo.position_errors(loaded, predicted)
    )
    assert diabolo.model_for("consistent", file) == diabolo.model_for("consistent", loaded)
    assert diabolo.view_html(file) == diabolo.view_html(loaded)
    np.testing.assert_array_equal(diabolo.baseline(file), diabolo.baseline(recording=loaded))
    np.testing.assert_array_equal(
        diabolo.start_state(row=100, recording=file).to_array(), diabolo.start_state(loaded, 100).to_array()
    )
    assert TipMotion.of_recording(file, "held").end == TipMotion.of_recording(loaded, "held").end
    with pytest.raises(TypeError, match=r"^start_state: row: 'one'; expected a whole number$"):
        diabolo.start_state(file, "one")
    with pytest.raises(ValueError, match=r"no\.csv: there is no such file"):
        diabolo.baseline(kind(tmp_path / "no.csv"))
    with pytest.raises(ValueError, match=r"no\.csv: there is no such file"):
        diabolo.diagnose(tmp_path / "no.csv")
    with pytest.raises(ValueError, match="hold the same 481 samples"):
        diabolo.diagnose(file, holdout=[file])


# ---- warnings ----


def test_the_page_of_an_odd_recording_warns(played: Recording) -> None:
    odd = Recording(played.time, played.left, played.right, played.diabolo, played.rate, string_length=3.0)
    with pytest.warns(diabolo.RecordingWarning) as caught:
        diabolo.view_html(odd)
    assert len(caught) == len(odd.warnings()) and caught[0].filename == __file__


def test_there_is_no_page_of_nothing() -> None:
    nothing = np.zeros((0, 3))
    empty = Recording(np.zeros(0), nothing, nothing, nothing, 120.0, name="empty")
    with pytest.raises(ValueError, match=r"^recording: empty has no rows; expected at least one$"):
        diabolo.view_html(empty)


def test_no_warning_comes_twice(played: Recording) -> None:
    feet = (track / 0.3048 for track in (played.left, played.right, played.diabolo))
    odd = Recording(played.time, *feet, played.rate)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        diabolo.evaluate([odd, odd.cut(0, 300)], "paper")
    texts = [str(warning.message) for warning in caught]
    assert texts and len(set(texts)) == len(texts)
