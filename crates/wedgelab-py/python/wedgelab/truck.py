"""Three-piece trucks with four wedges that have mass (``docs/truck.md``)."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from ._wedgelab import NativeTruckCase
from .case import _names, _nested
from .errors import CaseError
from .result import TruckResult, checked

__all__ = ["TruckCase"]


class TruckCase:
    """A truck's case that is ready to run: complete, checked, immutable.

    ``base`` is the name of a built-in truck (``wedgelab case`` lists them), the path of a case file with ``model = "truck"``, or another
    case. ``values`` are laid over it by their paths. A text carries its unit; a bare number is in SI units.

    >>> TruckCase("truck_warp_nest_constant_rising", {"truck.condition": "worn"}).run()            # doctest: +SKIP
    >>> TruckCase("my_truck.toml", {"wedge.leading_left.friction.column": 0.2})                    # doctest: +SKIP

    Raises `CaseError`, with all mistakes at once.
    """

    __slots__ = ("_native",)

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

    @property
    def name(self) -> str:
        """A name that can be the name of a folder."""
        return self._native.name

    @property
    def title(self) -> str:
        """One line for people; may be empty."""
        return self._native.title

    @property
    def duration(self) -> float:
        """End of the run, s."""
        return self._native.duration

    def to_dict(self) -> dict[str, Any]:
        """The complete case as nested dicts, as in its case file."""
        return self._native.document()

    def to_toml(self) -> str:
        """The complete case as a commented case file; `parse` reads it back to the same case."""
        return self._native.to_toml()

    def run(
        self,
        *,
        columns: Iterable[str] | None = None,
        progress: Callable[[float], object] | None = None,
        incomplete: str = "raise",
    ) -> TruckResult:
        """Runs it to its end; see `Case.run`."""
        interruptible = threading.current_thread() is threading.main_thread()
        native = self._native.run(_names(columns), progress, interruptible)
        result: TruckResult = checked(TruckResult(native), incomplete)
        return result

    def __eq__(self, other: object) -> bool:
        return self.to_toml() == other.to_toml() if isinstance(other, TruckCase) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __repr__(self) -> str:
        return f"<TruckCase {self.name}: {self.title}>" if self.title else f"<TruckCase {self.name}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (TruckCase.parse, (self.to_toml(),))
