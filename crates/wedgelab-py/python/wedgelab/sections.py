"""The sections of a case and the motions of its neighbours, as typed objects.

Every dimensional value is a text with a unit (``"32 deg"``), a `Quantity`, or a number in SI units: m, N, s, rad,
rad/s, N/m, N s/m, N m s/rad, kg m^2, m/s^2. What is ``None`` is left out, and takes the value of the case that is changed, or of the
thesis. The sections of a case that was made hold every value, with quantities as `Quantity`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, ClassVar, Union

import numpy as np
import numpy.typing as npt

from ._wedgelab import Quantity

__all__ = [
    "BolsterSection",
    "Constant",
    "ContactSection",
    "ControlCoilSection",
    "EnvironmentSection",
    "FaceSection",
    "FrictionSection",
    "MotionLike",
    "QuantityLike",
    "Ramp",
    "Section",
    "SideFrameSection",
    "SimulationSection",
    "Sine",
    "SweptSine",
    "Table",
    "Triangle",
    "WedgeSection",
]

QuantityLike = Union[str, float, Quantity]
"""A text with a unit, a number in SI units, or a quantity."""
Triple = Sequence[QuantityLike]
"""Three of them."""
Points = Union[Sequence[Sequence[QuantityLike]], npt.NDArray[np.float64]]
"""Rows of two quantities."""


@dataclass(frozen=True)
class Constant:
    """A coordinate that is held."""

    value: QuantityLike
    """Length or angle."""

    def _to_values(self) -> Mapping[str, Any]:
        return {"shape": "constant", "value": self.value}


@dataclass(frozen=True)
class Sine:
    """``amplitude · sin(frequency · t + phase)``."""

    amplitude: QuantityLike
    """Length or angle."""
    frequency: QuantityLike
    """Frequency; a bare number is in rad/s, ``"1 Hz"`` counts cycles."""
    phase: QuantityLike | None = None
    """Angle at time zero; 0 if left out."""

    def _to_values(self) -> Mapping[str, Any]:
        return {"shape": "sine", "amplitude": self.amplitude, "frequency": self.frequency, "phase": self.phase}


@dataclass(frozen=True)
class Triangle:
    """A triangle wave that rises from zero."""

    amplitude: QuantityLike
    """Length or angle."""
    frequency: QuantityLike
    """Frequency; a bare number is in rad/s."""

    def _to_values(self) -> Mapping[str, Any]:
        return {"shape": "triangle", "amplitude": self.amplitude, "frequency": self.frequency}


@dataclass(frozen=True)
class SweptSine:
    """A sine whose frequency changes linearly with time and then stays."""

    amplitude: QuantityLike
    """Length or angle."""
    start_frequency: QuantityLike
    """Frequency at time zero; a bare number is in rad/s."""
    end_frequency: QuantityLike
    """Frequency from ``duration`` on."""
    duration: QuantityLike
    """Time of the sweep."""

    def _to_values(self) -> Mapping[str, Any]:
        return {"shape": "swept_sine", **{field.name: getattr(self, field.name) for field in fields(self)}}


@dataclass(frozen=True)
class Ramp:
    """From zero to the amplitude, which is then held."""

    amplitude: QuantityLike
    """Length or angle at the end."""
    duration: QuantityLike
    """Time it takes."""
    start: QuantityLike | None = None
    """Time it begins; 0 if left out."""
    profile: str | None = None
    """``"smooth"`` (if left out) or ``"linear"``."""

    def _to_values(self) -> Mapping[str, Any]:
        return {"shape": "ramp", **{field.name: getattr(self, field.name) for field in fields(self)}}


@dataclass(frozen=True)
class Table:
    """A cubic spline through points of time and value: at least four, times increasing."""

    points: Points | None = None
    """Rows of time and value; an array holds s, and m or rad."""
    file: str | None = None
    """Instead of points: a CSV file whose first line is such as ``time [s], value [in]``."""

    @classmethod
    def of(cls, times: npt.ArrayLike, values: npt.ArrayLike) -> Table:
        """From arrays of the same length: times in s, values in m or rad."""
        columns = np.column_stack([np.asarray(times, dtype=float), np.asarray(values, dtype=float)])
        return cls(columns)

    def _to_values(self) -> Mapping[str, Any]:
        return {"shape": "table", "points": self.points, "file": self.file}


Motion = Union[Constant, Sine, Triangle, SweptSine, Ramp, Table]
MotionLike = Union[Motion, QuantityLike, Mapping[str, Any], Sequence[Any]]
"""A motion, one held value, a mapping as in a case file, or a list of motions to be added up."""

_SHAPES: dict[str, Any] = {
    "constant": Constant,
    "sine": Sine,
    "triangle": Triangle,
    "swept_sine": SweptSine,
    "ramp": Ramp,
    "table": Table,
}


def _quantity(value: Any) -> Any:
    """Texts as quantities, in lists too."""
    if isinstance(value, str):
        return Quantity(value)
    if isinstance(value, list):
        return tuple(_quantity(one) for one in value)
    return value


def _motion(value: Any) -> Any:
    """A motion as a case file has it, as an object."""
    if isinstance(value, list):
        return tuple(_motion(one) for one in value)
    if isinstance(value, dict):
        entries = dict(value)
        shape = _SHAPES[entries.pop("shape")]
        words = ("profile", "file")
        return shape(**{key: one if key in words else _quantity(one) for key, one in entries.items()})
    return Constant(_quantity(value))


class Section:
    """A section of a case."""

    _words: ClassVar[frozenset[str]] = frozenset()
    """Fields that hold names, truths and plain numbers."""
    _motions: ClassVar[frozenset[str]] = frozenset()
    """Fields that hold motions."""

    def _to_values(self) -> Mapping[str, Any]:
        return {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]

    @classmethod
    def _of(cls, entries: Mapping[str, Any]) -> Any:
        """From a complete section of a case file."""

        def read(key: str, value: Any) -> Any:
            if key in cls._motions:
                return _motion(value)
            if key in cls._words:
                return tuple(value) if isinstance(value, list) else value
            return _quantity(value)

        return cls(**{key: read(key, value) for key, value in entries.items()})


@dataclass(frozen=True)
class WedgeSection(Section):
    """``[wedge]``"""

    damping: str | None = None
    """Where the control coil stands: ``"variable"`` (side frame) or ``"constant"`` (bolster)."""
    angle: QuantityLike | None = None
    """Angle between the slope and the vertical."""
    height: QuantityLike | None = None
    """Length: height of the vertical face."""
    width: QuantityLike | None = None
    """Length: lateral width."""
    weight: QuantityLike | None = None
    """Force under standard gravity."""
    inertia: Triple | None = None
    """Moments of inertia about the center of gravity: roll, pitch, yaw."""
    center_of_gravity: Triple | None = None
    """Lengths from the wedge frame's origin: x, y, z."""
    column_wear: QuantityLike | None = None
    """Length: depth of wear of the column and the wedge's vertical face together."""
    slope_wear: QuantityLike | None = None
    """Length: depth of wear of the pocket's slope and the wedge's slope face together."""
    rise: QuantityLike | None = None
    """Length: rise of the wedge by wear, as a gauge shows it, in place of both depths."""
    rise_column_share: float | None = None
    """Share of the column in the sum of both depths that ``rise`` makes, from 0 to 1."""
    free_coordinates: Sequence[str] | None = None
    """Those that are free of ``"x"``, ``"y"``, ``"z"``, ``"roll"``, ``"pitch"``, ``"yaw"``."""

    _words = frozenset({"damping", "free_coordinates"})


