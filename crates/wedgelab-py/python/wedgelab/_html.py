"""What notebooks show: small tables as HTML."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

import numpy as np

__all__ = ["escape", "page", "shown", "table"]

_MOST_ROWS = 10


def shown(value: object) -> str:
    """A cell: numbers with six significant digits."""
    if isinstance(value, (float, np.floating)):
        return f"{float(value):.6g}"
    return str(value)


def table(header: Sequence[str], rows: Sequence[Sequence[object]], most: int = _MOST_ROWS) -> str:
    """A table; of long ones the first and last rows."""
    lines: list[Sequence[object]] = list(rows)
    if len(lines) > most:
        half = most // 2
        lines = [*lines[:half], ["…"] * len(header), *lines[-half:]]
    head = "".join(f"<th>{escape(name)}</th>" for name in header)
    body = "".join("<tr>" + "".join(f"<td>{escape(shown(cell))}</td>" for cell in line) + "</tr>" for line in lines)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def page(title: str, parts: Iterable[str], note: str = "") -> str:
    """Parts below a title."""
    small = f"<p><small>{escape(note)}</small></p>" if note else ""
    return f"<div><p><b>{escape(title)}</b></p>{''.join(parts)}{small}</div>"
