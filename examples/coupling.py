"""Coupling: a mass on a spring, stepped by this program, whose damper is a wedge stepped by Wedgelab.

    python examples/coupling.py

The mass falls by its start and swings until the wedge holds it. The program knows the wedge by what it does:
a motion of the bolster in, a force on the bolster out.
"""

import wedgelab as wl

MASS, STIFFNESS, STEP = 5000.0, 2.0e6, 5e-4  # kg, N/m, s
wedge = wl.Wedge(wl.Case("cdrun_toe_-0.2_psi_0.012", {"simulation.duration": "2 s"}))
z, v = 0.0, -0.3  # m, m/s
at_rest = wedge.step({"vertical": z}, STEP).on_bolster[2]
peaks = []
for k in range(4000):
    # Velocity and displacement by turns (the symplectic Euler method); the wedge's force is that of the last step.
    force = at_rest if k == 0 else forces.on_bolster[2]
    previous, v = v, v + STEP * (-STIFFNESS * z + force - at_rest) / MASS
    z += STEP * v
    forces = wedge.step(wl.Motion({"vertical": z}, {"vertical": v}), STEP)
    if previous < 0.0 <= v or v < 0.0 <= previous:
        peaks.append(1e3 * z)
print("turning points, mm:", ", ".join(f"{peak:.2f}" for peak in peaks[:8]))