@dataclass(frozen=True)
class ControlCoilSection(Section):
    """``[control_coil]``"""

    stiffness: QuantityLike | None = None
    """Stiffness; or a ``table``."""
    table: Points | str | None = None
    """Rows of compression (length) and force, or the name of a CSV file."""
    free_length: QuantityLike | None = None
    """Length without force."""
    nominal_length: QuantityLike | None = None
    """Length in the nominal position."""
    damping: QuantityLike | None = None
    """Viscous damping along the coil."""
    rotational_damping: QuantityLike | None = None
    """Viscous damping of the wedge's rotations."""
    acts_at: str | None = None
    """Line of action: ``"center_of_gravity"`` or ``"seat"``."""
    pulls: bool | None = None
    """Whether it can pull."""

    _words = frozenset({"acts_at", "pulls"})


@dataclass(frozen=True)
class ContactSection(Section):
    """``[contact]``"""

    stiffness: QuantityLike | None = None
    """Stiffness per corner."""
    damping: QuantityLike | None = None
    """Viscous damping per corner."""


@dataclass(frozen=True)
class FrictionSection(Section):
    """``[friction]``"""

    law: str | Mapping[str, str] | None = None
    """``"tanh"`` or ``"bristle"``, or one for each of ``"column"`` and ``"slope"``."""
    column: float | None = None
    """Coefficient of friction at the column."""
    slope: float | None = None
    """Coefficient of friction at the slope."""
    directions: str | None = None
    """``"two"``: against the slip; ``"one"``: along a face's line of travel alone."""
    reference_speed: QuantityLike | None = None
    """Speed v0 of the tanh law."""
    bristle_stiffness: QuantityLike | None = None
    """Tangential stiffness of the bristle law, per face."""
    bristle_damping: QuantityLike | None = None
    """Tangential viscous damping of the bristle law, per face."""

    _words = frozenset({"law", "column", "slope", "directions"})


