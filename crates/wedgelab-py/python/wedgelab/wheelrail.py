"""Wheel on rail and track, over NumPy arrays: profiles, contact of a loaded wheelset, creep forces, conicity, tracks.

Texts carry units (``"56.5 in"``), bare numbers are in SI units (m, N, rad, m/s, 1/m, Pa). Axes are x forward, y to the left,
z up, but for ``contact``, which is the command ``wedgelab wheelrail contact`` and speaks CONTACT's frame: y to the right, z down.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from . import _wedgelab as _native
from ._points import Failed, tell, unmet
from ._units import si
from .errors import WheelRailError
from .quasi_static import Floats, Values, _values
from ._motions import QuantityLike

__all__ = [
    "Contact",
    "CreepForces",
    "CreepLaw",
    "PatchForm",
    "Positions",
    "Profile",
    "Track",
    "TrackSample",
    "WheelContact",
    "Wheelset",
    "contact",
    "creep_forces",
]

CreepLaw = Literal["linear", "shen_hedrick_elkins", "polach", "fastsim"]
PatchForm = Literal["ellipse", "strips"]
_PATCHES = 9
_STEEL = 82e9
_POISSON = 0.28


def _flat(values: Sequence[Floats]) -> tuple[tuple[int, ...], list[Floats]]:
    """The common shape, and flat arrays of it."""
    try:
        arrays = np.broadcast_arrays(*values)
    except ValueError:
        shapes = ", ".join(str(one.shape) for one in values)
        raise WheelRailError(f"the shapes of the arguments do not fit together: {shapes}") from None
    return arrays[0].shape, [np.ascontiguousarray(one, dtype=float).ravel() for one in arrays]


def _whole(value: Any, what: str, low: int, high: int) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not low <= value <= high:
        raise WheelRailError(f"{what} is {value!r}; it must be a whole number between {low} and {high}")
    return int(value)


def _law(creep: Any) -> str:
    if not isinstance(creep, str):
        laws = ", ".join(f'"{law}"' for law in get_args(CreepLaw))
        raise WheelRailError(f"the creep law is {creep!r}; write one of {laws}")
    return creep


def _sides(given: Profile | tuple[Profile, Profile], what: str) -> tuple[Profile, Profile]:
    """The left and the right one."""
    both = given if isinstance(given, tuple) else (given, given)
    for one in both:
        if not isinstance(one, Profile):
            raise WheelRailError(f"{what} is a {type(one).__name__}; a Profile is expected, such as Profile.read(...)")
    if len(both) != 2:
        raise WheelRailError(f"{what} has {len(both)} profiles; a left and a right one are expected")
    return both


class Profile:
    """A profile of a wheel or a rail: y to the field side, z up, m. A wheel's origin lies in its tape circle."""

    def __init__(self, native: _native.NativeProfile) -> None:
        self._native = native

    @classmethod
    def read(
        cls,
        path: str | os.PathLike[str],
        kind: Literal["wheel", "rail"],
        *,
        deviation: QuantityLike = "0.02 mm",
        datum: Literal["tape", "flange_back"] | None = None,
        tape_from_back: QuantityLike | None = None,
    ) -> Profile:
        """Reads CSV with units in its header, Simpack (``.prw``, ``.prr``), MiniProf (``.whl``, ``.ban``, ``.mpt``) or VAMPIRE
        (``.whe``, ``.rai``); the spline lies at most ``deviation`` from the points. ``datum`` says where y = 0 of a wheel lies, if
        the file does not; the tape circle is ``tape_from_back`` from the back of the flange (that of the file, or 70 mm). What
        is doubtful about the file is in ``notices``."""
        if datum not in (None, "tape", "flange_back"):
            raise WheelRailError(f'the datum is {datum!r}; write "tape" or "flange_back"')
        back = None if tape_from_back is None else si(tape_from_back, "length", "tape_from_back")
        from_back = None if datum is None else datum == "flange_back"
        deviates = si(deviation, "length", "deviation")
        return cls(_native.NativeProfile.read(path, _is_wheel(kind), deviates, from_back, back))

    @classmethod
    def from_points(
        cls, y: Values, z: Values, kind: Literal["wheel", "rail"], *, deviation: QuantityLike = 0.0
    ) -> Profile:
        """A spline along points, from the gauge side to the field side."""
        _, (y_points, z_points) = _flat([_values(y, "length", "y"), _values(z, "length", "z")])
        return cls(
            _native.NativeProfile.of_points(y_points, z_points, _is_wheel(kind), si(deviation, "length", "deviation"))
        )

    @classmethod
    def nominal(cls, name: str) -> Profile:
        """A profile by its name, rails upright: ``"aar_1b"``, ``"s1002"``, ``"hollow_2mm"``, ``"136re"``, ``"60e1"`` and others
        (docs/wheelrail.md). Most are from memory, not from drawings: see ``note``."""
        return cls(_native.NativeProfile.nominal(name))

    @classmethod
    def cone(cls, slope: float, *, half_width: QuantityLike = "2 in") -> Profile:
        """The tread of a cone without flange; 0.05 is 1:20."""
        return cls(_native.NativeProfile.cone(si(slope, "dimensionless", "slope"), si(half_width, "length", "half_width")))

    def inclined(self, slope: float) -> Profile:
        """The profile inclined towards the track's center, such as by 1/40."""
        return Profile(self._native.inclined(si(slope, "dimensionless", "slope")))

    def points(self, spacing: QuantityLike = "0.5 mm") -> tuple[Floats, Floats]:
        """y and z of points along the profile, m."""
        return self._native.sample(si(spacing, "length", "spacing"))

    @property
    def name(self) -> str:
        """The file, or the name of a nominal profile."""
        return self._native.name

    @property
    def kind(self) -> Literal["wheel", "rail"]:
        """Wheel or rail."""
        return "wheel" if self._native.is_wheel else "rail"

    @property
    def note(self) -> str:
        """What must be known of its source; empty if nothing."""
        return self._native.note

    @property
    def notices(self) -> list[tuple[str, str]]:
        """What is doubtful about its file, and what to do."""
        return self._native.notices

    @property
    def deviation(self) -> float:
        """How far the curve lies from the points that it was made of, m."""
        return self._native.deviation

    def __repr__(self) -> str:
        return f"<Profile of a {self.kind}: {self.name}>"


