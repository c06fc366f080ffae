"""Cases: what is run."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, TypeVar, Union

from . import _html
from ._motions import Section
from ._wedgelab import (
    NativeCarCase,
    NativeCase,
    NativeResult,
    NativeTruckCase,
    NativeVehicleCase,
    built_in_groups,
    wedge_assumptions,
)
from .errors import CaseError
from .result import Result, checked
from .sections import (
    BolsterSection,
    ContactSection,
    ControlCoilSection,
    EnvironmentSection,
    FaceSection,
    FrictionSection,
    SideFrameSection,
    SimulationSection,
    WedgeSection,
)

__all__ = ["Case", "Group", "built_in"]

SectionLike = Union[Section, Mapping[str, Any]]

_SECTIONS: dict[str, type[Section]] = {
    "wedge": WedgeSection,
    "control_coil": ControlCoilSection,
    "contact": ContactSection,
    "friction": FrictionSection,
    "column_face": FaceSection,
    "slope_face": FaceSection,
    "side_frame": SideFrameSection,
    "bolster": BolsterSection,
    "environment": EnvironmentSection,
    "simulation": SimulationSection,
}


def _given(
    name: str | None, title: str | None, sections: Mapping[str, SectionLike | None]
) -> dict[str, Any]:
    given: dict[str, Any] = {"name": name, "title": title, **sections}
    for key, value in given.items():
        if isinstance(value, Section) and key in _SECTIONS and not isinstance(value, _SECTIONS[key]):
            message = f"`{key}` is a {type(value).__name__}; a {_SECTIONS[key].__name__} is expected"
            raise CaseError(message)
    return {key: value for key, value in given.items() if value is not None}


def _nested(changes: Mapping[str, Any]) -> dict[str, Any]:
    """``{"friction.column": 0.3}`` as nested dicts."""
    nested: dict[str, Any] = {}
    for path, value in changes.items():
        if not isinstance(path, str):
            raise CaseError(f"the path {path!r} is no text; write for example \"friction.column\"")
        *tables, key = path.split(".")
        inner = nested
        for table in tables:
            inner = inner.setdefault(table, {})
            if not isinstance(inner, dict):
                raise CaseError(f"`{path}` is set, and `{table}` as a whole too; set one of them")
        if key in inner:
            raise CaseError(f"`{path}` is set twice")
        inner[key] = value
    return nested


class CompleteCase:
    """What cases of wedges, trucks and cars have in common: complete, checked, immutable."""

    __slots__ = ("_native",)

    _native: NativeCase | NativeTruckCase | NativeCarCase | NativeVehicleCase

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

    def _run(
        self, columns: Iterable[str] | None, progress: Callable[[float], object] | None
    ) -> NativeResult:
        interruptible = threading.current_thread() is threading.main_thread()
        return self._native.run(_names(columns), progress, interruptible)

    def __eq__(self, other: object) -> bool:
        return self.to_toml() == other.to_toml() if isinstance(other, type(self)) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def _repr_html_(self) -> str:
        title = f"{self.name}: {self.title}" if self.title else self.name
        return _html.page(f"{type(self).__name__} {title}", [f"<pre>{_html.escape(self.to_toml())}</pre>"])

    def __repr__(self) -> str:
        kind = type(self).__name__
        return f"<{kind} {self.name}: {self.title}>" if self.title else f"<{kind} {self.name}>"


_Own = TypeVar("_Own", bound="ModelCase")


class ModelCase(CompleteCase):
    """What cases of trucks, cars and vehicles have in common: values are laid over a base by their paths."""

    __slots__ = ()

    _NATIVE: ClassVar[type[NativeTruckCase] | type[NativeCarCase] | type[NativeVehicleCase]]
    _MODEL: ClassVar[str]

    _native: NativeTruckCase | NativeCarCase | NativeVehicleCase

    def __init__(
        self: _Own, base: str | os.PathLike[str] | _Own, values: Mapping[str, Any] | None = None, /
    ) -> None:
        given = _nested(values or {})
        if isinstance(base, type(self)):
            self._native = self._NATIVE.parse(base.to_toml(), "case.toml", "", given)
        elif isinstance(base, (str, os.PathLike)):
            path = Path(base)
            looks_like_a_name = len(path.parts) == 1 and path.suffix != ".toml" and isinstance(base, str)
            if looks_like_a_name and not path.is_file():
                self._native = self._NATIVE.built_in(os.fspath(base), given)
            else:
                self._native = self._NATIVE.read(path, given)
        else:
            message = f"a {self._MODEL}'s case cannot be made from a {type(base).__name__}"
            raise CaseError(f"{message}: the name of a built-in {self._MODEL}, a path or a case is expected")

    @classmethod
    def _of(cls: type[_Own], native: NativeTruckCase | NativeCarCase | NativeVehicleCase) -> _Own:
        case = cls.__new__(cls)
        case._native = native
        return case

    @classmethod
    def parse(
        cls: type[_Own], text: str, *, source: str = "case.toml", folder: str | os.PathLike[str] = ""
    ) -> _Own:
        """The text of a case file. ``source`` names it in messages; tables are looked for in ``folder``."""
        return cls._of(cls._NATIVE.parse(text, source, folder, {}))

    def replace(self: _Own, values: Mapping[str, Any], /) -> _Own:
        """This case with other values by their paths, as in ``{"truck.condition": "mu_0.25"}``."""
        return type(self)(self, values)

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self).parse, (self.to_toml(),))


class Case(CompleteCase):
    """A case that is ready to run: complete, checked, immutable.

    ``base`` is the name of a built-in case, the path of a case file (TOML), or another case; without it, the values of
    the thesis for the damping. What is given by keywords is laid over it: section objects, or mappings with the keys of case files. A text carries its
    unit; a bare number is in SI units.

    >>> Case("cdrun_toe_out_0.2_psi_0.012").run()                                          # doctest: +SKIP
    >>> Case(wedge={"damping": "constant"}, friction={"column": 0.3})                   # doctest: +SKIP
    >>> Case("my.toml", bolster=BolsterSection(vertical=Sine("20 mm", "0.5 Hz")))       # doctest: +SKIP

    Raises `CaseError`, with all mistakes at once.
    """

    __slots__ = ("_document",)

    _native: NativeCase
    _document: dict[str, Any] | None

    def __init__(
        self,
        base: str | os.PathLike[str] | Case | None = None,
        /,
        *,
        name: str | None = None,
        title: str | None = None,
        wedge: WedgeSection | Mapping[str, Any] | None = None,
        control_coil: ControlCoilSection | Mapping[str, Any] | None = None,
        contact: ContactSection | Mapping[str, Any] | None = None,
        friction: FrictionSection | Mapping[str, Any] | None = None,
        column_face: FaceSection | Mapping[str, Any] | None = None,
        slope_face: FaceSection | Mapping[str, Any] | None = None,
        side_frame: SideFrameSection | Mapping[str, Any] | None = None,
        bolster: BolsterSection | Mapping[str, Any] | None = None,
        environment: EnvironmentSection | Mapping[str, Any] | None = None,
        simulation: SimulationSection | Mapping[str, Any] | None = None,
    ) -> None:
        sections: dict[str, SectionLike | None] = {
            "wedge": wedge,
            "control_coil": control_coil,
            "contact": contact,
            "friction": friction,
            "column_face": column_face,
            "slope_face": slope_face,
            "side_frame": side_frame,
            "bolster": bolster,
            "environment": environment,
            "simulation": simulation,
        }
        given = _given(name, title, sections)
        self._document = None
        if base is None:
            self._native = _over_thesis(given)
        elif isinstance(base, Case):
            self._native = base._with(given) if given else base._native
        elif isinstance(base, (str, os.PathLike)):
            self._native = _of_name(base, given)
        else:
            message = f"a case cannot be made from a {type(base).__name__}"
            raise CaseError(f"{message}: the name of a built-in case, a path or a case is expected")

    @classmethod
    def _of(cls, native: NativeCase) -> Case:
        case = cls.__new__(cls)
        case._native = native
        case._document = None
        return case

    @classmethod
    def built_in(cls, name: str) -> Case:
        """The built-in case of this name; `built_in()` lists them."""
        return cls._of(NativeCase.built_in(name, {}))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Case:
        """A case file (TOML)."""
        return cls._of(NativeCase.read(path, {}))

    @classmethod
    def parse(cls, text: str, *, source: str = "case.toml", folder: str | os.PathLike[str] = "") -> Case:
        """The text of a case file. ``source`` names it in messages; tables are looked for in ``folder``."""
        return cls._of(NativeCase.parse(text, source, folder, {}))

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Case:
        """From nested mappings with the keys of case files; bare numbers are in SI units."""
        return cls._of(_over_thesis(dict(values)))

    def replace(self, changes: Mapping[str, Any] | None = None, /, **sections: Any) -> Case:
        """This case with other values: by paths, as in ``{"friction.column": 0.3}``, by sections, or both.

        All else stays as it stands in `to_toml`, also where the thesis would have another value for it.
        """
        given = _nested(changes or {})
        for key, value in _given(None, None, sections).items():
            if key in given:
                raise CaseError(f"`{key}` is given twice: in the paths and by its name")
            given[key] = value
        return type(self)._of(self._with(given))

    def _with(self, given: dict[str, Any]) -> NativeCase:
        return NativeCase.parse(self.to_toml(), "case.toml", "", given)

    @property
    def wedge(self) -> WedgeSection:
        """``[wedge]``, complete."""
        return self._section("wedge")  # type: ignore[no-any-return]

    @property
    def control_coil(self) -> ControlCoilSection:
        """``[control_coil]``, complete."""
        return self._section("control_coil")  # type: ignore[no-any-return]

    @property
    def contact(self) -> ContactSection:
        """``[contact]``, complete."""
        return self._section("contact")  # type: ignore[no-any-return]

    @property
    def friction(self) -> FrictionSection:
        """``[friction]``, complete."""
        return self._section("friction")  # type: ignore[no-any-return]

    @property
    def column_face(self) -> FaceSection:
        """``[column_face]``, complete."""
        return self._section("column_face")  # type: ignore[no-any-return]

    @property
    def slope_face(self) -> FaceSection:
        """``[slope_face]``, complete."""
        return self._section("slope_face")  # type: ignore[no-any-return]

    @property
    def side_frame(self) -> SideFrameSection:
        """``[side_frame]``, complete."""
        return self._section("side_frame")  # type: ignore[no-any-return]

    @property
    def bolster(self) -> BolsterSection:
        """``[bolster]``, complete."""
        return self._section("bolster")  # type: ignore[no-any-return]

    @property
    def environment(self) -> EnvironmentSection:
        """``[environment]``, complete."""
        return self._section("environment")  # type: ignore[no-any-return]

    @property
    def simulation(self) -> SimulationSection:
        """``[simulation]``, complete."""
        return self._section("simulation")  # type: ignore[no-any-return]

    def _section(self, key: str) -> Any:
        return _SECTIONS[key]._of(self._entries()[key])

    def _entries(self) -> dict[str, Any]:
        if self._document is None:
            self._document = self._native.document()
        return self._document

    @property
    def assumptions(self) -> list[str]:
        """What the numbers of a run rest on."""
        return wedge_assumptions(self._native)

    def run(
        self,
        *,
        columns: Iterable[str] | None = None,
        progress: Callable[[float], object] | None = None,
        incomplete: str = "raise",
    ) -> Result:
        """Runs the case to its end, without the interpreter lock; Ctrl-C stops it.

        ``columns`` are the names (without units) of those that are kept; without it, all. ``progress`` is called some 20 times
        a second with the time reached, s; an exception in it ends the run. A run that cannot go on, that derails, or whose energy ledger does not
        close to 1e-2, raises `RunError`, which has what was computed as ``result``; with ``incomplete="keep"`` it is returned instead. An
        `EnergyWarning` tells of a ledger that does not close to 1e-3, a `PlausibilityWarning` of what is implausible.
        """
        result: Result = checked(Result(self._run(columns, progress)), incomplete)
        return result

    def __reduce__(self) -> tuple[Any, ...]:
        return (Case.parse, (self.to_toml(),))


def _names(columns: Iterable[str] | None) -> list[str] | None:
    if isinstance(columns, str):
        raise CaseError(f"columns is the text {columns!r}; a list of names is expected: [{columns!r}]")
    return None if columns is None else list(columns)


def _over_thesis(given: dict[str, Any]) -> NativeCase:
    """The thesis's wedge with these values."""
    return NativeCase.parse('model = "wedge"', "case", "", given)


def _of_name(base: str | os.PathLike[str], given: dict[str, Any]) -> NativeCase:
    """A built-in case, or a file; as the command line takes them."""
    path = Path(base)
    name = os.fspath(base)
    is_file = path.is_file()
    known = any(name == one for group in built_in_groups() for one, _ in group[3])
    looks_like_a_name = len(path.parts) == 1 and path.suffix != ".toml" and isinstance(base, str)
    if known and not is_file or (looks_like_a_name and not path.exists()):
        return NativeCase.built_in(name, given)
    return NativeCase.read(path, given)


@dataclass(frozen=True)
class Group:
    """Built-in cases that belong together."""

    name: str
    title: str
    look_at: str
    """What to look at in their results."""
    cases: dict[str, str]
    """Names and titles."""


def built_in() -> dict[str, Group]:
    """The groups of built-in cases by their names, the thesis's first."""
    groups = (Group(name, title, look_at, dict(cases)) for name, title, look_at, cases in built_in_groups())
    return {group.name: group for group in groups}
