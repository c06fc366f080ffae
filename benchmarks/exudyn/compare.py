"""Runs the truck in Wedgelab and in Exudyn, converges both, tells how far apart they are and what they cost.

python compare.py --wedgelab PATH            prints the tables and writes results.json beside this file
python compare.py --wedgelab PATH --readme   writes the tables into README.md too
python compare.py --from-results --readme    the same from results.json, without a run
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import own_elements
import user_function
import wedgelab_run
from measures import coil_energy, histories, measures
from model import VERTICAL_VARIABLE, WARP_CONSTANT_RISING, Rig
from result import Result
from tables import percent, tables

HERE = Path(__file__).resolve().parent
BEGIN, END = "<!-- tables: begin -->", "<!-- tables: end -->"

TOLERANCES = (1e-6, 1e-8)
"""Of Wedgelab: its default, and a hundredth of it."""

USER_FUNCTION_STEPS = (4.0e-5, 2.0e-5)
OWN_ELEMENTS_STEPS = (1.0e-4, 5.0e-5)
CPU_REPEATS = 3

LONG_STEPS, LONG_STEPS_DURATION = (2.0e-4, 1.0e-4), 4.5
"""Of the table that tells what longer steps of the explicit method do, in s."""

CREEP_SPEEDS = (1.0e-3, 1.0e-4)
"""Of the table that tells how the two regularized laws of friction come together, in in/s."""


@dataclass(frozen=True)
class Variant:
    """A rig, and how far it runs."""

    title: str
    rig: Rig

    @property
    def key(self) -> str:
        """A short name for the table of results."""
        return f"{self.rig.name}, friction {self.rig.contact.friction}"


VARIANTS = (
    Variant("Vertical, variable damping, friction 0.4", VERTICAL_VARIABLE),
    Variant("Warp, constant damping, friction 0.25", WARP_CONSTANT_RISING.with_friction(0.25)),
    Variant("Warp, constant damping, friction 0.4", WARP_CONSTANT_RISING.with_friction(0.4)),
)


@dataclass(frozen=True)
class Side:
    """One Exudyn model, and the friction law of Wedgelab that it stands against."""

    key: str
    law: str
    steps: tuple[float, float]
    run: Callable[[Rig, float], Result]


SIDES = (
    Side("user_function", "bristle", USER_FUNCTION_STEPS, user_function.run),
    Side("own_elements", "tanh", OWN_ELEMENTS_STEPS, own_elements.run),
)


def wedgelab_pair(program: Path, rig: Rig, law: str) -> tuple[Result, Result, float]:
    """Wedgelab at both tolerances, and the least processor time of some runs at the first."""
    pair = [
        wedgelab_run.run(program, rig, law, own_elements.CREEP_SPEED, t, rig.duration) for t in TOLERANCES
    ]
    again = [
        wedgelab_run.run(program, rig, law, own_elements.CREEP_SPEED, TOLERANCES[0], rig.duration).cpu_seconds
        for _ in range(CPU_REPEATS)
    ]
    return pair[0], pair[1], min([pair[0].cpu_seconds, *again])


def compare(program: Path, variant: Variant, side: Side) -> dict[str, Any]:
    """One variant in one Exudyn model against Wedgelab with the same kind of friction."""
    rig = variant.rig
    coarse = side.run(rig, side.steps[0])
    loose, tight, cpu = wedgelab_pair(program, rig, side.law)
    fine = side.run(rig, side.steps[1])
    found, halved = measures(rig, coarse), measures(rig, fine)
    reference, tightened = measures(rig, loose), measures(rig, tight)
    rows = {
        name: {
            "wedgelab": tightened[name],
            "exudyn": halved[name],
            "difference_percent": percent(halved[name], tightened[name]),
            "exudyn_by_halving_percent": percent(halved[name], found[name]),
            "wedgelab_by_tolerance_percent": percent(tightened[name], reference[name]),
        }
        for name in tightened
    }
    entry: dict[str, Any] = {
        "title": variant.title,
        "law_of_wedgelab": side.law,
        "steps_s": side.steps,
        "tolerances": TOLERANCES,
        "measures": rows,
        "histories_percent_of_largest": histories(fine, tight),
        "cpu_s": {"exudyn": [coarse.cpu_seconds, fine.cpu_seconds], "wedgelab": cpu},
        "cpu_ratio": coarse.cpu_seconds / cpu,
    }
    if side.key == "user_function":
        work = tight.columns["motion_work"] + (coil_energy(rig, tight) if rig.warp else 0.0)
        entry["motion_work_lbf_in"] = {
            "wedgelab": float(work[-1]),
            "exudyn": float(fine.columns["motion_work"][-1]),
        }
        entry["wedge_friction_loss_lbf_in"] = {
            "wedgelab": float(tight.columns["wedge_friction_loss"][-1]),
            "exudyn": float(fine.columns["wedge_friction_loss"][-1]),
        }
    else:
        entry["adapter_use_largest"] = float(fine.columns["adapter_use"].max())
        bristles, _, _ = wedgelab_pair(program, rig, "bristle")
        stuck = measures(rig, bristles)
        for name, row in rows.items():
            row["wedgelab_with_bristles"] = stuck[name]
            row["from_bristles_percent"] = percent(row["exudyn"], stuck[name])
    return entry


def creep(program: Path, variant: Variant) -> dict[str, Any]:
    """Exudyn's own elements against Wedgelab's tanh law at some speeds of regularization."""
    rig, rows = variant.rig, {}
    for speed in CREEP_SPEEDS:
        found = own_elements.run(rig, OWN_ELEMENTS_STEPS[0], speed)
        reference = wedgelab_run.run(program, rig, "tanh", speed, TOLERANCES[0], rig.duration)
        a, b = measures(rig, found), measures(rig, reference)
        rows[f"{speed:g}"] = {
            "measures_largest_percent": max(abs(percent(a[name], b[name])) for name in b),
            "histories_percent_of_largest": histories(found, reference),
        }
    return {"title": variant.title, "step_s": OWN_ELEMENTS_STEPS[0], "by_speed": rows}


def frictionless(program: Path, variant: Variant) -> dict[str, Any]:
    """Exudyn's own elements against Wedgelab without friction at the wedges: all but the friction law."""
    rig = variant.rig.with_friction(0.0)
    found = own_elements.run(rig, OWN_ELEMENTS_STEPS[0])
    reference = wedgelab_run.run(program, rig, "tanh", own_elements.CREEP_SPEED, TOLERANCES[1], rig.duration)
    a, b = measures(rig, found), measures(rig, reference)
    return {
        "title": variant.title.rsplit(",", 1)[0],
        "step_s": OWN_ELEMENTS_STEPS[0],
        "measures_percent": {name: percent(a[name], b[name]) for name in b},
        "histories_percent_of_largest": histories(found, reference),
    }


