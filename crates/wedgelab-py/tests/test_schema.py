"""The schemas of cases: every built-in case is valid by the one of its model, and mistakes are not."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import wedgelab as wl
from jsonschema import Draft7Validator

SCHEMAS = Path(__file__).resolve().parents[3] / "docs" / "schema"


def validator(model: str) -> Draft7Validator:
    schema = json.loads((SCHEMAS / f"{model}.json").read_text())
    Draft7Validator.check_schema(schema)
    return Draft7Validator(schema)


def cases(model: str) -> list[Any]:
    if model == "wedge":
        return [wl.Case(name) for group in wl.built_in().values() for name in group.cases]
    kind = wl.TruckCase if model == "truck" else wl.CarCase
    names = {
        "truck": ["truck_vertical_variable", "truck_warp_axles_variable_rising", "truck_vertical_split"],
        "car": ["car_tangent_loaded", "car_hunting_empty", "car_286k_loaded"],
    }
    return [kind(name) for name in names[model]]


@pytest.mark.parametrize("model", ["wedge", "truck", "car"])
def test_built_in_cases_are_valid(model: str) -> None:
    own = validator(model)
    for case in cases(model):
        wrong = [(list(error.absolute_path), error.message) for error in own.iter_errors(case.to_dict())]
        assert wrong == [], case.name
        assert case.to_toml().startswith(f"#:schema {own.schema['$id']}\n")
        assert own.schema["$id"].endswith(f"/docs/schema/{model}.json")


@pytest.mark.parametrize(
    ("section", "key", "value"),
    [
        ("wedge", "angel", "32 deg"),
        ("wedge", "angle", "32"),
        ("wedge", "angle", 32.0),
        ("wedge", "damping", "none"),
        ("friction", "column", -0.1),
        ("friction", "column", "0.4"),
        ("control_coil", "pulls", "yes"),
        ("bolster", "vertical", {"shape": "sinus"}),
        ("simulation", "method", "euler"),
    ],
)
def test_mistakes_are_found(section: str, key: str, value: object) -> None:
    case = wl.Case("vdrun_toe_0_psi_0").to_dict()
    case[section][key] = value
    places = [list(error.absolute_path)[:1] for error in validator("wedge").iter_errors(case)]
    assert [section] in places
