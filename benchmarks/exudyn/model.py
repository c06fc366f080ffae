"""The truck's bodies, elements and rigs in numbers: inches, pounds-force, seconds, radians.

Axes: x forward, y left, z up from the top of rail, origin at the truck's center. Ends: leading +1,
trailing -1. Sides: left +1, right -1. In the nominal layout coils carry their preloads and all faces just
touch.

Both Exudyn models are built from these numbers; nothing here is read from Wedgelab or from its case files.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import cos, pi, radians, sin, tan

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

GRAVITY = 386.0886
"""Standard gravity in in/s²."""

ENDS = (("leading", 1.0), ("trailing", -1.0))
SIDES = (("left", 1.0), ("right", -1.0))
WEDGES = tuple((f"{end}_{side}", e, s) for end, e in ENDS for side, s in SIDES)
"""Names, ends and sides of the four wedges, in the order of all tables."""

LATERAL = 39.5
"""y of journals, side frames, nests and wedges."""


@dataclass(frozen=True)
class Spring:
    """A coil with shear stiffness; the force along z is max(0, preload - stiffness d_z)."""

    preload: float
    stiffness: float
    shear_stiffness: float
    damping: float = 0.0


@dataclass(frozen=True)
class Wedge:
    """A right triangular prism: vertical face, bottom, slope."""

    angle: float
    height: float = 6.125
    width: float = 10.5
    weight: float = 50.0
    inertia: tuple[float, float, float] = (1.461, 0.3756, 1.295)

    @property
    def length(self) -> float:
        """Length of the bottom."""
        return self.height * tan(self.angle)

    def column_corners(self) -> list[tuple[float, float, float]]:
        """Corners of the vertical face from the center of gravity, in wedge axes (x from the column)."""
        x = -self.length / 3.0
        return [(x, y, z) for z in self._heights() for y in self._edges()]

    def slope_corners(self) -> list[tuple[float, float, float]]:
        """Corners of the slope from the center of gravity, in wedge axes."""
        low, high = self._heights()
        at = ((2.0 * self.length / 3.0, low), (-self.length / 3.0, high))
        return [(x, y, z) for x, z in at for y in self._edges()]

    def _heights(self) -> tuple[float, float]:
        return -self.height / 3.0, 2.0 * self.height / 3.0

    def _edges(self) -> tuple[float, float]:
        return -self.width / 2.0, self.width / 2.0


@dataclass(frozen=True)
class Contact:
    """A corner of a face: a spring and a damper that never pull; a bristle in series with a slider."""

    stiffness: float = 2.5e5
    damping: float = 25.0
    friction: float = 0.4
    bristle_stiffness: float = 1.0e6 / 4.0
    bristle_damping: float = 1.0e3 / 4.0


@dataclass(frozen=True)
class Adapter:
    """One of two points on which a side frame stands on a bearing."""

    preload: float = 15691.0
    stiffness: float = 5.0e5
    damping: float = 1.0e3
    friction: float = 0.5
    bristle_stiffness: float = 1.0e6
    bristle_damping: float = 1.0e3


@dataclass(frozen=True)
class Clearances:
    """Gaps that the rigs do not close: their stops are left out, and each run checks that they stay open."""

    pocket_side: float = 0.25
    land: float = 0.21
    gib: float = 0.5
    adapter_longitudinal: float = 0.0468
    adapter_lateral: float = 0.25


@dataclass(frozen=True)
class Rig:
    """A truck, what is prescribed, and for how long."""

    name: str
    damping: str
    duration: float
    wedge: Wedge
    load_coil: Spring
    control_coil: Spring
    warp: bool
    """False: the bolster moves and side frames stand free on adapters. True: both are prescribed."""
    contact: Contact = field(default_factory=Contact)
    adapter: Adapter = field(default_factory=Adapter)
    clearances: Clearances = field(default_factory=Clearances)

    def with_friction(self, friction: float) -> Rig:
        """The same rig with another coefficient of friction at columns and slopes."""
        return replace(self, contact=replace(self.contact, friction=friction))


VERTICAL_VARIABLE = Rig(
    name="truck_vertical_variable",
    damping="variable",
    duration=10.0,
    wedge=Wedge(radians(32.0)),
    load_coil=Spring(12252.1, 5369.5, 3616.0),
    control_coil=Spring(6303.0, 1937.0, 1317.0, 1.0),
    warp=False,
)
"""Bolster z = 0.5 in sin(2 rad/s t); control coils stand on the side frames."""

WARP_CONSTANT_RISING = Rig(
    name="truck_warp_nest_constant_rising",
    damping="constant",
    duration=22.0,
    wedge=Wedge(radians(37.5)),
    load_coil=Spring(15403.8, 6468.7, 4450.0),
    control_coil=Spring(3702.2, 1979.0, 1346.0, 1.0),
    warp=True,
)
"""Bolster from -0.2 in to 0 within 0.2 to 1.2 s, then side frames yaw by a triangle of 0.02 rad at 0.1 Hz."""

RIGS = {rig.name: rig for rig in (VERTICAL_VARIABLE, WARP_CONSTANT_RISING)}

LIFT, LIFT_START, LIFT_DURATION = 0.2, 0.2, 1.0
WARP_ANGLE, WARP_PERIOD, WARP_START = 0.02, 10.0, 2.0
STROKE, STROKE_FREQUENCY = 0.5, 2.0


def bolster_height(rig: Rig, t: float) -> tuple[float, float]:
    """Displacement and speed of the bolster along z."""
    if not rig.warp:
        phase = STROKE_FREQUENCY * t
        return STROKE * sin(phase), STROKE * STROKE_FREQUENCY * cos(phase)
    phase = pi * min(max((t - LIFT_START) / LIFT_DURATION, 0.0), 1.0)
    return -0.5 * LIFT * (1.0 + cos(phase)), 0.5 * LIFT * sin(phase) * pi / LIFT_DURATION


def side_frame_yaw(rig: Rig, t: float) -> tuple[float, float]:
    """Yaw and yaw rate of both side frames where they are prescribed: zero, up, down, zero."""
    if not rig.warp or t < WARP_START:
        return 0.0, 0.0
    quarter = WARP_PERIOD / 4.0
    rate = WARP_ANGLE / quarter
    phase = (t - WARP_START) % WARP_PERIOD
    if phase < quarter:
        return rate * phase, rate
    if phase < 3.0 * quarter:
        return WARP_ANGLE - rate * (phase - quarter), -rate
    return rate * (phase - WARP_PERIOD), rate


BOLSTER, LEFT_FRAME, RIGHT_FRAME, FIRST_WEDGE = 0, 1, 2, 3
"""Numbers of the bodies; wedges follow in the order of WEDGES."""


@dataclass(frozen=True)
class Body:
    """A rigid body: nominal place of its center of gravity, weight, moments of inertia, free or not."""

    name: str
    at: tuple[float, float, float]
    weight: float
    inertia: tuple[float, float, float]
    free: bool


def bodies(rig: Rig) -> list[Body]:
    """Bolster, two side frames, four wedges."""
    listed = [Body("bolster", (0.0, 0.0, 22.0), 1300.0, (2915.0, 142.0, 2930.0), False)]
    for side, s in SIDES:
        at = (0.0, s * LATERAL, 18.0)
        listed.append(Body(f"{side}_side_frame", at, 1150.5, (900.0, 1370.0, 1370.0), not rig.warp))
    for name, e, s in WEDGES:
        listed.append(Body(name, (8.5 * e, s * LATERAL, 18.0), rig.wedge.weight, rig.wedge.inertia, True))
    return listed


def frame_of(side: float) -> int:
    """Number of the side frame on a side."""
    return LEFT_FRAME if side > 0.0 else RIGHT_FRAME


@dataclass(frozen=True)
class Face:
    """A plane against which four corners of a wedge stand; all in truck axes in the nominal layout."""

    wedge: int
    carrier: int
    corners: list[Array]
    """From the wedge's center of gravity."""
    center: Array
    """A point of the plane from the top of rail."""
    normal: Array
    """Towards the wedge."""
    column: bool


