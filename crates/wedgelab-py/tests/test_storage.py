"""limits, input: a study in object storage goes on anywhere, with the same bytes."""

from __future__ import annotations

import io
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import obstore
import pyarrow.parquet as pq
import pytest
import wedgelab as wl
from distributed import Client, LocalCluster
from moto.server import ThreadedMotoServer
from obstore.store import LocalStore, MemoryStore, S3Store

STUDY = """
case = "cdrun_toe_out_0.2_psi_0.012"
sampling = "full_factorial"
[set]
simulation.duration = "0.12 s"
[vary]
friction.column = { from = 0.2, to = 0.6, count = 40 }
"""
Stores = Callable[[], Any]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "friction.toml"
    path.write_text(STUDY)
    return path


@pytest.fixture(params=["memory", "folder", "s3"])
def store(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Any]:
    """An empty store: in memory, a folder, and a bucket of a server that speaks as S3 does."""
    if request.param == "memory":
        yield MemoryStore()
    elif request.param == "folder":
        yield LocalStore(tmp_path / "store", mkdir=True)
    else:
        server = ThreadedMotoServer(ip_address="127.0.0.1", port=0, verbose=False)
        server.start()
        try:
            address = "http://{}:{}".format(*server.get_host_and_port())
            urllib.request.urlopen(urllib.request.Request(f"{address}/bucket", method="PUT")).close()
            yield S3Store(
                "bucket",
                prefix="friction",
                endpoint=address,
                region="us-east-1",
                access_key_id="key",
                secret_access_key="secret",
                client_options={"allow_http": True},
                virtual_hosted_style_request=False,
            )
        finally:
            server.stop()


def names(store: Any) -> list[str]:
    return sorted(meta["path"] for chunk in obstore.list(store) for meta in chunk)


def rows(store: Any) -> list[dict[str, Any]]:
    """The rows of the parts' tables, in their order."""
    tables = [name for name in names(store) if name.startswith("table/")]
    found = [pq.read_table(io.BytesIO(bytes(obstore.get(store, name).bytes()))) for name in tables]
    return [row for table in found for row in table.to_pylist()]


def test_limits_another_machine_goes_on_with_the_same_bytes(path: Path, tmp_path: Path, store: Any) -> None:
    study = wl.Study(path)
    alone = study.run(tmp_path / "alone")

    class Killed(Exception):
        pass

    def kill(done: int, runs: int) -> None:
        if done >= 17:
            raise Killed

    with pytest.raises(Killed):
        study.run(tmp_path / "first", jobs=1, progress=kill, store=store)
    # The first part of 16 runs is complete, and its table is there; of the second one there are records.
    assert "table/part-000000.parquet" in names(store) and "table/part-000001.parquet" not in names(store)
    other = study.run(tmp_path / "second", store=store)
    assert 17 <= other.before < 40
    assert other.table.read_bytes() == alone.table.read_bytes() and other.page.read_bytes() == alone.page.read_bytes()
    parts = [f"part-{part:06}" for part in range(3)]
    tables = [f"table/{part}.parquet" for part in parts]
    assert names(store) == sorted(["index.html", "study.json", *(f"parts/{part}" for part in parts), *tables])
    assert rows(store) == pq.read_table(alone.table).to_pylist()
    assert study.run(tmp_path / "third", store=store).before == 40


def test_limits_a_cluster_sends_now_and_then(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("wedgelab.storage.PAUSE", 0.0)
    store, seen = MemoryStore(), list[int]()
    with (
        LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address=None, processes=False) as cluster,  # type: ignore[no-untyped-call]
        Client(cluster) as client,  # type: ignore[no-untyped-call]
    ):
        look = lambda done, runs: seen.append(len(names(store)))  # noqa: E731
        outcome = wl.cluster.run_study(path, tmp_path / "out", client=client, batch=8, progress=look, store=store)
    # Before it ended there was more than what the study is.
    assert seen[1] > 1 and seen == sorted(seen)
    assert rows(store) == pq.read_table(outcome.table).to_pylist()


def test_input_another_study_and_no_address(path: Path, tmp_path: Path) -> None:
    store = MemoryStore()
    wl.Study(path).run(tmp_path / "out", store=store)
    other = tmp_path / "other.toml"
    other.write_text(STUDY.replace("0.12 s", "0.13 s"))
    with pytest.raises(wl.StudyError, match="holds runs of another study"):
        wl.Study(other).run(tmp_path / "other", store=store)
    for address in ("no address", "s3x://bucket/friction"):
        with pytest.raises(wl.StudyError, match="is no address of object storage: .*"):
            wl.Study(path).run(tmp_path / "out", store=address)
    obstore.put(store, "parts/part-000000", b"what is this")
    assert wl.Study(path).run(tmp_path / "again", store=store).before == 24


def test_analytic_costs_are_those_of_a_sample(path: Path) -> None:
    cost = wl.Study(path).cost(sample=3, jobs=2)
    assert (cost.runs, cost.sample) == (40, 3)
    assert 0.0 < cost.least <= cost.seconds_per_run <= cost.largest
    assert cost.core_hours == pytest.approx(40 * cost.seconds_per_run / 3600) and cost.hours == cost.core_hours / 2
    with pytest.raises(wl.StudyError, match="sample is 0"):
        wl.Study(path).cost(sample=0)
