"""A wedge as a functional mock-up unit, run in FMPy: the bolster moves by a sine, the wedge answers.

    pip install fmpy
    cargo build --release
    target/release/wedgelab fmu export cdrun_toe_out_0.2_psi_0.012 -o wedge.fmu
    python examples/fmu_in_fmpy.py wedge.fmu
"""

import sys

import numpy as np
from fmpy import read_model_description, simulate_fmu

path = sys.argv[1] if len(sys.argv) > 1 else "wedge.fmu"
print(read_model_description(path).modelName)
time = np.arange(0.0, 2.0 + 5e-4, 1e-3)
motion = np.zeros(len(time), dtype=[("time", float), ("bolster_z", float), ("bolster_z_rate", float)])
motion["time"], motion["bolster_z"] = time, 0.0254 * np.sin(2.0 * time)  # s, m
motion["bolster_z_rate"] = 0.0508 * np.cos(2.0 * time)  # m/s
out = simulate_fmu(path, stop_time=2.0, step_size=1e-3, output_interval=1e-2, input=motion, output=["force_on_bolster_z"])
force = out["force_on_bolster_z"]
print(f"vertical force on the bolster: {force.min():.0f} to {force.max():.0f} N")
