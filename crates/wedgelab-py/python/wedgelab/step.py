"""The wedge in a loop of your own: you move bolster and side frame, it answers with forces and moments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from ._units import si
from ._wedgelab import NativeWedge
from .case import Case
from .errors import StepError
from ._motions import QuantityLike

__all__ = ["COORDINATES", "Forces", "Motion", "Place", "Wedge"]

Floats = npt.NDArray[np.float64]
_Six = list[float]

COORDINATES = ("longitudinal", "lateral", "vertical", "roll", "pitch", "yaw")
"""Coordinates of bolster and side frame: displacements of the turning center from its nominal position along fixed axes
(longitudinal: positive from column to bolster; lateral; vertical: positive up), m, and angles, rad."""

Place = Union[Sequence[QuantityLike], Floats, Mapping[str, QuantityLike]]
"""Six coordinates in the order of `COORDINATES`, or some of them by name, the others being zero."""


@dataclass(frozen=True)
class Motion:
    """Where a neighbour is at the end of a step, and how it moves there."""

    position: Place
    """Six coordinates (m, rad), or some of them by name."""
    rate: Place | None = None
    """Their rates (m/s, rad/s); without them, the mean rates of the step."""


@dataclass(frozen=True)
class Forces:
    """What the wedge does to its neighbours. Fixed axes (longitudinal, lateral, vertical); moments about the turning centers."""

    on_bolster: Floats
    """Force on the bolster, N."""
    moment_on_bolster: Floats
    """Moment on the bolster, N m."""
    on_side_frame: Floats
    """Force on the side frame, N; with the coil's where that stands on the side frame."""
    moment_on_side_frame: Floats
    """Moment on the side frame, N m."""
    coil_compression: float
    """Free length less length of the control coil, m."""
    coil_force: float
    """Spring force of the control coil, N; positive: it pushes."""
    normal_forces: tuple[float, float]
    """Sums of normal forces at column and slope, N."""
    friction_losses: tuple[float, float]
    """Power lost in friction at column and slope, W."""


def _six(place: Any, what: str, kinds: tuple[str, str]) -> _Six:
    if isinstance(place, Mapping):
        unknown = [key for key in place if key not in COORDINATES]
        if unknown:
            raise StepError(f"{what} has no {unknown[0]!r}; coordinates are {', '.join(COORDINATES)}")
        place = [place.get(name, 0.0) for name in COORDINATES]
    if isinstance(place, (str, bytes)) or not hasattr(place, "__len__") or np.ndim(np.asarray(place, dtype=object)) != 1:
        raise StepError(f"{what} is {place!r}; six values are expected, or a mapping of some of {', '.join(COORDINATES)}")
    if len(place) != 6:
        raise StepError(f"{what} has {len(place)} values; six are expected: {', '.join(COORDINATES)}")
    values = [
        si(value, kinds[0] if at < 3 else kinds[1], f"{what}, {name}")
        for at, (name, value) in enumerate(zip(COORDINATES, place))
    ]
    for name, value in zip(COORDINATES, values):
        if not np.isfinite(value):
            raise StepError(f"{what}: {name} is {value}; it must be finite")
    return values


def _motion(motion: Any, what: str) -> tuple[_Six, _Six | None]:
    if not isinstance(motion, Motion):
        return _six(motion, what, ("length", "angle")), None
    position = _six(motion.position, what, ("length", "angle"))
    if motion.rate is None:
        return position, None
    return position, _six(motion.rate, f"the rate of {what}", ("speed", "angular_speed"))


def _start(motion: Motion | Place | None, what: str) -> tuple[_Six, _Six] | None:
    if motion is None:
        return None
    position, rate = _motion(motion, what)
    return position, [0.0] * 6 if rate is None else rate


