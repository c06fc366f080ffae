"""FMUs of a yawed case, exported once, and what `wedgelab run` says of it.

The environment variable WEDGELAB names the program; the library lies beside it. PORTABLE_LIBRARY is the same library compiled for all
processors.
"""

import json
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

CASE = "cdrun_toe_out_0.2_psi_0.012"
INCH = 0.0254
LBF = 0.45359237 * 9.80665
# The bolster moves by 1 in · sin(2 rad/s · t), for 5 s: one whole cycle after the first half period.
AMPLITUDE, OMEGA, DURATION, STEP = INCH, 2.0, 5.0, 1e-3
PORTABLE = ["--library", os.environ["PORTABLE_LIBRARY"]]
KINDS = ["ModelExchange", "CoSimulation"]


def wedgelab(*arguments, check=True):
    """Runs the program."""
    program = os.environ["WEDGELAB"]
    return subprocess.run([program, *map(str, arguments)], check=check, capture_output=True, text=True)


@dataclass
class Fmus:
    """Files by version and model."""

    folder: Path

    def __call__(self, version, model="wedge", case=CASE, *more):
        name = f"{model}_{version}_{abs(hash((case, more)))}.fmu"
        path = self.folder / name
        if not path.exists():
            quasi_static = ["--quasi-static"] if model == "quasi_static" else []
            wedgelab("fmu", "export", case, "-o", path, "--fmi", version, *quasi_static, *more)
        return str(path)


@pytest.fixture(scope="session")
def fmus(tmp_path_factory):
    return Fmus(tmp_path_factory.mktemp("fmus"))


@pytest.fixture(scope="session")
def run(tmp_path_factory):
    """Energy per cycle (J) and branch means of the vertical wedge force (N; up, down) of the same case, run by itself."""
    folder = tmp_path_factory.mktemp("run") / "result"
    wedgelab("run", CASE, "--out", folder, "--quiet", "--set", f"simulation.duration='{DURATION} s'")
    averages = json.loads((folder / "summary.json").read_text())["averages"]
    energy = averages["energy_per_cycle"]["side_frame"]
    assert energy["unit"] == "lbf·in" or energy["unit"] == "lbf in", energy
    force = [averages[branch]["vertical_wedge_force"]["value"] * LBF for branch in ("up", "down")]
    return np.array([energy["value"] * LBF * INCH, *force])


def motion(time):
    """Bolster's height and its rate."""
    return AMPLITUDE * np.sin(OMEGA * time), AMPLITUDE * OMEGA * np.cos(OMEGA * time)


@pytest.fixture(scope="session")
def signal():
    """The motion as an input of FMPy."""
    time = np.arange(0.0, DURATION + 0.5 * STEP, STEP)
    table = np.zeros(len(time), dtype=[("time", float), ("bolster_z", float), ("bolster_z_rate", float)])
    table["time"] = time
    table["bolster_z"], table["bolster_z_rate"] = motion(time)
    return table


def averages(time, loss, force):
    """The same numbers as of a run, from time histories: whole cycles after the first half period; branches where the bolster moves with
    more than 0.9 of its peak speed."""
    half = np.pi / OMEGA
    cycles = np.floor((DURATION - half) / (2.0 * half) * (1.0 + 1e-12))
    ends = np.interp([half, half + cycles * 2.0 * half], time, loss)
    rate = motion(time)[1]
    counts = time > half
    peak = AMPLITUDE * OMEGA
    up, down = counts & (rate > 0.9 * peak), counts & (rate < -0.9 * peak)
    return np.array([(ends[1] - ends[0]) / cycles, force[up].mean(), force[down].mean()])
