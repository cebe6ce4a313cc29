# SPDX-License-Identifier: MIT
from __future__ import annotations

import json
import math
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
import pytest
from conftest import Command, make_recording
from diabolo import (
    DiagnosisResult,
    Goals,
    LadderRow,
    Model,
    Parameters,
    StickSpline,
    StringFriction,
    TipLimits,
    Waypoint,
    robot,
)
from diabolo.cli.plan import recording_of
from diabolo.enums import StringState
from diabolo.player import ACTIONS

LENGTH = 1.45


def swing() -> tuple[diabolo.State, StickSpline]:
    """A diabolo at rest under tips that will stay where they are."""
    left, right = np.array([0.5, 0.3, 1.2]), np.array([0.5, -0.3, 1.2])
    start = diabolo._core.hanging_state(left, right, LENGTH, 100.0)
    times = [0.0, 0.3, 0.6, 0.9]
    return start, StickSpline(times, np.tile(left, (4, 1)), np.tile(right, (4, 1)))


def test_plan_reaches_a_goal_state() -> None:
    start, seed = swing()
    wanted = np.array([0.5, 0.15, start.position[2] + 0.03])
    plan = diabolo.plan(start, seed, Goals(final_state=Waypoint(wanted)))
    assert plan.reached, plan.answer
    time, states, _, _, _ = plan.play
    assert np.linalg.norm(states[-1, :3] - wanted) < 0.02
    assert time[-1] == pytest.approx(plan.path.end)
    # The same by the library's own rollout of the sampled tips.
    initial = [*start.position, *start.velocity, start.spin]
    again = diabolo.rollout(Parameters(), initial, plan.path.tips(1e-3), string_state="on_string")
    assert np.linalg.norm(again.states[-1, :3] - wanted) < 0.02


def test_plans_keep_their_limits() -> None:
    start, seed = swing()
    goals = Goals(final_state=Waypoint([0.5, 0.3, 0.6]))
    plan = diabolo.plan(start, seed, goals, limits=TipLimits(speed=0.3, acceleration=3.0))
    motion = plan.path.derivatives(np.linspace(plan.path.begin, plan.path.end, 2000))
    for side in (slice(0, 3), slice(3, 6)):
        assert np.linalg.norm(motion[1][:, side], axis=1).max() <= 0.3
        assert np.linalg.norm(motion[2][:, side], axis=1).max() <= 3.0
    assert not plan.reached
    assert "what binds" in plan.answer


def test_limits_in_python_are_kept() -> None:
    start, seed = swing()

    def elbow(path: diabolo.TipPath) -> list[diabolo.LimitUse]:
        most = float(path.derivatives(np.linspace(path.begin, path.end, 50))[0][:, 1].max())
        return [diabolo.LimitUse("elbow", most, 0.32, "m", 0.0, most - 0.32)]

    plan = diabolo.plan(
        start, seed, Goals(final_state=Waypoint([0.5, 0.3, 0.6])), limits=TipLimits(others=elbow)
    )
    assert plan.limits[-1].name == "elbow"
    assert plan.limits[-1].value <= 0.32


def test_a_plan_for_two_arms_is_played_as_planned(command: Command, tmp_path: Path) -> None:
    out = tmp_path / "hop.csv"
    done = command("plan", "hop", "--robots", "--goal", "height=0.05", "--out", str(out))
    assert done.returncode == 0, done.stdout + done.stderr
    left, right = (
        robot.StickMap(arm, robot.SeedGrid.build(arm)) for arm in map(robot.StickArm, ("left", "right"))
    )
    check = robot.check_plan(left, right, robot.load_tip_plan(out))
    assert check["playable"], check["troubles"]
    assert check["worst_factor"] == pytest.approx(1.0, abs=0.02)
    slower = robot.RobotLimits(left, right, speed=0.1)
    path = diabolo.plan_action("hop").path
    assert max(use.excess for use in slower(path)) > max(
        use.excess for use in robot.RobotLimits(left, right)(path)
    )


def test_model_for_takes_what_is_the_recordings() -> None:
    take = make_recording("swing", 1.0)
    model = Model(Parameters(string_length=1.2, mass=0.4), own_mass=True)
    there = diabolo.model_for(model, take).parameters
    assert there.string_length == take.string_length == LENGTH
    assert there.mass == 0.4
    assert there.axle_radius == take.properties.axle_radius
    assert model.parameters.string_length == 1.2


