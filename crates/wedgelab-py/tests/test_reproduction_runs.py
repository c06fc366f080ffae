"""Runs: the same numbers as everywhere else, by name, with units, in tables, across processes."""

from __future__ import annotations

import json
import pickle
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import wedgelab as wl


def test_a_run_is_that_of_the_command_line(yawed: wl.Result, tmp_path: Path) -> None:
    # What the command writes goes through the same writer; the file's numbers are the arrays, bit for bit.
    names = yawed.write(tmp_path / "run")
    assert sorted(names) == sorted(path.name for path in (tmp_path / "run").iterdir())
    lines = (tmp_path / "run" / "result.csv").read_text().splitlines()
    header, rows = lines[0].split(","), np.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    arrays = yawed.to_dict()
    assert header == list(arrays) and rows.shape == (yawed.rows, len(yawed))
    for name, column in zip(header, rows.T):
        assert np.array_equal(arrays[name], column), name
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary == yawed.summary.to_dict()
    assert wl.Case(tmp_path / "run" / "case.toml") == yawed.case
    with pytest.raises(wl.FileError, match="force|exist"):
        yawed.write(tmp_path / "run")
    yawed.write(tmp_path / "run", force=True)


def test_the_thesis_values(yawed: wl.Result) -> None:
    # The energy per cycle is that of the loop itself, by the trapezoidal rule over a whole cycle.
    period = np.pi
    time, force, speed = yawed["time"], yawed["side_frame_dissipation"], yawed["time"]
    inside = (time >= np.pi / 2 - 1e-9) & (time <= np.pi / 2 + period)
    lost = -float(np.trapezoid(force[inside], speed[inside])) / 0.112984829
    assert lost == pytest.approx(yawed.summary.averages.energy_per_cycle.side_frame.value, rel=0.02)


def test_names_units_and_labels(short: wl.Result) -> None:
    assert short["wedge_z_in"] * 0.0254 == pytest.approx(short["wedge_z"], rel=1e-14, abs=0)
    assert np.array_equal(short["wedge_z_m"], short["wedge_z"])
    column = short.columns["vertical_wedge_force"]
    assert (column.kind, column.unit) == ("force", "N") and column.text
    values, unit = short.array("vertical_wedge_force")
    assert unit == "lbf" and np.array_equal(values, short["vertical_wedge_force_lbf"])
    assert short.label("vertical_wedge_force", "si") == "vertical wedge force (N)"
    assert "wedge_z" in short and "nothing" not in short and len(short["time"]) == short.rows == 51
    with pytest.raises(wl.UnknownColumn, match="did you mean wedge_z"):
        short["wegde_z"]
    with pytest.raises(wl.WedgelabError, match='write "us" or "si"'):
        short.to_dict("metric")
    assert short["time"].flags.writeable and short["time"].dtype == np.float64


def test_tables(short: wl.Result) -> None:
    frame = short.to_pandas()
    assert frame.index.name == "time_s" and np.array_equal(frame["wedge_z_in"].to_numpy(), short["wedge_z_in"])
    data = short.to_xarray()
    assert data["wedge_z"].attrs["units"] == "m" and np.array_equal(data["wedge_z"].values, short["wedge_z"])
    assert data.sel(time=0.25, method="nearest")["wedge_z"].size == 1
    events = short.events
    assert list(events) == ["time", "face", "corner", "from", "to"]
    assert events.rows == min(short.summary.events.total, 500) and np.all(np.diff(events["time"]) >= 0)
    assert set(events["to"]) <= {"open", "stick", "slip"} and len(events.to_pandas()) == events.rows
    ledger = short.ledger.to_pandas().set_index("entry")
    assert ledger.loc["motion_work", "unit"] == "lbf·in"
    history = short.ledger_history
    last = {name: values[-1] for name, values in history.items()}
    assert last["motion_work"] / 0.1129848290276167 == pytest.approx(ledger.loc["motion_work", "value"], rel=1e-9)


def test_the_ledger_closes(short: wl.Result) -> None:
    history = short.ledger_history
    stored = sum(history[n] for n in ("kinetic_energy", "gravity_energy", "coil_energy", "contact_energy", "bristle_energy") if n in history)
    assert np.abs(history["ledger_residual"]).max() <= 1e-3 * np.abs(history["motion_work"]).max()
    assert np.asarray(stored).shape == history["time"].shape


def test_summary_and_assumptions(short: wl.Result) -> None:
    summary = short.summary
    assert summary["averages"]["cycles"] == summary.averages.cycles
    assert summary.schema == "wedgelab.summary/2" and summary.complete
    assert short.assumptions == short.case.assumptions == summary.assumptions
    assert "ledger" in dir(summary) and isinstance(summary.to_dict()["ledger"], dict)
    with pytest.raises(AttributeError, match="there are"):
        _ = summary.avarages


def test_results_pickle_with_the_same_bits(short: wl.Result) -> None:
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        again = pickle.loads(pickle.dumps(short, protocol))
        assert again.summary.to_dict() == short.summary.to_dict() and again.case == short.case
        assert all(np.array_equal(again[name], short[name]) for name in short)
        assert again.columns == short.columns
    buffers: list[pickle.PickleBuffer] = []
    data = pickle.dumps(short, 5, buffer_callback=buffers.append)
    assert buffers and len(data) < 100_000
    assert np.array_equal(pickle.loads(data, buffers=buffers)["wedge_z"], short["wedge_z"])
    assert list(again.figures()) == list(short.figures())