def long_steps(program: Path, variant: Variant) -> dict[str, Any]:
    """The user function with longer steps: how far from Wedgelab, at what cost."""
    rig, rows = replace(variant.rig, duration=LONG_STEPS_DURATION), {}
    b = measures(rig, wedgelab_run.run(program, rig, "bristle", 0.0, TOLERANCES[1], rig.duration))
    for step in LONG_STEPS:
        result = user_function.run(rig, step)
        a = measures(rig, result)
        apart = max(abs(percent(a[name], b[name])) for name in b)
        rows[f"{step:g}"] = {"measures_largest_percent": apart, "cpu_s": result.cpu_seconds}
    return {"title": variant.title, "by_step": rows}


PARTS = (*(side.key for side in SIDES), "creep", "frictionless", "long_steps")
"""Parts of the comparison."""


def variants_of(part: str) -> tuple[Variant, ...]:
    """Variants that a part runs: without friction the warp rigs are one; long steps matter most if locked."""
    chosen = {"creep": VARIANTS[:1], "frictionless": VARIANTS[:2], "long_steps": (VARIANTS[0], VARIANTS[2])}
    return chosen.get(part, VARIANTS)


def run_part(program: Path, part: str, variant: Variant) -> dict[str, Any]:
    """One part of the comparison for one variant."""
    if part == "creep":
        return creep(program, variant)
    if part == "frictionless":
        return frictionless(program, variant)
    if part == "long_steps":
        return long_steps(program, variant)
    side = next(side for side in SIDES if side.key == part)
    return compare(program, variant, side)


def main() -> None:
    """Reads the arguments, runs all, and writes what came out."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--wedgelab", help="the program; left out, the one on the search path")
    parser.add_argument("--readme", action="store_true", help="write the tables into README.md")
    parser.add_argument("--from-results", action="store_true", help="run nothing: take results.json as it is")
    parser.add_argument("--part", choices=PARTS, help="run one part alone, and keep the other results")
    arguments = parser.parse_args()
    file = HERE / "results.json"
    results: dict[str, Any] = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    if not arguments.from_results:
        program = wedgelab_run.find(arguments.wedgelab)
        for part in [arguments.part] if arguments.part else PARTS:
            results[part] = {}
            for variant in variants_of(part):
                print(f"{part}: {variant.title}", flush=True)
                results[part][variant.key] = run_part(program, part, variant)
        results["made_with"] = {name: version(name) for name in ("exudyn", "numba", "numpy")}
        file.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    text = tables(results)
    print(text)
    if arguments.readme:
        readme = HERE / "README.md"
        before, _, rest = readme.read_text(encoding="utf-8").partition(BEGIN)
        _, _, after = rest.partition(END)
        readme.write_text(f"{before}{BEGIN}\n{text}{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