def test_best_guess_counts_what_was_too_unsure_to_be_claimed() -> None:
    def guessed(**entries: tuple[float, float, bool]) -> Model:
        ladder = [
            LadderRow(name=name, estimate=estimate, z=z, claimed=claimed)
            for name, (estimate, z, claimed) in entries.items()
        ]
        return diabolo.best_guess(Model(), ladder)

    assert guessed(air_drag_quadratic=(0.04, 2.0, False)).air.quadratic_drag == pytest.approx(0.03)
    assert guessed(magnus_lift=(-1e-3, -2.0, False)).magnus_lift.coefficient == pytest.approx(-7.5e-4)
    for none in ((0.04, 0.9, False), (0.04, 9.0, True), (-0.04, -3.0, False)):
        assert guessed(air_drag_quadratic=none).air.quadratic_drag == 0.0
    assert guessed(string_length=(0.05, 5.0, True)).parameters.string_length == pytest.approx(LENGTH + 0.05)
    assert guessed(string_length=(0.05, 3.0, False)).parameters.string_length == LENGTH
    both = guessed(air_drag_quadratic=(0.04, 2.0, False), air_drag_linear=(0.1, 9.0, True))
    assert both.air.quadratic_drag == 0.0


def test_cycles_go_on_smoothly_and_keep_the_limits_as_a_whole() -> None:
    limits = TipLimits(jerk=6000.0)
    for name in ("stop", "hop", "throw_and_catch"):
        play = diabolo.plan_action(name, cycles=3, limits=limits)
        assert play.reached, play.answer
        assert len(play.plans) == (6 if name == "throw_and_catch" else 3)
        assert max(use.excess for use in diabolo._core.limit_uses(play.path, limits, LENGTH)) <= 0.0
        first = play.plans[0].path
        seam = first.end - first.begin
        before, after = play.path.derivatives(np.array([seam - 1e-7, seam + 1e-7])).transpose(1, 0, 2)
        assert np.abs(before[:3] - after[:3]).max() < 5e-3  # of the jerk, 2e-7 s long


def test_cycles_end_with_a_throw_that_leaves_nothing_to_catch() -> None:
    play = diabolo.plan_action("throw_and_catch", cycles=2, limits=TipLimits(speed=0.3))
    assert not play.reached
    assert len(play.plans) == 1
    assert "what binds: left tip speed" in play.answer
    assert play.answer.startswith("cycle 1: ")
    assert "cycle 2: " in play.ended
    low = diabolo.plan_action("throw_and_catch", height=0.06)
    assert not low.reached
    assert "time to catch is missed" in low.answer


def test_cycles_go_on_from_where_the_tips_are() -> None:
    """A wall keeps the catch's hands from coming home."""
    limits = TipLimits(highest=[10.0, 0.66, 10.0])
    play = diabolo.plan_action("throw_and_catch", cycles=2, limits=limits)
    assert len(play.plans) == 4, play.ended
    assert max(use.excess for use in diabolo._core.limit_uses(play.path, limits, LENGTH)) <= 0.0


def test_cycles_that_cannot_go_on_within_the_limits_leave_those_before() -> None:
    play = diabolo.plan_action("linear_acceleration", cycles=3, limits=TipLimits(jerk=300.0))
    assert len(play.plans) == 1
    assert play.plans[0].reached and not play.reached
    assert play.answer == play.ended
    assert re.match("cycle 2: .* left tip jerk, 300 m/s\\^3", play.ended)


def test_a_flight_is_shown_until_it_comes_down_to_the_hands() -> None:
    play = diabolo.plan_action("throw", height=1.0)
    hands = play.path.derivatives(np.array([play.path.end]))[0, 0, [2, 5]].mean()
    assert play.states[-1, 2] <= hands < play.states[-2, 2]
    fall = play.time[-1] - play.time[play.states[:, 2].argmax()]
    assert fall == pytest.approx(math.sqrt(2.0 * 1.0 / 9.8), rel=0.02)


