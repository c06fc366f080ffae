"""What a run of any program gives: time histories and processor time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from model import Array, Rig, bodies

OUTPUT_INTERVAL = 0.01
"""Seconds between two rows of a result."""


@dataclass(frozen=True)
class Result:
    """Time histories of one run."""

    columns: dict[str, Array]
    step: float
    cpu_seconds: float
    """Processor time of the integration alone, without building and compiling."""


def check_clearances(rig: Rig, columns: dict[str, Array]) -> None:
    """Stops: an error if a gap whose stop is left out has closed (bodies turn by small angles)."""

    def largest(name: str, **levers: float) -> float:
        zero = np.zeros(len(columns["time"]))
        return float(
            sum(
                (lever * np.abs(columns.get(f"{name}_{axis}", zero)) for axis, lever in levers.items()), zero
            ).max()
        )

    gaps, used = rig.clearances, {}
    for body in bodies(rig)[1:]:
        if not body.name.endswith("side_frame"):
            used[f"pocket's side, {body.name}"] = (largest(body.name, y=1.0), gaps.pocket_side)
            continue
        used[f"gib, {body.name}"] = (largest(body.name, y=1.0, roll=4.0), gaps.gib)
        turned = 0.0 if body.free else 7.0 * float(np.abs(columns["warp_angle"]).max())
        used[f"lands, {body.name}"] = (turned + largest(body.name, x=1.0, yaw=7.0, pitch=3.0), gaps.land)
        if body.free:
            along = largest(body.name, x=1.0, yaw=1.56, pitch=4.5)
            across = largest(body.name, y=1.0, yaw=35.0, roll=4.5)
            used[f"adapter along the track, {body.name}"] = (along, gaps.adapter_longitudinal)
            used[f"adapter across the track, {body.name}"] = (across, gaps.adapter_lateral)
    for place, (way, gap) in used.items():
        if way >= gap:
            raise RuntimeError(
                f"{rig.name}: {place}: moved by {way:.4g} in, the gap is {gap} in, and has no stop here"
            )
