"""Identification: two coefficients of friction from measured forces, by the Gauss-Newton method.

    python examples/fit.py

The "measurement" is a run with known coefficients. `wedgelab fit` does this for any parameters and files.
"""

import numpy as np

import wedgelab as wl

KEYS = ("friction.column", "friction.slope")
BASE = wl.Case("cdrun_toe_out_0.2_psi_0.012", simulation={"duration": "4.8 s"})


def forces(points: list[np.ndarray]) -> np.ndarray:
    cases = [BASE.replace(dict(zip(KEYS, map(float, point)))) for point in points]
    results = wl.run_many(cases, workers=2, columns=["time", "vertical_wedge_force"])
    return np.array([result["vertical_wedge_force"] for result in results])


measured = forces([np.array([0.32, 0.27])])[0]
found, step = np.array([0.4, 0.4]), 1e-3
for _ in range(6):
    here, *moved = forces([found, found + [step, 0.0], found + [0.0, step]])
    sensitivities = (np.array(moved) - here).T / step
    found = found + np.linalg.lstsq(sensitivities, measured - here, rcond=None)[0]
    misfit = np.sqrt(np.mean((measured - here) ** 2))
    print("column {:.4f}, slope {:.4f};".format(*found), f"misfit before this step {misfit:.2f} N")
