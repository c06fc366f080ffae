"""Short runs of both Exudyn models against Wedgelab: `python -m pytest` in this folder, a minute or two.

The program is the one named by the environment variable WEDGELAB, or `wedgelab` on the search path.
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import own_elements
import user_function
import wedgelab_run
from measures import coil_energy, measures
from model import VERTICAL_VARIABLE, WARP_CONSTANT_RISING, Rig
from result import Result

USER_FUNCTION_BOUND = 5e-5
"""Same equations, other code: what is left is the error of both integrators, largest in the first steps."""

OWN_ELEMENTS_BOUND = 5e-3
"""Friction is regularized by a ramp here and by tanh there: the sticking slope creeps at other speeds."""

FRICTIONLESS_BOUND = 1e-3
"""The largest force of the first swing, with a sixteenth of its period as step; all else is within 1e-6."""

VERTICAL = replace(VERTICAL_VARIABLE, duration=3.4)
"""Both branches once."""

WARP = replace(WARP_CONSTANT_RISING, duration=4.5)
"""Up to the first turn."""

WARPS = (WARP.with_friction(0.25), WARP.with_friction(0.4))


@pytest.fixture(scope="session")
def program() -> Path:
    """Wedgelab."""
    return wedgelab_run.find(os.environ.get("WEDGELAB"))


def largest_difference(rig: Rig, found: Result, reference: Result) -> tuple[float, str]:
    """Largest relative difference of a measure, and which it is."""
    a, b = measures(rig, found), measures(rig, reference)
    assert a.keys() == b.keys() and len(b) >= 2
    return max((abs(a[name] - b[name]) / abs(b[name]), name) for name in b)


def wedgelab(program: Path, rig: Rig, law: str) -> Result:
    """Wedgelab at a tight tolerance."""
    return wedgelab_run.run(program, rig, law, own_elements.CREEP_SPEED, 1e-8, rig.duration)


def by_user_function(rig: Rig) -> Result:
    """Exudyn with one compiled user function."""
    return user_function.run(rig, 4.0e-5)


@pytest.mark.parametrize("rig", [VERTICAL, *WARPS], ids=lambda rig: f"{rig.name}-{rig.contact.friction}")
def test_cross_code_user_function_is_wedgelabs_truck(program: Path, rig: Rig) -> None:
    found, reference = by_user_function(rig), wedgelab(program, rig, "bristle")
    apart, name = largest_difference(rig, found, reference)
    assert apart < USER_FUNCTION_BOUND, name

    work = reference.columns["motion_work"] + (coil_energy(rig, reference) if rig.warp else 0.0)
    size = np.abs(found.columns["motion_work"]).max()
    assert np.abs(work - found.columns["motion_work"]).max() < USER_FUNCTION_BOUND * size
    ours, theirs = (float(result.columns["wedge_friction_loss"][-1]) for result in (reference, found))
    assert theirs == pytest.approx(ours, rel=USER_FUNCTION_BOUND)


@pytest.mark.parametrize("rig", [VERTICAL, WARP], ids=lambda rig: rig.name)
def test_cross_code_own_elements_without_friction_are_wedgelabs_truck(program: Path, rig: Rig) -> None:
    smooth = rig.with_friction(0.0)
    found = own_elements.run(smooth, 1.0e-4)
    apart, name = largest_difference(smooth, found, wedgelab(program, smooth, "tanh"))
    assert apart < FRICTIONLESS_BOUND, name
    # Adapters are springs that stick: they must not be asked for more than friction holds.
    assert found.columns["adapter_use"].max() < 1.0


def test_cross_code_own_elements_are_wedgelabs_truck_with_regularized_friction(program: Path) -> None:
    found = own_elements.run(VERTICAL, 1.0e-4)
    apart, name = largest_difference(VERTICAL, found, wedgelab(program, VERTICAL, "tanh"))
    assert apart < OWN_ELEMENTS_BOUND, name


def test_convergence_regularized_laws_come_together_with_their_speed(program: Path) -> None:
    rig = replace(WARPS[0], duration=2.1)
    apart = []
    for speed in (1.0e-3, 1.0e-4):
        found = own_elements.run(rig, 1.0e-4, speed)
        reference = wedgelab_run.run(program, rig, "tanh", speed, 1e-8, rig.duration)
        apart.append(largest_difference(rig, found, reference)[0])
    assert apart[1] < 0.6 * apart[0] < 0.03


def test_limits_a_truck_of_another_friction_is_told_apart(program: Path) -> None:
    other = by_user_function(VERTICAL.with_friction(0.399))
    apart, _ = largest_difference(VERTICAL, other, wedgelab(program, VERTICAL, "bristle"))
    assert apart > 10.0 * USER_FUNCTION_BOUND


def test_input_a_missing_program_is_told() -> None:
    with pytest.raises(SystemExit, match="is no file"):
        wedgelab_run.find("no_such_program")
