"""Three-piece trucks with four wedges that have mass (``docs/truck.md``)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import ClassVar

from ._wedgelab import NativeTruckCase
from .case import ModelCase
from .result import TruckResult, checked

__all__ = ["TruckCase"]


class TruckCase(ModelCase):
    """A truck's case that is ready to run: complete, checked, immutable.

    ``base`` is the name of a built-in truck (``wedgelab case`` lists them), the path of a case file with ``model = "truck"``, or another
    case. ``values`` are laid over it by their paths. A text carries its unit; a bare number is in SI units.

    >>> TruckCase("truck_warp_nest_constant_rising", {"truck.condition": "mu_0.25"}).run()            # doctest: +SKIP
    >>> TruckCase("my_truck.toml", {"wedge.leading_left.friction.column": 0.2})                    # doctest: +SKIP

    Raises `CaseError`, with all mistakes at once.
    """

    __slots__ = ()

    _NATIVE: ClassVar[type[NativeTruckCase]] = NativeTruckCase
    _MODEL = "truck"

    _native: NativeTruckCase

    def run(
        self,
        *,
        columns: Iterable[str] | None = None,
        progress: Callable[[float], object] | None = None,
        incomplete: str = "raise",
    ) -> TruckResult:
        """Runs it to its end; see `Case.run`."""
        result: TruckResult = checked(TruckResult(self._run(columns, progress)), incomplete)
        return result
