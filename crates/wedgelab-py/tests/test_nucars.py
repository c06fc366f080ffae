"""Files of NUCARS: read, check, run."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
import wedgelab as wl
from wedgelab import NucarsError, HalfTruckCase, nucars

RUN = "bolst_wedge_sf_bolst-vert-displ_69_const.run"
FILES = (RUN, "bolst_wedge_sf_69_const.sys", "sngl_trk_69.dat", "bolst_displ_input3.inp")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The thesis's files, under the names that the run file has for them."""
    for name in FILES:
        target = "sngl_trk.DAT" if name.endswith(".dat") else name
        (tmp_path / target).write_text(nucars.read(name).text)
    return tmp_path


def test_input_reading_and_writing_anew(folder: Path) -> None:
    system = nucars.read(folder / FILES[1])
    assert system.kind == "system" and not system.has_errors and system.title
    frame = system.tables["bodies"].to_pandas()
    assert len(frame) == 3 and np.issubdtype(frame["x [in]"].dtype, np.number)
    (folder / "again.sys").write_text(system.written)
    assert nucars.read(folder / "again.sys").tables == system.tables
    assert [nucars.read(folder / name).kind for name in (RUN, "sngl_trk.DAT", FILES[3])] == ["run", "data", "input"]


def test_input_checks_have_places(folder: Path) -> None:
    checked = nucars.check(folder / RUN)
    assert {one.kind for one in checked} == {"run", "system", "data", "input"}
    warnings = [finding for one in checked for finding in one.findings if finding.severity == "warning"]
    assert warnings and all(w.line >= 1 and w.column >= 1 and w.message and w.code in w.text for w in warnings)
    text = (folder / FILES[1]).read_text()
    (folder / FILES[1]).write_text(text.replace("\\BODY DATA", "\\BODY DATTA"))
    with pytest.raises(NucarsError) as caught:
        nucars.read(folder / FILES[1])
    assert caught.value.findings and "help" in str(caught.value)
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)
    assert nucars.read(folder / FILES[1], strict=False).has_errors
    with pytest.raises(NucarsError, match="cannot be run"):
        HalfTruckCase(folder / RUN)


def test_input_is_explained(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("nothing")
    for call, said in (
        (lambda: nucars.read(tmp_path / "missing.sys"), "there is no file"),
        (lambda: nucars.read(tmp_path), "is a folder"),
        (lambda: nucars.read(tmp_path / "notes.txt"), "is no file of NUCARS"),
        (lambda: nucars.check(), "at least one"),
        (lambda: HalfTruckCase("nucars_69_constant_toe_ou"), "did you mean nucars_69_constant_toe_out"),
        (lambda: HalfTruckCase("nucars_69_constant_toe_out", duration=-1), "must be positive"),
        (lambda: HalfTruckCase("nucars_69_constant_toe_out", duration=float("nan")), "must be positive"),
        (lambda: HalfTruckCase("nucars_69_constant_toe_out", interval=0), "must be positive"),
        (lambda: HalfTruckCase("nucars_69_constant_toe_out", relative_tolerance=2), "between 0 and 1"),
        (lambda: HalfTruckCase("nucars_69_constant_toe_out", units="metric"), '"us", "si"'),
        (lambda: HalfTruckCase("nucars_69_constant_toe_out", start="lying"), '"drawn"'),
        (lambda: HalfTruckCase("nucars_69_constant_toe_out", yaw="drop"), "does not fit"),
        (lambda: HalfTruckCase("nucars_69_constant_toe_out", yaw="much"), '"printed"'),
        (lambda: HalfTruckCase("nucars_69_constant_toe_out", options={"bent": "linear"}), "did you mean bend"),
        (lambda: HalfTruckCase("nucars_69_constant_toe_out", options={"bend": 3}), "half_cosine or linear"),
        (lambda: HalfTruckCase("nucars_69_constant_toe_out", system="x.sys"), "its own files"),
    ):
        with pytest.raises(NucarsError) as caught:
            call()
        assert said in str(caught.value), str(caught.value)
    with pytest.raises(wl.UnitError, match="a time is expected"):
        HalfTruckCase("nucars_69_constant_toe_out", duration="3 in")


def test_reproduction_of_the_built_in_run_from_its_files(folder: Path) -> None:
    assert "nucars_69_constant_toe_out" in nucars.built_in()
    built_in = HalfTruckCase("nucars_69_constant_toe_out", duration="1 s")
    from_files = HalfTruckCase(folder / RUN, duration=1.0)
    a, b = built_in.run(), from_files.run()
    assert a.keys() == b.keys() and all(np.array_equal(a[name], b[name]) for name in a)
    assert a.units == "us" and a.summary.wedges and built_in.duration == 1.0
    assert a.summary.largest_relative_residual < 1e-3
    assert np.array_equal(a["wedge_127_column_friction_lbf"], a.array("wedge_127_column_friction")[0])
    assert a.plot_hysteresis(127).get_xlabel() and len(a.to_pandas()) == a.rows == 101
    assert a.ledger.rows > 5 and a.ledger_history.rows == a.rows


def test_trucks_pickle_without_their_files(folder: Path) -> None:
    case = HalfTruckCase(folder / RUN, duration="0.2 s", options={"bend": "linear"})
    data = pickle.dumps(case)
    for name in list(folder.iterdir()):
        name.unlink()
    again = pickle.loads(data)
    assert again.assumptions == case.assumptions and again.name == case.name
    a, b = case.run(), wl.run_many([again, again], workers=2)[1]
    assert all(np.array_equal(a[name], b[name]) for name in a)
    c = pickle.loads(pickle.dumps(b))
    assert c.summary.to_dict() == b.summary.to_dict() and np.array_equal(c["time"], b["time"])
    built_in = pickle.loads(pickle.dumps(HalfTruckCase("nucars_68_variable_toe_in", duration=0.1)))
    assert built_in.name == "nucars_68_variable_toe_in"
