"""Warp: the moment that a truck's nests have against the yaw of its side frames, over the friction of its wedges.

    python examples/warp_curve.py

It writes warp_curve.png. `wedgelab warp` does the same for one truck, with tables and parts of the moment.
"""

import matplotlib.pyplot as plt

import wedgelab as wl

frictions = (0.1, 0.2, 0.25)
trucks = [
    wl.TruckCase("truck_warp_nest_constant_rising", {"friction.column": friction, "friction.slope": friction})
    for friction in frictions
]
for friction, result in zip(frictions, wl.run_many(trucks, workers=2)):
    moment = result["warp_moment"] / 112.985  # N m to kip in
    plt.plot(1e3 * result["warp_angle"], moment, label=f"friction {friction}")
    print(f"friction {friction}: largest moment {moment.max():.0f} kip in")
plt.xlabel("warp angle, mrad")
plt.ylabel("warp moment, kip in")
plt.legend()
plt.savefig("warp_curve.png")
