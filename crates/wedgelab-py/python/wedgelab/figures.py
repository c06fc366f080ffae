"""The report's figures as data, drawn with Matplotlib."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._optional import need
from ._wedgelab import report_figures as _report_figures

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as MatplotlibFigure

    from .result import AnyResult

__all__ = ["Curve", "Figure", "Mark", "Panel", "report_figures"]


@dataclass(frozen=True)
class Curve:
    """A curve."""

    label: str
    """Its name in the legend; one without a name has none."""
    color: str
    """As ``#0072B2``; the colors can be told apart with any kind of color vision."""
    line: str
    """``solid``, ``dashed``, ``dashdot``, ``dotted``, or ``bar``: solid and broad."""
    x: npt.NDArray[np.float64]
    """In the unit of the axis; NaN interrupts."""
    y: npt.NDArray[np.float64]
    """In the unit of the axis; NaN interrupts."""


@dataclass(frozen=True)
class Mark:
    """A short text at a point."""

    x: float
    y: float
    text: str


@dataclass(frozen=True)
class Panel:
    """Axes with curves."""

    title: str
    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    x_window: tuple[float, float] | None
    """The part of the abscissa that is shown."""
    y_names: tuple[str, ...]
    """Names of the ordinates 0, 1, ... where the ordinate is no number."""
    marks: tuple[Mark, ...]
    cell: tuple[int, int, int]
    """Row, first column and number of columns in the figure's grid."""

    def draw(self, ax: Axes) -> None:
        """Draws it."""
        for curve in self.curves:
            broad = curve.line == "bar"
            ax.plot(
                curve.x,
                curve.y,
                color=curve.color,
                linestyle="solid" if broad else curve.line,
                linewidth=5.0 if broad else 1.2,
                solid_capstyle="butt" if broad else "projecting",
                label=curve.label or "_unnamed",
            )
        for mark in self.marks:
            ax.annotate(mark.text, (mark.x, mark.y), fontsize="small", ha="center", va="center")
        ax.set_title(self.title, fontsize="medium")
        ax.set_xlabel(self.x_label)
        ax.set_ylabel(self.y_label)
        ax.grid(True, color="0.9")
        ax.set_axisbelow(True)
        if self.y_names:
            ax.set_yticks(range(len(self.y_names)), self.y_names)
            ax.set_ylim(-0.5, len(self.y_names) - 0.5)
        if self.x_window is not None:
            ax.set_xlim(*self.x_window)
            self._fit_height(ax)

    def _fit_height(self, ax: Axes) -> None:
        """The range of the ordinate within the window."""
        if self.x_window is None or self.y_names:
            return
        low, high = self.x_window
        inside = [curve.y[(curve.x >= low) & (curve.x <= high)] for curve in self.curves]
        values = np.concatenate(inside) if inside else np.empty(0)
        values = values[np.isfinite(values)]
        if values.size and values.min() < values.max():
            air = 0.05 * float(values.max() - values.min())
            ax.set_ylim(float(values.min()) - air, float(values.max()) + air)


@dataclass(frozen=True)
class Figure:
    """A figure of the report: panels in rows, with a common legend."""

    name: str
    """As in the report's file names."""
    thesis: str
    """What it is called in the thesis, such as ``figure 5-4``; empty if the thesis does not have it."""
    title: str
    caption: str
    """What it shows, in full sentences."""
    panels: tuple[Panel, ...]
    grid: tuple[int, int]
    """Rows and columns."""
    common_axes: bool
    """Whether all panels have the same ranges of axes."""

    def plot(self, figure: MatplotlibFigure | None = None) -> MatplotlibFigure:
        """Draws it with Matplotlib, into ``figure`` or a new one, which is returned.

        Curves keep the look they have in the report; change the Matplotlib figure as you like.
        """
        if figure is None:
            figure = need("matplotlib.pyplot", "Figure.plot", "plot").figure(
                figsize=(4.4 * self.grid[1] if self.grid[1] > 1 else 6.5, 3.4 * self.grid[0] + 0.8),
                layout="constrained",
            )
        cells = figure.add_gridspec(*self.grid)
        axes: list[Axes] = []
        for panel in self.panels:
            row, column, width = panel.cell
            first = axes[0] if axes and self.common_axes else None
            ax = figure.add_subplot(cells[row, column : column + width], sharex=first, sharey=first)
            panel.draw(ax)
            axes.append(ax)
        figure.suptitle(self.title)
        self._legend(figure, axes)
        return figure

    def _legend(self, figure: MatplotlibFigure, axes: list[Axes]) -> None:
        """One entry for each name, in the order in which they first appear."""
        entries: dict[str, Any] = {}
        for ax in axes:
            for handle, label in zip(*ax.get_legend_handles_labels()):
                entries.setdefault(label, handle)
        if entries:
            # About 0.08 in a letter and 0.7 in for the line and the gaps.
            widest = 0.08 * max(map(len, entries)) + 0.7
            columns = max(1, min(len(entries), 4, int(figure.get_figwidth() / widest)))
            figure.legend(entries.values(), entries.keys(), loc="outside lower center", ncols=columns)


def _figure(data: Mapping[str, Any]) -> Figure:
    panels = (
        Panel(
            title=panel["title"],
            x_label=panel["x_label"],
            y_label=panel["y_label"],
            curves=tuple(Curve(**curve) for curve in panel["curves"]),
            x_window=panel["x_window"],
            y_names=tuple(panel["y_names"]),
            marks=tuple(Mark(*mark) for mark in panel["marks"]),
            cell=panel["cell"],
        )
        for panel in data["panels"]
    )
    return Figure(**{**data, "panels": tuple(panels)})


def _figures(list_of_data: Iterable[Mapping[str, Any]]) -> dict[str, Figure]:
    return {data["name"]: _figure(data) for data in list_of_data}


def report_figures(results: Iterable[AnyResult]) -> dict[str, Figure]:
    """The figures that the report has of these results together, by their names.

    Results of the thesis's built-in cases, or of cases like them, give the thesis's figures; those of other groups of built-in cases
    theirs; with results of built-in half-trucks, the comparison. `Figure.thesis` says which figure of the thesis one is.
    """
    return _figures(_report_figures([result._native for result in results]))