def test_paths_go_on_where_they_meet_only() -> None:
    _, seed = swing()
    path = seed.path()
    assert path.followed_by(path).end == pytest.approx(2.0 * path.end)
    higher = StickSpline(seed.times, np.add(seed.left, [0.0, 0.0, 0.1]), seed.right).path()
    with pytest.raises(ValueError, match="what follows begins elsewhere"):
        path.followed_by(higher)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('{"schema": 1, "schema": 2}', 'field "schema" is there twice'),
        ('{"ladder": [' + "9" * 400 + "]}", "a number is too large"),
        ('{"ladder": []}', 'field "schema" is missing'),
        ('{"schema": "diabolo.model/1"}', 'expected "diabolo.diagnosis/1"'),
        ("", "the file is empty"),
        ("{", "this is not JSON"),
        ("[" * 100000, "JSON nested deeper"),
        ("\xff", "belongs to another encoding"),
    ],
)
def test_wrong_diagnoses_are_refused(command: Command, tmp_path: Path, text: str, said: str) -> None:
    file = tmp_path / "wrong.json"
    file.write_bytes(text.encode("latin-1"))
    done = command("plan", "hop", "--diagnosis", str(file))
    assert done.returncode == 2
    assert str(file) in done.stderr and said in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_numbers_of_a_diagnosis_that_are_none_are_named(command: Command, tmp_path: Path) -> None:
    rung = {"name": "air_drag_quadratic", "claimed": False, "estimate": 0.1, "z": 1e200}
    file = tmp_path / "d.json"
    file.write_text(json.dumps({"schema": "diabolo.diagnosis/1", "ladder": [rung]}))
    done = command("plan", "hop", "--diagnosis", str(file))
    assert done.returncode == 2
    assert "ladder[0], z: 1e+200; expected a number of at most 1e+06" in done.stderr
    done = command("plan", "hop", "--diagnosis", "/dev/zero")
    assert done.returncode == 2 and "a device or a pipe" in done.stderr


def test_sticks_give_only_square_to_their_directions() -> None:
    model = Model(stick_flex=diabolo.StickFlex(compliance=1.0 / 300.0, damping=3.0))
    along_the_pull = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0]
    unknown, forward, upright = (
        diabolo.plan_action("swing", model, sticks=sticks).states[0, 2]
        for sticks in (None, [1.0, 0.0, 0.0, 1.0, 0.0, 0.0], along_the_pull)
    )
    assert forward == pytest.approx(unknown, abs=1e-4)  # the strands are square to them
    assert upright > unknown + 2e-3
    with pytest.raises(ValueError, match="neither a unit vector nor zero"):
        diabolo.plan_action("swing", sticks=[2.0, 0.0, 0.0, 2.0, 0.0, 0.0])


def test_start_states_are_one_or_one_for_each_model() -> None:
    start, seed = swing()
    goals = Goals(final_state=Waypoint(start.position))
    with pytest.raises(ValueError, match="2 start states; expected 3"):
        diabolo.plan([start, start], seed, goals, [Parameters()] * 3)
    with pytest.raises(ValueError, match="no start state"):
        diabolo.plan([], seed, goals)


def test_random_walk_repeats_itself() -> None:
    start, seed = swing()
    goals = Goals(final_state=Waypoint([0.5, 0.15, 0.6]))
    first, again, other = (
        diabolo.plan(start, seed, goals, solver="walk", evaluations=200, random_seed=n) for n in (3, 3, 4)
    )
    assert first.cost == again.cost
    assert first.cost != other.cost
    assert first.evaluations == 200


@pytest.mark.parametrize("height", [0.3, 0.8])
def test_throw_and_catch(height: float) -> None:
    played = diabolo.plan_action("throw_and_catch", height=height)
    assert played.reached, played.answer
    flying = played.string_states == StringState.FLYING
    above = played.states[:, 2] - 0.5 * (played.left[:, 2] + played.right[:, 2])
    assert flying.any() and not flying[-1]
    release_tips = played.plans[0].path.derivatives(np.array([played.plans[0].path.end]))[0][0]
    apex = played.states[:, 2].max() - 0.5 * (release_tips[2] + release_tips[5])
    assert apex == pytest.approx(height, abs=0.01)
    assert above[-1] < -0.3
    assert np.linalg.norm(played.states[-1, 3:6]) < 0.3


