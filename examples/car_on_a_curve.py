"""A loaded car on a curve: the forces of its eight wheels on the rails, and their ratios L/V.

    python examples/car_on_a_curve.py
"""

import wedgelab as wl

car = wl.CarCase("car_constant_curve_loaded", {"simulation.duration": "8 s"})
result = car.run()
distance = result["distance_ft"]
print(f"after {distance[-1]:.0f} ft at {result['speed_mph'][-1]:.1f} mph:")
for axle in range(1, 5):
    for side in ("left", "right"):
        wheel = f"axle_{axle}_{side}"
        vertical, lateral = result[f"{wheel}_vertical_lbf"][-1], result[f"{wheel}_lateral_lbf"][-1]
        print(f"axle {axle}, {side:5}: V {vertical:6.0f} lbf, L {lateral:6.0f} lbf, L/V {lateral / vertical:5.2f}")
    print(f"        angle of attack {1e3 * result[f'axle_{axle}_yaw'][-1]:.2f} mrad to the track")