class Wedge:
    """A wedge whose neighbours you move.

    It has the parameters, tolerances and start of a case, at time zero; the case's motions only say where the neighbours are then,
    unless places are given.

    >>> wedge = Wedge(Case("cdrun_toe_out_0.2_psi_0.012"))                    # doctest: +SKIP
    >>> forces = wedge.step({"vertical": "0.05 mm", "yaw": 0.012}, "1 ms")  # doctest: +SKIP
    >>> state = wedge.save()                                               # doctest: +SKIP
    """

    __slots__ = ("_case", "_native")

    def __init__(
        self,
        case: Case | str,
        *,
        bolster: Motion | Place | None = None,
        side_frame: Motion | Place | None = None,
    ) -> None:
        self._case = case if isinstance(case, Case) else Case(case)
        start = (_start(bolster, "the bolster"), _start(side_frame, "the side frame"))
        self._native = NativeWedge(self._case._native, *start)

    @property
    def case(self) -> Case:
        """Its case."""
        return self._case

    @property
    def time(self) -> float:
        """Time reached, s."""
        return self._native.time

    def step(
        self,
        bolster_motion: Motion | Place,
        dt: QuantityLike,
        *,
        side_frame_motion: Motion | Place | None = None,
    ) -> Forces:
        """Goes on by ``dt`` (s, or a text with a unit), while the bolster goes from where it is to where you say, and gives the
        forces then.

        In between each coordinate is the cubic through its values and rates at both ends; without rates, these are the mean rates of the
        step. The side frame stays where it is if nothing is said of it. Steps may have any lengths.

        Raises `StepError`: for values that are wrong the wedge stays as it was; a step that cannot be made leaves it useless until a
        state is restored.
        """
        duration = si(dt, "time", "dt")
        position, rate = _motion(bolster_motion, "the bolster")
        side: tuple[_Six | None, _Six | None] = (None, None)
        if side_frame_motion is not None:
            side = _motion(side_frame_motion, "the side frame")
        self._native.step(duration, position, rate, *side)
        return self.forces

    @property
    def forces(self) -> Forces:
        """Forces and moments now."""
        bolster, side_frame, compression, force, normal, losses = self._native.reading()
        return Forces(
            on_bolster=np.array(bolster[0]),
            moment_on_bolster=np.array(bolster[1]),
            on_side_frame=np.array(side_frame[0]),
            moment_on_side_frame=np.array(side_frame[1]),
            coil_compression=compression,
            coil_force=force,
            normal_forces=(normal[0], normal[1]),
            friction_losses=(losses[0], losses[1]),
        )

    @property
    def bolster(self) -> Motion:
        """Where the bolster is, and how it moves."""
        position, rate = self._native.places[0]
        return Motion(np.array(position), np.array(rate))

    @property
    def side_frame(self) -> Motion:
        """Where the side frame is, and how it moves."""
        position, rate = self._native.places[1]
        return Motion(np.array(position), np.array(rate))

    @property
    def outputs(self) -> dict[str, float]:
        """Everything that a run writes, now, by the names of columns, SI."""
        return dict(zip(self._native.columns(), self._native.row().tolist()))

    def set_coil(self, *, stiffness: QuantityLike | None = None, force: QuantityLike | None = None) -> None:
        """From now on the coil's force is ``stiffness`` times its compression, or ``force``; without both, the case's law."""
        self._native.set_coil(
            None if stiffness is None else si(stiffness, "stiffness", "stiffness"),
            None if force is None else si(force, "force", "force"),
        )

    def set_friction(self, column: float, slope: float) -> None:
        """Coefficients of friction from now on."""
        self._native.set_friction(si(column, "dimensionless", "column"), si(slope, "dimensionless", "slope"))

    def save(self) -> bytes:
        """All that is needed to go on with the same bits, also in another process."""
        return self._native.save()

    def restore(self, state: bytes) -> None:
        """Goes back, or on, to a state that a wedge of the same case has saved."""
        if not isinstance(state, (bytes, bytearray, memoryview)):
            raise StepError(f"a saved state is bytes, and this is a {type(state).__name__}")
        self._native.restore(bytes(state))

    def __repr__(self) -> str:
        return f"<Wedge of {self._case.name} at {self.time} s>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (_restored, (self._case, self.save()))


def _restored(case: Case, state: bytes) -> Wedge:
    wedge = Wedge(case)
    wedge.restore(state)
    return wedge