def _is_wheel(kind: str) -> bool:
    if kind not in ("wheel", "rail"):
        raise WheelRailError(f'the kind of a profile cannot be {kind!r}; write "wheel" or "rail"')
    return kind == "wheel"


@dataclass(frozen=True)
class WheelContact:
    """The contact of one wheel, in CONTACT's frame: y to the right, z down, forces on the rail.

    Arrays of patches have the shape of the arguments with a last axis of nine patches, the deepest first, NaN where there is
    none; others have the shape of the arguments. ``share`` is 1 but where two areas grow together, which are given as one patch
    and as two; forces contain it.
    """

    share: Floats
    """Share with which a patch counts."""
    y: Floats
    """Lateral place on the track, m."""
    angle: Floats
    """Angle of the plane of contact about x, rad."""
    normal: Floats
    """Normal force, N."""
    fx: Floats
    """Creep force along x, N."""
    fy: Floats
    """Creep force in the plane of contact, to the right, N."""
    spin_moment: Floats
    """Moment about the normal that points down, N m."""
    creepage_x: Floats
    """Longitudinal creepage: velocity of the rail less that of the wheel over the speed."""
    creepage_y: Floats
    """Lateral creepage."""
    spin: Floats
    """Spin, 1/m."""
    a: Floats
    """Semi-axis along the rolling direction, m."""
    b: Floats
    """Semi-axis across it, m."""
    greatest_pressure: Floats
    """Greatest pressure, Pa."""
    center: Floats
    """Lateral place of the wheel's center, m."""
    height: Floats
    """Height of the wheel's center above the top of its rail, m; NaN off the rail."""
    lateral_force: Floats
    """Lateral force on the rail, N."""
    vertical_force: Floats
    """Vertical force on the rail, N."""
    seat: npt.NDArray[np.str_]
    """``on_rail``, ``flange_tip`` (climbed), ``rim_edge`` (about to fall in), ``off_rail``; empty where there is no answer."""


@dataclass(frozen=True)
class Contact:
    """The contact of both wheels."""

    left: WheelContact
    """The left wheel."""
    right: WheelContact
    """The right wheel."""
    pitch_rate: Floats
    """Pitch rate, rad/s: as given, or that of free rolling. Negative forward."""


