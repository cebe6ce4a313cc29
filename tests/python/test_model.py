# SPDX-License-Identifier: MIT
from __future__ import annotations

import pickle
from pathlib import Path

import diabolo
import pytest
from diabolo import Model, Parameters, StringElasticity, StringFriction

SPRING = StringElasticity.of_stiffness(600.0, damping=2.0)


def test_effects_come_by_keyword() -> None:
    model = Model(Parameters(mass=0.2), string_elasticity=SPRING)
    assert model.string_elasticity == SPRING
    assert model.parameters.mass == 0.2
    assert Model(string_elasticity=None) == Model()
    assert Model().string_elasticity.compliance == 0.0


def test_parts_of_a_model_can_be_changed_in_place() -> None:
    model = Model()
    model.parameters.mass = 0.2
    model.string_elasticity.damping = 3.0
    assert model.parameters.mass == 0.2
    assert model.string_elasticity.damping == 3.0


def test_models_are_equal_where_everything_is() -> None:
    model = Model(string_elasticity=SPRING)
    assert model != Model()
    assert model == pickle.loads(pickle.dumps(model))
    names = {"Model": Model, "Parameters": Parameters, "StringElasticity": StringElasticity}
    assert eval(repr(model), names) == model
    assert Model(name="a") != Model(name="b")
    assert Model(interpolation="held") != Model(interpolation=diabolo.Interpolation.LINEAR)


def test_models_by_name_know_how_to_read_recordings() -> None:
    published = Model.named("published")
    assert published == Model.published()
    assert published.interpolation == "held"
    assert published.own_string_length
    assert Model.named("consistent").interpolation == diabolo.Interpolation.SPLINE
    with pytest.raises(ValueError, match="expected published, paper or consistent"):
        Model.named("ours")


@pytest.mark.parametrize("model", [Model.published(), Model.paper(), Model(string_elasticity=SPRING)])
def test_model_files_hold_everything(model: Model, tmp_path: Path) -> None:
    path = tmp_path / "model.json"
    model.save(path)
    assert Model.load(path) == model
    assert [file.name for file in tmp_path.iterdir()] == ["model.json"]


def test_bad_model_files_are_named(tmp_path: Path) -> None:
    path = tmp_path / "model.json"
    path.write_text('{"schema": "diabolo.model/1", "base": "paper", "parameters": {"mass": -1}}')
    with pytest.raises(ValueError, match=r"model\.json.*mass"):
        Model.load(path)
    with pytest.raises(ValueError, match="no such file"):
        Model.load(tmp_path / "other.json")


def test_effects_are_held_to_their_ranges() -> None:
    with pytest.raises(ValueError, match=r"string_friction coefficient: 9; must be within \[0, 3\]$"):
        StringFriction(coefficient=9.0)
    with pytest.raises(ValueError, match=r"string_elasticity compliance: -1 m/N; must be within \[0, 1\]"):
        StringElasticity(compliance=-1.0)
    with pytest.raises(ValueError, match="compliance"):
        StringElasticity.of_stiffness(0.5)
    with pytest.raises(ValueError, match="compliance"):
        StringElasticity.of_stiffness(0.0)
    with pytest.raises(TypeError, match="StringElasticity has no field 'stiffness'"):
        StringElasticity(stiffness=600.0)
    assert [field.unit for field in StringElasticity.fields()] == ["m/N", "N s/m"]


def test_unknown_effects_are_refused() -> None:
    with pytest.raises(TypeError, match="'string_elastic'; the effects are: string_elasticity"):
        Model(string_elastic=SPRING)
    with pytest.raises(TypeError, match="expected StringElasticity or None"):
        Model(string_elasticity=600.0)
