"""Optional packages, asked for where they are needed."""

from __future__ import annotations

import importlib
from typing import Any

from .errors import MissingDependencyError


def need(package: str, what: str, extra: str) -> Any:
    """The module, or an error that says how to get it."""
    try:
        return importlib.import_module(package)
    except ImportError as error:
        name = package.partition(".")[0]
        help_text = f"pip install {name}, or pip install with the extra: wedgelab[{extra}]"
        message = f"{what} needs {name}, which cannot be imported"
        raise MissingDependencyError(message, f"  × {message}\n  help: {help_text}") from error
