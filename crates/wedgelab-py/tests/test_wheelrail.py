"""Wheel on rail and track."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import wedgelab as wl
from wedgelab import wheelrail as wr

MANCHESTER = Path(__file__).parents[2] / "wheelrail" / "tests" / "data" / "manchester"


def manchester() -> wr.Wheelset:
    return wr.Wheelset(
        wr.Profile.read(MANCHESTER / "MBench_S1002_v3.prw", "wheel", deviation=0.0),
        wr.Profile.read(MANCHESTER / "MBench_UIC60_v3.prr", "rail", deviation=0.0),
        gauge="1435 mm",
        gauge_depth="14 mm",
        tape_distance="1500 mm",
        radius="460 mm",
    )


def test_reproduction_manchester_contact_benchmark() -> None:
    """CONTACT (github.com/eve70a/CONTACT, mbench_a22, revision 2707): places within 1 mm, N within 1 %, forces within 10 %."""
    shift = np.array([1.0, 2.0, 4.0])
    out = manchester().contact(
        lateral=1e-3 * shift,
        yaw=2.4e-3 * shift,
        roll=np.array([-5.049e-5, -1.128e-4, -2.557e-4]),
        load="10 kN",
        pitch_rate=np.array([-4.3465752, -4.3459197, -4.344093]),
        creep="fastsim",
    )
    for wheel, rows in (
        (out.left, [[-755.24, 10050, 829, -2893], [-756.51, 10040, 546, -2961], [-757.66, 10030, 437, -2977]]),
        (out.right, [[741.99, 9827, -814, -2832], [740.91, 9799, -517, -2893], [738.74, 9745, -380, -2898]]),
    ):
        y, normal, fx, fy = np.array(rows, dtype=float).T
        assert wheel.y.shape == (3, 9)
        assert 1e3 * wheel.y[:, 0] == pytest.approx(y, abs=1.0)
        assert np.nansum(wheel.normal, axis=-1) == pytest.approx(normal, rel=0.01)
        difference = np.hypot(np.nansum(wheel.fx, axis=-1) - fx, np.nansum(wheel.fy, axis=-1) - fy)
        assert (difference < 0.1 * np.hypot(fx, fy)).all()
        assert wheel.vertical_force == pytest.approx(1e4, rel=1e-6)
        assert (wheel.seat == "on_rail").all() and np.isnan(wheel.y[:, 1:]).all()


def test_contact_in_one_call_is_that_of_the_wheelset_and_tells_derailment() -> None:
    wheel, rail = wr.Profile.nominal("aar_1b"), wr.Profile.nominal("136re").inclined(1 / 40)
    given: dict[str, Any] = {"load": "33 kip", "lateral": ["5 mm", "80 mm", "200 mm"], "gauge": "1435.1 mm"}
    one = wr.contact(wheel, rail, **given)
    gauge = given.pop("gauge")
    other = wr.Wheelset(wheel, rail, gauge=gauge).contact(**given)
    assert np.array_equal(one.left.fy, other.left.fy, equal_nan=True)
    assert list(one.right.seat) == ["on_rail", "flange_tip", "off_rail"]
    assert np.isnan(one.right.height[2]) and one.right.height[1] > one.right.height[0] + 0.02


def test_limits_creep_laws_start_linear_and_saturate() -> None:
    creep = np.array([1e-7, 1e-1])
    limit = 0.3 * 82e3
    forces = {
        law: wr.creep_forces(law, a="8 mm", b="4 mm", load="82 kN", longitudinal=creep, lateral=-0.5 * creep)
        for law in ("linear", "shen_hedrick_elkins", "polach", "fastsim")
    }
    linear = np.hypot(forces["linear"].x, forces["linear"].y)
    for law, found in forces.items():
        size = np.hypot(found.x, found.y)
        assert size[0] == pytest.approx(linear[0], rel=2e-3)
        assert found.x[0] < 0.0 < found.y[0]
        if law != "linear":
            assert 0.95 * limit < size[1] <= 1.001 * limit
    # CONTACT's example `fastsim`, parabolic bound.
    example = wr.creep_forces(
        "fastsim", a=8e-3, b=4e-3, load=82e3, lateral=-6.25e-4, spin=0.625, cells=200
    )
    assert float(example.y) == pytest.approx(-15640.0, rel=0.03)
    assert float(example.spin_moment) == pytest.approx(-37.98, rel=0.03)


def test_analytic_cones_have_their_conicity() -> None:
    """A shift y rolls the axle by λ y / l, which moves the contact on the crown: λ (1 + λ R / l) with R = 10 in."""
    wheelset = wr.Wheelset(wr.Profile.cone(1 / 40), wr.Profile.nominal("136re"))
    expected = 0.025 * (1.0 + 0.025 * 0.254 / 0.7485)
    assert wheelset.equivalent_conicity(np.array([2e-3, 3e-3, 5e-3])) == pytest.approx(expected, rel=2e-5)
    assert wheelset.equivalent_conicity("3 mm", method="linearization") == pytest.approx(expected, rel=2e-5)
    shift = np.array([-2e-3, 0.0, 2e-3])
    found = wheelset.positions(shift)
    assert found.rolling_radius_difference == pytest.approx(2 * expected * shift, rel=2e-5, abs=1e-12)
    assert found.left_angle[1] == pytest.approx(np.arctan(0.025), abs=1e-6)


def test_analytic_a_track_is_sampled(tmp_path: Path) -> None:
    table = "distance [ft],left_profile [in]\n,down\n" + "".join(f"{k},0.25\n" for k in range(801))
    (tmp_path / "car.csv").write_text(table)
    text = '[[segments]]\ntangent = "200 ft"\n[[segments]]\nspiral = "200 ft"\n[[segments]]\ncurve = "400 ft"\ndegree = "6 deg"\n'
    text += 'superelevation = "3 in"\n[[irregularities]]\ntable = "car.csv"\nform = "space_curve"\n'
    path = tmp_path / "curve.toml"
    path.write_text(text)
    track = wr.Track.read(path)
    assert track.name == "curve" and track.length == pytest.approx(800 * 0.3048)
    at = track.sample(["100 ft", "300 ft", "600 ft"])
    curvature = 2 * np.sin(np.radians(3.0)) / 30.48
    assert at.curvature == pytest.approx(curvature * np.array([0.0, 0.5, 1.0]))
    assert at.superelevation == pytest.approx(3 * 0.0254 * np.array([0.0, 0.5, 1.0]))
    assert at.left_profile[1] == pytest.approx(-0.25 * 0.0254) and (at.right_profile == 0.0).all()
    assert at.cross_level[1] == pytest.approx(1.75 * 0.0254)
    assert track.sample(np.zeros((2, 3))).heading.shape == (2, 3)
    with pytest.raises(wl.CaseError, match="must have one of tangent, spiral, curve") as caught:
        wr.Track.parse('[[segments]]\ntangnt = "5 ft"\n')
    assert caught.value.problems


def test_profiles_are_points_and_back(tmp_path: Path) -> None:
    wheel = wr.Profile.nominal("aar_1b")
    assert wheel.kind == "wheel" and "memory" in wheel.note and "AAR-1B" in repr(wheel)
    y, z = wheel.points("0.2 mm")
    again = wr.Profile.from_points(y, z, "wheel", deviation="0.001 mm")
    assert again.deviation <= 1.001e-6
    rail = wr.Profile.nominal("136re").inclined(1 / 40)
    difference = [wr.Wheelset(one, rail).positions(2e-3).rolling_radius_difference for one in (wheel, again)]
    assert difference[0] == pytest.approx(difference[1], abs=2e-6)


def test_issue_047_kinds_and_datums_of_profiles_are_told() -> None:
    wheel, rail = wr.Profile.nominal("aar_1b"), wr.Profile.nominal("136re")
    with pytest.raises(wl.WheelRailError, match="looks like a wheel"):
        wr.Profile.from_points(*wheel.points("0.2 mm"), "rail")
    with pytest.raises(wl.WheelRailError, match="looks like a rail"):
        wr.Profile.from_points(*rail.points("0.2 mm"), "wheel")
    y, z = rail.points("0.2 mm")
    with pytest.raises(wl.WheelRailError, match=r"highest point is at z = 30.000 mm"):
        wr.Wheelset(wheel, wr.Profile.from_points(y, np.asarray(z) + 0.03, "rail"))


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"load": "10 mm"}, "load: this is a length"),
        ({"load": -1.0}, "load .N. is -1"),
        ({"load": 1e9}, "no height of the left wheel carries"),
        ({"load": 1e4, "creep": "contact"}, "there is no creep law"),
        ({"load": 1e4, "speed": 0.0}, "speed .m/s. is 0"),
        ({"load": 1e4, "lateral": [0.0, 1.0], "yaw": [0.0, 1.0, 2.0]}, "do not fit together"),
        ({"load": 1e4, "cells": 0}, "cells is 0"),
        ({"load": 1e4, "gauge": "50 in"}, "flanges"),
        ({"load": 1e4, "poisson": 0.7}, "Poisson"),
    ],
)
def test_input_contact_is_explained(given: dict[str, Any], said: str) -> None:
    rail = wr.Profile.nominal("136re").inclined(1 / 40)
    with pytest.raises(wl.WedgelabError, match=said):
        wr.contact(wr.Profile.nominal("aar_1b"), rail, **given)


def test_input_others_are_explained(tmp_path: Path) -> None:
    bad = tmp_path / "bad.csv"
    bad.write_text("y,z\n0,0\n1,1\n")
    with pytest.raises(wl.WheelRailError, match="has no unit") as caught:
        wr.Profile.read(bad, "wheel")
    assert "bad.csv" in str(caught.value) and "help" in caught.value.shown
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)
    with pytest.raises(wl.WheelRailError, match="no nominal profile"):
        wr.Profile.nominal("aar_1c")
    with pytest.raises(wl.WheelRailError, match='"wheel" or "rail"'):
        wr.Profile.read(bad, "tire")  # type: ignore[arg-type]
    with pytest.raises(wl.WheelRailError, match="a is 0.0; it must be positive"):
        wr.creep_forces("polach", a=0.0, b=1e-3, load=1e4)
    with pytest.raises(wl.WheelRailError, match="wider|amplitude"):
        wr.Wheelset(wr.Profile.nominal("aar_1b"), wr.Profile.nominal("136re")).equivalent_conicity("30 mm")
    with pytest.raises(wl.WheelRailError, match="Profile is expected"):
        wr.Wheelset("aar_1b", wr.Profile.nominal("136re"))  # type: ignore[arg-type]


def test_sides_of_their_own() -> None:
    """A cylinder on the left and a cone of 1:20 on the right: half the conicity of two cones; radii may differ."""
    cylinder, cone = wr.Profile.cone(0.0), wr.Profile.cone(0.05)
    rail = wr.Profile.nominal("136re").inclined(1 / 40)
    unlike = wr.Wheelset((cylinder, cone), (rail, rail))
    slope = np.gradient(unlike.positions(np.linspace(-2e-3, 2e-3, 5)).rolling_radius_difference, 1e-3)
    np.testing.assert_allclose(slope, 0.05, atol=1e-3)
    pair = wr.Wheelset(cone, rail, radius=("18 in", "17.99 in"))
    middle = pair.positions(0.0).rolling_radius_difference
    assert 2.5e-4 < float(middle) < 2.6e-4
    with pytest.raises(wl.WheelRailError, match="left and a right"):
        wr.Wheelset((cone, cone, cone), rail)  # type: ignore[arg-type]


def test_patches_of_strips() -> None:
    """A cone on a rail's crown touches as Hertz says: strips have his pressure within 1 %."""
    pair = (wr.Profile.cone(0.05), wr.Profile.nominal("136re").inclined(1 / 40))
    ellipse, strips = (
        wr.Wheelset(*pair, patch=form).contact(load="20 kip", friction=0.3, creep="fastsim")
        for form in ("ellipse", "strips")
    )
    both = [float(np.nanmax(own.left.greatest_pressure)) for own in (ellipse, strips)]
    assert both[0] != both[1]
    assert abs(both[1] / both[0] - 1) < 0.01
    with pytest.raises(wl.WheelRailError, match="strips"):
        wr.Wheelset(*pair, patch="strip")  # type: ignore[arg-type]


def test_files_of_measuring_devices(tmp_path: Path) -> None:
    """MiniProf counts from the back of the flange; CSV does where that is said."""
    y, z = wr.Profile.nominal("aar_1b").points()
    rows = "".join(f"{1e3 * (a + 77.7875e-3):.5f} {-1e3 * b:.5f}\n" for a, b in zip(y, z, strict=True))
    mini = tmp_path / "worn.whl"
    mini.write_text(f"ProgramName=MiniProf for Windows\n\n{rows}")
    csv = tmp_path / "worn.csv"
    csv.write_text("y [mm]; z_down [mm]\n" + rows.replace(" ", ";"))
    tape = "3.0625 in"
    for one in (
        wr.Profile.read(mini, "wheel", tape_from_back=tape),
        wr.Profile.read(csv, "wheel", datum="flange_back", tape_from_back=tape),
    ):
        assert abs(min(one.points()[1]) + 0.0254) < 3e-5
        assert one.notices == []
    with pytest.raises(wl.WheelRailError, match="not built in"):
        wr.Profile.nominal("aar_2a")
