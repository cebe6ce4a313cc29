# SPDX-License-Identifier: MIT
"""The robot cell: URDF and SDF as Drake reads them, URDF and MJCF as MuJoCo does, and SDF as Gazebo does."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from diabolo import Model, Parameters, StringFriction
from diabolo.cli import main
from diabolo.robot import JOINTS, StickArm
from numpy.typing import NDArray

SIDES = ("left", "right")
WHERE = ("0.75", "1.05", "-0.1")
SEED = 71
LINK = "<link name="


@pytest.fixture(scope="module")
def arms() -> dict[str, StickArm]:
    height, spacing, forward = map(float, WHERE)
    return {side: StickArm(side, height=height, spacing=spacing, forward=forward) for side in SIDES}


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The cell in each format, of a model whose diabolo is heavier than the paper's."""
    folder = tmp_path_factory.mktemp("cell")
    friction = StringFriction(coefficient=0.2, spin_gain=4.0)
    Model(Parameters(mass=0.3, gravity=9.81), name="a<b", string_friction=friction).save(
        folder / "model.json"
    )
    files = {suffix: folder / f"cell.{suffix}" for suffix in ("urdf", "sdf", "xml")}
    for file in files.values():
        assert main(["convert", str(folder / "model.json"), str(file), "--arms", *WHERE]) == 0
    return files


def configurations() -> NDArray[np.float64]:
    """Of both arms, and the seed."""
    return np.random.default_rng(SEED).uniform(-np.pi, np.pi, (20, 2, len(JOINTS)))


@pytest.mark.hosts
@pytest.mark.parametrize("suffix", ["urdf", "sdf"])
def test_drake_has_the_tips_where_the_arms_have_them(
    written: dict[str, Path], arms: dict[str, StickArm], suffix: str
) -> None:
    plants = pytest.importorskip("pydrake.multibody.plant")
    parsing = pytest.importorskip("pydrake.multibody.parsing")
    plant = plants.MultibodyPlant(1e-3)
    parsing.Parser(plant).AddModels(str(written[suffix]))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    for both in configurations():
        for side, angles in zip(SIDES, both, strict=True):
            for joint, angle in zip(JOINTS, angles, strict=True):
                plant.GetJointByName(f"{side}_{joint}").set_angle(context, angle)
        for side, angles in zip(SIDES, both, strict=True):
            tip = plant.GetFrameByName(f"{side}_tip").CalcPoseInWorld(context)
            np.testing.assert_allclose(tip.translation(), arms[side].tip_position(angles), atol=1e-9)
            flange = plant.GetFrameByName(f"{side}_wrist_3_link").CalcPoseInWorld(context)
            stick = tip.translation() - flange.translation()
            np.testing.assert_allclose(tip.rotation().col(0), stick / np.linalg.norm(stick), atol=1e-9)
    if suffix == "sdf":
        hub, cups = (plant.GetBodyByName(name).default_spatial_inertia() for name in ("hub", "cups"))
        assert hub.get_mass() + cups.get_mass() == pytest.approx(0.3)
        axial = cups.CalcRotationalInertia().get_moments()[0]
        assert axial == pytest.approx(0.3 * 0.0065 / 4.0)  # m r / gain


@pytest.mark.mujoco
@pytest.mark.parametrize("suffix", ["urdf", "xml"])
def test_mujoco_has_the_tips_where_the_arms_have_them(
    written: dict[str, Path], arms: dict[str, StickArm], suffix: str
) -> None:
    mujoco = pytest.importorskip("mujoco")
    from diabolo.hosts.mujoco import load_plugin

    load_plugin()
    text = written[suffix].read_text()
    # MuJoCo keeps links without a joint of their own where it is asked to.
    text = text.replace(LINK, '<mujoco><compiler fusestatic="false"/></mujoco>' + LINK, 1)
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    for both in configurations():
        for side, angles in zip(SIDES, both, strict=True):
            for joint, angle in zip(JOINTS, angles, strict=True):
                data.joint(f"{side}_{joint}").qpos = angle
        mujoco.mj_kinematics(model, data)
        for side, angles in zip(SIDES, both, strict=True):
            tip = data.body(f"{side}_tip").xpos if suffix == "urdf" else data.site(side).xpos
            np.testing.assert_allclose(tip, arms[side].tip_position(angles), atol=1e-9)
    weights = model.body_mass[model.body_mass > 0.0]
    one = [mass for mass, *_ in arms["left"].link_masses]
    np.testing.assert_allclose(weights, [*one, *one, *([0.3] if suffix == "xml" else [])])


def masses(file: Path, body: str) -> dict[str, float]:
    """Of the links of an arm, URDF's or MJCF's, by their names [kg]."""
    found = {}
    for link in ElementTree.parse(file).iter(body):
        told = link.find("inertial/mass" if body == "link" else "inertial")
        if told is not None and link.get("name") != "diabolo":
            found[link.get("name")] = float(told.get("value") or told.get("mass"))
    return found


def played_in_gazebo(world: Path, seconds: float) -> dict:
    program = Path(__file__).resolve().parents[2] / "build" / "gazebo" / "diabolo_gazebo_alone"
    assert program.exists(), "make gazebo builds it"
    done = subprocess.run([program, world, str(seconds)], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")
    return json.loads(done.stdout)


@pytest.mark.gazebo
def test_gazebo_s_engine_has_the_cell_as_urdf_and_mjcf_do(
    written: dict[str, Path], arms: dict[str, StickArm]
) -> None:
    told = played_in_gazebo(written["sdf"], 0.0)
    cell, diabolo = told["models"]["cell"], told["models"]["diabolo"]
    assert (cell["links"], cell["joints"]) == (14, 14)  # six of an arm, and its tip, which is fixed
    assert [cell["masses"].pop(f"{side}_tip") for side in SIDES] == [1e-3, 1e-3]  # SDF has no link without
    for suffix, body in (("urdf", "link"), ("xml", "body")):
        assert cell["masses"] == masses(written[suffix], body)
    assert sum(diabolo["masses"].values()) == pytest.approx(0.3)
    for side in SIDES:
        np.testing.assert_allclose(told["begin"][side], arms[side].tip_position(np.zeros(6)), atol=1e-9)


@pytest.mark.gazebo
def test_gazebo_s_engine_plays_the_cell(written: dict[str, Path]) -> None:
    """The string is 1 cm too short, which pulls the arms together. They fall, as this engine knows no links
    without weight, and no servo holds them: the string does not become longer again."""
    begin = {name: np.array(place) for name, place in played_in_gazebo(written["sdf"], 0.0)["begin"].items()}
    path = sum(np.linalg.norm(begin[side] - begin["diabolo"]) for side in SIDES)
    world = written["sdf"].with_name("short.sdf")
    length = f"<string_length>{path - 0.01}</string_length>"
    world.write_text(written["sdf"].read_text().replace("</plugin>", f"{length}</plugin>"))
    told = played_in_gazebo(world, 1.0)
    assert told["longest_path"] == pytest.approx(path, abs=1e-3)
    assert 1.0 < told["largest_tension"] < 10.0  # [N]
    for side in SIDES:
        assert np.linalg.norm(told["end"][side] - begin[side]) > 0.1
    assert np.isfinite(told["end"]["diabolo"]).all()
