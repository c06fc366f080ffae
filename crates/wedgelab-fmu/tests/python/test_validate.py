"""Descriptions without a problem, and packages that hold what they must."""

import subprocess
import sys
import zipfile

import fmpy
import pytest
from fmpy.validation import validate_fmu


@pytest.mark.parametrize("model", ["wedge", "quasi_static"])
@pytest.mark.parametrize("version", ["2", "3"])
def test_input_fmpy_finds_no_problem(fmus, version, model):
    path = fmus(version, model)
    assert validate_fmu(path) == []
    done = subprocess.run([sys.executable, "-m", "fmpy", "validate", path], capture_output=True, text=True)
    assert done.returncode == 0 and "No problems found" in done.stdout, done.stdout + done.stderr


def test_input_bristles_and_free_roll_make_a_valid_description(fmus):
    path = fmus(
        "2",
        "wedge",
        "vdrun_toe_in_0.2_psi_0.012",
        "--set",
        'friction.law="bristle"',
        "--set",
        'wedge.free_coordinates=["x", "y", "z", "roll", "pitch", "yaw"]',
        "--set",
        'contact.damping="10 lbf s/in"',
    )
    assert validate_fmu(path) == []
    states = fmpy.read_model_description(path).numberOfContinuousStates
    assert states == 12 + 16 + 7


@pytest.mark.parametrize("version", ["2", "3"])
def test_input_the_package_is_whole(fmus, version):
    with zipfile.ZipFile(fmus(version)) as archive:
        names = archive.namelist()
    folder = {"2": "linux64", "3": "x86_64-linux"}[version]
    assert f"binaries/{folder}/FrictionWedge.so" in names
    for name in ["modelDescription.xml", "resources/case.toml", "documentation/index.html"]:
        assert name in names
    assert any(name.startswith("documentation/licenses/") for name in names)
    assert not any("\\" in name for name in names)


def test_input_every_variable_has_a_text_and_dimensional_ones_a_unit(fmus):
    description = fmpy.read_model_description(fmus("2"))
    for variable in description.modelVariables:
        assert variable.description, variable.name
        if "force" in variable.name and variable.type == "Real":
            assert variable.declaredType is None and variable.unit == "N", variable.name
    names = {variable.name: variable for variable in description.modelVariables}
    assert names["bolster_z"].displayUnit == "in"
    assert names["toe"].displayUnit == "deg"
