"""Results: arrays by name with units, tables, summary, figures."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from . import _html
from ._optional import need
from ._wedgelab import NativeCarCase, NativeCase, NativeResult, NativeTruckCase, NativeVehicleCase, Quantity
from .errors import EnergyWarning, PlausibilityWarning, RunError, UnitError, WedgelabError
from .figures import Figure, _figures

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .case import Case

__all__ = ["AnyResult", "CarResult", "Column", "DataTable", "HalfTruckResult", "Measure", "Record", "Result", "TruckResult", "VehicleResult"]

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Column:
    """What a column of a result holds."""

    name: str
    """Its name without unit."""
    kind: str
    """What kind of quantity it is, such as ``force``."""
    unit: str
    """Unit of its values under the bare name: SI."""
    frame: str
    """The axes in which components are given."""
    reference: str
    """The point that it refers to."""
    text: str
    """What it is, in a few words."""


class Record(Mapping[str, Any]):
    """A nested dict whose keys are attributes too: ``summary.averages.cycles``, ``summary["averages"]["cycles"]``."""

    __slots__ = ("_entries",)

    def __init__(self, entries: Mapping[str, Any]) -> None:
        self._entries = {key: _record(value) for key, value in entries.items()}

    def __getitem__(self, key: str) -> Any:
        return self._entries[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __getattr__(self, key: str) -> Any:
        if key.startswith("__") or key == "_entries":
            raise AttributeError(key)
        try:
            return self._entries[key]
        except KeyError:
            known = ", ".join(self._entries)
            raise AttributeError(f"there is no {key!r} here; there are {known}") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._entries]

    def __repr__(self) -> str:
        return f"Record({self.to_dict()!r})"

    def _repr_html_(self) -> str:
        rows = [(key, value if isinstance(value, Measure) else _short(value)) for key, value in self._entries.items()]
        return _html.table(("key", "value"), rows, most=60)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_record, (self.to_dict(),))

    def to_dict(self) -> dict[str, Any]:
        """Plain nested dicts and lists."""
        return {key: _plain(value) for key, value in self._entries.items()}


class Measure(Record):
    """A number with its unit, ``value`` and ``unit``, that converts: ``measure.to("N")``, ``measure.si``."""

    __slots__ = ()

    def to(self, unit: str) -> float:
        """The value in another unit of the same kind."""
        return Quantity(self["value"], self["unit"]).to(unit)

    @property
    def si(self) -> float:
        """The value in SI units."""
        return Quantity(self["value"], self["unit"]).si

    def __str__(self) -> str:
        return f"{self['value']:.6g} {self['unit']}".rstrip()


def _short(value: Any) -> str:
    """What stands for a value in a table."""
    if isinstance(value, Record):
        return ", ".join(value)
    if isinstance(value, list):
        return f"{len(value)} entries"
    return _html.shown(value)


def _record(value: Any) -> Any:
    if isinstance(value, Mapping):
        is_measure = value.keys() == {"value", "unit"} and isinstance(value["value"], (int, float))
        return Measure(value) if is_measure else Record(value)
    if isinstance(value, list):
        return [_record(one) for one in value]
    return value


def _plain(value: Any) -> Any:
    if isinstance(value, Record):
        return value.to_dict()
    if isinstance(value, list):
        return [_plain(one) for one in value]
    return value


class DataTable(Mapping[str, npt.NDArray[Any]]):
    """A table: arrays of the same length by name. `to_pandas` makes a DataFrame of it."""

    __slots__ = ("_arrays", "_units")

    def __init__(self, arrays: Mapping[str, npt.NDArray[Any]], units: Mapping[str, str] | None = None) -> None:
        self._arrays = dict(arrays)
        self._units = dict(units or {})

    @property
    def units(self) -> dict[str, str]:
        """The units of the columns that have one."""
        return dict(self._units)

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        return self._arrays[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(next(iter(self._arrays.values()), ()))

    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """A dict of arrays."""
        return dict(self._arrays)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame``; its ``attrs`` have the ``units``."""
        frame = need("pandas", "to_pandas", "pandas").DataFrame(self._arrays)
        frame.attrs["units"] = self.units
        return frame

    def __repr__(self) -> str:
        return f"<DataTable of {self.rows} rows: {', '.join(self._arrays)}>"

    def _repr_html_(self) -> str:
        header = [f"{name} ({self._units[name]})" if self._units.get(name) else name for name in self._arrays]
        count = self.rows
        # As many as are shown.
        places = range(count) if count <= 10 else [*range(5), *range(count - 6, count)]
        rows = [[array[place] for array in self._arrays.values()] for place in places]
        return _html.page(f"{count} rows", [_html.table(header, rows)])


