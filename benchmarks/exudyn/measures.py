"""What the runs are compared by: the same lines for the tables of both programs."""

from __future__ import annotations

from math import pi

import numpy as np

from model import STROKE, STROKE_FREQUENCY, WARP_PERIOD, WARP_START, Array, Rig
from result import OUTPUT_INTERVAL, Result


def loop_area(times: Array, along: Array, force: Array, begin: float, end: float) -> float:
    """Integral of a force over a displacement between two times, by the trapezoidal rule."""
    inside = times[(times > begin) & (times < end)]
    grid = np.concatenate([[begin], inside, [end]])
    x, f = np.interp(grid, times, along), np.interp(grid, times, force)
    return float(np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(x)))


def vertical(result: Result) -> dict[str, float]:
    """Means over branches (after the first half period, above 0.9 of the largest speed), and the loop."""
    columns, times = result.columns, result.columns["time"]
    period = 2.0 * pi / STROKE_FREQUENCY
    speed = np.cos(STROKE_FREQUENCY * times)
    values: dict[str, float] = {}
    for branch, sign in (("up", 1.0), ("down", -1.0)):
        chosen = (times > 0.5 * period) & (sign * speed > 0.9)
        for name, shown in (
            ("left_nest_vertical_force", "nest load"),
            ("leading_left_column_normal", "column normal force"),
            ("leading_left_slope_normal", "slope normal force"),
        ):
            values[f"{shown}, mean {branch} [lbf]"] = float(columns[name][chosen].mean())
    cycles = int(times[-1] / period + 1e-9) - 1
    if cycles > 0:
        both = columns["left_nest_vertical_force"] + columns["right_nest_vertical_force"]
        begin = period
        area = loop_area(times, columns["bolster_z"], both, begin, begin + cycles * period)
        values["loop of nest loads, a cycle [lbf in]"] = abs(area) / cycles
    values["column normal force, largest [lbf]"] = float(columns["leading_left_column_normal"].max())
    return values


def warp(result: Result) -> dict[str, float]:
    """Moments one output time before each turn, the mean over the last quarter before it, the second loop."""
    columns, times = result.columns, result.columns["time"]
    values: dict[str, float] = {}
    for turn in range(4):
        at = WARP_START + WARP_PERIOD * (0.25 + 0.5 * turn)
        if at > times[-1] + 1e-9:
            break
        last = round(at / OUTPUT_INTERVAL) - 1
        values[f"warp moment before turn {turn + 1} [lbf in]"] = float(columns["warp_moment"][last])
        column = float(columns["leading_left_column_normal"][last])
        values[f"column normal force before turn {turn + 1} [lbf]"] = column
        # The last quarter of the way from zero to the turn.
        chosen = (times > at - WARP_PERIOD / 16.0) & (times < at - 0.5 * OUTPUT_INTERVAL)
        values[f"warp moment, mean from 15 to 20 mrad before turn {turn + 1} [lbf in]"] = float(
            columns["warp_moment"][chosen].mean()
        )
    begin = WARP_START + WARP_PERIOD
    if times[-1] + 1e-6 >= begin + WARP_PERIOD:
        end = min(begin + WARP_PERIOD, float(times[-1]))
        area = loop_area(times, columns["warp_angle"], columns["warp_moment"], begin, end)
        values["loop of the warp moment, second cycle [lbf in]"] = abs(area)
    chosen = (times > 1.3) & (times < WARP_START)
    values["column normal force, risen [lbf]"] = float(columns["leading_left_column_normal"][chosen].mean())
    values["nest load, risen [lbf]"] = float(columns["left_nest_vertical_force"][chosen].mean())
    return values


def measures(rig: Rig, result: Result) -> dict[str, float]:
    """All measures of a rig."""
    return warp(result) if rig.warp else vertical(result)


def histories(one: Result, other: Result) -> dict[str, dict[str, float]]:
    """Largest and root mean square difference of time histories over the largest value, in percent."""
    names = {
        "nest load": "left_nest_vertical_force",
        "column normal force": "leading_left_column_normal",
        "slope normal force": "leading_left_slope_normal",
        "warp moment": "warp_moment",
    }
    values: dict[str, dict[str, float]] = {}
    for shown, name in names.items():
        apart, size = one.columns[name] - other.columns[name], float(np.abs(other.columns[name]).max())
        if size > 1.0:
            largest, mean = float(np.abs(apart).max()), float(np.sqrt(np.mean(apart**2)))
            values[shown] = {"largest": 100.0 * largest / size, "root_mean_square": 100.0 * mean / size}
    return values


def coil_energy(rig: Rig, result: Result) -> Array:
    """Energy that load coils between prescribed bodies have taken up since the start (lbf in).

    Wedgelab's ledger leaves elements between two prescribed bodies out; here it is added, from closed form.
    """
    spring = rig.load_coil
    z, yaw = result.columns["bolster_z"], result.columns["warp_angle"]
    along = -8.0 * (spring.preload * z - 0.5 * spring.stiffness * z * z)
    # The seat of a coil at (x, y) from the nest's center moves by the chord of the turn.
    shear = 0.5 * spring.shear_stiffness * 8.0 * 2.0 * 3.75**2 * 2.0 * (1.0 - np.cos(yaw))
    taken = along + shear
    return np.asarray(taken - taken[0])


__all__ = ["STROKE", "coil_energy", "histories", "measures"]
