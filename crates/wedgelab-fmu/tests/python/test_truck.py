"""The truck with four wedges: as a system structure in FMPy, and step by step with a master of our own that reads everything."""

import zipfile

import numpy as np
import pytest
from conftest import wedgelab
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import get_connections, read_ssd, read_ssv
from fmpy.validation import validate_fmu
from test_state import Wedge

CASE = "cdrun_toe_0_psi_0"
WEDGES = ["leading_left", "leading_right", "trailing_left", "trailing_right"]
STEP = 1e-4
POUND, INCH = 0.45359237, 0.0254
LBF = POUND * 9.80665


@pytest.fixture(scope="module")
def truck(tmp_path_factory):
    folder = tmp_path_factory.mktemp("truck")
    wedgelab("fmu", "ssp", CASE, "-o", folder / "truck.ssp")
    with zipfile.ZipFile(folder / "truck.ssp") as archive:
        archive.extractall(folder)
    return folder


class Master:
    """Exchanges values once a step, as FMPy's does: each component goes on with what the others said at the step's begin."""

    def __init__(self, folder, **start):
        ssd = read_ssd(str(folder / "truck.ssp"))
        self.parts = {"truck": Wedge(str(folder / "resources" / "FrictionTruck.fmu"), "truck")}
        for name in WEDGES:
            self.parts[name] = Wedge(str(folder / "resources" / "FrictionWedge.fmu"), name)
        self.parts["truck"].set(**start)
        for part in self.parts.values():
            part.start()
        self.links = {}
        for connection in ssd.system.connections:
            key = connection.startElement, connection.endElement
            names = self.links.setdefault(key, ([], []))
            names[0].append(connection.startConnector)
            names[1].append(connection.endConnector)
        self.time = 0.0
        self.step_number = 0
        self.exchange()

    def exchange(self):
        values = {key: self.parts[key[0]].get(*names[0]) for key, names in self.links.items()}
        for key, names in self.links.items():
            self.parts[key[1]].set(**dict(zip(names[1], values[key])))

    def step(self):
        for part in self.parts.values():
            part.fmu.doStep(currentCommunicationPoint=self.time, communicationStepSize=STEP)
        self.step_number += 1
        self.time = self.step_number * STEP
        self.exchange()

    def free(self):
        for part in self.parts.values():
            part.free()


def test_input_fmpy_finds_no_problem(truck):
    ssd = read_ssd(str(truck / "truck.ssp"))
    assert [element.name for element in ssd.system.elements] == ["truck", *WEDGES]
    # Six positions and rates of two neighbours to each wedge; force and moment on both back.
    assert len(ssd.system.connections) == 4 * (24 + 12) == len(get_connections(ssd.system))
    units = {unit.name for unit in ssd.units}
    assert {"m", "rad", "m/s", "rad/s", "N", "N.m"} <= units
    for name in ["FrictionTruck", "FrictionWedge"]:
        assert validate_fmu(str(truck / "resources" / f"{name}.fmu")) == []
    values = read_ssv(str(truck / "truck.ssp"), "resources/parameters.ssv")
    assert any(parameter.name == "trailing_left.toe" for parameter in values.parameters)


def test_limits_symmetric_wedges_give_equal_forces(truck):
    """Bounce in FMPy: stable, and the four wedges do the same. Mirrored ones (left and right) and turned ones (leading, trailing)."""
    path = str(truck / "truck.ssp")
    result = simulate_ssp(
        path, stop_time=0.4, step_size=STEP, parameter_set=read_ssv(path, "resources/parameters.ssv")
    )
    force = [np.array(result[f"{name}.force_on_bolster_z"]) for name in WEDGES]
    height = np.array(result["truck.leading_left_bolster_z"])
    print(height.min(), height.max(), [(f.min(), f.max()) for f in force])
    assert all(np.isfinite(result[name]).all() for name in result.dtype.names)
    scale = np.abs(force[0]).max()
    for other in force[1:]:
        assert np.abs(other - force[0]).max() < 0.02 * scale
    # About a tenth of a metre a second on springs of 2 Hz: up by some millimetres, and held back by friction.
    assert 0.002 < height.max() < 0.02 and height.min() > -0.02


def test_energy_what_wedges_give_is_what_the_truck_takes(truck):
    """The work of the loads on the truck, and that of the motions on the wedges, sum to zero but for what one exchange a step loses; each
    part's own ledger closes."""
    master = Master(truck, body_z_rate_start=0.1, body_roll_rate_start=0.02, body_yaw_rate_start=0.01)
    for _ in range(4000):
        master.step()
    work = master.parts["truck"].get("load_work")[0]
    residual = master.parts["truck"].get("ledger_residual")[0]
    given = sum(master.parts[name].get("motion_work")[0] for name in WEDGES)
    lost = sum(
        master.parts[name].get("side_frame_friction_loss", "bolster_friction_loss").sum() for name in WEDGES
    )
    residuals = [master.parts[name].get("ledger_residual")[0] for name in WEDGES]
    print(work, given, lost, residual, residuals)
    assert lost > 10.0
    assert abs(work + given) < 0.02 * lost
    assert abs(residual) < 1e-3 * lost
    assert max(map(abs, residuals)) < 1e-3 * lost
    master.free()


def test_analytic_the_truck_at_rest_carries_weight_and_wedges(truck):
    """All forces on a truck that has come to rest sum to its weight and that of the wedges: through the wedges go only these."""
    master = Master(truck)
    sums = []
    for number in range(6000):
        master.step()
        if number >= 5000:
            forces = [master.parts[name].get("force_on_bolster_z", "force_on_side_frame_z") for name in WEDGES]
            sums.append(np.sum(forces))
    weight = 4 * 50 * LBF
    print(np.mean(sums), weight)
    assert abs(np.mean(sums) + weight) < 0.01 * weight
    master.free()


def test_limits_a_truck_turned_as_a_whole_moves_its_wedges_together(truck):
    """Rigid turns of everything: the points of bolster and side frame that a wedge sees are consistent with each other."""
    part = Wedge(str(truck / "resources" / "FrictionTruck.fmu"), "truck")
    angle = 1e-3
    part.set(body_yaw_start=angle)
    part.start()
    for name, sign in zip(WEDGES, [-1, -1, 1, 1]):
        x, y, yaw = part.get(*(f"{name}_bolster_{axis}" for axis in ("x", "y", "yaw")))
        left = 1 if name.endswith("left") else -1
        # x = -yaw · y0, y = yaw · x0 in the truck's axes; turned wedges see them with other signs, yaw as it is.
        assert np.isclose(x * sign, -angle * left * 39.5 * INCH)
        # Pockets lie 8.5 in from the bolster's middle, less a quarter of the wedge's length, which is 6.125 in tan 37.5°.
        middle = (8.5 - 0.25 * 6.125 * np.tan(np.deg2rad(37.5))) * INCH
        assert np.isclose(y * sign, -sign * angle * middle)
        assert yaw == angle
    part.free()
