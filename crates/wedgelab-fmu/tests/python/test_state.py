"""States, instances and derivatives, through FMPy's slaves."""

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import STEP, motion
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave


class Wedge:
    """One instance of co-simulation, by names of variables."""

    def __init__(self, path, name="wedge"):
        self.description = read_model_description(path)
        self.folder = extract(path)
        self.two = self.description.fmiVersion == "2.0"
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        kind = FMU2Slave if self.two else FMU3Slave
        token = self.description.guid if self.two else self.description.instantiationToken
        self.fmu = kind(
            guid=token,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.fmu.instantiate()
        self.time = 0.0

    def start(self, **values):
        """Initializes the instance; `values` are inputs at the start."""
        if self.two:
            self.fmu.setupExperiment(startTime=0.0)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=0.0)
        self.set(**values)
        self.fmu.exitInitializationMode()
        return self

    def get(self, *names):
        references = [self.references[name] for name in names]
        return np.array(self.fmu.getReal(references) if self.two else self.fmu.getFloat64(references))

    def set(self, **values):
        references = [self.references[name] for name in values]
        set_values = self.fmu.setReal if self.two else self.fmu.setFloat64
        set_values(references, list(values.values()))

    def step(self, number):
        for _ in range(number):
            z, rate = motion(self.time)
            self.set(bolster_z=z, bolster_z_rate=rate)
            if self.two:
                self.fmu.doStep(currentCommunicationPoint=self.time, communicationStepSize=STEP)
            else:
                self.fmu.doStep(currentCommunicationPoint=self.time, communicationStepSize=STEP)
            self.time += STEP
        return self

    def all(self):
        """Every real variable."""
        names = [v.name for v in self.description.modelVariables if v.type in ("Real", "Float64")]
        return self.get(*names)

    def save(self):
        return self.fmu.getFMUState() if not self.two else self.fmu.getFMUstate()

    def restore(self, state, time):
        (self.fmu.setFMUstate if self.two else self.fmu.setFMUState)(state)
        self.time = time

    def serialize(self, state):
        return (self.fmu.serializeFMUstate if self.two else self.fmu.serializeFMUState)(state)

    def deserialize(self, data):
        return (self.fmu.deSerializeFMUstate if self.two else self.fmu.deserializeFMUState)(data)

    def free(self):
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


@pytest.mark.parametrize("version", ["2", "3"])
@pytest.mark.parametrize("model", ["wedge", "quasi_static"])
def test_analytic_saving_and_restoring_changes_nothing(fmus, version, model):
    wedge = Wedge(fmus(version, model)).start().step(100)
    here, time, state = wedge.all(), wedge.time, wedge.save()
    there = wedge.step(150).all()
    assert not np.array_equal(here, there)
    wedge.restore(state, time)
    assert np.array_equal(wedge.all(), here)
    assert np.array_equal(wedge.step(150).all(), there)
    wedge.free()


@pytest.mark.parametrize("version", ["2", "3"])
@pytest.mark.parametrize("model", ["wedge", "quasi_static"])
def test_analytic_a_serialized_state_goes_on_in_another_process(fmus, version, model, tmp_path):
    path = fmus(version, model)
    wedge = Wedge(path).start().step(100)
    (tmp_path / "state").write_bytes(bytes(wedge.serialize(wedge.save())))
    time, there = wedge.time, wedge.step(100).all()
    wedge.free()
    code = (
        "import sys, numpy as np\n"
        f"sys.path.insert(0, {str(Path(__file__).parent)!r})\n"
        "from test_state import Wedge\n"
        f"wedge = Wedge({path!r}).start()\n"
        f"wedge.restore(wedge.deserialize(open({str(tmp_path / 'state')!r}, 'rb').read()), {time!r})\n"
        f"np.save({str(tmp_path / 'there.npy')!r}, wedge.step(100).all())\n"
        "wedge.free()\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
    assert np.array_equal(np.load(tmp_path / "there.npy"), there)


@pytest.mark.parametrize("version", ["2", "3"])
def test_analytic_four_instances_give_what_one_gives(fmus, version):
    path = fmus(version)
    alone = Wedge(path).start().step(50)
    expected = alone.all()
    alone.free()
    four = [Wedge(path, f"wedge_{number}").start() for number in range(4)]
    for _ in range(50):
        for wedge in four:
            wedge.step(1)
    for wedge in four:
        assert np.array_equal(wedge.all(), expected)
        wedge.free()


def test_analytic_derivatives_are_those_of_differences(fmus):
    """Of the forces by the bolster's height, its rate and its yaw: against differences of the initialization."""
    path = fmus("2")
    outputs = ["force_on_bolster_x", "force_on_bolster_z", "moment_on_bolster_yaw", "force_on_side_frame_x"]
    start = {"bolster_z": 0.0, "bolster_z_rate": 0.01, "bolster_yaw": 0.012}

    def at(values):
        wedge = Wedge(path)
        wedge.fmu.setupExperiment(startTime=0.0)
        wedge.fmu.enterInitializationMode()
        wedge.set(**values)
        return wedge

    for name, h in [("bolster_z", 1e-9), ("bolster_z_rate", 1e-8), ("bolster_yaw", 1e-9)]:
        wedge = at(start)
        exact = wedge.fmu.getDirectionalDerivative(
            [wedge.references[output] for output in outputs], [wedge.references[name]], [1.0]
        )
        wedge.fmu.freeInstance()
        values = []
        for sign in (1.0, -1.0):
            wedge = at({**start, name: start[name] + sign * h})
            values.append(wedge.get(*outputs))
            wedge.fmu.freeInstance()
        difference = (values[0] - values[1]) / (2.0 * h)
        assert np.allclose(exact, difference, rtol=1e-4, atol=1e-5 * np.abs(difference).max()), (name, exact, difference)


def test_input_bad_calls_are_refused_with_a_message(fmus):
    wedge = Wedge(fmus("2"))
    with pytest.raises(Exception):
        wedge.fmu.doStep(0.0, STEP)  # before the initialization
    wedge.start()
    for call in [
        lambda: wedge.set(bolster_z=float("nan")),
        lambda: wedge.set(force_on_bolster_z=1.0),
        lambda: wedge.set(wedge_angle=0.5),
        lambda: wedge.fmu.getReal([100000]),
        lambda: wedge.fmu.doStep(0.0, -STEP),
        lambda: wedge.fmu.doStep(0.0, float("nan")),
        lambda: wedge.fmu.doStep(5.0, STEP),
        lambda: wedge.fmu.getString([0]),
    ]:
        with pytest.raises(Exception):
            call()
    # And nothing has happened.
    assert wedge.get("time")[0] == 0.0
    wedge.step(3).free()