@dataclass(frozen=True)
class Positions:
    """A rigid wheelset that touches both rails, over lateral shifts (to the left); NaN where a wheel is not over its rail."""

    rolling_radius_difference: Floats
    """Rolling radius of the left wheel less that of the right one, m."""
    left_angle: Floats
    """Contact angle of the left wheel, rad: positive where its plane of contact rises to the field side."""
    right_angle: Floats
    """Contact angle of the right wheel, rad."""
    roll: Floats
    """Roll of the axle, rad: positive with the right side down."""


class Wheelset:
    """A wheelset on rails: two wheels, two rails of one profile each."""

    def __init__(
        self,
        wheel: Profile | tuple[Profile, Profile],
        rail: Profile | tuple[Profile, Profile],
        *,
        gauge: QuantityLike = "56.5 in",
        gauge_depth: QuantityLike = "0.625 in",
        tape_distance: QuantityLike = "59.5 in",
        radius: QuantityLike | tuple[QuantityLike, QuantityLike] = "18 in",
        shear_modulus: float = _STEEL,
        poisson: float = _POISSON,
        patch: PatchForm = "ellipse",
    ) -> None:
        """Gauge is measured ``gauge_depth`` below the datum of the rail, z = 0 of its points (its top, for nominal ones); the
        tape circles of the wheels, of the nominal ``radius``, are ``tape_distance`` apart; ``shear_modulus`` in Pa. Rails stand
        as their profile is: incline nominal ones (``Profile.nominal("136re").inclined(1 / 40)``). ``wheel``, ``rail`` and ``radius`` may
        be pairs: left, right. ``patch`` is "ellipse" (Hertz) or "strips" (half-spaces on strips along the rolling direction, for
        patches that are no ellipses; "fastsim" takes these strips then)."""
        if patch not in get_args(PatchForm):
            raise WheelRailError(f"the patch is {patch!r}; write \"ellipse\" or \"strips\"")
        wheels, rails = _sides(wheel, "wheel"), _sides(rail, "rail")
        left, right = radius if isinstance(radius, tuple) else (radius, radius)
        self._native = _native.NativeWheelset(
            [own._native for own in wheels],
            [own._native for own in rails],
            si(gauge, "length", "gauge"),
            si(gauge_depth, "length", "gauge_depth"),
            si(tape_distance, "length", "tape_distance"),
            [si(left, "length", "radius"), si(right, "length", "radius")],
            si(shear_modulus, "pressure", "shear_modulus"),
            si(poisson, "dimensionless", "poisson"),
            patch == "strips",
        )

    def contact(
        self,
        *,
        load: Values,
        lateral: Values = 0.0,
        yaw: Values = 0.0,
        roll: Values = 0.0,
        speed: Values = "2 m/s",
        pitch_rate: Values | None = None,
        friction: Values = 0.3,
        creep: CreepLaw = "polach",
        cells: int = 50,
    ) -> Contact:
        """The contact patches under a vertical load of each wheel, as ``wedgelab wheelrail contact`` gives them.

        **CONTACT's frame**: x forward, y to the right, z down. Lateral place and yaw are to the right, roll has the right side
        down, forward rolling is a negative pitch rate; without one the wheelset rolls freely: its axle spins so fast that the
        rails' forces make no torque about it. Arguments may be arrays, which are broadcast. Answers are in SI units, as
        everywhere in this package.

        A point without an answer (a load that the rail carries at no height, an argument out of its range) is NaN with an empty
        ``seat``, and a `PointWarning` tells how many, which, and why. If no point has an answer, that is an error.
        """
        law, count = _law(creep), _whole(cells, "cells", 1, 1000)
        free = pitch_rate is None
        shape, flat = _flat(
            [
                _values(lateral, "length", "lateral"),
                _values(yaw, "angle", "yaw"),
                _values(roll, "angle", "roll"),
                _values(speed, "speed", "speed"),
                np.asarray(0.0) if free else _values(pitch_rate, "angular_speed", "pitch_rate"),
                _values(load, "force", "load"),
                _values(friction, "dimensionless", "friction"),
            ]
        )
        failed: Failed = []
        if free:
            rates, failed = self._native.free_rolling(flat, law, count)
            flat[4] = rates
        without = {k for k, _, _ in failed}
        sides = []
        for left in (True, False):
            side, own = self._side(left, shape, flat, law, count)
            failed += [one for one in own if one[0] not in without]
            sides.append(side)
        tell("contact", shape, failed, WheelRailError)
        return Contact(sides[0], sides[1], flat[4].reshape(shape))

    def _side(
        self, left: bool, shape: tuple[int, ...], flat: list[Floats], creep: str, cells: int
    ) -> tuple[WheelContact, Failed]:
        patches, whole, seats, failed = self._native.contact(left, flat, creep, cells)
        of_patch = np.moveaxis(patches.reshape(*shape, _PATCHES, -1), -1, 0)
        of_wheel = np.moveaxis(whole.reshape(*shape, -1), -1, 0)
        names = [field.name for field in fields(WheelContact) if field.name != "seat"]
        numbers = dict(zip(names, [*of_patch, *of_wheel], strict=True))
        return WheelContact(**numbers, seat=np.array(seats, dtype=np.str_).reshape(shape)), failed

    def positions(self, shift: Values) -> Positions:
        """Rolling radius difference, contact angles and roll at lateral shifts (to the left, at the height of the rails'
        tops), with rigid bodies."""
        shape, (flat,) = _flat([_values(shift, "length", "shift")])
        return Positions(*(one.reshape(shape) for one in self._native.positions(flat)))

    def equivalent_conicity(
        self,
        amplitude: Values = "3 mm",
        *,
        method: Literal["wavelength", "linearization"] = "wavelength",
        largest_shift: QuantityLike = "0.5 in",
        positions: int = 400,
    ) -> Floats:
        """Equivalent conicity at amplitudes: by the wavelength (EN 15302) or by harmonic linearization, from a table of
        rolling radius differences up to ``largest_shift``. The axle rolls, which the standard neglects (0.8 % with cones of
        1:40). Amplitudes that the table does not cover are NaN, with a `PointWarning`; if none is covered, that is an error."""
        if method not in ("wavelength", "linearization"):
            raise WheelRailError(f'method cannot be {method!r}; write "wavelength" or "linearization"')
        positions = _whole(positions, "positions", 2, 100_000)
        shape, (flat,) = _flat([_values(amplitude, "length", "amplitude")])
        found, failed = self._native.conicity(flat, si(largest_shift, "length", "largest_shift"), positions)
        tell("equivalent conicity", shape, failed, WheelRailError)
        return found[0 if method == "wavelength" else 1].reshape(shape)


