"""Points of arrays that have no answer: NaN and a warning, an error where no point has one."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from .errors import PointWarning, WedgelabError

Failed = list[tuple[int, str, str]]
"""Number of a point in the flat arrays, what is wrong there, and what to try (may be empty)."""
Condition = tuple[npt.NDArray[np.bool_], npt.NDArray[np.float64], str, str]
"""Where it holds, of which values, their name, and the condition in words."""


def unmet(conditions: Sequence[Condition]) -> Failed:
    """The points at which a condition does not hold, each with the first such one; all arrays are flat and of one length."""
    failed: dict[int, tuple[int, str, str]] = {}
    for holds, values, what, expected in conditions:
        for k in map(int, np.flatnonzero(~holds)):
            failed.setdefault(k, (k, f"{what} is {values[k]}; it must be {expected}", ""))
    return [failed[k] for k in sorted(failed)]


def tell(what: str, shape: tuple[int, ...], failed: Failed, error: type[WedgelabError], stacklevel: int = 3) -> None:
    """Warns of the points that have no ``what``, with how many, which, and why. Raises ``error`` if there is none that has one."""
    if not failed:
        return
    numbers = sorted({k for k, _, _ in failed})
    count = int(np.prod(shape))
    by_reason: dict[tuple[str, str], list[int]] = {}
    for k, message, remedy in failed:
        by_reason.setdefault((message, remedy), []).append(k)
    (message, remedy), first = next(iter(by_reason.items()))
    if len(numbers) == count:
        raise error(message, f"{message}\n  help: {remedy}" if remedy else message)
    places = [k if len(shape) == 1 else tuple(map(int, np.unravel_index(k, shape))) for k in numbers]
    shown = ", ".join(map(str, places[:8])) + (", ..." if len(places) > 8 else "")
    place = places[numbers.index(first[0])]
    text = f"{len(numbers)} of {count} points have no {what} (NaN): {shown}; at {place}: {message}"
    warnings.warn(f"{text}; {remedy}" if remedy else text, PointWarning, stacklevel=stacklevel + 1)