def test_cycles_go_on_from_each_other() -> None:
    model = Model(
        Parameters(spin_coupling=0.0), string_friction=StringFriction(coefficient=0.25, spin_gain=3.4)
    )
    played = diabolo.plan_action("linear_acceleration", model, cycles=3, spin=60.0)
    assert len(played.plans) == 3
    assert played.states[-1, 6] > 70.0
    jumps = np.abs(np.diff(played.path.derivatives(np.linspace(0.0, played.path.end, 5000))[0], axis=0))
    assert jumps.max() < 0.01


def test_hanging_stays_where_it_is() -> None:
    left, right = [0.5, 0.3, 1.2], [0.5, -0.3, 1.2]
    rest = StickSpline([0.0, 0.4], [left, left], [right, right]).path()
    lowest = diabolo.hang_at_rest(Parameters(), left, right).position
    assert lowest == pytest.approx([0.5, 0.0, 1.2 - np.sqrt(0.725**2 - 0.3**2)], abs=1e-6)
    for model in (
        Model(Parameters(), string_friction=StringFriction(coefficient=0.3)),
        Model(Parameters(), string_elasticity=diabolo.StringElasticity.of_stiffness(300.0, 5.0)),
    ):
        state = diabolo.hang_at_rest(model, left, right, spin=100.0)
        assert np.linalg.norm(state.position - lowest) > 0.002
        _, states, _, _, _ = diabolo._core.foresee(model, state, rest)
        assert np.linalg.norm(states[:, :3] - state.position, axis=1).max() < 0.003


def test_success_rate_tells_robust_from_fragile() -> None:
    played = diabolo.plan_action("throw_and_catch", height=0.6)
    same = Model(Parameters())
    longer = Model(Parameters(string_length=1.6))
    assert diabolo.success_rate(played, [same]) == 1.0
    assert diabolo.success_rate(played, [same, longer]) <= 0.5


def test_horizon_joins_pieces() -> None:
    start, seed = swing()
    left, right = seed.left[0], seed.right[0]
    horizon = diabolo.RecedingHorizon(Model(Parameters()), left, right, start)
    seam = horizon.seam(0.5)
    goals = Goals(final_state=Waypoint([0.5, 0.1, start.position[2]]))
    piece = diabolo.plan(seam.state, seam.joined(seed), goals)
    assert horizon.join(seam, piece, 0.52, 0.02)
    assert not horizon.join(seam, piece, seam.time + 0.1, 0.02)
    assert horizon.path.end == pytest.approx(piece.path.end)
    elsewhere = diabolo.plan(
        start, StickSpline(seed.times, np.add(seed.left, [0.0, 0.0, 0.5]), seed.right), goals
    )
    with pytest.raises(ValueError, match="does not begin at the seam"):
        horizon.join(seam, elsewhere, 0.52, 0.02)
    with pytest.raises(ValueError, match="times of a join"):
        horizon.join(seam, piece, math.nan, 0.02)
    with pytest.raises(ValueError, match="more than 600 s"):
        horizon.seam_at(1e6)
    with pytest.raises(ValueError, match="time of the observation: inf s"):
        horizon.observe(math.inf, start)
    with pytest.raises(ValueError, match="the tips: nan m"):
        diabolo.RecedingHorizon(Model(Parameters()), [math.nan] * 3, right, start)


@pytest.mark.parametrize("weight", [math.nan, math.inf, -1.0])
def test_weights_of_goals_are_numbers(weight: float) -> None:
    for goals in (
        lambda: Goals(taut=weight),
        lambda: Goals(caught=weight),
        lambda: Goals(spin=50.0, spin_weight=weight),
        lambda: Goals(final_state=Waypoint([0.0, 0.0, 0.5], velocity_weight=weight)),
    ):
        with pytest.raises(ValueError, match="weight"):
            goals()


