# SPDX-License-Identifier: MIT
"""The robot cell as MJCF, SDF and URDF: what is written, and what is refused."""

import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from diabolo import DiaboloProperties, MagnusLift, Model, Parameters, Recording, load_recording
from diabolo.cli import main
from diabolo.hosts import mjcf, sdf, urdf
from diabolo.robot import JOINTS, StickArm

SWING = Path(__file__).parents[2] / "data" / "recordings" / "swing.csv"
NAMES = {f"{side}_{joint}" for side in ("left", "right") for joint in JOINTS}


@pytest.mark.parametrize("suffix", ["urdf", "xml", "sdf"])
def test_every_format_has_the_twelve_joints(tmp_path: Path, suffix: str) -> None:
    file = tmp_path / f"cell.{suffix}"
    assert main(["convert", "consistent", str(file), "--json", str(tmp_path / "said.json")]) == 0
    joints = {one.get("name") for one in ElementTree.parse(file).iter("joint")}
    assert joints >= NAMES
    assert "nan" not in file.read_text()
    assert json.loads((tmp_path / "said.json").read_text())["string_length_m"] == 1.45


def test_a_model_s_file_is_named_as_seen_from_the_world_s(tmp_path: Path) -> None:
    folder = tmp_path / "a & b"
    folder.mkdir()
    model = Model(name="lifts", magnus_lift=MagnusLift(coefficient=1e-3))
    model.save(folder / "model.json")
    assert main(["convert", str(folder / "model.json"), str(tmp_path / "cell.sdf")]) == 0
    assert ElementTree.parse(tmp_path / "cell.sdf").findtext(".//plugin/model") == "a & b/model.json"
    assert main(["convert", str(folder / "model.json"), str(tmp_path / "cell.xml")]) == 0
    keys = {
        one.get("key"): one.get("value") for one in ElementTree.parse(tmp_path / "cell.xml").iter("config")
    }
    assert json.loads(keys["model"] or "") == json.loads(model.to_json())


def test_a_preset_is_meant_by_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "paper").mkdir()
    (tmp_path / "worlds").mkdir()
    assert main(["convert", "paper", "worlds/cell.sdf"]) == 0
    assert ElementTree.parse("worlds/cell.sdf").findtext(".//plugin/model") == "paper"


def test_a_cell_in_mjcf_has_a_key_where_it_is_ready() -> None:
    def key(arms: list[StickArm], length: float = 1.45) -> ElementTree.Element | None:
        model = Model(Parameters(string_length=length))
        return ElementTree.fromstring(mjcf.cell(arms, model)).find("keyframe/key")

    arms = [StickArm(side, height=0.75, spacing=1.05, forward=0.2) for side in ("left", "right")]
    ready = key(arms)
    assert ready is not None
    place = np.array((ready.get("qpos") or "").split(), float)
    for arm, joints, aside in zip(arms, (place[:6], place[6:12]), (0.35, -0.35), strict=True):
        np.testing.assert_allclose(arm.tip_position(joints), [0.8, aside, 1.3], atol=1e-9)
    below = 1.3 - np.sqrt(0.725**2 - 0.35**2)  # but for the axle's width
    np.testing.assert_allclose(place[12:], [0.8, 0.0, below, 1.0, 0.0, 0.0, 0.0], atol=1e-3)
    assert (ready.get("ctrl") or "").split() == (ready.get("qpos") or "").split()[:12]
    assert key(arms, length=3.0) is None  # it would be in the floor
    assert key([StickArm(side, spacing=2.5) for side in ("left", "right")]) is None  # out of reach


@pytest.mark.parametrize("name", ["", " ", "a\x01.json", "\ud800", 5, None, Path("model.json")])
def test_a_model_s_file_has_a_name(name: Any) -> None:
    with pytest.raises(ValueError, match=r"^model_file: .*; expected the name of a model's file or of a pre"):
        sdf.world(model_file=name)


@pytest.mark.parametrize("write", [urdf.urdf, sdf.world, mjcf.cell])
def test_arms_are_one_of_each_side(write: object) -> None:
    with pytest.raises(ValueError, match=r"arms: \['left', 'left'\]; expected one of the left and one"):
        write([StickArm("left")] * 2)  # type: ignore[operator]


@pytest.mark.parametrize(
    ("given", "complaint"),
    [
        (["nothing.json", "cell.sdf"], "model nothing.json: no such file; expected"),
        (
            ["consistent", "cell.stl"],
            "cell.stl: expected a name that ends in .csv, .mcap, .parquet, .rrd, .urdf",
        ),
        (["consistent", "cell.sdf", "--up", "y"], "--up: it says how a recording is read; cell.sdf is of a"),
        (["consistent", "cell.sdf", "--arms", "0.7", "0", "0"], "spacing: 0 m; must be > 0"),
        (["consistent", "cell.sdf", "--arms", "nan", "1", "0"], "--arms: height: nan m; must be finite"),
        (["consistent", "cell.sdf", "--arms", "1e9", "1", "0"], "--arms: 1e+09 m; expected at most 100 m"),
        (["consistent", "take.csv"], "consistent: a model; expected OUT to end in .urdf, .xml, .sdf"),
        (["model.json", "take.csv"], "model.json: a model; expected OUT to end in .urdf, .xml, .sdf"),
        ([str(SWING), "cell.sdf"], "swing.csv: a recording; expected OUT to end in .csv, .mcap"),
        (["consistent", "nowhere/cell.sdf"], "there is no folder"),
    ],
)
def test_what_cannot_be_written_is_one_sentence(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    given: list[str],
    complaint: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["convert", *given]) == 2
    error = capsys.readouterr().err
    assert complaint in error and error.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_a_cell_may_be_of_the_set_up_of_a_take(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    played = load_recording(SWING)
    green = {"properties": DiaboloProperties.green(), "string_length": 1.2}
    take = Recording(played.time, played.left, played.right, played.diabolo, played.rate, **green)
    take.save(tmp_path / "take.csv")
    Model(name="open").save(tmp_path / "model.json")
    for suffix in ("xml", "sdf"):
        cell = ["convert", str(tmp_path / "model.json"), str(tmp_path / f"cell.{suffix}")]
        assert main([*cell, "--arms", "0.7", "1", "0", "--recording", str(tmp_path / "take.csv")]) == 0
    assert "a diabolo of 0.1415 kg on a string of 1.2 m" in capsys.readouterr().out
    world = ElementTree.parse(tmp_path / "cell.sdf")
    assert world.findtext(".//plugin/string_length") == "1.2"
    assert world.findtext(".//plugin/axle_radius") == "0.0065"
    scene = ElementTree.parse(tmp_path / "cell.xml")
    [model] = [one.get("value") for one in scene.iter("config") if one.get("key") == "model"]
    assert json.loads(model or "")["parameters"]["string_length"] == 1.2
    assert scene.find(".//body[@name='diabolo']/inertial").get("mass") == "0.1415"  # type: ignore[union-attr]
    assert main(["convert", str(SWING), str(tmp_path / "a.csv"), "--recording", str(SWING)]) == 2
    complaint = "--recording: it says of which set-up a model is; a.csv is of a recording"
    assert complaint in capsys.readouterr().err
