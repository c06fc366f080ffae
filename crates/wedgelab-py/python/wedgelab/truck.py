"""Three-piece trucks with four wedges that have mass (``docs/truck.md``)."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from ._wedgelab import NativeTruckCase
from .case import CompleteCase, _nested
from .errors import CaseError
from .result import TruckResult, checked

__all__ = ["TruckCase"]


class TruckCase(CompleteCase):
    """A truck's case that is ready to run: complete, checked, immutable.

    ``base`` is the name of a built-in truck (``wedgelab case`` lists them), the path of a case file with ``model = "truck"``, or another
    case. ``values`` are laid over it by their paths. A text carries its unit; a bare number is in SI units.

    >>> TruckCase("truck_warp_nest_constant_rising", {"truck.condition": "worn"}).run()            # doctest: +SKIP
    >>> TruckCase("my_truck.toml", {"wedge.leading_left.friction.column": 0.2})                    # doctest: +SKIP

    Raises `CaseError`, with all mistakes at once.
    """

    __slots__ = ()

    _native: NativeTruckCase

    def __init__(
        self, base: str | os.PathLike[str] | TruckCase, values: Mapping[str, Any] | None = None, /
    ) -> None:
        given = _nested(values or {})
        if isinstance(base, TruckCase):
            self._native = NativeTruckCase.parse(base.to_toml(), "case.toml", "", given)
        elif isinstance(base, (str, os.PathLike)):
            path = Path(base)
            looks_like_a_name = len(path.parts) == 1 and path.suffix != ".toml" and isinstance(base, str)
            if looks_like_a_name and not path.is_file():
                self._native = NativeTruckCase.built_in(os.fspath(base), given)
            else:
                self._native = NativeTruckCase.read(path, given)
        else:
            message = f"a truck's case cannot be made from a {type(base).__name__}"
            raise CaseError(f"{message}: the name of a built-in truck, a path or a case is expected")

    @classmethod
    def _of(cls, native: NativeTruckCase) -> TruckCase:
        case = cls.__new__(cls)
        case._native = native
        return case

    @classmethod
    def parse(cls, text: str, *, source: str = "case.toml", folder: str | os.PathLike[str] = "") -> TruckCase:
        """The text of a case file. ``source`` names it in messages; tables are looked for in ``folder``."""
        return cls._of(NativeTruckCase.parse(text, source, folder, {}))

    def replace(self, values: Mapping[str, Any], /) -> TruckCase:
        """This case with other values by their paths, as in ``{"friction.column": 0.3}``."""
        return TruckCase(self, values)

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

    def __reduce__(self) -> tuple[Any, ...]:
        return (TruckCase.parse, (self.to_toml(),))
