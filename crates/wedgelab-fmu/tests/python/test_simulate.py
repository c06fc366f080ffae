"""All kinds of FMUs, simulated, against `wedgelab run`."""

from ctypes import c_double, c_int, c_uint

import numpy as np
import pytest
from conftest import DURATION, KINDS, OMEGA, STEP, averages, motion
from fmpy import read_model_description, simulate_fmu
from test_state import Wedge

OUTPUT = ["side_frame_friction_loss", "vertical_wedge_force", "force_on_side_frame_z", "force_on_bolster_z"]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("version", ["2", "3"])
def test_cross_code_an_fmu_gives_the_averages_of_a_run(fmus, run, signal, version, kind):
    # CVode makes no more than 500 steps between two outputs, and the contacts ring: short intervals.
    step, tolerance = (STEP, 1e-6) if kind == "CoSimulation" else (2e-4, 1e-8)
    result = simulate_fmu(
        fmus(version),
        fmi_type=kind,
        stop_time=DURATION,
        output_interval=step,
        relative_tolerance=tolerance,
        input=signal,
        output=OUTPUT,
        record_events=False,
    )
    every = round(0.01 / step)
    found = averages(
        result["time"][::every], result["side_frame_friction_loss"][::every], result["vertical_wedge_force"][::every]
    )
    error = np.abs(found / run - 1.0)
    print(version, kind, found, run, error)
    assert np.all(error < 0.005), (found, run, error)


def test_cross_code_input_derivatives_come_closer_to_a_run(fmus, run):
    """Communication steps of 10 ms, with and without the derivatives of the inputs."""
    errors = []
    step = 0.01
    for derivatives in [False, True]:
        z, rate = motion(0.0)
        wedge = Wedge(fmus("2")).start(bolster_z=z, bolster_z_rate=rate)
        inputs = [wedge.references[name] for name in ("bolster_z", "bolster_z_rate")]
        references = (c_uint * 2)(*inputs)
        rows = []
        for number in range(round(DURATION / step)):
            time = number * step
            rows.append([time, *wedge.get(*OUTPUT[:2])])
            z, rate = motion(time)
            wedge.fmu.setReal(inputs, [z, rate])
            if derivatives:
                values = (c_double * 2)(rate, -OMEGA * OMEGA * z)
                wedge.fmu.fmi2SetRealInputDerivatives(wedge.fmu.component, references, 2, (c_int * 2)(1, 1), values)
            wedge.fmu.doStep(time, step)
        rows.append([DURATION, *wedge.get(*OUTPUT[:2])])
        wedge.free()
        time, loss, force = np.array(rows).T
        errors.append(np.abs(averages(time, loss, force) / run - 1.0).max())
    print(errors)
    assert errors[1] < errors[0] / 5.0 and errors[1] < 0.001


def test_cross_code_rates_can_be_left_to_the_fmu(fmus, run, signal):
    result = simulate_fmu(
        fmus("2"),
        fmi_type="CoSimulation",
        stop_time=DURATION,
        output_interval=STEP,
        relative_tolerance=1e-6,
        start_values={"derive_rates": True},
        input=signal[["time", "bolster_z"]],
        output=OUTPUT,
    )
    found = averages(
        result["time"][::10], result["side_frame_friction_loss"][::10], result["vertical_wedge_force"][::10]
    )
    assert np.all(np.abs(found / run - 1.0) < 0.005), (found, run)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("version", ["2", "3"])
def test_analytic_the_quasi_static_element_follows_its_closed_form(fmus, signal, version, kind):
    result = simulate_fmu(
        fmus(version, "quasi_static", "cdrun_toe_out_0.2_psi_0"),
        fmi_type=kind,
        stop_time=DURATION,
        output_interval=STEP if kind == "CoSimulation" else 0.01,
        relative_tolerance=1e-6,
        input=signal,
        output=[*OUTPUT[:1], "force_on_side_frame_z", "column_normal_force", "coil_force"],
        record_events=False,
    )
    time = result["time"]
    steady = np.abs(np.cos(2.0 * time)) > 0.5
    angle, toe, psi = np.deg2rad(37.5), np.deg2rad(0.2), np.arctan(0.4)
    for way, sign in [("up", -1.0), ("down", 1.0)]:
        rows = steady & (np.sign(np.cos(2.0 * time)) == -sign)
        load = result["coil_force"][rows] - 50 * 0.45359237 * 9.80665
        # Eq. 5-1 with a = sign and, toe out, b = -a.
        expected = load * np.cos(psi) * np.cos(angle + sign * psi) / np.sin(angle + toe + sign * psi - sign * psi)
        found = result["column_normal_force"][rows]
        assert rows.sum() > 100
        assert np.abs(found / expected - 1.0).max() < 0.005, way
    # What is lost is the friction force times the way: 4 amplitudes a cycle, the mean of both branches.
    loss = result["side_frame_friction_loss"]
    assert np.all(np.diff(loss) > -1e-6)


def test_limits_the_coil_from_outside_is_the_coil_inside(fmus, signal):
    """K(δ) as an input: with the stiffness of the case nothing changes."""
    variables = {variable.name: variable for variable in read_model_description(fmus("2")).modelVariables}
    stiffness = float(variables["coil_stiffness"].start)
    assert abs(stiffness / (1979 * 0.45359237 * 9.80665 / 0.0254) - 1.0) < 1e-12
    results = [
        simulate_fmu(
            fmus("2"),
            fmi_type="CoSimulation",
            stop_time=0.5,
            output_interval=STEP,
            start_values=values,
            input=signal,
            output=["coil_force", "force_on_bolster_z"],
        )
        for values in [{}, {"coil_mode": 1, "coil_stiffness_input": stiffness}]
    ]
    for name in ["coil_force", "force_on_bolster_z"]:
        inside, outside = (result[name] for result in results)
        assert np.array_equal(inside, outside), name