def test_ctrl_c_ends_a_plan_whose_limits_are_in_python() -> None:
    code = (
        "import diabolo, numpy as np, threading, os, signal\n"
        "from diabolo import Goals, StickSpline, TipLimits, Waypoint, Model\n"
        "left, right = [0.0, 0.5, 1.0], [0.0, -0.5, 1.0]\n"
        "start = diabolo.hang_at_rest(Model.consistent(), left, right, 100.0)\n"
        "goals = Goals(final_state=Waypoint([9.0, 0.0, 0.0]))\n"
        "seed = StickSpline(np.linspace(0, 3, 13), [left] * 13, [right] * 13)\n"
        "threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()\n"
        "limits = TipLimits(others=lambda path: [])\n"
        "try:\n    diabolo.plan(start, seed, goals, limits=limits, solver='walk', seconds=600.0)\n"
        "except KeyboardInterrupt:\n    print('ended')\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.stdout == "ended\n", done.stderr


def test_bad_input_is_refused_in_a_sentence() -> None:
    start, seed = swing()
    limits = TipLimits(others=lambda path: None)  # type: ignore[arg-type, return-value]
    with pytest.raises(ValueError, match="others: what it returned is no list of LimitUse"):
        diabolo.plan(start, seed, Goals(taut=1.0), limits=limits)
    with pytest.raises(ValueError, match="goals: none"):
        Goals()
    with pytest.raises(ValueError, match=r"solver: 'magic'"):
        diabolo.plan(start, seed, Goals(taut=1.0), solver="magic")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="somersault"):
        diabolo.plan_action("somersault")
    with pytest.raises(ValueError, match=r"speed: -1; expected"):
        TipLimits(speed=-1.0)
    with pytest.raises(ValueError, match=r"velocity of its start: nan m/s"):
        StickSpline(
            [0.0, 1.0], [[0.0, 0.3, 1.0]] * 2, [[0.0, -0.3, 1.0]] * 2, start=([math.nan] * 6, [0.0] * 6)
        )
    with pytest.raises(ValueError, match="interval"):
        seed.path().tips(1e-9)
    nothing = diabolo.LimitUse("mine", math.nan, 1.0, "m", 0.0, math.nan)
    with pytest.raises(ValueError, match="mine: its value is not a number"):
        diabolo.plan(start, seed, Goals(taut=1.0), limits=TipLimits(others=lambda path: [nothing]))
    with pytest.raises(ValueError, match="height"):
        diabolo.plan_action("throw", height=-0.5)
    with pytest.raises(ValueError, match="spin_gain: nothing that hop can aim at"):
        diabolo.plan_action("hop", spin_gain=5.0)
    with pytest.raises(ValueError, match="solver: 'walk'"):
        diabolo.plan_action("throw_and_catch", solver="walk")
    with pytest.raises(ValueError, match="models: none"):
        diabolo.success_rate(diabolo.plan_action("hop"), [])
    with pytest.raises(ValueError, match="left tip z, highest"):
        diabolo.plan(start, seed, Goals(taut=1.0), limits=TipLimits(highest=[2.0, 2.0, 1.0]))


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ({"ladder": 5}, "ladder: 5; expected a list"),
        ({"ladder": [5]}, r"ladder\[0\]: 5; expected an object"),
        ({"ladder": [{}]}, r"ladder\[0\]: no name"),
        (
            {"ladder": [{"name": "magnus_lift", "claimed": 1}]},
            r"ladder\[0\], claimed: 1; expected true or false",
        ),
        ({"ladder": [{"name": "magnus_lift", "claimed": False}]}, r"ladder\[0\], z: nan; expected a number"),
        ({"ladder": [{"name": "magnus_lift", "z": 2.0, "estimate": None}]}, r"ladder\[0\], estimate: nan"),
        ({"headline": 3}, "headline: 3; expected a text"),
        ({"fit": {"windows": -1}}, "fit, windows: -1; expected a whole number"),
        (
            {"locate": {"windows": [{"z": [1.0, "two"]}]}},
            r'locate, windows\[0\], z\[1\]: "two"; expected a num',
        ),
        ({"nuisances": [{"ci90": [1.0]}]}, r"nuisances\[0\], ci90: \[1.0\]; expected two numbers"),
    ],
)
def test_a_diagnosis_that_is_none_is_refused(parts: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        text = json.dumps({"schema": "diabolo.diagnosis/1", **parts})
        diabolo.best_guess(Model(), DiagnosisResult.from_json(text))


def test_best_guess_takes_a_diagnosis_only() -> None:
    with pytest.raises(ValueError, match=r"result\[0\]: 'ladder'; expected LadderRow"):
        diabolo.best_guess(Model(), {"ladder": []})  # type: ignore[arg-type]


def test_a_search_may_take_any_time() -> None:
    assert diabolo.plan_action("hop", seconds=math.inf).reached


def test_command_writes_what_the_readers_read(command: Command, tmp_path: Path) -> None:
    out, page, found = tmp_path / "throw.csv", tmp_path / "throw.html", tmp_path / "found.json"
    arguments = ["--goal", "height=0.6", "--out", out, "--html", page, "--json", found]
    done = command("plan", "throw_and_catch", *map(str, arguments))
    assert done.returncode == 0, done.stderr
    assert "every goal is reached" in done.stdout
    recording = diabolo.load_recording(out)
    played = diabolo.plan_action("throw_and_catch", height=0.6)
    assert len(recording) == pytest.approx(240 * played.path.end, abs=2)
    assert np.abs(recording.left[0] - played.left[0]).max() < 1e-9
    # The recording predicts itself: the written tips make the diabolo do the same again.
    again = diabolo.predict(recording)
    assert np.nanmax(np.linalg.norm(again.states[:200, :3] - recording.diabolo[:200], axis=1)) < 0.02
    summary = json.loads(found.read_text())
    assert summary["schema"] == "diabolo.plan/1"
    assert summary["reached"] is True
    assert summary["highest_above_tips_m"] == pytest.approx(0.6, abs=0.15)
    text = page.read_text()
    assert "http" not in re.sub(r"xmlns=\S+", "", text)
    assert '"title":"throw"' in text


def test_the_exit_status_tells_a_missed_goal(command: Command, tmp_path: Path) -> None:
    out = tmp_path / "throw.csv"
    done = command("plan", "throw", "--goal", "height=1.2", "--limit", "speed=1.5", "--out", str(out))
    assert done.returncode == 1
    assert "apex is missed by" in done.stdout
    assert not done.stderr
    assert out.exists()
    assert "1 where one is missed" in command("plan", "--help").stdout


def test_command_plans_for_the_set_up_of_a_recording(command: Command, tmp_path: Path) -> None:
    take = make_recording("swing", 1.0)
    take.save(tmp_path / "take.csv")
    out = tmp_path / "swing.csv"
    done = command("plan", "swing", "--recording", str(tmp_path / "take.csv"), "--out", str(out))
    assert done.returncode == 0, done.stderr
    assert diabolo.load_recording(out).string_length == take.string_length


def test_command_complains_in_one_sentence(command: Command, tmp_path: Path) -> None:
    for arguments, words in (
        (["somersault"], "invalid choice"),
        (["throw", "--goal", "hight=1"], "expected NAME=X"),
        (["throw", "--goal", "height=tall"], "'tall' is no number"),
        (["throw", "--limit", "speed=0"], "speed"),
        (["throw", "--out", str(tmp_path / "plan.txt")], "ends in .csv"),
        (["throw", "--cycles", "3"], "not caught"),
        (["hop", "--goal", "spin=5"], "nothing that hop can aim at"),
        (["hop", "--limit", "joint_speed=2"], "with --robots only"),
        (["hop", "--diagnosis", __file__], "not JSON"),
        (["hop", "--recording", ""], "an empty name"),
    ):
        done = command("plan", *arguments)
        assert done.returncode == 2
        assert words in done.stderr
        assert len(done.stderr.strip().splitlines()) == 1


def test_view_shows_recording_and_prediction(command: Command, tmp_path: Path) -> None:
    assert command("simulate", str(tmp_path / "swing.csv"), "--motion", "swing").returncode == 0
    page = tmp_path / "swing.html"
    done = command("view", str(tmp_path / "swing.csv"), "--model", "consistent", "--out", str(page))
    assert done.returncode == 0, done.stderr
    data = json.loads(re.search(r"const data = (\{.*\});\n", page.read_text())[1])  # type: ignore[index]
    (ghost,) = data["predictions"]
    assert ghost["name"] == "consistent"
    assert len(data["time"]) == len(ghost["positions"]) == 601
    assert data["string_length"] == LENGTH
    assert command("view", str(tmp_path / "none.csv"), "--out", str(page)).returncode == 2


def test_names_cannot_break_the_page() -> None:
    played = diabolo.plan_action("swing")
    recording = recording_of(
        played, "</script><b>", diabolo.DiaboloProperties(0.2845, 0.127, 0.143, 0.0065), LENGTH
    )
    assert diabolo.view_html(recording).count("</script>") == 1


def test_actions_are_all_reached() -> None:
    for name in ACTIONS:
        played = diabolo.plan_action(name)
        assert played.reached, f"{name}: {played.answer}"
