"""A study: the energy that a wedge takes a cycle, over friction and angle, kept as it is computed.

    python examples/study.py

Interrupt it and start it again: it goes on where it was. The folder `study` has a page and a table.
"""

from pathlib import Path

import pandas as pd

import wedgelab as wl

Path("friction_and_angle.toml").write_text(
    """
title = "Friction and angle"
case = "cdrun_toe_out_0.2_psi_0.012"
sampling = "full_factorial"
[set]
simulation.duration = "4.8 s"
[vary]
friction.column = [0.2, 0.3, 0.4]
wedge.angle = ["30 deg", "32 deg", "35 deg"]
"""
)
outcome = wl.Study("friction_and_angle.toml").run("study", jobs=2)
table = pd.read_parquet(outcome.table)  # needs pyarrow
print(table[["friction.column", "wedge.angle_deg", "energy_per_cycle_side_frame_lbf_in"]].to_string(index=False))
