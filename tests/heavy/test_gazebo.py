# SPDX-License-Identifier: MIT
"""The string in Gazebo's physics: the program of examples/gazebo on the engine dartsim."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import diabolo
import numpy as np
import pytest
from diabolo import Model, Parameters, TipMotion, rollout
from diabolo.motions import swing_and_beat
from numpy.typing import NDArray

pytestmark = pytest.mark.gazebo

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build" / "gazebo" / "diabolo_gazebo"
WORLD = (ROOT / "examples" / "gazebo" / "diabolo.world.sdf").read_text(encoding="utf-8")
TAKE = ROOT / "data" / "recordings" / "puzzle_1.csv"
LENGTH, RADIUS = 1.46, 0.0065
START = {
    "position": [0.0, 0.0, 1.3 - 0.5 * (LENGTH**2 - 0.64) ** 0.5],
    "velocity": [0.3, 0.2, 0.0],
    "spin": 60.0,
}
EFFECTS = {
    "string_friction": diabolo.StringFriction(coefficient=0.2),
    "string_elasticity": diabolo.StringElasticity(compliance=5e-4, damping=5.0),
    "stick_flex": diabolo.StickFlex(compliance=0.004),
    "finite_axle": diabolo.FiniteAxle(radius=RADIUS),
    "air": diabolo.Air(linear_drag=0.05, quadratic_drag=0.02),
    "magnus_lift": diabolo.MagnusLift(coefficient=1e-3),
    "spin_loss": diabolo.SpinLoss(air=1e-4),
    "gravity_tilt": diabolo.GravityTilt(x=0.01),
}
Tips = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]


def swinging(seconds: float, lowered: float = 0.0) -> Tips:
    """Times, left and right tips that swing and beat; lowered by so much in the middle [m]."""
    t = np.arange(round(seconds * 1000) + 1) / 1000
    left, right, *_ = swing_and_beat(seconds).at(t)
    down = np.outer(1.0 - np.cos(2.0 * np.pi * t / seconds), [0.0, 0.0, 0.5 * lowered])
    return t, left - down, right - down


def with_words(words: str) -> str:
    return WORLD.replace("<model>consistent</model>", words)


def one_link(world: str) -> str:
    """The whole diabolo is one link that spins."""
    apart = r'<link name="hub">.*?</link>|<joint.*?</joint>|<spinning_link>.*?</spinning_link>'
    world = re.sub(apart, "", world, flags=re.DOTALL)
    return world.replace("<link>hub</link>", "<link>cups</link>").replace("0.14225", "0.2845")


class Player:
    """Runs the program in a folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def __call__(
        self, world: str, tips: Tips, times: list[float], **told: object
    ) -> subprocess.CompletedProcess[str]:
        rows = "\n".join(",".join(map(repr, row)) for row in np.column_stack(tips).tolist())
        header = "time,left_x,left_y,left_z,right_x,right_y,right_z\n"
        (self.folder / "motion.csv").write_text(header + rows + "\n")
        body = {"mass": 0.2845, "diameter": 0.127, "length": 0.143, "axle_radius": RADIUS}
        whole = {"schema": "diabolo.recording/1", "diabolo": body, "string_length": LENGTH, "rate": 1000.0}
        whole |= {"units": "SI", "frame": "x forward, y left, z up"}
        whole["starts"] = [START | {"time": time} for time in times]
        (self.folder / "motion.json").write_text(json.dumps(whole | told))
        return self.run(world)

    def run(self, world: str, *flags: str) -> subprocess.CompletedProcess[str]:
        (self.folder / "world.sdf").write_text(world)
        names = [str(self.folder / name) for name in ("world.sdf", "motion.csv", "sim.csv")]
        assert PROGRAM.exists(), "make gazebo builds it"
        return subprocess.run([PROGRAM, *names, *flags], capture_output=True, text=True, timeout=120)

    def seen(self, done: subprocess.CompletedProcess[str]) -> diabolo.Recording:
        assert done.returncode == 0, done.stderr
        return diabolo.load_recording(self.folder / "sim.csv")

    def table(self, done: subprocess.CompletedProcess[str]) -> NDArray[np.float64]:
        assert done.returncode == 0, done.stderr
        return np.genfromtxt(self.folder / "sim.csv", delimiter=",", skip_header=1)


@pytest.fixture
def player(tmp_path: Path) -> Player:
    return Player(tmp_path)


def same(world: str) -> str:
    return world


