"""Inputs that are not connected, or contradict each other, in FMPy."""

import numpy as np
import pytest
from conftest import INCH, LBF, STEP, motion, wedgelab
from fmpy import simulate_fmu

CASE = "cdrun_toe_0_psi_0"
AT = [0.5, 1.0, 1.5, 2.0, 2.5, 2.9]
WEIGHT = 50.0 * LBF


class Log(list):
    """The importer's logger: the warnings."""

    def __call__(self, _, name, status, category, message):
        if category == b"logStatusWarning":
            assert status == 1 and name, (status, name)
            self.append(message.decode())


def simulate(path, kind, step, stop, names, **more):
    log = Log()
    options = {"relative_tolerance": 1e-8} if kind == "ModelExchange" else {}
    result = simulate_fmu(
        path, fmi_type=kind, stop_time=stop, output_interval=step, output=names, logger=log, record_events=False, **options, **more
    )
    return result, log


@pytest.fixture(scope="module")
def forces(tmp_path_factory):
    """Vertical force on the side frame (N) in the run of the case: of the column's friction, and of the coil where it stands there."""
    folder = tmp_path_factory.mktemp("run") / "result"
    wedgelab("run", CASE, "--out", folder, "--quiet", "--set", "simulation.duration='3 s'")
    table = np.genfromtxt(folder / "result.csv", delimiter=",", names=True, deletechars="")
    [name] = [name for name in table.dtype.names if name.startswith("vertical_force_on_side_frame")]
    assert "lbf" in name, name
    return np.interp(AT, table[table.dtype.names[0]], table[name]) * LBF


def positions(step, stop):
    time = np.arange(0.0, stop + 0.5 * step, step)
    table = np.zeros(len(time), dtype=[("time", float), ("bolster_z", float)])
    table["time"], table["bolster_z"] = time, motion(time)[0]
    return table


@pytest.mark.parametrize("step", [0.01, STEP])
def test_issue_047_positions_alone_give_the_forces_of_the_run(fmus, forces, step):
    names = ["force_on_bolster_z", "force_on_side_frame_z"]
    result, log = simulate(fmus("2", case=CASE), "CoSimulation", step, 3.0, names, input=positions(step, 3.0))
    bolster, side_frame = (np.interp(AT, result["time"], result[name]) for name in names)
    print(step, bolster, side_frame, forces)
    assert not log, log
    assert np.abs(side_frame / forces - 1.0).max() < 0.01, (side_frame, forces)
    # The wedge's weight and its vibration remain.
    assert np.abs(bolster + side_frame + WEIGHT).max() < WEIGHT


def test_issue_047_model_exchange_warns_of_positions_alone(fmus):
    names = ["force_on_bolster_z"]
    _, log = simulate(fmus("2", case=CASE), "ModelExchange", 2e-4, 0.1, names, input=positions(STEP, 0.1))
    [text] = log
    assert "`bolster_z` and `bolster_z_rate` contradict" in text and "never been set" in text, text


def test_issue_047_a_wedge_with_nothing_connected_rests(fmus):
    names = ["force_on_bolster_x", "force_on_bolster_z", "force_on_side_frame_z"]
    found = []
    for kind, step in [("CoSimulation", 0.0005), ("CoSimulation", 0.002), ("CoSimulation", 0.01), ("ModelExchange", 2e-4)]:
        result, log = simulate(fmus("2", case=CASE), kind, step, 2.0, names)
        assert not log, log
        found.append([result[name][-1] for name in names])
        assert abs(found[-1][1] + found[-1][2] + WEIGHT) < 1.0
    found = np.array(found)
    error = np.abs(found - found[0]).max(axis=1) / abs(found[0, 0])
    print(found, error)
    assert np.all(error[:3] < 1e-4) and error[3] < 1e-3, (found, error)


def test_issue_047_a_wedge_with_bristles_holds_for_a_minute(tmp_path, fmus):
    case = tmp_path / "bristles.toml"
    case.write_text('[wedge]\ndamping = "constant"\n[friction]\nlaw = "bristle"\n')
    names = ["force_on_bolster_x", "force_on_bolster_z"]
    result, log = simulate(fmus("3", case=str(case)), "CoSimulation", 0.01, 60.0, names)
    rows = result["time"] >= 5.0
    size = abs(result[names[0]][-1])
    assert size > 1000.0 * INCH
    for name in names:
        assert np.ptp(result[name][rows]) < 1e-6 * size, name
