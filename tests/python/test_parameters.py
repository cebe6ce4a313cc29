# SPDX-License-Identifier: MIT
from __future__ import annotations

import copy
import json
import pickle
from typing import Any

import diabolo
import numpy as np
import pytest
from diabolo import Parameters
from hypothesis import assume, given
from hypothesis import strategies as st

FIELDS = Parameters.fields()
CHOICES = {
    "string_law": diabolo.StringLaw,
    "projection": diabolo.Projection,
    "normal_rule": diabolo.NormalRule,
    "flight_rule": diabolo.FlightRule,
    "thin_rule": diabolo.ThinRule,
    "spin_rule": diabolo.SpinRule,
    "integrator": diabolo.Integrator,
}


def numbers() -> st.SearchStrategy[dict[str, float]]:
    return st.fixed_dictionaries({}, optional={f.name: st.floats(f.minimum, f.maximum) for f in FIELDS})


def test_presets_are_those_of_the_library() -> None:
    assert Parameters() == Parameters.consistent()
    assert Parameters.published().string_length == 1.46
    assert Parameters.paper().string_length == 1.45
    assert Parameters.published().string_law == diabolo.StringLaw.PULL_VELOCITY
    assert Parameters.paper().flight_rule == "paper"
    assert len({repr(p) for p in (Parameters(), Parameters.paper(), Parameters.published())}) == 3


def test_presets_take_fields() -> None:
    assert Parameters.paper(mass=0.2).mass == 0.2
    assert Parameters.paper(mass=0.2) == Parameters.paper().replace(mass=0.2)


@given(numbers())
def test_every_number_survives_dict_json_repr_and_pickle(fields: dict[str, float]) -> None:
    # Slip worn off faster than a step lasts would turn it over.
    assume(fields.get("spin_coupling", 0.0) * fields.get("reference_step", 1e-3) <= 1.0)
    p = Parameters(**fields)
    for name, value in fields.items():
        assert getattr(p, name) == value
    assert Parameters(**p.to_dict()) == p
    assert Parameters(**json.loads(json.dumps(p.to_dict()))) == p
    assert eval(repr(p), {"Parameters": Parameters}) == p
    assert pickle.loads(pickle.dumps(p)) == p
    assert copy.deepcopy(p) == p


@pytest.mark.parametrize("field", FIELDS, ids=lambda f: f.name)
def test_every_number_is_held_to_its_range(field: diabolo.ParameterInfo) -> None:
    p = Parameters()
    before = getattr(p, field.name)
    for bad in (np.nextafter(field.minimum, -np.inf), np.nextafter(field.maximum, np.inf), np.nan, np.inf):
        with pytest.raises(ValueError, match=rf"^{field.name}: .*must be within \["):
            Parameters(**{field.name: bad})
        with pytest.raises(ValueError, match=field.name):
            setattr(p, field.name, bad)
    assert getattr(p, field.name) == before
    for good in (field.minimum, field.maximum):
        setattr(p, field.name, good)
        assert getattr(p, field.name) == good


def test_every_number_says_what_it_is() -> None:
    for field in FIELDS:
        assert field.unit and field.meaning
        assert f"[{field.unit}]" in getattr(Parameters, field.name).__doc__


@pytest.mark.parametrize(("name", "choices"), CHOICES.items())
def test_rules_are_chosen_by_member_or_by_name(name: str, choices: Any) -> None:
    for choice in choices:
        by_member, by_name = Parameters(**{name: choice}), Parameters(**{name: str(choice)})
        assert by_member == by_name
        assert getattr(by_member, name) is choice
        assert getattr(by_member, name) == choice.value
    listed = ", ".join(f"'{choice.value}'" for choice in choices)
    with pytest.raises(ValueError, match=f"^{name}: 'no'; expected one of {listed}$"):
        Parameters(**{name: "no"})


def test_changes_of_rules_count_in_comparisons() -> None:
    assert Parameters(per_step=True) != Parameters()
    assert Parameters() != "Parameters()"
    assert Parameters(planar=True, plane_normal=[0.0, 1.0, 0.0]) != Parameters(planar=True)


@pytest.mark.parametrize(
    ("fields", "error", "text"),
    [
        ({"masss": 1.0}, TypeError, "no field 'masss'"),
        ({"mass": "heavy"}, TypeError, "mass: 'heavy'; expected a number"),
        ({"string_law": 3}, TypeError, "string_law: 3; expected a str"),
        ({"planar": None}, TypeError, "planar: None; expected True or False"),
        ({"plane_normal": [1.0, 0.0]}, ValueError, r"plane_normal: shape \(2,\); expected \(3,\)"),
        ({"planar": True, "plane_normal": [1.0, 1.0, 0.0]}, ValueError, "unit vector"),
    ],
)
def test_bad_fields_are_named(fields: dict[str, Any], error: type[Exception], text: str) -> None:
    with pytest.raises(error, match=text):
        Parameters(**fields)


def test_unknown_attributes_are_refused() -> None:
    with pytest.raises(TypeError):
        Parameters().planar = None  # type: ignore[assignment]
    assert Parameters(planar=np.False_) == Parameters()
    with pytest.raises(AttributeError):
        Parameters().masss = 1.0  # type: ignore[attr-defined]