def contact(wheel: Profile, rail: Profile, *, load: Values, **given: Any) -> Contact:
    """``Wheelset(wheel, rail, ...).contact(load=..., ...)`` in one call: takes the arguments of both."""
    names = ("gauge", "gauge_depth", "tape_distance", "radius", "shear_modulus", "poisson")
    layout = {name: given.pop(name) for name in names if name in given}
    return Wheelset(wheel, rail, **layout).contact(load=load, **given)


@dataclass(frozen=True)
class CreepForces:
    """Creep forces on the wheel, in the common shape of the arguments."""

    x: Floats
    """Along the rolling direction, N."""
    y: Floats
    """Across it, N."""
    spin_moment: Floats
    """About the normal, N m."""


def creep_forces(
    law: CreepLaw,
    *,
    a: Values,
    b: Values,
    load: Values,
    longitudinal: Values = 0.0,
    lateral: Values = 0.0,
    spin: Values = 0.0,
    friction: Values = 0.3,
    shear_modulus: float = _STEEL,
    poisson: float = _POISSON,
    cells: int = 50,
) -> CreepForces:
    """Creep forces of an ellipse with the semi-axes ``a`` along and ``b`` across the rolling direction under a normal load.

    Creepages are velocities of the wheel relative to the rail over the rolling speed, ``spin`` in 1/m; forces act on the wheel
    and oppose them. FASTSIM has ``cells`` by ``cells`` cells. Arguments may be arrays, which are broadcast. Points with an
    argument out of its range are NaN, with a `PointWarning`; if there are no others, that is an error.
    """
    values = [
        _values(a, "length", "a"),
        _values(b, "length", "b"),
        _values(load, "force", "load"),
        _values(friction, "dimensionless", "friction"),
        _values(longitudinal, "dimensionless", "longitudinal"),
        _values(lateral, "dimensionless", "lateral"),
        _values(spin, "dimensionless", "spin"),
    ]
    modulus, ratio = si(shear_modulus, "pressure", "shear_modulus"), si(poisson, "dimensionless", "poisson")
    if not (modulus > 0.0 and 0.0 <= ratio <= 0.5):
        raise WheelRailError("shear_modulus (Pa) must be positive, and poisson between 0 and 0.5")
    shape, flat = _flat(values)
    names = ("a", "b", "load", "friction", "longitudinal", "lateral", "spin")
    positive, not_negative, finite = "positive and finite", "finite, 0 or more", "a finite number"
    conditions = []
    for k, (own, what) in enumerate(zip(flat, names, strict=True)):
        holds = np.isfinite(own) & (own > 0.0 if k < 3 else own >= 0.0 if k == 3 else True)
        conditions.append((holds, own, what, positive if k < 3 else not_negative if k == 3 else finite))
    failed = unmet(conditions)
    tell("creep forces", shape, failed, WheelRailError)
    out = [k for k, _, _ in failed]
    flat = [own.copy() for own in flat]
    for own in flat:
        own[out] = 1.0
    found = _native.creep_forces(_law(law), flat, modulus, ratio, _whole(cells, "cells", 1, 1000))
    for one in found:
        one[out] = np.nan
    return CreepForces(*(one.reshape(shape) for one in found))


