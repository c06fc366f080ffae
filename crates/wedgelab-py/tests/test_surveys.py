"""Surveys of wedge rise and probabilities: in this process and on a cluster they give the same bytes, whoever dies meanwhile."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import wedgelab as wl
from distributed import Client, LocalCluster

REGIME = """
title = "a dip of the left rail"
source = "made up for a test"
speeds = ["30 mph", "40 mph"]
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
# Subset simulation: what comes next follows from the results before.
PLAN = """
case = "cdrun_toe_out_0.2_psi_0.012"
measure = "peak_side_frame_pitch_moment"
at_most = "4000 lbf in"
method = "subset"
samples = 20
repeats = 4
most_runs = 200
[set]
simulation.duration = "0.1 s"
simulation.relative_tolerance = 1e-4
[uncertain.friction.column]
distribution = "triangular"
from = 0.3
mode = 0.4
to = 0.55
also = ["friction.slope"]
mark = "guess"
"""


@pytest.fixture
def client() -> Iterator[Any]:
    """Two local workers, each a process of its own."""
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,  # type: ignore[no-untyped-call]
        Client(cluster) as client,  # type: ignore[no-untyped-call]
    ):
        yield client


def killer(client: Any, at: int) -> tuple[Any, list[int]]:
    """Kills a worker when so many runs are done."""
    victim = next(iter(client.run(os.getpid).values()))
    killed: list[int] = []

    def kill(done: int, most: int) -> None:
        if not killed and at <= done < most:
            os.kill(victim, signal.SIGKILL)
            killed.append(done)

    return kill, killed


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file() and path.name != ".lock"}


def test_limits_a_probability_on_a_cluster_has_the_same_bytes(tmp_path: Path, client: Any) -> None:
    path = tmp_path / "plan.toml"
    path.write_text(PLAN)
    plan = wl.Probability(path)
    told: list[int] = []
    alone = plan.run(tmp_path / "alone", progress=lambda done, most: told.append(done))
    assert told == sorted(told) and told[-1] == alone.runs <= plan.most == 200
    kill, killed = killer(client, 30)
    together = wl.cluster.run_probability(path, tmp_path / "together", client=client, progress=kill)
    assert killed and files(together.folder) == files(alone.folder)
    assert together.before == 0 and plan.run(tmp_path / "together").before == alone.runs
    low, high = alone.probability
    assert 0.0 < alone.bounds[0] <= low <= high <= alone.bounds[1] <= 1.0 and alone.confidence == 0.95
    with pytest.raises(wl.CaseError, match="distribution"):
        path.write_text(PLAN.replace('"triangular"', '"round"'))
        wl.Probability(path)


def test_limits_a_survey_of_rise_on_a_cluster_has_the_same_bytes(
    tmp_path: Path, client: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("short.toml").write_text(REGIME)
    Path("limits.toml").write_text(LIMITS)

    def survey(runs: int) -> wl.RiseSurvey:
        started = ["start.kind=equilibrium"]
        return wl.RiseSurvey(
            "car_tangent_loaded",
            regimes=["short.toml"],
            limits="limits.toml",
            factors=[],
            to="0.25 in",
            runs=runs,
            set=started,
        )

    alone = survey(4).run(tmp_path / "alone")
    kill, killed = killer(client, 5)
    together = wl.cluster.run_rise(survey(4), tmp_path / "together", client=client, progress=kill)
    assert killed and files(together.folder) == files(alone.folder)
    assert (alone.runs, alone.before, together.before) == (4, 0, 0)
    (answer,) = alone.answers
    assert (answer.limit, answer.condition, answer.kept_up_to_in) == ("load", "as_given", 0.25)
    assert answer.exceeded_from_in is None and answer.runs_without_value == ()
    for wrong, message in (({"to": "2 in"}, "more than the pockets hold"), ({"to": "2 kg"}, "2 kg"), ({"runs": 0}, "runs is 0")):
        with pytest.raises(wl.CaseError, match=message):
            wl.RiseSurvey("car_tangent_loaded", **wrong)