def to_truck(end: float, vector: tuple[float, float, float]) -> Array:
    """A vector in wedge axes, told in truck axes: leading wedges are turned by half a turn about z."""
    x, y, z = vector
    return np.array([-end * x, -end * y, z])


def faces(rig: Rig) -> list[Face]:
    """Columns and slopes, wedge by wedge."""
    wedge, listed = rig.wedge, []
    for number, (_, e, s) in enumerate(WEDGES):
        height = 18.0 + wedge.height / 6.0
        column_x = 8.5 + wedge.length / 3.0
        listed.append(
            Face(
                wedge=FIRST_WEDGE + number,
                carrier=frame_of(s),
                corners=[to_truck(e, corner) for corner in wedge.column_corners()],
                center=np.array([e * column_x, s * LATERAL, height]),
                normal=to_truck(e, (1.0, 0.0, 0.0)),
                column=True,
            )
        )
        listed.append(
            Face(
                wedge=FIRST_WEDGE + number,
                carrier=BOLSTER,
                corners=[to_truck(e, corner) for corner in wedge.slope_corners()],
                center=np.array([e * (column_x - wedge.length / 2.0), s * LATERAL, height]),
                normal=to_truck(e, (-cos(wedge.angle), 0.0, -sin(wedge.angle))),
                column=False,
            )
        )
    return listed


@dataclass(frozen=True)
class PlacedSpring:
    """A spring on body `upper` that stands on body `seat`, with its place in the nominal layout."""

    spring: Spring
    upper: int
    seat: int
    at: Array


def load_coils(rig: Rig) -> list[PlacedSpring]:
    """Four groups a nest, between bolster and side frame."""
    return [
        PlacedSpring(rig.load_coil, BOLSTER, frame_of(s), np.array([x, s * LATERAL + y, 13.0]))
        for _, s in SIDES
        for x in (-3.75, 3.75)
        for y in (-3.75, 3.75)
    ]


def control_coils(rig: Rig) -> list[PlacedSpring]:
    """One a wedge, below its center of gravity, on side frame (variable damping) or bolster (constant)."""
    return [
        PlacedSpring(
            rig.control_coil,
            FIRST_WEDGE + number,
            frame_of(s) if rig.damping == "variable" else BOLSTER,
            np.array([8.5 * e, s * LATERAL, 18.0 - rig.wedge.height / 3.0]),
        )
        for number, (_, e, s) in enumerate(WEDGES)
    ]


def adapter_points(rig: Rig) -> list[tuple[int, Array]]:
    """Side frame and place of each adapter point; none where side frames are prescribed."""
    if rig.warp:
        return []
    return [
        (frame_of(s), np.array([35.0 * e, s * LATERAL + y, 22.5]))
        for _, s in SIDES
        for _, e in ENDS
        for y in (-3.0, 3.0)
    ]
