"""Studies, assessments, surveys and probabilities on the workers of a Dask cluster.

Workers compute runs and send their records; this process alone keeps them, in the folder that ``wedgelab study`` and ``Study.run`` use. So a
study goes on wherever it was begun, and its table has the same bytes. Workers may die and join while it runs: runs that
were under way on one that died are computed by others.
"""

from __future__ import annotations

import warnings

from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Any

from ._optional import need
from ._wedgelab import NativePlanRuns, NativeRiseRuns, NativeStudy, NativeStudyFolder, run_errand
from .assessment import Assessment, AssessmentOutcome
from .errors import StudyError
from .many import Progress, _teller, _workers
from .probability import Probability, ProbabilityOutcome
from .rise import RiseOutcome, RiseSurvey
from .storage import mirrored
from .study import PathLike, Study, StudyOutcome, finished, opened

__all__ = ["run_assessment", "run_probability", "run_rise", "run_study"]

DEATHS = 5
"""A batch on which workers died so often, as often as Dask itself tries it each time, is given up."""


def run_study(
    study: Study | PathLike,
    folder: PathLike | None = None,
    *,
    client: Any,
    batch: int = 16,
    progress: Progress = False,
    yes: bool = False,
    store: Any = None,
) -> StudyOutcome:
    """Runs what the folder of a study lacks on the workers of ``client`` (``dask.distributed.Client``), then makes its table and page.

    ``batch`` runs are one task: what a worker loses at most when it dies. The folder lies with this process; workers need the package ``wedgelab``
    of the same version, and tables in files of their own where this process finds them, but no other file. Without any worker it waits until
    one joins. What ends this process ends the study, which the same call continues. Other arguments as in ``Study.run``.
    """
    if not isinstance(study, Study):
        study = Study(study)
    distributed = _checked(client, batch)
    with opened(study, folder, yes) as (native, path), mirrored(store, native, path) as send:
        before = _compute(distributed, study, native, client, batch, progress, send)
        return finished(study, native, path, before)


def run_assessment(
    assessment: Assessment,
    folder: PathLike | None = None,
    *,
    client: Any,
    batch: int = 1,
    progress: Progress = False,
) -> AssessmentOutcome:
    """Runs what the folder of an assessment lacks on the workers of ``client``, then makes its tables and page in this process.

    As ``run_study``; what ``wedgelab assess`` or ``Assessment.run`` began goes on here, and the other way round, with the same bytes.
    """
    distributed = _checked(client, batch)
    with opened(assessment.study, assessment._folder(folder), False) as (native, path):
        before = _compute(distributed, assessment.study, native, client, batch, progress, lambda: None)
        return assessment._finished(native, path, before, None)


def _checked(client: Any, batch: int) -> Any:
    """The package ``distributed``, if what a caller gave can be worked with."""
    distributed = need("distributed", "wedgelab.cluster", "cluster")
    if isinstance(batch, bool) or not isinstance(batch, int) or batch < 1:
        raise StudyError(f"batch is {batch!r}; a whole number, 1 or more, is expected")
    if not isinstance(client, distributed.Client) or client.asynchronous:
        raise StudyError(f"client is {client!r}; a dask.distributed.Client that is not asynchronous is expected")
    return distributed


def run_rise(
    survey: RiseSurvey, folder: PathLike | None = None, *, client: Any, progress: Progress = False
) -> RiseOutcome:
    """Runs what the folder of a survey of wedge rise lacks on the workers of ``client``, then writes the answers.

    A run of a car is one task; those of the truck alone are computed in this process. Batches follow from the runs before them: at the end of one
    some workers wait. What ``wedgelab rise`` or ``RiseSurvey.run`` began goes on here, and the other way round, with the same bytes.
    """
    distributed = _checked(client, 1)
    runs, path = survey._opened(folder)
    tell = _teller(progress, survey.most)
    done = 0
    while count := runs.more():
        if runs.errand(0) is None:
            before = done
            done += runs.compute(_workers(None), None if tell is None else lambda now: tell(before + now))
            continue
        done = _errands(distributed, client, runs, count, done, tell)
    return survey._finished(runs, path)


