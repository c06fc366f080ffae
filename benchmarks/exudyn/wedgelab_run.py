"""Runs Wedgelab and reads its table under the names that the Exudyn models use."""

from __future__ import annotations

import resource
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from forces import OBSERVED
from model import WEDGES, Rig
from result import Result

STOPS = ("warp_moment_pocket_sides", "warp_moment_lands", "warp_moment_gibs")
"""Parts of the warp moment of elements that the Exudyn models leave out."""


def find(given: str | None) -> Path:
    """The program: as given, or on the search path."""
    found = given or shutil.which("wedgelab")
    if found is None or not Path(found).is_file():
        named = f"`{given}` is no file" if given else "no `wedgelab` is on the search path"
        raise SystemExit(
            f"{named}; build it with `cargo build --release -p wedgelab`, and give --wedgelab PATH"
        )
    return Path(found).resolve()


def run(program: Path, rig: Rig, law: str, creep_speed: float, tolerance: float, duration: float) -> Result:
    """Runs a built-in case with a friction law, and checks that the stops left out elsewhere stay open."""
    settings = {
        "friction.law": law,
        "friction.column": rig.contact.friction,
        "friction.slope": rig.contact.friction,
        "simulation.relative_tolerance": tolerance,
        "simulation.duration": f'"{duration} s"',
    }
    if law == "tanh":
        settings["friction.reference_speed"] = f'"{creep_speed} in/s"'
    with tempfile.TemporaryDirectory() as folder:
        command = [str(program), "run", rig.name, "--quiet", "--force", "--out", folder]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, check=True, capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        table = np.genfromtxt(Path(folder) / "result.csv", delimiter=",", names=True)
    columns = {
        "time": table["time_s"],
        "bolster_z": table["bolster_z_in"],
        "warp_angle": table["warp_angle_rad"],
    }
    names = table.dtype.names or ()
    wanted = (*OBSERVED, *STOPS, "motion_work", "friction_loss", "contact_damping_loss", "element_loss")
    for name in wanted:
        unit = "in" if name.startswith("warp_moment") or name.endswith(("_work", "_loss")) else ""
        column = f"{name}_lbf{'_in' if unit else ''}"
        if column not in names:
            raise SystemExit(f"Wedgelab's table has no column `{column}`: its names have changed")
        columns[name] = table[column]
    columns["wedge_friction_loss"] = np.sum(
        [
            table[f"{name}_{face}_friction_loss_lbf_in"]
            for name, _, _ in WEDGES
            for face in ("column", "slope")
        ],
        axis=0,
    )
    for name in STOPS:
        if np.any(columns[name] != 0.0):
            raise SystemExit(f"{rig.name}: `{name}` is not zero: the Exudyn models have no such stop")
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Result(columns, tolerance, spent)