@dataclass(frozen=True)
class FaceSection(Section):
    """``[column_face]`` or ``[slope_face]``"""

    grid: Sequence[int] | None = None
    """Points up the face and across it, edges included; (2, 2): the corners."""
    wedge_surface: str | Mapping[str, Any] | None = None
    """The wedge's surface: ``"flat"``, or a mapping as in a case file, such as
    ``{"shape": "crown", "radius": "60 in", "direction": "up"}``."""
    wedge_wear: str | Sequence[Sequence[QuantityLike]] | None = None
    """Wear of the wedge's surface: a CSV file, or points of place up, place across and depth."""
    counterface: str | Mapping[str, Any] | None = None
    """The surface that it touches, in the same words."""
    counterface_wear: str | Sequence[Sequence[QuantityLike]] | None = None
    """Wear of that surface, as ``wedge_wear``."""
    sliding_friction: float | None = None
    """Coefficient of sliding; left out, that of rest."""
    stribeck_speed: QuantityLike | None = None
    """Slip speed at which half of the way from rest to sliding is gone."""
    friction_half_load: QuantityLike | None = None
    """Force: load of the face at which its coefficients are half of those without load."""
    friction_map: Sequence[Sequence[float]] | None = None
    """Factors of the coefficients: rows from the lower edge, each from the right to the left edge."""
    pad: Mapping[str, Any] | None = None
    """A resilient pad, as in a case file: stiffness, damping, hardening, friction, shear_stiffness, shear_damping."""

    _words = frozenset(
        {
            "grid",
            "wedge_surface",
            "wedge_wear",
            "counterface",
            "counterface_wear",
            "sliding_friction",
            "friction_map",
            "pad",
        }
    )


@dataclass(frozen=True)
class SideFrameSection(Section):
    """``[side_frame]``"""

    toe: QuantityLike | None = None
    """Angle of the column: ``"0.2 deg out"``, ``"0.2 deg in"``; a number is in rad, positive out."""
    toe_pivot: QuantityLike | None = None
    """Height of the point about which toe turns the column, above the middle of the wedge's face."""
    center: Triple | None = None
    """Lengths: the point it turns about; left out, the center of its face."""
    longitudinal: MotionLike | None = None
    """Motion of a length."""
    lateral: MotionLike | None = None
    """Motion of a length."""
    vertical: MotionLike | None = None
    """Motion of a length."""
    roll: MotionLike | None = None
    """Motion of an angle."""
    pitch: MotionLike | None = None
    """Motion of an angle."""
    yaw: MotionLike | None = None
    """Motion of an angle."""

    # The toe has its direction in words.
    _words = frozenset({"toe"})
    _motions = frozenset({"longitudinal", "lateral", "vertical", "roll", "pitch", "yaw"})


@dataclass(frozen=True)
class BolsterSection(Section):
    """``[bolster]``"""

    center: Triple | None = None
    """Lengths: the point it turns about; left out, the center of its face."""
    longitudinal: MotionLike | None = None
    """Motion of a length."""
    lateral: MotionLike | None = None
    """Motion of a length."""
    vertical: MotionLike | None = None
    """Motion of a length."""
    roll: MotionLike | None = None
    """Motion of an angle."""
    pitch: MotionLike | None = None
    """Motion of an angle."""
    yaw: MotionLike | None = None
    """Motion of an angle."""

    _motions = frozenset({"longitudinal", "lateral", "vertical", "roll", "pitch", "yaw"})


@dataclass(frozen=True)
class EnvironmentSection(Section):
    """``[environment]``"""

    gravity: QuantityLike | None = None
    """Acceleration."""


@dataclass(frozen=True)
class SimulationSection(Section):
    """``[simulation]``"""

    duration: QuantityLike | None = None
    """Time the run ends."""
    output_interval: QuantityLike | None = None
    """Time between two rows of the result."""
    relative_tolerance: float | None = None
    """Of the integrator; between 0 and 1."""
    start: str | None = None
    """``"rest"``, ``"touching"`` or ``"equilibrium"``."""
    output_units: str | None = None
    """Units of the summary, of figures and of files: ``"us"`` or ``"si"``."""
    method: str | None = None
    """Integration method: ``"rodas5p"``; ``"tr-bdf2"`` and ``"esdirk3"`` damp vibrations: for averages and slow
    motions."""

    _words = frozenset({"relative_tolerance", "start", "output_units", "method"})
