"""Assessments: a car in the regimes of its assessment, beside limits, as ``wedgelab assess`` makes them (``docs/regimes.md``)."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ._wedgelab import NativeAssessment, NativeStudyFolder
from .many import Progress, _teller, _workers
from .study import PathLike, Study, opened

__all__ = ["Assessment", "AssessmentOutcome", "Verdict"]


@dataclass(frozen=True)
class Verdict:
    """How a limit is kept in a regime and a condition, over all speeds."""

    regime: str
    """The regime."""
    condition: str
    """The condition."""
    limit: str
    """The limit's name."""
    quantity: str
    """What is limited, in words."""
    verdict: str
    """``kept``, ``exceeded``, or ``unknown`` if a run has no numbers."""
    value: float | None
    """The worst value, in ``unit``."""
    limit_value: float | None
    """The limit for the worst run, in ``unit``: some depend on the car."""
    unit: str
    """Their unit; empty for pure numbers."""
    margin: float | None
    """What is left, in parts of the limit (of a least share, of the way from 100 %); negative where it is not kept."""
    speed: str | None
    """The speed of the worst run, with its unit."""
    run: int | None
    """The number of the worst run."""
    until_derailed: bool
    """Whether a wheel left its rail in the worst run: value and margin are of the part until then."""
    derailed: tuple[str, ...]
    """Speeds at which a wheel left its rail."""
    missing: tuple[str, ...]
    """Speeds of runs without numbers."""
    paragraph: str
    """The paragraph of the rule; may be empty."""
    mark: str | None
    """Where the limit is from: ``source``, ``derived``, ``remembered``, ``guess``; ``None`` where its file does not say."""
    friction: float | None
    """The friction of wheel on rail at which the limit is reached; ``None`` where it is not between those that were looked at."""
    turned_by: tuple[str, ...]
    """What would turn the verdict, of what was looked at: ``speeds``, ``start``, ``friction``."""


@dataclass(frozen=True)
class AssessmentOutcome:
    """What came out of an assessment."""

    folder: Path
    """Where it is."""
    page: Path
    """The page."""
    table: Path
    """A row each run and limit, as CSV; Parquet stands beside it."""
    runs: int
    """Number of runs."""
    before: int
    """How many of them were there before."""
    verdicts: tuple[Verdict, ...]
    """How each limit is kept."""
    kind: str
    """``certificate`` where all that a rule asks for is covered, read in its source, and kept; else ``assessment``."""
    no_certificate_because: tuple[str, ...]
    """Why it is no certificate."""


class Assessment:
    """A car in regimes, at speeds and in conditions, beside limits.

    ``car`` is the name of a built-in car or the path of a case file; ``regimes`` are names or files (by default all that are built in), ``speeds``
    texts such as ``"30 mph"`` (by default those of each regime), ``conditions`` names or a file, ``limits`` a name or a file, ``frictions``
    those of wheel on rail at which runs near limits are looked at again, and ``set`` values over the car's case as ``--set`` takes them.
    """

    def __init__(
        self,
        car: PathLike,
        *,
        regimes: Iterable[str] = (),
        speeds: Iterable[str] = (),
        conditions: Iterable[str] = (),
        limits: str = "aar_chapter_xi",
        frictions: Iterable[float] = (0.3, 0.5),
        set: Iterable[str] = (),
    ) -> None:
        """Reads what is named; a mistake in it is a ``CaseError`` that shows where."""
        self._native = NativeAssessment(
            Path(car), list(set), list(regimes), list(speeds), list(conditions), limits, list(frictions)
        )
        self.study: Study = Study._of(self._native.study())
        """Its runs."""

    def __repr__(self) -> str:
        return f"<Assessment of {self._native.car!r}: {self.study.count} runs>"

    def run(
        self, folder: PathLike | None = None, *, jobs: int | None = None, progress: Progress = False
    ) -> AssessmentOutcome:
        """Runs what the folder lacks (by default ``NAME_assessment``) on ``jobs`` threads, then makes its tables and page.

        What ``wedgelab assess`` began goes on here, and the other way round. Other arguments as in ``Study.run``.
        """
        with opened(self.study, self._folder(folder), False) as (native, path):
            before, _ = native.begun()
            tell = _teller(progress, self.study.count)
            native.compute(_workers(jobs), None if tell is None else lambda now: tell(before + now))
            return self._finished(native, path, before, jobs)

    def _folder(self, folder: PathLike | None) -> PathLike:
        return f"{self._native.car}_assessment" if folder is None else folder

    def _finished(
        self, native: NativeStudyFolder, path: Path, before: int, jobs: int | None
    ) -> AssessmentOutcome:
        self._native.finish(native, _workers(jobs))
        told = json.loads((path / "assessment.json").read_text(encoding="utf-8"))
        return AssessmentOutcome(
            folder=path,
            page=path / "index.html",
            table=path / "assessment.csv",
            runs=len(told["runs"]),
            before=before,
            verdicts=tuple(_verdict(own) for own in told["verdicts"]),
            kind=told["kind"],
            no_certificate_because=tuple(told["no_certificate_because"]),
        )


def _verdict(own: dict[str, Any]) -> Verdict:
    """A verdict as ``assessment.json`` has it."""
    worst = own["worst"] or {}
    return Verdict(
        regime=own["regime"],
        condition=own["condition"],
        limit=own["limit"],
        quantity=own["quantity"],
        verdict=own["verdict"],
        value=worst.get("value"),
        limit_value=own["limit_value"],
        unit=own["unit"],
        margin=worst.get("margin"),
        speed=worst.get("speed"),
        run=worst.get("run"),
        until_derailed=worst.get("until_derailed", False),
        derailed=tuple(own["derailed"]),
        missing=tuple(own["missing"]),
        paragraph=own["paragraph"],
        mark=own["mark"],
        friction=(own["friction"] or {}).get("reached"),
        turned_by=tuple(own["turned_by"]),
    )
