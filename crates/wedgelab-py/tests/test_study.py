"""Studies: in this process and on a cluster they give the same bytes, whoever dies meanwhile."""

from __future__ import annotations

import json
import os
import pickle
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import dask
import pyarrow.parquet as pq
import pytest
import wedgelab as wl
from distributed import Client, LocalCluster

STUDY = """
title = "Friction and stiffness"
case = "cdrun_toe_out_0.2_psi_0.012"
sampling = "full_factorial"
[set]
simulation.duration = "0.12 s"
[vary]
friction.column = { from = 0.2, to = 0.6, count = 20 }
friction.reference_speed = ["0.001 in/s", "0.002 in/s", "0.003 in/s", "1e-300 in/s"]
"""


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "friction.toml"
    path.write_text(STUDY)
    return path


# How often Dask itself tries a task again whose worker died: never, or as usual.
@pytest.fixture(params=[0, 3])
def client(request: pytest.FixtureRequest) -> Iterator[Any]:
    """Two local workers, each a process of its own."""
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": request.param}),
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,  # type: ignore[no-untyped-call]
        Client(cluster) as client,  # type: ignore[no-untyped-call]
    ):
        yield client


def test_a_study_is_what_its_file_says(path: Path) -> None:
    study = wl.Study(path)
    assert (study.name, study.title, study.count, len(study)) == ("friction", "Friction and stiffness", 80, 80)
    assert study.parameters == ["friction.column", "friction.reference_speed"]
    assert study.values(0) == {"friction.column": "0.2", "friction.reference_speed": "0.001 in/s"}
    case = study.case(1)
    assert isinstance(case, wl.Case) and case.friction.column == 0.2
    assert study.columns["wear_power_column_lbf_in_per_s"].unit == "lbf·in/s"
    again = pickle.loads(pickle.dumps(study))
    assert again.values(79) == study.values(79) and list(again.columns) == list(study.columns)


def test_limits_any_number_of_jobs_gives_the_same_bytes(path: Path, tmp_path: Path) -> None:
    study = wl.Study(path)
    told: list[tuple[int, int]] = []
    one = study.run(tmp_path / "one", jobs=1, progress=lambda done, runs: told.append((done, runs)))
    two = study.run(tmp_path / "two", jobs=2)
    assert one.table.read_bytes() == two.table.read_bytes()
    assert one.page.read_bytes() == two.page.read_bytes()
    assert (one.runs, one.before, one.complete) == (80, 0, 60)
    assert one.refused + one.stopped == 20 and one.reasons[3]
    assert told[-1] == (80, 80) and told == sorted(told)
    assert study.run(tmp_path / "one").before == 80


def test_cross_code_the_table_is_read_by_others(path: Path, tmp_path: Path) -> None:
    study = wl.Study(path)
    table = pq.read_table(study.run(tmp_path / "out").table)
    columns = json.loads(table.schema.metadata[b"wedgelab.columns"])
    assert [column["name"] for column in columns] == table.column_names == list(study.columns)
    assert {c["name"]: c["unit"] for c in columns} == {c.name: c.unit for c in study.columns.values()}
    rows = table.to_pylist()
    assert [row["run"] for row in rows] == list(range(80))
    assert rows[4]["friction.column"] == pytest.approx(0.2 + 0.4 / 19, abs=1e-15)
    assert rows[4]["friction.reference_speed_in_per_s"] == 0.001
    assert rows[3]["status"] != "complete" and rows[3]["reason"] and rows[3]["steps"] is None
    steps = study.case(6).run().summary.solver.statistics.steps
    assert rows[6]["steps"] == steps


def test_limits_a_cluster_that_loses_a_worker_gives_the_same_bytes(path: Path, tmp_path: Path, client: Any) -> None:
    study = wl.Study(path)
    alone = study.run(tmp_path / "alone", jobs=2)
    victim = next(iter(client.run(os.getpid).values()))
    killed: list[int] = []

    def kill(done: int, runs: int) -> None:
        if not killed and runs // 5 <= done < runs // 2:
            os.kill(victim, signal.SIGKILL)
            killed.append(done)

    together = wl.cluster.run_study(path, tmp_path / "together", client=client, batch=2, progress=kill)
    assert killed and victim not in client.run(os.getpid).values()
    assert together.table.read_bytes() == alone.table.read_bytes()
    assert together.page.read_bytes() == alone.page.read_bytes()
    assert (together.runs, together.before, together.complete) == (80, 0, 60)
    # Each run is kept once, though some were begun twice: as many bytes as without a cluster.
    assert parts(together.folder) == parts(alone.folder)


