"""Coupling: a mass on a spring, stepped by this program, whose damper is a wedge stepped by Wedgelab.

    python examples/coupling.py

The mass starts downwards and swings until the wedge holds it. The program knows the wedge by what it does: a motion of
the bolster in, a force on the bolster out.
"""

import wedgelab as wl

MASS, STIFFNESS, STEP = 5000.0, 2.0e6, 5e-4  # kg, N/m, s
case = wl.Case("cdrun_toe_out_0.2_psi_0.012")
# What the spring carries besides: the wedge's force midway between a bolster that rises and one that falls.
carried = case.run()["net_force_on_bolster_z"].mean()

wedge = wl.Wedge(case)
z, v, force = 0.0, -0.5, carried  # m, m/s, N
peaks = []
for _ in range(4000):
    # The symplectic Euler method; the wedge's force is that at the end of the last step.
    previous, v = v, v + STEP * (-STIFFNESS * z + force - carried) / MASS
    z += STEP * v
    force = wedge.step(wl.Motion({"vertical": z}, {"vertical": v}), STEP).on_bolster[2]
    if previous < 0.0 <= v or v < 0.0 <= previous:
        peaks.append(1e3 * z)
print("turning points, mm:", ", ".join(f"{peak:.2f}" for peak in peaks[:8]))