def test_only_some_columns(short_case: wl.Case, short: wl.Result) -> None:
    few = short_case.run(columns=["time", "wedge_z"])
    assert few.keys() == ["time", "wedge_z"] and np.array_equal(few["wedge_z"], short["wedge_z"])
    none = short_case.run(columns=[])
    assert none.keys() == [] and none.summary.ledger == short.summary.ledger
    assert pickle.loads(pickle.dumps(none)).keys() == []
    with pytest.raises(wl.CaseError, match="a list of names"):
        short_case.run(columns="time")


def test_the_lock_is_released(short_case: wl.Case) -> None:
    case = wl.Case("vdrun_toe_0_psi_0").replace({"simulation.relative_tolerance": 1e-7})
    ended = threading.Event()

    def work() -> None:
        case.run(columns=[])
        ended.set()

    thread = threading.Thread(target=work)
    thread.start()
    count = 0
    while not ended.is_set():
        count += 1
        time.sleep(0.001)
    thread.join()
    # With the lock held all the time this loop would turn a few times at most.
    assert count > 20


@pytest.fixture
def hears_ctrl_c() -> Iterator[None]:
    """Programs that are started in the background of a shell ignore it; here it is heard."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def _interrupt_soon() -> threading.Timer:
    timer = threading.Timer(0.15, signal.raise_signal, [signal.SIGINT])
    timer.start()
    return timer


@pytest.mark.usefixtures("hears_ctrl_c")
def test_ctrl_c_stops_a_run_and_many_runs() -> None:
    long = wl.Case("vdrun_toe_0_psi_0").replace({"simulation.duration": "2000 s", "simulation.output_interval": "1 s"})
    for work in (lambda: long.run(), lambda: wl.run_many([long] * 5, workers=2)):
        timer = _interrupt_soon()
        with pytest.raises(KeyboardInterrupt):
            work()
        timer.join()
    truck = wl.HalfTruckCase("nucars_69_constant_toe_out", duration="5000 s", interval="1 s")
    timer = _interrupt_soon()
    with pytest.raises(KeyboardInterrupt):
        truck.run()
    timer.join()


def test_progress_is_told_and_its_exceptions_end_the_run() -> None:
    long = wl.Case("vdrun_toe_0_psi_0").replace({"simulation.duration": "1000 s", "simulation.output_interval": "1 s"})
    told: list[float] = []

    def tell(time: float) -> None:
        told.append(time)
        if len(told) == 3:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        long.run(progress=tell)
    assert told == sorted(told) and len(told) == 3


def test_many_runs_do_not_depend_on_workers(short_case: wl.Case) -> None:
    cases = [short_case.replace({"friction.column": mu}) for mu in (0.2, 0.3, 0.4, 0.5)]
    told: list[tuple[int, int]] = []
    first = wl.run_many(cases, workers=1, progress=lambda done, count: told.append((done, count)))
    assert told[-1] == (4, 4) and told == sorted(told)
    for workers in (2, 3, 7, None):
        other = wl.run_many(iter(cases), workers=workers)
        for a, b, case in zip(first, other, cases):
            assert a.case == b.case == case
            assert all(np.array_equal(a[name], b[name]) for name in a)
            assert a.summary.to_dict() == b.summary.to_dict()
    assert wl.run_many([]) == []
    assert np.array_equal(first[2]["wedge_z"], short_case.run()["wedge_z"])


def test_many_runs_say_what_is_wrong(short_case: wl.Case, capsys: pytest.CaptureFixture[str]) -> None:
    wl.run_many([short_case], progress=True, columns=[])
    assert "1 of 1 runs" in capsys.readouterr().err
    for workers in (0, -1, 1.5, True, "2"):
        with pytest.raises(wl.WedgelabError, match="whole number"):
            wl.run_many([short_case], workers=workers)  # type: ignore[arg-type]
    with pytest.raises(wl.WedgelabError, match=r"cases\[0\] is a str"):
        wl.run_many(["vdrun_toe_0_psi_0"])  # type: ignore[list-item]
    with pytest.raises(wl.WedgelabError, match='"raise" or "keep"'):
        wl.run_many([short_case], errors="no")
    with pytest.raises(wl.WedgelabError, match='"raise" or "keep"'):
        short_case.run(incomplete="no")


def test_a_run_that_stops_keeps_what_it_has(short_case: wl.Case) -> None:
    # No step is short enough for a wedge that turns so easily.
    changes = {"wedge.inertia": ["1e-300 lb in^2"] * 3, "simulation.duration": "0.05 s"}
    broken = wl.Case("vdrun_toe_0_psi_0").replace(changes)
    with pytest.raises(wl.RunError, match="is incomplete") as caught:
        broken.run()
    error = pickle.loads(pickle.dumps(caught.value))
    assert not error.result.is_complete and error.result.rows >= 1
    assert not broken.run(incomplete="keep").is_complete
    kept = wl.run_many([broken, short_case], errors="keep", columns=["time"])
    assert isinstance(kept[0], wl.RunError) and isinstance(kept[1], wl.Result)
    with pytest.raises(wl.RunError) as many:
        wl.run_many([short_case, broken, short_case])
    assert [isinstance(one, wl.Result) for one in many.value.results] == [True, False, True]
