"""Freight cars on track (``docs/car.md``)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import ClassVar

from ._wedgelab import NativeCarCase
from .case import ModelCase
from .result import CarResult, checked

__all__ = ["CarCase"]


class CarCase(ModelCase):
    """A car's case that is ready to run: complete, checked, immutable.

    ``base`` is the name of a built-in car (``wedgelab case`` lists them), the path of a case file with ``model = "car"``, or another
    case. ``values`` are laid over it by their paths. A text carries its unit; a bare number is in SI units.

    >>> CarCase("car_twist_and_roll_loaded", {"speed.value": "18 mph"}).run()            # doctest: +SKIP
    >>> CarCase("my_car.toml", {"front_truck.friction.column": 0.2})                     # doctest: +SKIP

    Raises `CaseError`, with all mistakes at once.
    """

    __slots__ = ()

    _NATIVE: ClassVar[type[NativeCarCase]] = NativeCarCase
    _MODEL = "car"

    _native: NativeCarCase

    def run(
        self,
        *,
        columns: Iterable[str] | None = None,
        progress: Callable[[float], object] | None = None,
        incomplete: str = "raise",
    ) -> CarResult:
        """Runs it to its end; see `Case.run`."""
        result: CarResult = checked(CarResult(self._run(columns, progress)), incomplete)
        return result