@dataclass(frozen=True)
class TrackSample:
    """A track at distances: arrays of their shape. Curvature and lateral irregularities are positive to the left, profiles up,
    superelevation and cross level where the right rail is higher."""

    x: Floats
    """Place of the center line, m: along the track at its start."""
    y: Floats
    """Place, m: to the left."""
    z: Floats
    """Height, m."""
    heading: Floats
    """Heading, rad: to the left."""
    curvature: Floats
    """Curvature, 1/m."""
    superelevation: Floats
    """Superelevation, m."""
    grade: Floats
    """Rise by the distance."""
    left_profile: Floats
    """Vertical irregularity of the left rail, m."""
    right_profile: Floats
    """Vertical irregularity of the right rail, m."""
    left_alignment: Floats
    """Lateral irregularity of the left rail, m."""
    right_alignment: Floats
    """Lateral irregularity of the right rail, m."""
    left_profile_slope: Floats
    """Derivative of the left profile by the distance."""
    right_profile_slope: Floats
    """Derivative of the right profile by the distance."""
    left_alignment_slope: Floats
    """Derivative of the left alignment by the distance."""
    right_alignment_slope: Floats
    """Derivative of the right alignment by the distance."""
    cross_level: Floats
    """Right rail above the left one, with superelevation, m."""
    gauge_deviation: Floats
    """Gauge less its nominal value, m."""


class Track:
    """A track: curves, superelevation, grades, irregularities (docs/wheelrail.md)."""

    def __init__(self, native: _native.NativeTrack) -> None:
        self._native = native

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Track:
        """Reads a track file. Raises ``CaseError`` with all mistakes and their places."""
        return cls(_native.NativeTrack.read(path))

    @classmethod
    def parse(cls, text: str, source: str = "track.toml") -> Track:
        """A track from the text of a track file; tables are looked for beside ``source``."""
        return cls(_native.NativeTrack.parse(text, source))

    @property
    def name(self) -> str:
        """Its name."""
        return self._native.name

    @property
    def title(self) -> str:
        """One line for people; may be empty."""
        return self._native.title

    @property
    def length(self) -> float:
        """Length of its center line in plan, m."""
        return self._native.length

    def sample(self, distance: Values) -> TrackSample:
        """The track at distances from its start, in plan; NaN, with a `PointWarning`, at distances that are not finite."""
        shape, (flat,) = _flat([_values(distance, "length", "distance")])
        failed = unmet([(np.isfinite(flat), flat, "distance", "a finite number")])
        tell("track", shape, failed, WheelRailError)
        out = [k for k, _, _ in failed]
        given = flat.copy()
        given[out] = 0.0
        found = self._native.sample(given).reshape(given.size, -1)
        found[out] = np.nan
        found = found.reshape(*shape, -1)
        return TrackSample(*np.moveaxis(found, -1, 0))
