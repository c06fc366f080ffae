"""A truck on a rig: the bolster bounces on its two spring nests, with new wedges and with worn ones.

    python examples/truck_on_a_rig.py
"""

import wedgelab as wl

rises = {"new": "0 in", "worn": "0.75 in"}
trucks = [wl.TruckCase("truck_crowned_vertical_constant", {"wedge.rise": rise}) for rise in rises.values()]
for condition, result in zip(rises, wl.run_many(trucks, workers=2)):
    load = result["leading_left_column_normal_lbf"]
    friction = result["leading_left_column_friction_z_lbf"]
    print(f"{condition}: column load of a wedge {load.min():.0f} to {load.max():.0f} lbf,", end=" ")
    print(f"vertical friction there {friction.min():.0f} to {friction.max():.0f} lbf")