def run_probability(
    plan: Probability | PathLike, folder: PathLike | None = None, *, client: Any, progress: Progress = False
) -> ProbabilityOutcome:
    """Runs what the folder of a plan lacks on the workers of ``client``, then writes the result.

    A run is one task. What ``wedgelab probability`` or ``Probability.run`` began goes on here, and the other way round, with the same bytes.
    """
    distributed = _checked(client, 1)
    if not isinstance(plan, Probability):
        plan = Probability(plan)
    with plan._opened(folder) as (runs, path):
        before = runs.kept()
        tell = _teller(progress, plan.most)
        while count := runs.more():
            _errands(distributed, client, runs, count, runs.kept(), tell)
        return plan._finished(runs, path, before)


def _errands(
    distributed: Any,
    client: Any,
    runs: NativeRiseRuns | NativePlanRuns,
    count: int,
    done: int,
    tell: Callable[[int], None] | None,
) -> int:
    """Has runs that do not wait for each other computed, and keeps them; how many runs are done then."""
    waiting = (([number], (runs.errand(number),)) for number in range(count))
    for [number], record in _worked(distributed, client, run_errand, waiting):
        runs.keep(number, record)
        done += 1
        if tell is not None:
            tell(done)
    return done


def _compute(
    distributed: Any,
    study: Study,
    native: NativeStudyFolder,
    client: Any,
    batch: int,
    progress: Progress,
    send: Callable[[], None],
) -> int:
    """Has all missing runs computed by the workers; how many were there before."""
    before, _ = native.begun()
    tell = _teller(progress, study.count)
    saved = study._native.saved()
    waiting = ((numbers, (saved, numbers)) for numbers in _batches(native, batch))
    done = before
    for _, records in _worked(distributed, client, _records, waiting):
        done += native.keep(records)
        send()
        if tell is not None:
            tell(done)
    return before


def _worked(
    distributed: Any, client: Any, work: Callable[..., bytes], waiting: Iterator[tuple[list[int], tuple[Any, ...]]]
) -> Iterator[tuple[list[int], bytes]]:
    """Has tasks computed by the workers: numbers of runs with the arguments of ``work``; the numbers with what came out, as it comes."""
    under_way: dict[Any, tuple[list[int], tuple[Any, ...], int]] = {}
    ended = distributed.as_completed()

    def send(numbers: list[int], arguments: tuple[Any, ...], deaths: int) -> None:
        # Not pure: a result is asked for once, and nobody keeps it for later.
        future = client.submit(work, *arguments, pure=False)
        under_way[future] = (numbers, arguments, deaths)
        ended.add(future)

    try:
        while True:
            # Enough for all workers and those that may join soon, and no more in memory, however many there are.
            room = 4 + 3 * sum(client.ncores().values())
            while len(under_way) < room and (task := next(waiting, None)) is not None:
                send(*task, 0)
            if not under_way:
                return
            future = next(ended)
            numbers, arguments, deaths = under_way.pop(future)
            try:
                records = future.result()
            except (distributed.KilledWorker, distributed.CancelledError) as error:
                if deaths + 1 >= DEATHS:
                    message = f"workers died again and again on the runs {numbers[0]} to {numbers[-1]}"
                    help_text = "look at the workers' memory and logs; all other runs that were done are kept, and the same call goes on"
                    raise StudyError(message, f"  × {message}\n  help: {help_text}") from error
                send(numbers, arguments, deaths + 1)
                continue
            yield numbers, records
    finally:
        client.cancel(list(under_way))


def _batches(native: NativeStudyFolder, size: int) -> Iterator[list[int]]:
    """The numbers of the runs that are missing, part by part."""
    for part in range(native.parts):
        missing = native.missing(part)
        for start in range(0, len(missing), size):
            yield missing[start : start + size]


@lru_cache(maxsize=4)
def _study(saved: bytes) -> NativeStudy:
    return NativeStudy.load(saved)


def _records(saved: bytes, numbers: list[int]) -> bytes:
    """What a worker does."""
    return _study(saved).records(numbers)


def __getattr__(name: str) -> object:
    """The older name of ``run_assessment``, which goes with the next version."""
    if name != "run_certificate":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    warnings.warn(
        "wedgelab.cluster.run_certificate is called run_assessment now", DeprecationWarning, stacklevel=2
    )
    return run_assessment
