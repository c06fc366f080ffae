"""The half-truck of a built-in run: valid files, and its run again in FMPy."""

import csv

import numpy as np
import pytest
from conftest import LBF, wedgelab
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu
from test_state import Wedge

RUN = "nucars_69_constant_toe_out"
STEP, DURATION = 0.01, 0.5


@pytest.fixture(scope="module", params=["2", "3"])
def half_truck(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("half_truck") / "half.fmu"
    wedgelab("fmu", "export", RUN, "-o", path, "--fmi", request.param)
    return str(path)


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    """result.csv of `wedgelab nucars run`: forces in pounds-force, by the first word of their column."""
    folder = tmp_path_factory.mktemp("run") / "result"
    wedgelab("nucars", "run", RUN, "--out", folder, "--quiet")
    with open(folder / "result.csv", newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    values = np.array(rows[1:], dtype=float)
    return {name: values[:, number] for number, name in enumerate(rows[0])}


def test_input_fmpy_finds_no_problem(half_truck):
    assert validate_fmu(half_truck) == []


def test_cross_code_the_motions_of_the_files_give_the_forces_of_the_run(half_truck, table):
    names = [f"wedge_{number}_column_friction" for number in (127, 128, 129, 130)]
    result = simulate_fmu(
        half_truck,
        fmi_type="CoSimulation",
        stop_time=DURATION,
        output_interval=STEP,
        relative_tolerance=1e-5,
        start_values={"motion": 1},
        output=[*names, "ledger_relative_residual"],
    )
    count = len(result["time"])
    for name in names:
        own = result[name]
        (column,) = (values for key, values in table.items() if key.startswith(name))
        there = column[:count] * LBF
        # Two integrations at a tolerance of 1e-5, whose steps end elsewhere.
        assert np.abs(own - there).max() < 5e-3 * np.abs(there).max(), name
    assert result["ledger_relative_residual"].max() < 1e-3


def test_cross_code_model_exchange_and_co_simulation_agree(half_truck):
    """Integrated by CVode, and by itself."""
    name = "wedge_127_column_friction"
    results = [
        simulate_fmu(
            half_truck,
            fmi_type=kind,
            stop_time=0.3,
            output_interval=1e-3,
            relative_tolerance=1e-8,
            start_values={"motion": 1},
            output=[name, "body_1_z", "ledger_relative_residual"],
            record_events=False,
        )
        for kind in ["ModelExchange", "CoSimulation"]
    ]
    exchange, simulation = results
    for column, bound in [(name, 1e-3), ("body_1_z", 1e-5)]:
        there = simulation[column]
        assert np.abs(exchange[column] - there).max() < bound * np.abs(there).max(), column
    assert max(result["ledger_relative_residual"].max() for result in results) < 1e-4


def test_analytic_loads_do_work_and_saved_states_go_on(tmp_path):
    path = tmp_path / "half.fmu"
    wedgelab("fmu", "export", RUN, "-o", path)

    def loaded(part, number):
        for _ in range(number):
            part.set(force_on_body_1_z=1e5 * np.sin(20.0 * part.time))
            part.fmu.doStep(currentCommunicationPoint=part.time, communicationStepSize=1e-3)
            part.time += 1e-3
        return part.all()

    part = Wedge(str(path), "half").start()
    loaded(part, 50)
    time, state = part.time, part.save()
    there = loaded(part, 50)
    part.restore(state, time)
    assert np.array_equal(loaded(part, 50), there)
    other = Wedge(str(path), "other").start()
    other.restore(other.deserialize(part.serialize(state)), time)
    assert np.array_equal(loaded(other, 50), there)
    assert abs(part.get("load_work")[0]) > 1.0
    part.free()
    other.free()
