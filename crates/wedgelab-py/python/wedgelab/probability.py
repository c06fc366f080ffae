"""Probabilities to lie beyond a limit, as ``wedgelab probability`` estimates them (``docs/probability.md``)."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from ._wedgelab import NativePlan, NativePlanRuns
from .many import Progress, _teller, _workers
from .study import PathLike

__all__ = ["Probability", "ProbabilityOutcome"]


@dataclass(frozen=True)
class ProbabilityOutcome:
    """What came out of a plan."""

    folder: Path
    """Where it is."""
    summary: Path
    """All of it as JSON."""
    table: Path
    """All runs as CSV."""
    probability: tuple[float, float]
    """The probability: the least and the greatest by runs that have no value; most often both are the same."""
    bounds: tuple[float, float]
    """The confidence bounds."""
    confidence: float
    """The confidence."""
    runs: int
    """Number of runs."""
    before: int
    """How many of them were there before."""
    beyond: int
    """Number of runs beyond the limit."""
    unknown: int
    """Number of runs of which it is not known."""
    warnings: tuple[str, ...]
    """What makes the result doubtful."""


class Probability:
    """A plan: a case, its uncertain parameters with a distribution and a mark each, a measure with its limit, and a method."""

    def __init__(self, path: PathLike) -> None:
        """Reads a plan; a mistake in it is a ``CaseError`` that shows where."""
        self._native = NativePlan(Path(path).absolute())

    def __repr__(self) -> str:
        return f"<Probability {self.name!r}: up to {self.most} runs>"

    @property
    def name(self) -> str:
        """Its name."""
        return self._native.name

    @property
    def title(self) -> str:
        """One line for people; may be empty."""
        return self._native.title

    @property
    def most(self) -> int:
        """The greatest number of runs."""
        return self._native.most

    def run(
        self, folder: PathLike | None = None, *, jobs: int | None = None, progress: Progress = False
    ) -> ProbabilityOutcome:
        """Runs what the folder lacks (by default ``NAME_probability``) on ``jobs`` threads, then writes the result.

        The folder is that of ``wedgelab probability``: what the command began goes on here, and the other way round. Ctrl-C ends this call
        after the runs under way, which are kept. ``progress`` as in ``run_many``, of the greatest number of runs.
        """
        with self._opened(folder) as (runs, path):
            before = runs.kept()
            tell = _teller(progress, self.most)
            while runs.more():
                done = runs.kept()
                runs.compute(_workers(jobs), None if tell is None else lambda now: tell(done + now))
            return self._finished(runs, path, before)

    @contextmanager
    def _opened(self, folder: PathLike | None) -> Iterator[tuple[NativePlanRuns, Path]]:
        path = Path(f"{self.name}_probability" if folder is None else folder)
        runs = NativePlanRuns(self._native, path)
        try:
            yield runs, path
        finally:
            runs.close()

    def _finished(self, runs: NativePlanRuns, path: Path, before: int) -> ProbabilityOutcome:
        runs.finish()
        told = json.loads((path / "probability.json").read_text(encoding="utf-8"))
        estimate = told["estimate"]
        return ProbabilityOutcome(
            folder=path,
            summary=path / "probability.json",
            table=path / "probability.csv",
            probability=(estimate["probability"]["low"], estimate["probability"]["high"]),
            bounds=(estimate["bounds"]["low"], estimate["bounds"]["high"]),
            confidence=estimate["confidence"],
            runs=runs.kept(),
            before=before,
            beyond=estimate["beyond"],
            unknown=estimate["unknown"],
            warnings=tuple(told["warnings"]),
        )
