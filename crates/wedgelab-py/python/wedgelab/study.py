"""Studies: many variants of a case, one row a run in a Parquet table, as ``wedgelab study`` makes it (``docs/study.md``)."""

from __future__ import annotations

import os
import time
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
from .storage import mirrored
from .truck import TruckCase
from .vehicle import VehicleCase

__all__ = ["Study", "StudyColumn", "StudyCost", "StudyOutcome"]

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


@dataclass(frozen=True)
class StudyCost:
    """What the runs of a study cost, judged by a sample of them."""

    runs: int
    """Number of runs."""
    sample: int
    """Number of runs of the sample."""
    seconds_per_run: float
    """Mean time of a run of the sample, s."""
    least: float
    """The least, s."""
    largest: float
    """The largest, s."""
    core_hours: float
    """Time of all runs on one core, h."""
    hours: float
    """Time of all runs on the threads that were asked for, h."""
    bytes: int
    """Space of all runs on the disk, about, bytes."""


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
        store: Any = None,
    ) -> StudyOutcome:
        """Runs what the folder lacks (by default one with the study's name) on ``jobs`` threads, then makes its table and page.

        The folder is that of ``wedgelab study``: what the command began goes on here, and the other way round. Every run is kept as soon
        as it is done; Ctrl-C ends this call after the runs under way. ``progress`` as in ``run_many``. Studies of more than a million
        runs need ``yes=True``. ``store`` is an address in object storage where the folder is mirrored, such as ``"s3://bucket/friction"``, or a
        store of the package obstore: runs that are there are not computed again, on whatever machine, and each part of the
        table appears there as a Parquet file. One process at a time works there.
        """
        with opened(self, folder, yes) as (native, path), mirrored(store, native, path) as send:
            before, _ = native.begun()
            tell = _teller(progress, self.count)

            def told(now: int) -> None:
                send()
                if tell is not None:
                    tell(before + now)

            native.compute(_workers(jobs), told)
            return finished(self, native, path, before)

    def cost(self, *, sample: int = 4, jobs: int | None = None) -> StudyCost:
        """Computes ``sample`` runs, spread over the study, one after the other, and judges by them what all runs cost on ``jobs`` threads.

        The runs are not kept. What else the machine does meanwhile counts; runs at a time slow each other down where they share caches.
        """
        if isinstance(sample, bool) or not isinstance(sample, int) or sample < 1:
            raise StudyError(f"sample is {sample!r}; a whole number, 1 or more, is expected")
        numbers = sorted({self.count * (2 * own + 1) // (2 * sample) for own in range(sample)})
        seconds: list[float] = []
        size = 0
        for number in numbers:
            start = time.perf_counter()
            size += len(self._native.records([number]))
            seconds.append(time.perf_counter() - start)
        mean = sum(seconds) / len(seconds)
        return StudyCost(
            runs=self.count,
            sample=len(numbers),
            seconds_per_run=mean,
            least=min(seconds),
            largest=max(seconds),
            core_hours=mean * self.count / 3600.0,
            hours=mean * self.count / 3600.0 / _workers(jobs),
            # A record, and a row of each table.
            bytes=3 * size * self.count // len(numbers),
        )

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
