"""FMI 2.0 co-simulation in libcosim, the library of the Open Simulation Platform, against `wedgelab run`."""

import numpy as np
from conftest import DURATION, STEP, averages, motion
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

# Else every change of a contact state is printed.
log_output_level(CosimLogLevel.WARNING)

INPUT = ["bolster_z", "bolster_z_rate"]
OUTPUT = ["side_frame_friction_loss", "vertical_wedge_force"]


class Simulation:
    """Instances of one FMU, driven and observed by libcosim."""

    def __init__(self, path, names):
        self.execution = CosimExecution.from_step_size(round(STEP * 1e9))
        self.slaves = []
        for name in names:
            slave = CosimLocalSlave(fmu_path=path, instance_name=name)
            index = self.execution.add_local_slave(slave)
            assert index >= 0, "the FMU is not taken"
            self.slaves.append(index)
        self.manipulator = CosimManipulator.create_override()
        self.observer = CosimObserver.create_last_value()
        assert self.execution.add_manipulator(self.manipulator)
        assert self.execution.add_observer(self.observer)
        variables = self.execution.slave_variables(self.slaves[0])
        self.references = {variable.name.decode(): variable.reference for variable in variables}

    def step(self, time, slave):
        references = [self.references[name] for name in INPUT]
        assert self.manipulator.slave_real_values(slave, references, list(map(float, motion(time))))

    def get(self, slave, names):
        return list(self.observer.last_real_values(slave, [self.references[name] for name in names]))

    def advance(self):
        assert self.execution.step()


def test_cross_code_libcosim_gives_the_averages_of_a_run(fmus, run):
    simulation = Simulation(fmus("2"), ["wedge"])
    slave = simulation.slaves[0]
    rows = []
    for k in range(round(DURATION / STEP)):
        simulation.step(k * STEP, slave)
        simulation.advance()
        if (k + 1) % 10 == 0:
            rows.append([(k + 1) * STEP, *simulation.get(slave, OUTPUT)])
    time, loss, force = np.array(rows).T
    found = averages(time, loss, force)
    error = np.abs(found / run - 1.0)
    print(found, run, error)
    assert np.all(error < 0.005), (found, run, error)


def test_analytic_four_wedges_in_libcosim_give_what_one_gives(fmus):
    names = ["force_on_bolster_x", "force_on_bolster_z", "force_on_side_frame_z", *OUTPUT]
    results = []
    for count in [1, 4]:
        simulation = Simulation(fmus("2"), [f"wedge_{number}" for number in range(count)])
        for k in range(100):
            for slave in simulation.slaves:
                simulation.step(k * STEP, slave)
            simulation.advance()
        results += [simulation.get(slave, names) for slave in simulation.slaves]
    assert len(results) == 5 and all(result == results[0] for result in results)
    assert all(np.isfinite(results[0])) and results[0][0] != 0.0