class _Base:
    """What results of wedges and of half-trucks share."""

    __slots__ = ("_columns", "_native", "_places", "_summary")

    _native: NativeResult

    def __init__(self, native: NativeResult) -> None:
        self._native = native
        self._columns: list[Any] | None = None
        self._places: dict[str, tuple[int, str]] = {}
        self._summary: Record | None = None

    def _described(self) -> list[Any]:
        """Columns as the native part has them; names with units are noted with their system on the way."""
        if self._columns is None:
            columns = self._native.columns()
            for place, (name, _, _, _, _, us, si) in enumerate(columns):
                for system, (_, suffix, _) in (("us", us), ("si", si)):
                    if suffix:
                        self._places.setdefault(f"{name}_{suffix}", (place, system))
            # Bare names win.
            for place, column in enumerate(columns):
                self._places[column[0]] = (place, "si")
            self._columns = columns
        return self._columns

    @property
    def columns(self) -> dict[str, Column]:
        """The columns by their names, in the order of ``result.csv``."""
        return {
            name: Column(name, kind, si[0], frame, reference, text)
            for name, kind, frame, reference, text, _, si in self._described()
        }

    @property
    def units(self) -> str:
        """Units of the summary, of figures and of files: ``us`` or ``si``."""
        return self._native.units

    def _place(self, name: str) -> tuple[int, str]:
        self._described()
        try:
            return self._places[name]
        except (KeyError, TypeError):
            import difflib

            near = difflib.get_close_matches(str(name), self._places, n=1)
            hint = f"did you mean {near[0]}?" if near else "result.columns lists all"
            raise UnknownColumn(f"there is no column {name!r}; {hint}") from None

    def __getitem__(self, name: str) -> Floats:
        """A column: under its bare name in SI units, under its name in a file (``wedge_z_in``) in that unit."""
        place, system = self._place(name)
        return self._native.values(place, self._described()[place][5 if system == "us" else 6][2])

    def __contains__(self, name: object) -> bool:
        self._described()
        return name in self._places

    def __iter__(self) -> Iterator[str]:
        return (column[0] for column in self._described())

    def __len__(self) -> int:
        """Number of columns."""
        return len(self._described())

    @property
    def rows(self) -> int:
        """Number of rows."""
        return self._native.rows

    def keys(self) -> list[str]:
        """Names of the columns, without units."""
        return list(self)

    def array(self, name: str, units: str | None = None) -> tuple[Floats, str]:
        """A column by its bare name, and its unit: in ``"us"`` or ``"si"`` units, by default those of the summary.

        ``units`` may also be a unit of the column's kind: ``result.array("wedge_z", "mm")``.
        """
        place, _ = self._place(name)
        column = self._described()[place]
        chosen = units or self.units
        if chosen in ("us", "si") or not isinstance(chosen, str):
            label, _, factor = column[_system(chosen)]
            return self._native.values(place, factor), label
        own = column[6][0]
        if not own:
            raise UnitError(f"{column[0]} is a number without unit; it has no value in {chosen}")
        return self._native.values(place, Quantity(1.0, own).to(chosen)), chosen

    def label(self, name: str, units: str | None = None) -> str:
        """A column's name in words with its unit, as axes have it."""
        place, _ = self._place(name)
        column = self._described()[place]
        unit = column[_system(units or self.units)][0]
        words = str(column[0]).replace("_", " ")
        return f"{words} ({unit})" if unit else words

    def to_dict(self, units: str | None = None) -> dict[str, Floats]:
        """All columns by their names with units, as in ``result.csv``; ``"us"`` or ``"si"``, by default those of the summary."""
        system = _system(units or self.units)
        columns = enumerate(self._described())
        factors = (self._native.values(place, column[system][2]) for place, column in columns)
        return dict(zip(self.to_names(units), factors))

    def to_names(self, units: str | None = None) -> list[str]:
        """The names of all columns with units, as in ``result.csv``; ``"us"`` or ``"si"``, by default those of the summary."""
        system = _system(units or self.units)
        return [f"{column[0]}_{column[system][1]}" if column[system][1] else column[0] for column in self._described()]

    def to_pandas(self, units: str | None = None) -> Any:
        """A ``pandas.DataFrame`` of `to_dict`, with the time as its index.

        Its ``attrs`` have the ``name`` and ``title`` of the run, and the ``units`` and ``descriptions`` of the columns by their names.
        """
        frame = need("pandas", "to_pandas", "pandas").DataFrame(self.to_dict(units))
        frame = frame.set_index("time_s") if "time_s" in frame else frame
        system = _system(units or self.units)
        frame.attrs["name"], frame.attrs["title"] = self.summary.name, self.summary.title
        pairs = list(zip(self.to_names(units), self._described()))
        frame.attrs["units"] = {name: column[system][0] for name, column in pairs}
        frame.attrs["descriptions"] = {name: column[4] for name, column in pairs}
        return frame

    def to_xarray(self, units: str | None = None) -> Any:
        """A ``xarray.Dataset`` over ``time``, with unit and description of each variable as attributes.

        As everywhere, bare names are in SI units: without ``units`` variables have bare names and SI units; with ``"us"`` or ``"si"``
        they are in these, under the names that say so, as in `to_dict`.
        """
        xarray = need("xarray", "to_xarray", "xarray")
        system = _system(units or "si")
        names = list(self) if units is None else self.to_names(units)
        variables = {}
        for place, column in enumerate(self._described()):
            label, _, factor = column[system]
            attributes = {"units": label, "long_name": column[4], "frame": column[2], "reference_point": column[3]}
            dimension = "time" if "time" in self else "row"
            kept = {key: value for key, value in attributes.items() if value}
            variables["time" if column[0] == "time" else names[place]] = (dimension, self._native.values(place, factor), kept)
        time = variables.pop("time", None)
        coordinates = {} if time is None else {"time": time}
        attributes = {"name": self.summary.name, "title": self.summary.title, "units": units or "si"}
        return xarray.Dataset(variables, coords=coordinates, attrs=attributes)

    @property
    def summary(self) -> Record:
        """What ``summary.json`` holds: averages, extremes, ledger, statistics, assumptions; with attributes for keys."""
        if self._summary is None:
            self._summary = Record(self._native.summary())
        return self._summary

    @property
    def assumptions(self) -> list[str]:
        """What the numbers rest on."""
        return list(self.summary.assumptions)

    @property
    def warnings(self) -> list[str]:
        """What makes the numbers doubtful; empty for a sound run."""
        return list(self.summary.warnings)

    @property
    def outcome(self) -> str:
        """How the run ended: ``complete``, ``derailed``, ``stopped`` or ``failed``."""
        return self._native.outcome

    @property
    def is_complete(self) -> bool:
        """Whether the run came to its end and its energy ledger closes to 1e-2."""
        return self.outcome == "complete"

    @property
    def derailed(self) -> tuple[float, str] | None:
        """When (s) and how a wheel left its rail, if one did; the run ends there, and all its numbers are of the part until then."""
        return self._native.derailed

    @property
    def stopped(self) -> tuple[float, str] | None:
        """When (s) and why the run stopped, if it could not go on; all its numbers are of the part until then."""
        return self._native.stopped

    @property
    def failed(self) -> str | None:
        """Why the numbers are not to be used although the run came to its end: its energy ledger does not close to 1e-2."""
        return self._native.failed

    def _energies(self) -> DataTable:
        names = ["time"] if "time" in self else []
        names += [column[0] for column in self._described() if column[1] == "energy"]
        return DataTable({name: self[name] for name in names}, {name: self.columns[name].unit for name in names})

    @property
    def ledger_history(self) -> DataTable:
        """The energy ledger over time, J: stored energies, works, losses, and the residual."""
        return self._energies()

    def _loop(self, ax: Axes | None, over: str, column: str, options: dict[str, Any]) -> Axes:
        if ax is None:
            ax = need("matplotlib.pyplot", "plotting", "plot").figure(layout="constrained").add_subplot()
        options.setdefault("label", self.summary.name)
        ax.plot(self.array(over)[0], self.array(column)[0], **options)
        ax.set_xlabel(self.label(over))
        ax.set_ylabel(self.label(column))
        return ax

    def __repr__(self) -> str:
        how = "" if self.is_complete else f", {self.outcome}"
        return f"<{type(self).__name__} of {self.summary.name}: {self.rows} rows, {len(self)} columns{how}>"

    def _repr_html_(self) -> str:
        columns = ((name, own.unit, own.text) for name, own in self.columns.items())
        how = "" if self.is_complete else f", {self.outcome}"
        title = f"{self.summary.name}: {self.summary.title}" if self.summary.title else self.summary.name
        note = "Bare names are in SI units; assumptions and summary say what the numbers rest on."
        texts = [_html.table(("column", "unit", "what it is"), list(columns), most=30)]
        told = [] if self.is_complete else [f"The run {self._native.told}"]
        warned = "".join(f"<p>Warning: {_html.escape(text)}</p>" for text in [*told, *self.warnings])
        return _html.page(f"{title} ({self.rows} rows, {len(self)} columns{how})", [warned, *texts], note)


