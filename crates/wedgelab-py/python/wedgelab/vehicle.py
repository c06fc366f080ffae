"""Vehicles of bodies and elements that a user names (``docs/vehicle.md``)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import ClassVar

from ._wedgelab import NativeVehicleCase
from .case import ModelCase
from .result import VehicleResult, checked

__all__ = ["VehicleCase"]


class VehicleCase(ModelCase):
    """A vehicle's case that is ready to run: complete, checked, immutable.

    ``base`` is the name of a built-in vehicle (``wedgelab case`` lists them), the path of a case file with ``model = "vehicle"``, or another
    case. ``values`` are laid over it by their paths. A text carries its unit; a bare number is in SI units.

    >>> VehicleCase("vehicle_two_masses", {"elements.lower_spring.stiffness": "3000 lbf/in"}).run()   # doctest: +SKIP
    >>> VehicleCase("my_vehicle.toml", {"bodies.frame.weight": "900 lbf"})                         # doctest: +SKIP

    Raises `CaseError`, with all mistakes at once.
    """

    __slots__ = ()

    _NATIVE: ClassVar[type[NativeVehicleCase]] = NativeVehicleCase
    _MODEL = "vehicle"

    _native: NativeVehicleCase

    def run(
        self,
        *,
        columns: Iterable[str] | None = None,
        progress: Callable[[float], object] | None = None,
        incomplete: str = "raise",
    ) -> VehicleResult:
        """Runs it to its end; see `Case.run`."""
        result: VehicleResult = checked(VehicleResult(self._run(columns, progress)), incomplete)
        return result
