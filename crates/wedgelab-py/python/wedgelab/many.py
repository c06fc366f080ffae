"""Many runs at a time."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable
from typing import Any, TextIO, Union, overload

from ._wedgelab import NativeCarCase, NativeCase, NativeHalfTruckCase, NativeTruckCase, NativeVehicleCase
from ._wedgelab import run_many as _run_many
from .car import CarCase
from .case import Case, _names
from .errors import RunError, WedgelabError
from .nucars import HalfTruckCase
from .result import (
    AnyResult,
    CarResult,
    HalfTruckResult,
    Result,
    TruckResult,
    VehicleResult,
    result_of,
    unsound_error,
    warn,
)
from .truck import TruckCase
from .vehicle import VehicleCase

__all__ = ["run_many"]

Progress = Union[bool, Callable[[int, int], object]]


@overload
def run_many(
    cases: Iterable[Case],
    *,
    workers: int | None = None,
    columns: Iterable[str] | None = None,
    progress: Progress = False,
    errors: str = "raise",
) -> list[Result]: ...
@overload
def run_many(
    cases: Iterable[HalfTruckCase],
    *,
    workers: int | None = None,
    columns: Iterable[str] | None = None,
    progress: Progress = False,
    errors: str = "raise",
) -> list[HalfTruckResult]: ...
@overload
def run_many(
    cases: Iterable[TruckCase],
    *,
    workers: int | None = None,
    columns: Iterable[str] | None = None,
    progress: Progress = False,
    errors: str = "raise",
) -> list[TruckResult]: ...
@overload
def run_many(
    cases: Iterable[CarCase],
    *,
    workers: int | None = None,
    columns: Iterable[str] | None = None,
    progress: Progress = False,
    errors: str = "raise",
) -> list[CarResult]: ...
@overload
def run_many(
    cases: Iterable[VehicleCase],
    *,
    workers: int | None = None,
    columns: Iterable[str] | None = None,
    progress: Progress = False,
    errors: str = "raise",
) -> list[VehicleResult]: ...
def run_many(
    cases: Iterable[Case] | Iterable[HalfTruckCase] | Iterable[TruckCase] | Iterable[CarCase] | Iterable[VehicleCase],
    *,
    workers: int | None = None,
    columns: Iterable[str] | None = None,
    progress: Progress = False,
    errors: str = "raise",
) -> Any:
    """Runs cases on all processors and gives their results in the order of the cases.

    The results do not depend on ``workers`` (by default, as many as there are processors). ``columns`` are the names
    (without units) of those that are kept; a result with all columns of a run of 10 s has a megabyte, and ``columns=[]`` keeps the
    summary only. ``progress=True`` writes to the standard error, on a terminal one line and elsewhere at most ten; a function is called with how many are done and how many there are. Ctrl-C
    stops all of them.

    Runs that are not complete: with ``errors="raise"`` all others are finished, then the first of them is raised, with everything
    that came out as its ``results``; with ``errors="keep"`` the list has the exceptions in their places.
    """
    natives: list[NativeCase | NativeHalfTruckCase | NativeTruckCase | NativeCarCase | NativeVehicleCase] = []
    for place, case in enumerate(cases):
        if not isinstance(case, (Case, HalfTruckCase, TruckCase, CarCase, VehicleCase)):
            kinds = "a Case, HalfTruckCase, TruckCase, CarCase or VehicleCase"
            raise WedgelabError(f"cases[{place}] is a {type(case).__name__}; {kinds} is expected")
        natives.append(case._native)
    count = _workers(workers)
    if errors not in ("raise", "keep"):
        raise WedgelabError(f'errors cannot be {errors!r}; write "raise" or "keep"')
    done = _run_many(natives, count, _names(columns), _teller(progress, len(natives)))
    results = [_finished(one) for one in done]
    failed = [one for one in results if isinstance(one, WedgelabError)]
    if failed and errors == "raise":
        if isinstance(failed[0], RunError):
            failed[0].results = results
        raise failed[0]
    return results


def _workers(workers: int | None) -> int:
    if workers is None:
        affinity = getattr(os, "sched_getaffinity", None)
        return len(affinity(0)) if affinity else os.cpu_count() or 1
    if isinstance(workers, bool) or not isinstance(workers, int) or workers < 1:
        raise WedgelabError(f"workers is {workers!r}; a whole number, 1 or more, is expected")
    return min(workers, 1024)


def _finished(one: Any) -> AnyResult | WedgelabError:
    if isinstance(one, WedgelabError):
        return one
    result: AnyResult = result_of(one)
    if not result.is_complete:
        return unsound_error(result)
    warn(result, stacklevel=4)
    return result


def _written(count: int, out: TextIO) -> Callable[[int], None]:
    """Writes how far it is: on a terminal one line that is written over, elsewhere (notebooks, logs) a line for each tenth."""
    if out.isatty():

        def over(done: int) -> None:
            end = "\n" if done == count else "\r"
            print(f"{done} of {count} runs", end=end, file=out, flush=True)

        return over
    told = 0

    def lines(done: int) -> None:
        nonlocal told
        tenth = 10 * done // max(count, 1)
        if tenth > told:
            told = tenth
            print(f"{done} of {count} runs", file=out, flush=True)

    return lines


def _teller(progress: Progress, count: int) -> Callable[[int], None] | None:
    if progress is False or progress is None:
        return None
    if progress is True:

        return _written(count, sys.stderr)
    if not callable(progress):
        raise WedgelabError(f"progress is {progress!r}; True, False or a function is expected")
    call = progress

    def tell(done: int) -> None:
        call(done, count)

    return tell
