"""The sections of a case, as typed objects.

Every dimensional value is a text with a unit (``"32 deg"``), a `Quantity`, or a number in SI units: m, N,
s, rad, rad/s, N/m, N s/m, N m s/rad, kg m^2, m/s^2. What is ``None`` is left out, and takes the value of the
case that is changed, or of the thesis. The sections of a case that was made hold every value, with
quantities as `Quantity`.
"""

# Written by `cargo run --release -p study --example case_keys`.

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ._motions import MotionLike, Points, QuantityLike, Section, Triple

__all__ = [
    "BolsterSection",
    "ContactSection",
    "ControlCoilSection",
    "EnvironmentSection",
    "FaceSection",
    "FrictionSection",
    "SideFrameSection",
    "SimulationSection",
    "WedgeSection",
]


@dataclass(frozen=True)
class WedgeSection(Section):
    """``[wedge]``"""

    damping: str | None = None
    """``"variable"``: the coil stands on the side frame; ``"constant"``: in the bolster."""
    angle: QuantityLike | None = None
    """Between the slope and the vertical."""
    height: QuantityLike | None = None
    """Of the vertical face."""
    width: QuantityLike | None = None
    """Across the track."""
    weight: QuantityLike | None = None
    """A force; the mass is the weight over standard gravity."""
    inertia: Triple | None = None
    """Roll, pitch, yaw. The thesis gives no unit; lb in^2 is the only plausible one."""
    center_of_gravity: Triple | None = None
    """From the point above the coil. It is taken as the prism's centroid, which places the faces."""
    column_wear: QuantityLike | None = None
    """What column and wedge have lost there, together: the column lies deeper by it."""
    slope_wear: QuantityLike | None = None
    """The same at the slope; a worn wedge rises. Begin in equilibrium."""
    rise: QuantityLike | None = None
    """Of the wedge by wear, as a gauge shows it, in place of both depths: (column_wear cos(angle) + slope_wear) / sin(angle) without toe."""
    rise_column_share: float | None = None
    """Of the sum of both depths that rise makes, at the column: 0.5 is equal wear, a guess."""
    free_coordinates: Sequence[str] | None = None
    """Of x, y, z, roll, pitch, yaw; the others are held."""

    _words = frozenset({"damping", "rise_column_share", "free_coordinates"})


@dataclass(frozen=True)
class ControlCoilSection(Section):
    """``[control_coil]``"""

    table: Points | str | None = None
    """Compression and force; straight between the points."""
    stiffness: QuantityLike | None = None
    """Or table = [[compression, force], ...] or table = ``"coil.csv"``."""
    free_length: QuantityLike | None = None
    """Without force."""
    nominal_length: QuantityLike | None = None
    """In the nominal position; the thesis: just free."""
    damping: QuantityLike | None = None
    """Along the coil."""
    rotational_damping: QuantityLike | None = None
    """Of the wedge's rotations; the thesis uses the same number as along the coil."""
    acts_at: str | None = None
    """``"center_of_gravity"``: the thesis's moment equations hold no moment of the coil; or ``"seat"``, with its moment."""
    pulls: bool | None = None
    """The thesis's coil pushes and pulls; false: it lifts off at its free length."""

    _words = frozenset({"acts_at", "pulls"})


@dataclass(frozen=True)
class ContactSection(Section):
    """``[contact]``"""

    stiffness: QuantityLike | None = None
    """Per corner. The thesis gives none; four of 2.5e5 lbf/in give its limits and orderings."""
    damping: QuantityLike | None = None
    """The same; it never pulls."""


