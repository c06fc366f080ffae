"""The report's figures, drawn with Matplotlib."""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
import wedgelab as wl


@pytest.fixture(autouse=True)
def close_figures() -> object:
    """Figures are closed after each test."""
    yield
    plt.close("all")


def test_hysteresis_loops(yawed: wl.Result) -> None:
    ax = yawed.plot_hysteresis(color="black")
    (line,) = ax.get_lines()
    assert np.array_equal(line.get_xdata(), yawed["bolster_vertical_in"])
    assert np.array_equal(line.get_ydata(), yawed["vertical_wedge_force_lbf"])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("bolster vertical (in)", "vertical wedge force (lbf)")
    assert yawed.plot_hysteresis(ax, column="side_frame_pitch_moment") is ax and len(ax.get_lines()) == 2
    with pytest.raises(wl.UnknownColumn):
        yawed.plot_hysteresis(column="nothing")


def test_every_figure_of_a_run_can_be_drawn(short: wl.Result, tmp_path: Path) -> None:
    figures = short.figures()
    assert len(figures) >= 2
    for name, figure in figures.items():
        drawn = figure.plot()
        assert len(drawn.axes) == len(figure.panels) and figure.caption and figure.name == name
        drawn.savefig(tmp_path / f"{name}.png")
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000


def test_reproduction_of_figure_5_4(tmp_path: Path) -> None:
    names = [f"vdrun_toe_{toe}_psi_0" for toe in ("in_0.2", "0", "out_0.2")]
    results = wl.run_many([wl.Case(name) for name in names])
    figures = wl.report_figures(results)
    (loop,) = [figure for figure in figures.values() if figure.thesis == "figure 5-4"]
    labels = {curve.label for panel in loop.panels for curve in panel.curves}
    assert labels == {"toe out 0.2°", "no toe", "toe in 0.2°"}
    # Its curves are the columns of the results.
    for curve in loop.panels[0].curves:
        assert any(np.isin(curve.y, result["vertical_force_on_side_frame_lbf"]).all() for result in results)
    drawn = loop.plot()
    drawn.savefig(tmp_path / "figure_5_4.png")
    for figure in figures.values():
        plt.close(figure.plot())


def test_groups_and_the_comparison_have_figures() -> None:
    group = next(iter(wl.built_in()["rig"].cases))
    assert "beyond_rig" in wl.report_figures([wl.Case(group).run()])
    mixed = wl.Case("vdrun_toe_0_psi_0").replace({"simulation.duration": 0.1, "simulation.output_units": "si"})
    with pytest.raises(wl.WedgelabError, match="different units"):
        wl.report_figures([mixed.run(), mixed.replace({"simulation.output_units": "us"}).run()])
    assert wl.report_figures([]) == {}