class _OfCase(_Base):
    """What results of wedges, trucks, cars and vehicles share: a case file that makes them again."""

    __slots__ = ()

    def write(self, folder: str | os.PathLike[str], *, force: bool = False) -> list[str]:
        """Writes what ``wedgelab run`` writes into a folder: result.csv, result.mat, case.toml, summary.json.

        Of a car the tables are those of ``output.tables`` in its case: result.parquet and a short result.csv. Existing results are
        overwritten only with ``force``.
        """
        return self._native.write(folder, force)

    def _case_text(self) -> str | None:
        own = self._native
        native = own.case or own.truck_case or own.car_case or own.vehicle_case
        return None if native is None else native.to_toml()

    def __reduce__(self) -> tuple[Any, ...]:
        return (_result_of_parts, (self._native.model, self._case_text(), *self._native.parts()))


class UnknownColumn(WedgelabError, KeyError):
    """There is no column of this name."""


def _ledger_table(entries: Mapping[str, Any]) -> DataTable:
    return DataTable(
        {
            "entry": np.array(list(entries)),
            "value": np.array([measure.value for measure in entries.values()], dtype=float),
            "unit": np.array([measure.unit for measure in entries.values()]),
        }
    )


def _system(units: str) -> int:
    """The place of a system of units in a native column."""
    try:
        return {"us": 5, "si": 6}[units]
    except (KeyError, TypeError):
        raise WedgelabError(f'units cannot be {units!r}; write "us" or "si"') from None