@dataclass(frozen=True)
class FrictionSection(Section):
    """``[friction]``"""

    law: str | Mapping[str, Any] | None = None
    """``"tanh"`` (the thesis's; creeps under load) or ``"bristle"`` (holds); or { column = ..., slope = ... }."""
    column: float | None = None
    """Coefficient of friction."""
    slope: float | None = None
    """Coefficient of friction."""
    reference_speed: QuantityLike | None = None
    """Tanh: below it friction fades. It is part of the result: ten times it moves the forces by 20 to 30 %."""
    bristle_stiffness: QuantityLike | None = None
    """Bristle: tangential, per face. Not in the thesis: from the comparison program."""
    bristle_damping: QuantityLike | None = None
    """Bristle: tangential, per face. From the comparison program."""
    directions: str | None = None
    """``"two"``: against the slip; ``"one"``: along a face's line of travel alone, one tangent a face as in the thesis's equations."""

    _words = frozenset({"law", "column", "slope", "directions"})


@dataclass(frozen=True)
class FaceSection(Section):
    """``[column_face]`` or ``[slope_face]``"""

    grid: Sequence[int] | None = None
    """Points up the face and across it, edges included; [2, 2]: the corners. More points spread the pressure."""
    wedge_surface: str | Mapping[str, Any] | None = None
    """The wedge's surface: ``"flat"``, or { shape = ``"crown"``, radius = ``"60 in"``, direction = ``"up"`` }, ...."""
    wedge_wear: Points | str | None = None
    """Wear of the wedge's surface beyond that: a CSV file of up [in], across [in], depth [in], places from the middle; or the same as a list of points; left out, none."""
    counterface: str | Mapping[str, Any] | None = None
    """The surface that it touches, in the same words."""
    counterface_wear: Points | str | None = None
    """Wear of that surface, as wedge_wear; at least four places up and four across; left out, none."""
    sliding_friction: float | None = None
    """Coefficient of sliding; left out, that of rest, which is friction.column or friction.slope."""
    stribeck_speed: QuantityLike | None = None
    """Slip speed at which half of the way from rest to sliding is gone; left out, 0.1 in/s."""
    friction_half_load: QuantityLike | None = None
    """Load of the face at which its coefficients are half of those without load; left out, no dependence."""
    friction_map: Sequence[Sequence[float]] | None = None
    """Factors of the coefficients, rows from the lower edge, each from the right to the left edge; left out, 1."""
    pad: Mapping[str, Any] | None = None
    """A resilient pad in place of contact.stiffness and .damping, with friction of its own; left out, steel on steel."""

    _words = frozenset({"grid", "wedge_surface", "counterface", "sliding_friction", "friction_map", "pad"})


@dataclass(frozen=True)
class SideFrameSection(Section):
    """``[side_frame]``"""

    toe: QuantityLike | None = None
    """Of the column; out: the gap between column and bolster opens downwards; in: it closes."""
    toe_pivot: QuantityLike | None = None
    """The column turns about a point so far above the middle of the wedge's face. The thesis does not say."""
    center: Triple | None = None
    """The point it turns about; left out, the centre of the column."""
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

    _words = frozenset({"toe"})

    _motions = frozenset({"longitudinal", "lateral", "vertical", "roll", "pitch", "yaw"})


@dataclass(frozen=True)
class BolsterSection(Section):
    """``[bolster]``"""

    center: Triple | None = None
    """The point it turns about; left out, the pocket's centre: about the truck's, one wedge could not follow a yaw."""
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
    """Standard gravity."""


@dataclass(frozen=True)
class SimulationSection(Section):
    """``[simulation]``"""

    duration: QuantityLike | None = None
    """."""
    output_interval: QuantityLike | None = None
    """Time between two rows of the result; steps are chosen freely."""
    relative_tolerance: float | None = None
    """Of the integrator, between 0 and 1."""
    output_units: str | None = None
    """``"us"`` (in, lbf) or ``"si"`` (m, N)."""
    method: str | None = None
    """``"rodas5p"``; ``"tr-bdf2"`` and ``"esdirk3"`` damp vibrations."""
    start: str | None = None
    """``"rest"``: nominal position, corners may start inside; ``"touching"``; or ``"equilibrium"``."""

    _words = frozenset({"relative_tolerance", "output_units", "method", "start"})
