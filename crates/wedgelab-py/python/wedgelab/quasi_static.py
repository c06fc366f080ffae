"""The quasi-static element: the massless wedge in steady sliding, over arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from ._points import tell, unmet
from ._units import si
from ._wedgelab import Quantity, slide
from .errors import WedgelabError
from ._motions import QuantityLike

__all__ = ["Sliding", "quasi_static"]

Floats = npt.NDArray[np.float64]
Values = Union[QuantityLike, Sequence[QuantityLike], Floats]
Words = Union[str, Sequence[str], npt.NDArray[Any]]


@dataclass(frozen=True)
class Sliding:
    """Steady sliding; arrays of the common shape of the arguments. Forces are NaN where the wedge jams; the jam margin too where an
    argument is out of its range."""

    column_normal: Floats
    """Normal force at the column, N."""
    column_friction: Floats
    """Friction at the column, N; positive."""
    slope_normal: Floats
    """Normal force at the slope, N."""
    jam_margin: Floats
    """How far the angle is from the one at which the wedge locks, rad; it jams where this is not positive."""
    up_slope: npt.NDArray[np.bool_]
    """Whether the slope's friction acts on the wedge up the slope."""

    @property
    def jams(self) -> npt.NDArray[np.bool_]:
        """Where there is no steady sliding."""
        return np.isnan(self.column_normal) & ~np.isnan(self.jam_margin)


def _values(value: Any, kind: str, what: str) -> Floats:
    if isinstance(value, (str, Quantity)):
        return np.asarray(si(value, kind, what))
    array = np.asarray(value)
    if array.dtype.kind in "US":
        array = array.astype(object)
    if array.dtype == object:
        flat = [si(one, kind, what) for one in array.ravel()]
        return np.array(flat, dtype=float).reshape(array.shape)
    if array.dtype.kind not in "fiu":
        raise WedgelabError(f"{what} holds {array.dtype}; numbers in SI units or texts with units are expected")
    return array.astype(float)


def _toe(value: Any) -> Floats:
    """A toe with its direction in words, or in rad, positive out."""

    def one(text: Any) -> float:
        if not isinstance(text, str):
            return si(text, "angle", "toe")
        size, _, direction = text.strip().rpartition(" ")
        if direction not in ("out", "in"):
            angle = si(text, "angle", "toe")
            if angle != 0.0:
                raise WedgelabError(f'the toe "{text}" does not say in or out; write for example "0.2 deg out"')
            return 0.0
        angle = si(size, "angle", "toe")
        if angle < 0.0:
            raise WedgelabError(f'the toe "{text}" is negative; its direction is said in words')
        return angle if direction == "out" else -angle

    if isinstance(value, str):
        return np.asarray(one(value))
    array = np.asarray(value)
    if array.dtype.kind in "USO":
        return np.array([one(text) for text in array.astype(object).ravel()]).reshape(array.shape)
    return _values(value, "angle", "toe")


def _signs(value: Any, names: dict[str, float], what: str) -> Floats:
    array = np.asarray(value)
    unknown = [text for text in array.ravel() if not (isinstance(text, str) and text in names)]
    if unknown:
        known = ", ".join(f'"{name}"' for name in names)
        raise WedgelabError(f"{what} cannot be {unknown[0]!r}; write one of {known}")
    return np.array([names[str(text)] for text in array.ravel()]).reshape(array.shape)


def quasi_static(
    *,
    angle: Values = "32 deg",
    toe: Values = "0 deg",
    mu_column: Values = 0.4,
    mu_slope: Values = 0.4,
    coil_force: Values = "3000 lbf",
    direction: Words = "down",
    slope_friction: Words = "as_moved",
) -> Sliding:
    """Forces of the massless wedge (Steets 2007, eq. 5-1) and its jam margin.

    Every argument may be an array; they are broadcast. ``angle`` from the vertical and ``toe`` (``"0.2 deg out"``; numbers in
    rad, positive out), coefficients of friction of column and slope, force of the control coil upwards on the wedge (N), ``direction`` of the bolster
    (``"down"``, ``"up"``), and which way the slope's friction acts on the wedge: ``"as_moved"`` (rigid kinematics choose), ``"up"``, ``"down"`` the slope.
    Points with an argument out of its range are NaN, with a `PointWarning`; if there are no others, that is an error.
    """
    values = [
        _values(angle, "angle", "angle"),
        _toe(toe),
        _values(mu_column, "dimensionless", "mu_column"),
        _values(mu_slope, "dimensionless", "mu_slope"),
        _values(coil_force, "force", "coil_force"),
        _signs(direction, {"down": -1.0, "up": 1.0}, "direction"),
        _signs(slope_friction, {"as_moved": 0.0, "up": 1.0, "down": -1.0}, "slope_friction"),
    ]
    try:
        arrays = np.broadcast_arrays(*values)
    except ValueError:
        shapes = ", ".join(str(one.shape) for one in values)
        raise WedgelabError(f"the shapes of the arguments do not fit together: {shapes}") from None
    shape = arrays[0].shape
    flat = [np.array(one, dtype=float).ravel() for one in arrays]
    angles, toes, columns, slopes, forces, *_ = flat
    right_angle = np.pi / 2
    friction_is = "finite, 0 or more"
    failed = unmet(
        [
            (
                (angles > 0.0) & (angles < right_angle),
                angles,
                "angle",
                "between 0 and pi/2 rad, both excluded (a number without unit is in rad)",
            ),
            (np.abs(toes) < right_angle / 4, toes, "toe", "below pi/8 rad (22.5 deg) in size"),
            ((columns >= 0.0) & np.isfinite(columns), columns, "mu_column", friction_is),
            ((slopes >= 0.0) & np.isfinite(slopes), slopes, "mu_slope", friction_is),
            ((forces > 0.0) & np.isfinite(forces), forces, "coil_force", "positive and finite: the coil pushes"),
        ]
    )
    tell("steady sliding", shape, failed, WedgelabError)
    out = slide(*flat)
    for one in out:
        one[[k for k, _, _ in failed]] = np.nan
    normal, friction, slope, margin, branch = (one.reshape(shape) for one in out)
    return Sliding(normal, friction, slope, margin, branch > 0.0)
