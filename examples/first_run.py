"""A first run: the wedge of the thesis with constant damping, and the force that it has on the bolster.

    pip install ".[all]" pyarrow
    python examples/first_run.py
"""

import wedgelab as wl

case = wl.Case("cdrun_toe_out_0.2_psi_0.012", friction={"column": 0.3})
result = case.run()

averages = result.summary.averages
print("mean vertical wedge force while the bolster rises:", averages.up.vertical_wedge_force)
print("mean vertical wedge force while the bolster falls:", averages.down.vertical_wedge_force)
print("friction energy a cycle at the side frame:        ", averages.energy_per_cycle.side_frame)
print("largest residual of the energy ledger:            ", result.summary.ledger.largest_relative_residual)
for assumption in result.assumptions[:3]:
    print("assumed:", assumption)

result.write("first_run", force=True)  # result.csv, result.mat, case.toml, summary.json
result.plot_hysteresis().figure.savefig("first_run/loop.png")
