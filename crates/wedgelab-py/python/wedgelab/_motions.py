"""Motions of the neighbours of a wedge, and what the sections of a case have in common."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, ClassVar, Union

import numpy as np
import numpy.typing as npt

from ._wedgelab import Quantity

__all__ = [
    "Constant",
    "MotionLike",
    "QuantityLike",
    "Ramp",
    "Section",
    "Sine",
    "SweptSine",
    "Table",
    "Triangle",
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
