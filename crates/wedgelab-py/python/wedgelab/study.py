"""Studies: many variants of a case, one row a run in a Parquet table, as ``wedgelab study`` makes it (``docs/study.md``)."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Union

from ._wedgelab import (
    NativeCarCase,
    NativeHalfTruckCase,
    NativeStudy,
    NativeStudyFolder,
    NativeTruckCase,
    NativeVehicleCase,
)
from .car import CarCase
from .case import Case
from .errors import StudyError
from .many import Progress, _teller, _workers
from .nucars import HalfTruckCase
from .truck import TruckCase
from .vehicle import VehicleCase

__all__ = ["Study", "StudyColumn", "StudyOutcome"]

PathLike = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class StudyColumn:
    """A column of a study's table."""

    name: str
    """Its name, with its unit."""
    unit: str
    """Its unit; empty for pure numbers and texts."""
    text: str
    """What it is."""
    kind: str
    """``number``, ``integer`` or ``text``."""


@dataclass(frozen=True)
class StudyOutcome:
    """What came out of a study."""

    folder: Path
    """Where it is."""
    table: Path
    """The Parquet table."""
    csv: Path
    """The same table as text."""
    page: Path
    """The summary page."""
    runs: int
    """Number of runs."""
    before: int
    """How many of them were there before."""
    complete: int
    """How many came to their end."""
    refused: int
    """How many have values that make no run."""
    stopped: int
    """How many stopped on their way."""
    failed: int
    """How many came to their end, but their energy ledger does not close to 1e-2; their measures are in the table."""
    derailed: int
    """How many derailed, where they ended; their measures in the table are of the part until then."""
    reasons: Mapping[int, str]
    """Why, of the first ones that are not complete, by their numbers."""
    warnings: list[str]
    """What makes complete runs doubtful: energy ledgers that do not close to 1e-3."""


class Study:
    """A study file: a case and its variants, numbered from 0. Which values a variant has depends on the file and its number alone."""

    def __init__(self, path: PathLike) -> None:
        """Reads a study file; a mistake in it is a ``CaseError`` that shows where."""
        self._native: NativeStudy = NativeStudy.read(Path(path).absolute())

    @classmethod
    def _of(cls, native: NativeStudy) -> Study:
        study = cls.__new__(cls)
        study._native = native
        return study

    def __reduce__(self) -> tuple[Any, ...]:
        return (_loaded, (self._native.saved(),))

    def __repr__(self) -> str:
        return f"<Study {self.name!r}: {self.count} runs>"

    def __len__(self) -> int:
        return self.count

    @property
    def name(self) -> str:
        """Its name, which is that of its folder."""
        return self._native.name

    @property
    def title(self) -> str:
        """One line for people; may be empty."""
        return self._native.title

    @property
    def count(self) -> int:
        """Number of variants."""
        return self._native.count

    @property
    def parameters(self) -> list[str]:
        """What is varied, by path."""
        return [paths[0] for paths in self._native.parameters()]

    @property
    def columns(self) -> Mapping[str, StudyColumn]:
        """The columns of the table, by name."""
        columns = (StudyColumn(*column) for column in self._native.columns())
        return MappingProxyType({column.name: column for column in columns})

    def values(self, number: int) -> dict[str, str]:
        """What is varied in a variant, by path, as a case file shows it."""
        return dict(self._native.values(self._number(number)))

    def case(self, number: int) -> Case | HalfTruckCase | TruckCase | CarCase | VehicleCase:
        """The case of a variant, for example to run it with its time series: ``study.case(17).run()``."""
        native = self._native.case(self._number(number))
        if isinstance(native, NativeHalfTruckCase):
            return HalfTruckCase._of(native)
        if isinstance(native, NativeCarCase):
            return CarCase._of(native)
        if isinstance(native, NativeVehicleCase):
            return VehicleCase._of(native)
        return TruckCase._of(native) if isinstance(native, NativeTruckCase) else Case._of(native)

    def run(
        self,
        folder: PathLike | None = None,
        *,
        jobs: int | None = None,
        progress: Progress = False,
        yes: bool = False,
    ) -> StudyOutcome:
        """Runs what the folder lacks (by default one with the study's name) on ``jobs`` threads, then makes its table and page.

        The folder is that of ``wedgelab study``: what the command began goes on here, and the other way round. Every run is kept as soon
        as it is done; Ctrl-C ends this call after the runs under way. ``progress`` as in ``run_many``. Studies of more than a million
        runs need ``yes=True``.
        """
        with opened(self, folder, yes) as (native, path):
            before, _ = native.begun()
            tell = _teller(progress, self.count)
            native.compute(_workers(jobs), None if tell is None else lambda now: tell(before + now))
            return finished(self, native, path, before)

    def _number(self, number: int) -> int:
        if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < self.count:
            raise StudyError(f"there is no run {number!r}: runs of this study are numbered from 0 to {self.count - 1}")
        return number


def _loaded(saved: bytes) -> Study:
    return Study._of(NativeStudy.load(saved))


@contextmanager
def opened(study: Study, folder: PathLike | None, yes: bool) -> Iterator[tuple[NativeStudyFolder, Path]]:
    """The folder of a study, held while the block runs."""
    if study._native.is_large and not yes:
        message = f"the study has {study.count} runs"
        help_text = "give yes=True if you mean it, or vary fewer values"
        raise StudyError(message, f"  × {message}\n  help: {help_text}")
    path = Path(study.name if folder is None else folder)
    native = NativeStudyFolder(study._native, path)
    try:
        yield native, path
    finally:
        native.close()


def finished(study: Study, native: NativeStudyFolder, path: Path, before: int) -> StudyOutcome:
    """Makes table and page of a study all of whose runs are kept."""
    (complete, refused, stopped, failed, derailed), reasons, warning = native.finish()
    return StudyOutcome(
        folder=path,
        table=path / "table.parquet",
        csv=path / "table.csv",
        page=path / "index.html",
        runs=study.count,
        before=before,
        complete=complete,
        refused=refused,
        stopped=stopped,
        failed=failed,
        derailed=derailed,
        reasons=MappingProxyType(dict(reasons)),
        warnings=[] if warning is None else [warning],
    )
