"""Files of NUCARS: reading, checking, running the half-truck they describe."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Union

from . import _html
from ._optional import need
from ._units import si
from ._wedgelab import NativeHalfTruckCase, built_in_half_trucks, check_files, read_file
from .case import _names
from .errors import Finding, NucarsError
from .result import HalfTruckResult, checked
from ._motions import QuantityLike

__all__ = ["Checked", "NucarsFile", "ShownTable", "HalfTruckCase", "built_in", "check", "read"]

Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class ShownTable:
    """A table of a system file, in the file's units."""

    key: str
    """A short name, which stays: ``bodies``, ``connections``, ``wedges``."""
    title: str
    columns: tuple[tuple[str, str], ...]
    """Names and units."""
    rows: tuple[tuple[str, ...], ...]

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame``; columns that hold numbers only are numbers. Its ``attrs`` have ``title`` and ``units``."""
        pandas = need("pandas", "to_pandas", "pandas")
        names = [f"{name} [{unit}]" if unit else name for name, unit in self.columns]
        frame = pandas.DataFrame(list(self.rows), columns=names)
        for name in names:
            try:
                frame[name] = pandas.to_numeric(frame[name])
            except (ValueError, TypeError):
                continue
        frame.attrs["title"] = self.title
        frame.attrs["units"] = {name: unit for name, (_, unit) in zip(names, self.columns)}
        return frame

    def _repr_html_(self) -> str:
        header = [f"{name} ({unit})" if unit else name for name, unit in self.columns]
        return _html.page(self.title, [_html.table(header, self.rows, most=40)])


@dataclass(frozen=True)
class NucarsFile:
    """A file that was read and checked alone."""

    name: str
    kind: str
    """``system``, ``input``, ``data`` or ``run``."""
    title: str
    text: str
    """As it was read."""
    written: str
    """Written anew from what was understood."""
    tables: dict[str, ShownTable]
    """Of a system file, those that have rows, by their keys: ``bodies``, ``input_bodies``, ``connections``, ``springs``, ``gaps``,
    ``viscous_wedges``, ``surfaces``, ``wedges``, ``wedges_3d``, ``unused_characteristics``, ``functions``."""
    findings: list[Finding]
    """Errors, warnings and notes, in the order of the text."""

    @property
    def has_errors(self) -> bool:
        """Whether the file cannot be used."""
        return any(finding.severity == "error" for finding in self.findings)


@dataclass(frozen=True)
class Checked:
    """What was found in a file, alone and with the files it belongs to."""

    path: str
    kind: str
    findings: list[Finding]

    @property
    def has_errors(self) -> bool:
        """Whether the file cannot be used."""
        return any(finding.severity == "error" for finding in self.findings)


def read(path: Path, *, strict: bool = True) -> NucarsFile:
    """Reads a file (.SYS, .INP, .DAT, .RUN), or one of the thesis's by its name.

    Errors in it raise `NucarsError`; with ``strict=False`` what could be read is returned, with ``findings``.
    """
    native = read_file(path)
    tables = (ShownTable(key, title, tuple(columns), tuple(map(tuple, rows))) for key, title, columns, rows in native.tables)
    file = NucarsFile(
        native.name,
        native.kind,
        native.title,
        native.text,
        native.written,
        {table.key: table for table in tables},
        list(native.findings),
    )
    errors = [finding for finding in file.findings if finding.severity == "error"]
    if strict and errors:
        message = f"{file.name} has {len(errors)} error(s); the first: {errors[0].message}"
        raise NucarsError(message, "\n\n".join([f"  × {message}", *(one.text for one in errors)]), errors)
    return file


def check(
    *paths: Path, system: Path | None = None, data: Path | None = None, input: Path | None = None
) -> list[Checked]:
    """What is wrong or doubtful with files, alone and with those they belong to.

    A run file is checked with the files it names; ``system``, ``data`` and ``input`` are taken instead of those.
    """
    if not paths:
        raise NucarsError("no file is named; name at least one")
    return [Checked(path, kind, list(found)) for path, kind, found in check_files(list(paths), system, data, input)]


def built_in() -> dict[str, str]:
    """Names and titles of the built-in runs of the thesis's half-truck."""
    return dict(built_in_half_trucks())


class HalfTruckCase:
    """A half-truck's run, ready to be made.

    ``path`` is a run file (.RUN), with the files it names, or the name of a built-in run; ``system``, ``data``, ``input`` are
    taken instead of the named ones. ``yaw``: ``"printed"`` (as the files say), ``"drop"`` (without the springs that hold the bolster),
    ``"drive"`` (their input bodies move along). ``options`` choose where the files leave a choice, by the names of ``wedgelab nucars run
    --help``. ``duration`` (without it, what the run file says) and ``interval`` of rows are texts with units or in s; ``start`` is ``"drawn"`` or
    ``"equilibrium"``; ``units`` of summary and tables are ``"us"`` or ``"si"``. ``set`` lays single values over the files, by the paths of
    ``wedgelab nucars run --set``: ``{"wedges.column_friction": 0.3, "body.2.mass": "2000 lb"}``.
    """

    __slots__ = ("_native",)

    def __init__(
        self,
        path: Path,
        *,
        system: Path | None = None,
        data: Path | None = None,
        input: Path | None = None,
        yaw: str | None = None,
        options: Mapping[str, str | float | bool] | None = None,
        duration: QuantityLike | None = None,
        interval: QuantityLike = 0.01,
        start: str = "drawn",
        all_outputs: bool = False,
        units: str = "us",
        relative_tolerance: float = 1e-5,
        set: Mapping[str, str | float | bool] | None = None,
    ) -> None:
        choices = [(str(name), _option(value)) for name, value in (options or {}).items()]
        time = None if duration is None else si(duration, "time", "duration")
        self._native = NativeHalfTruckCase.read(
            path,
            system,
            data,
            input,
            yaw,
            choices,
            time,
            si(interval, "time", "interval"),
            start,
            all_outputs,
            units,
            relative_tolerance,
            [f"{path}={_option(value)}" for path, value in (set or {}).items()],
        )

    @classmethod
    def _of(cls, native: NativeHalfTruckCase) -> HalfTruckCase:
        case = cls.__new__(cls)
        case._native = native
        return case

    @property
    def name(self) -> str:
        """Its name."""
        return self._native.name

    @property
    def title(self) -> str:
        """One line for people."""
        return self._native.title

    @property
    def duration(self) -> float:
        """End of the run, s."""
        return self._native.duration

    @property
    def assumptions(self) -> list[str]:
        """What the numbers rest on."""
        return self._native.assumptions

    def run(
        self,
        *,
        columns: Iterable[str] | None = None,
        progress: Callable[[float], object] | None = None,
        incomplete: str = "raise",
    ) -> HalfTruckResult:
        """Runs it to its end; see `Case.run`."""
        interruptible = threading.current_thread() is threading.main_thread()
        result: HalfTruckResult = checked(
            HalfTruckResult(self._native.run(_names(columns), progress, interruptible)), incomplete
        )
        return result

    def __repr__(self) -> str:
        return f"<HalfTruckCase {self.name}: {self.title}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (_half_truck_case, (self._native.saved(),))


def _half_truck_case(saved: bytes) -> HalfTruckCase:
    return HalfTruckCase._of(NativeHalfTruckCase.load(saved))


def _option(value: str | float | bool) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
