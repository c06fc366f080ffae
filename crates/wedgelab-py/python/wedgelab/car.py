"""Freight cars on track (``docs/car.md``)."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from ._wedgelab import NativeCarCase
from .case import _names, _nested
from .errors import CaseError
from .result import CarResult, checked

__all__ = ["CarCase"]


class CarCase:
    """A car's case that is ready to run: complete, checked, immutable.

    ``base`` is the name of a built-in car (``wedgelab case`` lists them), the path of a case file with ``model = "car"``, or another
    case. ``values`` are laid over it by their paths. A text carries its unit; a bare number is in SI units.

    >>> CarCase("car_twist_and_roll_loaded", {"speed.value": "18 mph"}).run()            # doctest: +SKIP
    >>> CarCase("my_car.toml", {"front_truck.friction.column": 0.2})                     # doctest: +SKIP

    Raises `CaseError`, with all mistakes at once.
    """

    __slots__ = ("_native",)

    _native: NativeCarCase

    def __init__(
        self, base: str | os.PathLike[str] | CarCase, values: Mapping[str, Any] | None = None, /
    ) -> None:
        given = _nested(values or {})
        if isinstance(base, CarCase):
            self._native = NativeCarCase.parse(base.to_toml(), "case.toml", "", given)
        elif isinstance(base, (str, os.PathLike)):
            path = Path(base)
            looks_like_a_name = len(path.parts) == 1 and path.suffix != ".toml" and isinstance(base, str)
            if looks_like_a_name and not path.is_file():
                self._native = NativeCarCase.built_in(os.fspath(base), given)
            else:
                self._native = NativeCarCase.read(path, given)
        else:
            message = f"a car's case cannot be made from a {type(base).__name__}"
            raise CaseError(f"{message}: the name of a built-in car, a path or a case is expected")

    @classmethod
    def _of(cls, native: NativeCarCase) -> CarCase:
        case = cls.__new__(cls)
        case._native = native
        return case

    @classmethod
    def parse(cls, text: str, *, source: str = "case.toml", folder: str | os.PathLike[str] = "") -> CarCase:
        """The text of a case file. ``source`` names it in messages; tables are looked for in ``folder``."""
        return cls._of(NativeCarCase.parse(text, source, folder, {}))

    def replace(self, values: Mapping[str, Any], /) -> CarCase:
        """This case with other values by their paths, as in ``{"truck.friction.column": 0.3}``."""
        return CarCase(self, values)

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
    ) -> CarResult:
        """Runs it to its end; see `Case.run`."""
        interruptible = threading.current_thread() is threading.main_thread()
        native = self._native.run(_names(columns), progress, interruptible)
        result: CarResult = checked(CarResult(native), incomplete)
        return result

    def __eq__(self, other: object) -> bool:
        return self.to_toml() == other.to_toml() if isinstance(other, CarCase) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __repr__(self) -> str:
        return f"<CarCase {self.name}: {self.title}>" if self.title else f"<CarCase {self.name}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (CarCase.parse, (self.to_toml(),))
