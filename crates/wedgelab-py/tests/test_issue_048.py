"""Free rolling, points of arrays without an answer, lengths in another unit, None."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
import wedgelab as wl
from wedgelab import wheelrail as wr


@pytest.fixture(scope="module")
def wheelset() -> wr.Wheelset:
    return wr.Wheelset(wr.Profile.nominal("aar_1b"), wr.Profile.nominal("136re").inclined(1 / 40))


def test_issue_048_a_wheelset_rolls_freely_by_default(wheelset: wr.Wheelset) -> None:
    out = wheelset.contact(load="33 kip", lateral=[0.0, 5e-3, -5e-3], speed="40 mph")
    left, right = (np.nansum(wheel.fx, axis=-1) for wheel in (out.left, out.right))
    assert abs(left[0]) < 20.0 and abs(right[0]) < 20.0
    assert left[1] > 1e3 and left[1] + right[1] == pytest.approx(0.0, abs=0.01 * left[1])
    assert left[2] == pytest.approx(right[1], rel=1e-6)
    again = wheelset.contact(load="33 kip", lateral=[0.0, 5e-3, -5e-3], speed="40 mph", pitch_rate=out.pitch_rate)
    assert np.array_equal(again.left.fx, out.left.fx, equal_nan=True)
    given = wheelset.contact(load="33 kip", pitch_rate=-5.0)
    assert given.pitch_rate == -5.0


def test_issue_048_points_without_contact_are_nan_with_a_warning(wheelset: wr.Wheelset) -> None:
    lateral = [0.0, 5.0, np.nan, 5e-3]
    with pytest.warns(wl.PointWarning, match=r"2 of 4 points have no contact \(NaN\): 1, 2; at 1: the lateral place") as told:
        out = wheelset.contact(load="33 kip", lateral=lateral)
    assert "did you give inches" in str(told[0].message)
    assert list(np.isnan(out.left.vertical_force)) == [False, True, True, False]
    assert list(out.left.seat) == ["on_rail", "", "", "on_rail"]
    assert np.isnan(out.pitch_rate[1]) and np.isnan(out.right.fx[2]).all()
    whole = wheelset.contact(load="33 kip", lateral=[0.0, 5e-3])
    assert np.array_equal(out.left.normal[[0, 3]], whole.left.normal, equal_nan=True)
    with pytest.warns(wl.PointWarning, match=r"\(0, 1\)"):
        wheelset.contact(load=np.array([[1.5e5, 1e9]]), pitch_rate=-4.37)
    for load in (-1.0, [-1.0, -2.0]):
        with pytest.raises(wl.WheelRailError, match="load .N. is -1"):
            wheelset.contact(load=load)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        wheelset.contact(load=["33 kip", "20 kip"])


def test_issue_048_other_arrays_keep_the_points_that_have_an_answer(wheelset: wr.Wheelset) -> None:
    with pytest.warns(wl.PointWarning, match="1 of 2 points have no equivalent conicity"):
        found = wheelset.equivalent_conicity(["3 mm", "20 mm"])
    assert found[0] == pytest.approx(float(wheelset.equivalent_conicity("3 mm"))) and np.isnan(found[1])
    with pytest.warns(wl.PointWarning, match="2 of 3 points have no creep forces .*: 0, 2; at 0: a is nan"):
        forces = wr.creep_forces("polach", a=[np.nan, 8e-3, -1.0], b=4e-3, load=82e3, longitudinal=1e-3)
    assert list(np.isnan(forces.x)) == [True, False, True]
    assert forces.x[1] == float(wr.creep_forces("polach", a=8e-3, b=4e-3, load=82e3, longitudinal=1e-3).x)
    with pytest.warns(wl.PointWarning, match="1 of 2 points have no steady sliding .*angle is 32.0"):
        sliding = wl.quasi_static(angle=[32.0, np.radians(32.0)])
    assert np.isnan(sliding.jam_margin[0]) and list(sliding.jams) == [False, False]
    assert sliding.column_normal[1] == float(wl.quasi_static().column_normal)
    track = wr.Track.parse('[[segments]]\ntangent = "500 ft"\n')
    with pytest.warns(wl.PointWarning, match="1 of 2 points have no track"):
        sample = track.sample([10.0, np.inf])
    assert sample.x[0] == pytest.approx(10.0) and np.isnan(sample.x[1])


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"gauge": 56.5}, r"gauge is 56.5 m; it must be between 0.1 and 10 m\n.*did you give inches"),
        ({"radius": 18}, r"wheel radius is 18 m; it must be between 0.05 and 2 m\n.*did you give inches"),
        ({"tape_distance": 1504.0}, r"(?s)between 0.1 and 10 m\n.*did you give millimeters"),
        ({"cells": None}, "cells is None; it must be a whole number"),
        ({"creep": None}, "the creep law is None"),
        ({"shear_modulus": None}, "shear_modulus is None"),
        ({"poisson": None}, "poisson is None"),
        ({"lateral": [None, 0.0]}, "lateral is None"),
    ],
)
def test_issue_048_bounds_are_in_order_and_none_is_refused(given: dict[str, Any], said: str) -> None:
    rail = wr.Profile.nominal("136re").inclined(1 / 40)
    with pytest.raises(wl.WedgelabError, match=said):
        wr.contact(wr.Profile.nominal("aar_1b"), rail, load=1e5, **given)


def test_issue_048_cases_tell_inches_and_refuse_none() -> None:
    with pytest.raises(wl.CaseError, match=r"truck_distance` is 486 m; it must be between 1 and 100 m") as caught:
        wl.CarCase("car_tangent_empty", {"car.truck_distance": 486})
    assert "did you give inches" in str(caught.value)
    for values in ({"speed.value": None}, {"start": {"distance": None}}, {"lading.masses": [{"name": None}]}):
        with pytest.raises(wl.CaseError, match="is None, which is no value"):
            wl.CarCase("car_tangent_empty", values)
    with pytest.raises(wl.CaseError, match="`wedge.angle` is None"):
        wl.Case(wedge={"angle": None})
    # Attributes that were left out of a section are left out of the case.
    assert wl.Case(wedge=wl.WedgeSection(angle=None)) == wl.Case()