@pytest.mark.parametrize("client", [0], indirect=True)
def test_input_runs_on_which_workers_die_again_and_again(
    path: Path, tmp_path: Path, client: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(wl.cluster, "DEATHS", 1)
    victims = list(client.run(os.getpid).values())

    def kill(done: int, runs: int) -> None:
        if done >= 10 and victims:
            os.kill(victims.pop(), signal.SIGKILL)

    study = wl.Study(path)
    with pytest.raises(wl.StudyError, match=r"workers died again and again on the runs \d+ to \d+\n.*kept"):
        wl.cluster.run_study(study, tmp_path / "out", client=client, batch=2, progress=kill)
    ended = study.run(tmp_path / "out")
    assert 10 <= ended.before < 80 and ended.complete == 60


@pytest.mark.parametrize("client", [3], indirect=True)
def test_limits_what_one_began_the_other_ends(path: Path, tmp_path: Path, client: Any) -> None:
    study = wl.Study(path)
    alone = study.run(tmp_path / "alone", jobs=2)

    class Enough(Exception):
        pass

    def stop(done: int, runs: int) -> None:
        if done >= 10:
            raise Enough

    with pytest.raises(Enough):
        study.run(tmp_path / "both", jobs=1, progress=stop)
    # A worker that joins while the study is under way.
    late: list[int] = []

    def join(done: int, runs: int) -> None:
        if not late:
            client.cluster.scale(3)
            client.wait_for_workers(3)
            late.append(done)
        if done >= 60:
            raise Enough

    with pytest.raises(Enough):
        wl.cluster.run_study(study, tmp_path / "both", client=client, batch=2, progress=join)
    assert not (tmp_path / "both" / "table.parquet").exists()
    # Each worker keeps the study that it has batches of.
    assert list(client.run(lambda: wl.cluster._study.cache_info().currsize).values()) == [1, 1, 1]
    ended = study.run(tmp_path / "both")
    assert 60 <= ended.before < 80
    assert ended.table.read_bytes() == alone.table.read_bytes()
    assert parts(ended.folder) == parts(alone.folder)


def parts(folder: Path) -> int:
    return sum(part.stat().st_size for part in (folder / "parts").iterdir())


def test_input_mistakes_are_explained(path: Path, tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(STUDY.replace("friction.column", "friction.colum"))
    with pytest.raises(wl.CaseError, match="no key `colum`") as caught:
        wl.Study(wrong)
    assert caught.value.problems[0].line == 8
    study = wl.Study(path)
    with pytest.raises(wl.StudyError, match="from 0 to 79"):
        study.case(80)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "mine.txt").touch()
    with pytest.raises(wl.StudyError, match=r"holds no study: there is `mine.txt`"):
        study.run(tmp_path / "mine")
    study.run(tmp_path / "out")
    path.write_text(STUDY.replace("to = 0.6", "to = 0.5"))
    with pytest.raises(wl.StudyError, match="holds runs of another study"):
        wl.Study(path).run(tmp_path / "out")
    path.write_text(STUDY.replace("count = 20", "count = 1000000"))
    with pytest.raises(wl.StudyError, match="4000000 runs\n.*yes=True"):
        wl.Study(path).run(tmp_path / "large")
    for given in ({"batch": 0}, {"client": None}):
        arguments: dict[str, Any] = {"client": None, "batch": 1, **given}
        with pytest.raises(wl.StudyError, match=f"{next(iter(given))} is"):
            wl.cluster.run_study(study, tmp_path / "none", **arguments)
    assert not (tmp_path / "none").exists()


def test_a_missing_cluster_package_is_explained(path: Path) -> None:
    code = (
        "import sys; sys.modules['distributed'] = None\n"
        "import wedgelab as wl\n"
        f"try: wl.cluster.run_study({str(path)!r}, client=None)\n"
        "except wl.MissingDependencyError as error: print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "pip install distributed" in done.stdout, done.stdout + done.stderr