class Result(_OfCase):
    """What came out of a case's run.

    ``result["wedge_z"]`` is an array in SI units, ``result["wedge_z_in"]`` the same in inches; `columns` says what there is.
    """

    __slots__ = ()

    @property
    def case(self) -> Case:
        """The case that was run."""
        from .case import Case

        native = self._native.case
        if native is None:
            raise WedgelabError("this result has no case")
        return Case._of(native)

    @property
    def events(self) -> DataTable:
        """Changes of contact states: time (s), face, corner, from, to. The first 500; ``summary.events.total`` counts all."""
        listed = self.summary.events.listed
        columns = {"time": float, "face": str, "corner": str, "from": str, "to": str}
        arrays: dict[str, npt.NDArray[Any]] = {name: np.array([event[name] for event in listed], dtype=kind) for name, kind in columns.items()}
        return DataTable(arrays, {"time": "s"})

    @property
    def ledger(self) -> DataTable:
        """The energy ledger at the end, in the summary's units: entry, value, unit."""
        ledger = self.summary.ledger
        entries = {"stored_at_start": ledger.stored_at_start, **ledger.entries}
        return _ledger_table(entries)

    def figures(self) -> dict[str, Figure]:
        """The report's figures of this run by their names."""
        from ._wedgelab import run_figures

        return _figures(run_figures(self._native))

    def plot_hysteresis(
        self,
        ax: Axes | None = None,
        *,
        column: str = "vertical_wedge_force",
        over: str = "bolster_vertical",
        **options: Any,
    ) -> Axes:
        """Draws a column over another, by default the loop of the wedge's vertical force over the bolster's travel.

        In the units of the summary. ``options`` go to Matplotlib's ``plot``. Gives the axes.
        """
        return self._loop(ax, over, column, options)


class HalfTruckResult(_Base):
    """What came out of a half-truck's run; columns and their units as in `Result`."""

    __slots__ = ()

    @property
    def ledger(self) -> DataTable:
        """The energy ledger at the end, in the summary's units: entry, value, unit."""
        entries = self.summary.ledger
        return _ledger_table(entries)

    def plot_hysteresis(
        self, wedge: int | None = None, ax: Axes | None = None, *, over: str = "input_vertical", **options: Any
    ) -> Axes:
        """Draws the column friction of a wedge (by its number in the file; without it, the first) over the input's travel."""
        number = next(iter(self.summary.wedges)) if wedge is None else wedge
        options.setdefault("label", f"{self.summary.name}, wedge {number}")
        return self._loop(ax, over, f"wedge_{number}_column_friction", options)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_half_truck_of_parts, self._native.parts())


