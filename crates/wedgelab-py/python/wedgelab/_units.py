"""Quantities as arguments."""

from __future__ import annotations

from ._wedgelab import to_si
from .errors import UnitError


def si(value: object, kind: str, what: str) -> float:
    """An argument called ``what``, in SI units: a text with a unit, a quantity, or a number."""
    try:
        return to_si(value, kind)
    except UnitError as error:
        raise UnitError(f"{what}: {error.message}", error.shown.replace(error.message, f"{what}: {error.message}", 1)) from None
    except TypeError as error:
        found = f"{value!r}" if isinstance(value, (int, float, complex, type(None))) else f"a {type(value).__name__}"
        raise UnitError(f"{what} is {found}; {error}") from None


