"""Exceptions. Their text is what the command line shows: message, marked text, help.

``WedgelabError`` is the class of all of them; most are also ``ValueError`` or ``RuntimeError``. All of them pickle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .result import AnyResult

__all__ = [
    "CaseError",
    "EnergyWarning",
    "FileError",
    "Finding",
    "InternalError",
    "MissingDependencyError",
    "NucarsError",
    "PlausibilityWarning",
    "PointWarning",
    "Problem",
    "RunError",
    "StepError",
    "StudyError",
    "UnitError",
    "WedgelabError",
    "WheelRailError",
]


@dataclass(frozen=True)
class Problem:
    """One mistake in a case: what was found, where, and what to write instead."""

    message: str
    """What was found and what was expected."""
    label: str | None = None
    """What the marked text is."""
    help: str | None = None
    """What to write instead."""
    source: str | None = None
    """The file, or ``values`` for what was given from Python (shown as TOML)."""
    line: int | None = None
    """Line, from 1."""
    column: int | None = None
    """Column, from 1, in characters."""
    marked: str | None = None
    """The text the mistake is marked at."""


@dataclass(frozen=True)
class Finding:
    """Something wrong or doubtful in a file of NUCARS."""

    severity: str
    """``error``, ``warning`` or ``note``."""
    code: str
    """A short name of its kind, such as ``count``."""
    message: str
    """What was found and what was expected."""
    label: str | None
    """What the marked text is."""
    help: str | None
    """What to write instead, or why it matters."""
    source: str
    """The file."""
    line: int
    """Line, from 1."""
    column: int
    """Column, from 1, in characters."""
    marked: str
    """The text it is about."""
    text: str
    """As the command line shows it."""

    def __str__(self) -> str:
        return self.text


class WedgelabError(Exception):
    """Any error of this package."""

    def __init__(self, message: str, shown: str | None = None) -> None:
        super().__init__(message, shown)
        self.message: str = message
        """The message alone."""
        self.shown: str = message if shown is None else shown
        """What the command line shows."""

    def __str__(self) -> str:
        head, _, rest = self.shown.partition("\n")
        # The first line of what is shown is the message itself, behind a sign.
        return f"{self.message}\n{rest}" if rest and head.endswith(self.message) else self.message

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), self.args, self.__dict__)


class UnitError(WedgelabError, ValueError):
    """A text is no quantity, or a quantity of another kind."""


class CaseError(WedgelabError, ValueError):
    """A case is wrong; all mistakes are in ``problems``."""

    def __init__(self, message: str, shown: str | None = None, problems: Sequence[Problem] = ()) -> None:
        super().__init__(message, shown)
        self.args = (message, shown, tuple(problems))
        self.problems: tuple[Problem, ...] = tuple(problems)
        """The mistakes with their places; empty where there is no text to mark."""

    def __str__(self) -> str:
        if len(self.problems) > 1:
            return f"{self.message}\n{self.shown.partition(chr(10))[2]}"
        return super().__str__()


class EnergyWarning(UserWarning):
    """The energy ledger of a run does not close: its relative residual is above 1e-3."""


class PlausibilityWarning(UserWarning):
    """A run is implausible: bodies, contacts or coils leave the range in which the model means something."""


class PointWarning(UserWarning):
    """Some points of an array have no answer, and are NaN: how many, which, and why."""


class RunError(WedgelabError, RuntimeError):
    """A run cannot begin, cannot go on, has derailed, or has failed because its energy ledger does not close to 1e-2; ``result`` has
    what was computed."""

    def __init__(self, message: str, shown: str | None = None, result: AnyResult | None = None) -> None:
        super().__init__(message, shown)
        self.args = (message, shown, result)
        self.result: AnyResult | None = result
        """What was computed, marked as incomplete; ``None`` if the run could not begin."""
        self.results: list[AnyResult | WedgelabError] = []
        """Of ``run_many``: everything that came out, in the order of the cases."""


class StepError(WedgelabError, RuntimeError):
    """A step cannot be made, or a state cannot be restored."""


class StudyError(WedgelabError, RuntimeError):
    """A study cannot begin or go on; every run that was done is kept."""


class NucarsError(WedgelabError, ValueError):
    """A file of NUCARS cannot be read or run; the errors in it are ``findings``."""

    def __init__(self, message: str, shown: str | None = None, findings: Sequence[Finding] = ()) -> None:
        super().__init__(message, shown)
        self.args = (message, shown, tuple(findings))
        self.findings: tuple[Finding, ...] = tuple(findings)
        """The errors with their places."""


class WheelRailError(WedgelabError, ValueError):
    """A profile, a contact or a creep law cannot be: what was found, and what it must be."""


class FileError(WedgelabError, OSError):
    """Files cannot be written, or are there already."""

    def __str__(self) -> str:
        return WedgelabError.__str__(self)


class MissingDependencyError(WedgelabError, ImportError):
    """An optional package is missing."""


class InternalError(WedgelabError, RuntimeError):
    """A mistake of Wedgelab itself."""
