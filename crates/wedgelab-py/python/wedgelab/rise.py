"""Surveys of wedge rise: the rise at which a car reaches each limit, as ``wedgelab rise`` finds it (``docs/rise.md``)."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ._wedgelab import NativeRise, NativeRiseRuns
from .errors import CaseError
from .many import Progress, _teller, _workers
from .study import PathLike

__all__ = ["RiseAnswer", "RiseOutcome", "RiseSurvey"]


@dataclass(frozen=True)
class RiseAnswer:
    """The wedge rise at which a limit is reached in a regime and a condition."""

    regime: str
    """The regime."""
    condition: str
    """The condition; ``as_given``: the car as its case says."""
    limit: str
    """The limit's name."""
    quantity: str
    """What is limited, in words."""
    kept_up_to_in: float | None
    """The highest rise that was looked at and keeps it below the first that does not, in; ``None``: it is not kept without rise."""
    exceeded_from_in: float | None
    """The lowest rise that was looked at and does not keep it, in; ``None``: it is kept up to the highest."""
    mph: float
    """The speed at which it is reached first, or at which least is left."""
    answer: str
    """The same in words."""
    mark: str | None
    """Where the limit is from: ``source``, ``derived``, ``remembered``, ``guess``; ``None`` where its file does not say."""
    runs_without_value: tuple[str, ...]
    """Runs that have no value of it, by name."""


@dataclass(frozen=True)
class RiseOutcome:
    """What came out of a survey of wedge rise."""

    folder: Path
    """Where it is."""
    page: Path
    """The page of the answers, for an inspection; the page of the method, ``method.html``, stands beside it."""
    table: Path
    """The answers as CSV; all runs are in ``runs.csv`` beside it."""
    runs: int
    """Number of runs."""
    before: int
    """How many runs and rigs were there before."""
    answers: tuple[RiseAnswer, ...]
    """The answers."""
    left_to_look_at: tuple[str, ...]
    """What no run was left for."""


class RiseSurvey:
    """A car in regimes over wedge rise and speed, and in other conditions, beside limits.

    ``car`` is the name of a built-in car or the path of a case file; ``regimes`` are names or files (by default rocking, bouncing, curves and
    hunting), ``limits`` a name or a file, ``to`` the highest rise, a text with a unit (by default 1.25 in, or what the pockets hold); ``factors``
    are names or files of other conditions (by default two of each factor, ``[]``: none); ``runs`` is the greatest number of runs of cars, ``full``
    runs the car itself at all rises and all speeds, and ``set`` are values over the car's case as ``--set`` takes them.
    """

    def __init__(
        self,
        car: PathLike,
        *,
        regimes: Iterable[str] = (),
        limits: str = "aar_chapter_xi",
        to: str | None = None,
        factors: Iterable[str] | None = None,
        runs: int = 200,
        full: bool = False,
        set: Iterable[str] = (),
    ) -> None:
        """Reads what is named; a mistake in it is a ``CaseError`` that shows where."""
        if isinstance(runs, bool) or not isinstance(runs, int) or runs < 1:
            raise CaseError(f"runs is {runs!r}; a whole number, 1 or more, is expected")
        chosen = None if factors is None else list(factors)
        self._native = NativeRise(Path(car), list(set), list(regimes), limits, to, chosen, runs, full)

    def __repr__(self) -> str:
        return f"<RiseSurvey of {self._native.car!r}: up to {self.most} runs of {self._native.run_time:.0f} s>"

    @property
    def most(self) -> int:
        """The greatest number of runs, with those of the truck alone."""
        return self._native.most

    def run(
        self, folder: PathLike | None = None, *, jobs: int | None = None, progress: Progress = False
    ) -> RiseOutcome:
        """Runs what the folder lacks (by default ``NAME_rise``) on ``jobs`` threads, then writes the answers.

        The folder is that of ``wedgelab rise``: what the command began goes on here, and the other way round. Ctrl-C ends this call after
        the runs under way, which are kept. ``progress`` as in ``run_many``, of the greatest number of runs.
        """
        runs, path = self._opened(folder)
        tell = _teller(progress, self.most)
        done = 0
        while runs.more():
            before = done
            done += runs.compute(_workers(jobs), None if tell is None else lambda now: tell(before + now))
        return self._finished(runs, path)

    def _opened(self, folder: PathLike | None) -> tuple[NativeRiseRuns, Path]:
        path = Path(f"{self._native.car}_rise" if folder is None else folder)
        return NativeRiseRuns(self._native, path), path

    def _finished(self, runs: NativeRiseRuns, path: Path) -> RiseOutcome:
        before = runs.finish()
        told = json.loads((path / "rise.json").read_text(encoding="utf-8"))
        return RiseOutcome(
            folder=path,
            page=path / "index.html",
            table=path / "rise.csv",
            runs=told["runs"],
            before=before,
            answers=tuple(_answer(own) for own in told["answers"]),
            left_to_look_at=tuple(told["left_to_look_at"]),
        )


def _answer(own: dict[str, Any]) -> RiseAnswer:
    """An answer as ``rise.json`` has it."""
    rise = {name: (own["bracket"][name] or {}).get("in") for name in ("kept_up_to", "exceeded_from")}
    return RiseAnswer(
        regime=own["regime"],
        condition=own["condition"],
        limit=own["limit"],
        quantity=own["quantity"],
        kept_up_to_in=rise["kept_up_to"],
        exceeded_from_in=rise["exceeded_from"],
        mph=own["mph"],
        answer=own["answer"],
        mark=own["limit_mark"],
        runs_without_value=tuple(own["runs_without_value"]),
    )