@pytest.mark.parametrize("effects", [{}, EFFECTS], ids=["plain", "effects"])
@pytest.mark.parametrize("body", [same, one_link])
def test_the_link_goes_where_the_predictor_goes(
    player: Player, effects: dict[str, object], body: Callable[[str], str]
) -> None:
    words = "".join(
        f"<{name}.{field}>{value}</{name}.{field}>"
        for name, effect in effects.items()
        for field, value in effect_numbers(effect).items()
    )
    times, left, right = swinging(2.0)
    seen = player.seen(player(body(with_words(words)), (times, left, right), [0.0]))
    forward = np.tile([1.0, 0.0, 0.0], (len(times), 1))
    tips = TipMotion(times, left, right, "spline", forward, forward)
    model = Model(Parameters(string_length=LENGTH, axle_radius=RADIUS), name="played", **effects)
    start = [*START["position"], *START["velocity"], START["spin"]]
    plain = rollout(model, start, tips, dt=1e-3, steps=2000, string_state="loose").states
    farthest = np.linalg.norm(seen.diabolo[1:] - plain[:, :3], axis=1).max()
    print(f"{farthest:.1e} m from the predictor")
    assert farthest < 1e-9
    angle = np.unwrap(-2.0 * np.arctan2(seen.diabolo_orientation[:, 0], seen.diabolo_orientation[:, 3]))
    np.testing.assert_allclose(np.diff(angle)[1:] / 1e-3, 0.5 * (plain[:-1, 6] + plain[1:, 6]), atol=1e-6)


