"""Assessments: in this process and on a cluster they give the same bytes; limits are what their files say."""

from __future__ import annotations

import os
import pickle
import signal
from pathlib import Path
from typing import Any

import pytest
import wedgelab as wl
from distributed import Client, LocalCluster

REGIME = """
title = "a dip of the left rail"
source = "made up for a test"
speeds = ["30 mph", "35 mph", "40 mph", "45 mph"]
range = ["20 mph", "50 mph"]
reason = "the dip is short"
distance = "50 ft"
settle = "5 ft"
[track]
segments = [{ tangent = "400 ft" }]
[[track.irregularities]]
shape = "dip"
rails = "left"
direction = "vertical"
depth = "0.3 in"
length = "20 ft"
start = "55 ft"
"""
LIMITS = """
title = "ours"
source = "made up"
[[limits]]
name = "load"
quantity = "least wheel load"
measure = "least_load_time"
regimes = "all"
at_least = "5 %"
"""
FILES = ["assessment.csv", "assessment.parquet", "assessment.json", "table.parquet", "index.html"]


@pytest.fixture
def assessment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> wl.Assessment:
    monkeypatch.chdir(tmp_path)
    Path("short.toml").write_text(REGIME)
    Path("limits.toml").write_text(LIMITS)
    return wl.Assessment("car_tangent_loaded", regimes=["short.toml"], limits="limits.toml")


def test_limits_a_cluster_that_loses_a_worker_gives_the_same_bytes(
    assessment: wl.Assessment, tmp_path: Path
) -> None:
    alone = assessment.run(tmp_path / "alone", jobs=2)
    assert (alone.runs, alone.before, len(alone.verdicts)) == (4, 0, 1)
    (verdict,) = alone.verdicts
    assert (verdict.regime, verdict.limit, verdict.verdict, verdict.unit) == ("short", "load", "kept", "%")
    assert verdict.value is not None and 20.0 < verdict.value < 100.0
    assert verdict.margin == pytest.approx((verdict.value - 5.0) / (100.0 - 5.0))
    # The worst run's own statistics say the same.
    assert verdict.run is not None
    run = assessment.study.case(verdict.run).run()
    least = [own for name, own in run.summary.statistics.items() if name.endswith("_least_load_time")]
    assert min(own.filtered.value for own in least) == pytest.approx(verdict.value, rel=1e-9)

    killed: list[int] = []
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,  # type: ignore[no-untyped-call]
        Client(cluster) as client,  # type: ignore[no-untyped-call]
    ):
        victim = next(iter(client.run(os.getpid).values()))

        def kill(done: int, runs: int) -> None:
            if not killed:
                os.kill(victim, signal.SIGKILL)
                killed.append(done)

        together: Any = wl.cluster.run_assessment(assessment, tmp_path / "together", client=client, progress=kill)
    assert killed and together.before == 0
    for file in FILES:
        assert (alone.folder / file).read_bytes() == (together.folder / file).read_bytes(), file
    assert assessment.run(tmp_path / "together").before == 4


def test_input_mistakes_are_explained(assessment: wl.Assessment) -> None:
    assert pickle.loads(pickle.dumps(assessment.study)).count == 4
    for arguments, said in [
        ({"regimes": ["hunting"], "speeds": ["200 mph"]}, "not for 200 mph"),
        ({"regimes": ["hunting"], "speeds": ["200"]}, "200"),
        ({"regimes": ["huntin"]}, "no regime"),
        ({"conditions": ["wornn"]}, "no condition"),
        ({"limits": "aar"}, "no limits"),
        ({"set": ["truck.friction.colum=0.3"]}, "colum"),
    ]:
        with pytest.raises(wl.CaseError, match=said):
            wl.Assessment("car_tangent_loaded", **arguments)  # type: ignore[arg-type]


def test_older_names_are_taken_with_a_warning() -> None:
    with pytest.warns(DeprecationWarning, match="called Assessment now"):
        assert wl.Certificate is wl.Assessment
    with pytest.warns(DeprecationWarning, match="called run_assessment now"):
        assert wl.cluster.run_certificate is wl.cluster.run_assessment
    with pytest.raises(AttributeError, match="no attribute 'Certificates'"):
        wl.Certificates  # noqa: B018
