"""A freight car on its track: valid files, and its run again in FMPy."""

import csv

import numpy as np
import pytest
from conftest import LBF, wedgelab
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

CASE = "car_pitch_and_bounce_loaded"
STEP, DURATION = 0.005, 0.1
SET = ["--set", f"simulation.duration={DURATION} s", "--set", "start.settle=0 s", "--set", "start.kind=equilibrium"]


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """By the version of the standard."""
    folder = tmp_path_factory.mktemp("car")
    paths = {version: folder / f"car{version}.fmu" for version in ["2", "3"]}
    for version, path in paths.items():
        wedgelab("fmu", "export", CASE, "-o", path, "--fmi", version, *SET)
    return {version: str(path) for version, path in paths.items()}


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    """result.csv of `wedgelab run`."""
    folder = tmp_path_factory.mktemp("run") / "result"
    wedgelab("run", CASE, "--tables", "csv", "--out", folder, "--quiet", *SET)
    with open(folder / "result.csv", newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    values = np.array(rows[1:], dtype=float)
    return {name: values[:, number] for number, name in enumerate(rows[0])}


def test_input_fmpy_finds_no_problem(files):
    # FMPy takes ten seconds of CPU time for 1,800 variables; that of version 2 is read by the other test.
    assert validate_fmu(files["3"]) == []


def test_cross_code_the_car_gives_the_columns_of_its_run(files, table):
    names = ["axle_1_left_vertical", "axle_4_right_vertical", "truck_1_leading_left_column_normal"]
    result = simulate_fmu(
        files["2"],
        fmi_type="CoSimulation",
        stop_time=DURATION,
        output_interval=STEP,
        output=[*names, "distance"],
        validate=False,
    )
    assert len(result) == len(table["time_s"])
    for name in names:
        wanted = table[f"{name}_lbf"] * LBF
        assert np.abs(result[name] - wanted).max() < 0.01 * np.abs(wanted).max(), name
    assert np.abs(result["distance"] / 0.3048 - table["distance_ft"]).max() < 1e-3