def test_the_example_draws_its_comparison(tmp_path: Path) -> None:
    picture = tmp_path / "gazebo.png"
    example = [sys.executable, str(ROOT / "examples" / "hosts" / "diabolo_in_gazebo.py")]
    done = subprocess.run([*example, "--picture", picture], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    errors = [float(line.split(": ")[1].split()[0]) for line in done.stdout.splitlines()]
    assert len(errors) == 2
    assert max(errors) < 1e-9
    assert picture.read_bytes().startswith(b"\x89PNG")


def effect_numbers(effect: object) -> dict[str, float]:
    numbers = {name: getattr(effect, name) for name in dir(effect) if not name.startswith("_")}
    return {name: value for name, value in numbers.items() if isinstance(value, float) and value != 0.0}


def test_a_minute_of_play_stays_on_the_string_and_on_the_ground(player: Player) -> None:
    """The tips go down until the string is slack and the ground carries the diabolo, and up again."""
    seen = player.seen(
        player(WORLD, swinging(60.0, lowered=0.9), [], starts=[START | {"time": 0.0, "spin": 0.0}])
    )
    path = sum(np.linalg.norm(seen.diabolo - tip, axis=1) for tip in (seen.left, seen.right))
    assert len(path) == 60001
    assert path.max() < LENGTH + 1e-3
    assert seen.diabolo[:, 2].min() > 0.05
    low = slice(25000, 35000)
    assert (path[low] < LENGTH - 0.01).mean() > 0.3
    assert abs(np.median(seen.diabolo[low, 2]) - 0.0635) < 2e-3


def test_a_further_start_forgets_what_was_before(player: Player) -> None:
    tips = swinging(2.0)
    both = player.table(player(WORLD, tips, [0.0, 1.0]))
    once = player.table(player.run(WORLD, "--once"))
    later = player.table(player(WORLD, tips, [1.0]))
    assert (len(both), len(once), len(later)) == (2001, 2001, 1001)
    np.testing.assert_array_equal(both[:1000], once[:1000])
    np.testing.assert_allclose(both[1000:, :10], later[:, :10], atol=1e-12)  # the angle goes on
    assert np.linalg.norm(once[1000, 7:10] - later[0, 7:10]) > 0.01


def test_what_gazebo_plays_is_compared_with_reality(player: Player, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "diabolo"]
    subprocess.run([*command, "motion", TAKE, tmp_path / "motion.csv"], check=True, capture_output=True)
    player.seen(player.run(WORLD.replace("0.14225", "0.085")))
    arguments = ["diagnose", TAKE, "--simulated", tmp_path / "sim.csv", "--out", tmp_path / "out"]
    done = subprocess.run([*command, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "The simulator lacks friction of the string on the axle" in done.stdout


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("<link>hub<", "<link>hob<", '<link>: the model "diabolo" has no link "hob"'),
        ("<link>hub</link>", "", "<link> is missing; expected the name of a link"),
        ("<left>left_tip::tip<", "<left>left_tip<", '"left_tip"; expected MODEL::LINK'),
        ("<left>left_tip::tip<", "<left>none::tip<", '<left>: the world has no model "none"'),
        ("<left>left_tip::tip<", "<left>right_tip::tip<", "<right>: the same link as <left>; expected two"),
        (
            "<left>left_tip::tip<",
            "<left>diabolo::cups<",
            "<left>: a link of the diabolo; expected another model",
        ),
        ("<left>left_tip::tip<", "<left>ground::link<", '<left>: the model "ground" is static'),
        (
            "<joint name=",
            '<link name="more"/><joint name=',
            "<link>: the model has 3 links; expected <link> and <sp",
        ),
        ("<xyz>1 0 0<", "<xyz>0 1 0<", "<spinning_link>: the model has no revolute joint"),
        ("<model>consistent<", "<colour>red<", "<colour> is unknown; expected link, spinning_link, left"),
        ("<model>consistent<", "<model>none.json<", "none.json: there is no such file"),
        ("<model>consistent<", "<string_length>long<", 'string_length: "long"; expected a number'),
        ("<model>consistent<", "<string_length>-1<", "string_length"),
        ("<model>consistent<", "<string_length>nan<", 'string_length: "nan"; expected a number'),
        ("<model>consistent</model>", "<left>a::b</left>", "<left> is there twice"),
        ("<gravity>0 0 -9.80665", "<gravity>0 1 -9.80665", "expected it along -z"),
        (
            "<max_step_size>0.001",
            "<max_step_size>0.0012345",
            "<max_step_size> 0.0012345 s; expected a multiple",
        ),
        ('name="diabolo::String"', 'name="other"', 'no model has <plugin name="diabolo::String">'),
        ("</world>", "", "world.sdf: sdformat cannot read it; expected SDF, in XML that is whole"),
    ],
)
def test_a_wrong_world_is_told_in_a_sentence(player: Player, old: str, new: str, fault: str) -> None:
    assert old in WORLD
    world = WORLD.replace(old, new)
    if old.startswith("<model>") and not new.endswith("</left>"):
        world = world.replace(new + "/model>", new + "/" + new[1:].split(">")[0] + ">")
    refuses(player, player(world, swinging(0.1), [0.0]), fault)


@pytest.mark.parametrize("text", ['<robot name="arm"><link/></robot>', "<world/>", "plain text"])
def test_what_is_no_sdf_is_told_in_a_sentence(player: Player, text: str) -> None:
    """A broken robot, too, about which a reader of URDF says more."""
    refuses(player, player(text, swinging(0.1), [0.0]), "world.sdf: no <sdf>; expected an SDF world")


@pytest.mark.parametrize("name", ["diabolo_gazebo", "diabolo_gazebo_alone"])
def test_wrong_use_is_told_in_a_sentence(name: str) -> None:
    done = subprocess.run([PROGRAM.with_name(name)], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (2, f"{name}: WORLD.sdf is required; see --help\n")


def refuses(player: Player, done: subprocess.CompletedProcess[str], fault: str) -> None:
    assert done.returncode == 2, done.stdout
    assert fault in done.stderr
    assert done.stderr.startswith("diabolo_gazebo: ")
    assert done.stderr.count("\n") == 1
    assert not list(player.folder.glob("sim*"))


@pytest.mark.parametrize(
    ("starts", "told", "fault"),
    [
        ([], {}, "motion.json: no starts; expected one at least"),
        ([9.0], {}, 'field "starts[0].time" is 9.0; expected one after the start before it and within'),
        ([0.05, 0.0], {}, 'field "starts[1].time" is 0.0'),
        ([0.0], {"starts": [{"time": 0.0}]}, 'field "starts[0].position" is missing'),
        ([0.0], {"starts": [START | {"time": 0.0, "spin": 1e7}]}, "starts[0]: farther than 100 m, faster"),
        (
            [0.0],
            {"starts": [START | {"time": 0.0, "position": [60, 60, 60]}]},
            "the diabolo is farther than 100 m",
        ),
        ([0.0], {"string_length": -1.0}, 'field "string_length" is -1.0; expected a number > 0'),
    ],
)
def test_a_wrong_motion_is_told_in_a_sentence(
    player: Player, starts: list[float], told: dict[str, object], fault: str
) -> None:
    refuses(player, player(WORLD, swinging(0.1), starts, **told), fault)


def test_a_wrong_table_is_told_with_its_line(player: Player) -> None:
    player(WORLD, swinging(0.1), [0.0])
    for written in player.folder.glob("sim*"):
        written.unlink()
    motion = player.folder / "motion.csv"
    whole = motion.read_text()
    for text, fault in (
        (whole.replace("left_x", "x"), "motion.csv, line 1: other columns; expected time,left_x"),
        (whole.replace("\n0.001,", "\n0.0,"), "motion.csv, line 3: time 0 s does not come after 0 s"),
        (whole.replace("\n0.001,", "\n,"), "motion.csv, line 3: an empty cell; expected a number"),
    ):
        motion.write_text(text)
        refuses(player, player.run(WORLD), fault)
