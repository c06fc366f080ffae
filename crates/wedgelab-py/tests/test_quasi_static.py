"""The quasi-static element over arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import wedgelab as wl

POUND_FORCE = 4.4482216152605


def test_analytic_equation_5_1() -> None:
    angle, toe = np.radians(np.linspace(25.0, 45.0, 5))[:, None], np.radians(np.array([-0.2, 0.0, 0.2]))
    mu_c, mu_s, force = 0.4, 0.3, 13000.0
    for direction, a in (("down", 1.0), ("up", -1.0)):
        out = wl.quasi_static(
            angle=angle, toe=toe, mu_column=mu_c, mu_slope=mu_s, coil_force=force, direction=direction
        )
        assert out.column_normal.shape == (5, 3)
        b = np.where(toe < 0.0, a, -a)
        psi_c, psi_s = np.arctan(mu_c), np.arctan(mu_s)
        # The balance of forces along and across, solved as two equations: no formula of ours.
        for i in range(5):
            for j in range(3):
                t, p, s = angle[i, 0], toe[j], b[j]
                column = np.array([np.cos(p), -np.sin(p)]) + a * mu_c * np.array([np.sin(p), np.cos(p)])
                slope = np.array([-np.cos(t), -np.sin(t)]) + s * mu_s * np.array([-np.sin(t), np.cos(t)])
                normal = np.linalg.solve(np.column_stack([column, slope]), np.array([0.0, -force]))
                if normal.min() < 0.0:
                    # Faces do not pull: there is no such balance, and the wedge jams.
                    assert out.jams[i, j] and out.jam_margin[i, j] < 0.0
                    continue
                assert out.column_normal[i, j] == pytest.approx(normal[0], rel=1e-9)
                assert out.slope_normal[i, j] == pytest.approx(normal[1], rel=1e-9)
        assert out.jams.any() == (direction == "down") and not out.jams.all()
        assert np.allclose(out.column_friction, mu_c * out.column_normal, rtol=1e-14, equal_nan=True)
        assert np.allclose(out.jam_margin, angle + toe - b * psi_s - a * psi_c, rtol=1e-13)
        assert np.array_equal(out.up_slope, np.broadcast_to(b > 0, (5, 3)))


def test_the_command_lines_example() -> None:
    out = wl.quasi_static(angle="32 deg", toe="0.2 deg out", coil_force="3000 lbf", direction=["down", "up"])
    assert out.column_normal / POUND_FORCE == pytest.approx([3087.1, 5144.6], abs=0.05)


def test_limits_where_the_wedge_jams() -> None:
    mu = np.tan(np.radians(16.0)) * np.array([0.999, 1.001])
    out = wl.quasi_static(mu_column=mu, mu_slope=mu, slope_friction="up")
    assert list(out.jams) == [False, True] and out.jam_margin[0] > 0.0 > out.jam_margin[1]
    assert out.column_normal[0] > 100 * 3000 * POUND_FORCE


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"angle": "3 in"}, "angle: this is a length .in.; an angle is expected"),
        ({"coil_force": None}, "coil_force is None"),
        ({"angle": 32.0}, "between 0 and pi/2"),
        ({"angle": np.nan}, "between 0 and pi/2"),
        ({"angle": [0.5, 0.6], "mu_column": [0.1, 0.2, 0.3]}, "do not fit together"),
        ({"angle": 1j}, "complex128"),
        ({"angle": [object()]}, "angle is a object"),
        ({"toe": "0.2 deg"}, "in or out"),
        ({"toe": "-0.2 deg in"}, "in words"),
        ({"toe": 1.0}, "22.5 deg"),
        ({"mu_column": -0.1}, "0 or more"),
        ({"mu_slope": np.inf}, "0 or more"),
        ({"coil_force": [-1.0, 0.0]}, "coil pushes"),
        ({"coil_force": "3000 foo"}, "no unit"),
        ({"direction": "sideways"}, '"down", "up"'),
        ({"direction": 1}, '"down", "up"'),
        ({"slope_friction": "both"}, '"as_moved"'),
    ],
)
def test_input_is_explained(given: dict[str, Any], said: str) -> None:
    with pytest.raises(wl.WedgelabError, match=said):
        wl.quasi_static(**given)
