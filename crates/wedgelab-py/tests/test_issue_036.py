"""Issue 36: one meaning of bare names, units that convert, what notebooks show, progress, the reference."""

from __future__ import annotations

import io
import pickle
import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wedgelab as wl
from wedgelab.many import _written

MILLIMETRES_IN_AN_INCH = 25.4
NEWTONS_IN_A_POUND = 4.4482216152605


def test_issue_036_bare_names_are_si_everywhere(short: wl.Result) -> None:
    bare = short.to_xarray()
    assert bare["wedge_z"].attrs["units"] == "m" and np.array_equal(bare["wedge_z"].values, short["wedge_z"])
    us = short.to_xarray("us")
    assert "wedge_z" not in us and us["wedge_z_in"].attrs["units"] == "in"
    assert np.array_equal(us["wedge_z_in"].values, short["wedge_z_in"])
    assert set(us) | {"time_s"} == set(short.to_dict("us"))
    si = short.to_xarray("si")
    assert np.array_equal(si["wedge_z_m"].values, short["wedge_z"])


def test_issue_036_numbers_with_units_convert(short: wl.Result) -> None:
    measure = short.summary.ledger.entries["motion_work"]
    assert isinstance(measure, wl.Measure) and measure.unit == "lbf·in"
    assert measure.si == pytest.approx(measure.value * NEWTONS_IN_A_POUND * 0.0254, rel=1e-14)
    assert measure.to("J") == pytest.approx(measure.si, rel=1e-14)
    assert measure.to("ft lbf") == pytest.approx(measure.value / 12.0, rel=1e-12)
    with pytest.raises(wl.UnitError):
        measure.to("mm")
    again = pickle.loads(pickle.dumps(measure))
    assert isinstance(again, wl.Measure) and again == measure
    values, unit = short.array("wedge_z", "mm")
    assert unit == "mm" and np.allclose(values, short["wedge_z_in"] * MILLIMETRES_IN_AN_INCH, rtol=1e-14, atol=0)
    with pytest.raises(wl.UnitError):
        short.array("wedge_z", "lbf")
    with pytest.raises(wl.UnitError, match="number without unit"):
        short.array("column_upper_left_state", "mm")
    with pytest.raises(wl.WedgelabError, match="thumb"):
        short.array("wedge_z", "thumb")


def test_issue_036_frames_carry_their_units(short: wl.Result) -> None:
    frame = short.to_pandas()
    assert frame.attrs["name"] == short.summary.name and frame.attrs["units"]["wedge_z_in"] == "in"
    assert set(frame.columns) <= set(frame.attrs["units"]) and frame.attrs["descriptions"]["wedge_z_in"]
    assert short.to_pandas("si").attrs["units"]["wedge_z_m"] == "m"
    assert short.ledger_history.to_pandas().attrs["units"]["motion_work"] == "J"
    assert short.events.units == {"time": "s"}


def test_issue_036_tables_of_nucars_have_short_keys() -> None:
    tables = wl.nucars.read("bolst_wedge_sf_69_const.sys").tables
    assert list(tables)[:3] == ["bodies", "input_bodies", "connections"] and "wedges_3d" in tables
    assert all(key.isidentifier() and table.key == key for key, table in tables.items())
    assert tables["bodies"].to_pandas().attrs["units"]["x [in]"] == "in"


def test_issue_036_notebooks_show_tables(short: wl.Result) -> None:
    shows: list[tuple[Any, str]] = [
        (short, "vertical_wedge_force"),
        (short.events, "time (s)"),
        (short.ledger_history, "motion_work (J)"),
        (short.summary, "averages"),
        (short.case, "[wedge]"),
        (wl.nucars.read("bolst_wedge_sf_69_const.sys").tables["bodies"], "<table>"),
    ]
    for shown, text in shows:
        html = shown._repr_html_()
        assert text in html and html.count("<td") == html.count("</td>") and len(html) < 40_000, html[:500]
    assert "<b>" in short._repr_html_() and "<script" not in short._repr_html_()
    odd = wl.DataTable({"<a>": np.array(["<b>"])})
    assert "&lt;b&gt;" in odd._repr_html_() and "<a>" not in odd._repr_html_()


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_issue_036_progress_reads_well_outside_terminals() -> None:
    log = io.StringIO()
    tell = _written(1000, log)
    for done in range(1, 1001):
        tell(done)
    lines = log.getvalue().splitlines()
    assert len(lines) == 10 and lines[0] == "100 of 1000 runs" and lines[-1] == "1000 of 1000 runs"
    assert "\r" not in log.getvalue()
    terminal = _Terminal()
    tell = _written(3, terminal)
    for done in range(1, 4):
        tell(done)
    assert terminal.getvalue() == "1 of 3 runs\r2 of 3 runs\r3 of 3 runs\n"


def test_issue_036_the_reference_is_that_of_the_sources() -> None:
    place = Path(__file__).parents[1] / "scripts" / "api_page.py"
    written = runpy.run_path(str(place))
    assert written["PAGE"].read_text(encoding="utf-8") == written["page"](), f"run python {place}"