class TruckResult(_OfCase):
    """What came out of a truck's run; columns and their units as in `Result`."""

    __slots__ = ()

    @property
    def ledger(self) -> DataTable:
        """The energy ledger at the end, in the summary's units: entry, value, unit."""
        entries = self.summary.ledger.entries
        return _ledger_table(entries)

    def plot_warp(self, ax: Axes | None = None, *, column: str = "warp_moment", **options: Any) -> Axes:
        """Draws the warp moment on the bolster, or another column, over the warp angle; gives the axes."""
        return self._loop(ax, "warp_angle", column, options)


class CarResult(_OfCase):
    """What came out of a car's run; columns and their units as in `Result`."""

    __slots__ = ()

    @property
    def ledger(self) -> DataTable:
        """The energy ledger at the end, in the summary's units: entry, value, unit."""
        entries = self.summary.ledger.entries
        return _ledger_table(entries)

    def plot_over_distance(self, column: str, ax: Axes | None = None, **options: Any) -> Axes:
        """Draws a column over the distance along the track; gives the axes."""
        return self._loop(ax, "distance", column, options)


class VehicleResult(_OfCase):
    """What came out of a vehicle's run; columns and their units as in `Result`."""

    __slots__ = ()

    @property
    def ledger(self) -> DataTable:
        """The energy ledger at the end, in the summary's units: entry, value, unit."""
        return _ledger_table(self.summary.ledger.entries)


AnyResult = Union[Result, HalfTruckResult, TruckResult, CarResult, VehicleResult]


def result_of(native: NativeResult) -> AnyResult:
    """The result of a run of any model."""
    kinds: dict[str, type[AnyResult]] = {
        "wedge": Result,
        "half_truck": HalfTruckResult,
        "truck": TruckResult,
        "car": CarResult,
        "vehicle": VehicleResult,
    }
    return kinds[native.model](native)


_CASES: dict[
    str, type[NativeCase] | type[NativeTruckCase] | type[NativeCarCase] | type[NativeVehicleCase]
] = {
    "wedge": NativeCase,
    "truck": NativeTruckCase,
    "car": NativeCarCase,
    "vehicle": NativeVehicleCase,
}


def _result_of_parts(model: str, case: str | None, header: bytes, values: Floats) -> AnyResult:
    if case is None:
        raise WedgelabError("this saved result has no case")
    native = _CASES[model].parse(case, "case.toml", "", {})
    return result_of(native.result_of_parts(header, values))


def _half_truck_of_parts(header: bytes, values: Floats) -> HalfTruckResult:
    return HalfTruckResult(NativeResult.half_truck_of_parts(header, values))


def checked(result: Any, incomplete: str) -> Any:
    """The result, or, if it is incomplete or has failed and that is not wanted, an exception that has it."""
    if incomplete not in ("raise", "keep"):
        raise WedgelabError(f'incomplete cannot be {incomplete!r}; write "raise" or "keep"')
    if incomplete == "keep" or result.is_complete:
        warn(result, stacklevel=4)
        return result
    raise unsound_error(result)


def warn(result: Any, stacklevel: int) -> None:
    """Warns of an energy ledger that does not close, and of what is implausible."""
    for text in result._native.energy_warnings:
        warnings.warn(f"{result.summary.name}: {text}", EnergyWarning, stacklevel=stacklevel)
    for text in result._native.implausible:
        warnings.warn(f"{result.summary.name}: {text}", PlausibilityWarning, stacklevel=stacklevel)


def unsound_error(result: Any) -> RunError:
    """Why a result is not complete."""
    message = f"the run {result.summary.name} {result._native.told}"
    advice = {
        "failed": "the exception's `result` has what was computed; do not use its numbers",
        "derailed": "the exception's `result` has what was computed until then",
        "stopped": "the exception's `result` has what was computed until then; values far from the thesis's are the first suspects: try "
        "a softer contact.stiffness, a larger friction.reference_speed, another simulation.relative_tolerance",
    }[result.outcome]
    return RunError(message, f"  × {message}\n  help: {advice}", result)
