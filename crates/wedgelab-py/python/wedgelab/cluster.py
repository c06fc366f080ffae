"""Studies on the workers of a Dask cluster.

Workers compute runs and send their records; this process alone keeps them, in the folder that ``wedgelab study`` and ``Study.run`` use. So a
study goes on wherever it was begun, and its table has the same bytes. Workers may die and join while it runs: runs that
were under way on one that died are computed by others.
"""

from __future__ import annotations

import warnings

from collections.abc import Iterator
from functools import lru_cache
from typing import Any

from ._optional import need
from ._wedgelab import NativeStudy, NativeStudyFolder
from .assessment import Assessment, AssessmentOutcome
from .errors import StudyError
from .many import Progress, _teller
from .study import PathLike, Study, StudyOutcome, finished, opened

__all__ = ["run_assessment", "run_study"]

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
) -> StudyOutcome:
    """Runs what the folder of a study lacks on the workers of ``client`` (``dask.distributed.Client``), then makes its table and page.

    ``batch`` runs are one task: what a worker loses at most when it dies. The folder lies with this process; workers need the package ``wedgelab``
    of the same version, and tables in files of their own where this process finds them, but no other file. Without any worker it waits until
    one joins. What ends this process ends the study, which the same call continues. Other arguments as in ``Study.run``.
    """
    if not isinstance(study, Study):
        study = Study(study)
    distributed = _checked(client, batch)
    with opened(study, folder, yes) as (native, path):
        before = _compute(distributed, study, native, client, batch, progress)
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
        before = _compute(distributed, assessment.study, native, client, batch, progress)
        return assessment._finished(native, path, before, None)


def _checked(client: Any, batch: int) -> Any:
    """The package ``distributed``, if what a caller gave can be worked with."""
    distributed = need("distributed", "wedgelab.cluster", "cluster")
    if isinstance(batch, bool) or not isinstance(batch, int) or batch < 1:
        raise StudyError(f"batch is {batch!r}; a whole number, 1 or more, is expected")
    if not isinstance(client, distributed.Client) or client.asynchronous:
        raise StudyError(f"client is {client!r}; a dask.distributed.Client that is not asynchronous is expected")
    return distributed


def _compute(
    distributed: Any, study: Study, native: NativeStudyFolder, client: Any, batch: int, progress: Progress
) -> int:
    """Has all missing runs computed by the workers; how many were there before."""
    before, _ = native.begun()
    tell = _teller(progress, study.count)
    done = before
    for kept in _kept(distributed, client, study, native, batch):
        done += kept
        if tell is not None:
            tell(done)
    return before


def _kept(distributed: Any, client: Any, study: Study, native: NativeStudyFolder, batch: int) -> Iterator[int]:
    """Has all missing runs computed, and keeps them; how many, batch by batch."""
    saved = study._native.saved()
    waiting = _batches(native, batch)
    under_way: dict[Any, tuple[list[int], int]] = {}
    ended = distributed.as_completed()

    def send(numbers: list[int], deaths: int) -> None:
        # Not pure: a result is asked for once, and nobody keeps it for later.
        future = client.submit(_records, saved, numbers, pure=False)
        under_way[future] = (numbers, deaths)
        ended.add(future)

    try:
        while True:
            # Enough for all workers and those that may join soon, and no more in memory, however large the study is.
            room = 4 + 3 * sum(client.ncores().values())
            while len(under_way) < room and (numbers := next(waiting, None)) is not None:
                send(numbers, 0)
            if not under_way:
                return
            future = next(ended)
            numbers, deaths = under_way.pop(future)
            try:
                records = future.result()
            except (distributed.KilledWorker, distributed.CancelledError) as error:
                if deaths + 1 >= DEATHS:
                    message = f"workers died again and again on the runs {numbers[0]} to {numbers[-1]}"
                    help_text = "look at the workers' memory and logs; all other runs that were done are kept, and the same call goes on"
                    raise StudyError(message, f"  × {message}\n  help: {help_text}") from error
                send(numbers, deaths + 1)
                continue
            yield native.keep(records)
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
