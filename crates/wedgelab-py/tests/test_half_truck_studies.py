"""Half-trucks: values set over their files, and studies of them."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest
import wedgelab as wl

STUDY = """
case = "nucars_69_constant_toe_out"
sampling = "list"
[set]
simulation.duration = "0.3 s"
[[variants]]
wedges.column_friction = 0.3
[[variants]]
wedges.column_friction = 0.45
"""


def test_values_set_over_the_files_count() -> None:
    case = wl.HalfTruckCase("nucars_69_constant_toe_out", duration="0.3 s", set={"wedges.column_friction": 0.3})
    assert any("wedges.column_friction=0.3" in line for line in case.assumptions)
    other = wl.HalfTruckCase("nucars_69_constant_toe_out", duration="0.3 s")
    column = "wedge_127_column_friction"
    assert abs(case.run()[column]).max() < 0.9 * abs(other.run()[column]).max()
    with pytest.raises(wl.NucarsError, match="did you mean column_friction"):
        wl.HalfTruckCase("nucars_69_constant_toe_out", set={"wedges.column_fricton": 0.3})


def test_studies_of_half_trucks_are_those_of_their_runs(tmp_path: Path) -> None:
    (tmp_path / "half.toml").write_text(STUDY)
    study = pickle.loads(pickle.dumps(wl.Study(tmp_path / "half.toml")))
    assert study.count == 2
    assert "wedge_127_largest_column_normal_force_lbf" in study.columns
    outcome = study.run(tmp_path / "half")
    assert outcome.complete == 2
    case = study.case(1)
    assert isinstance(case, wl.HalfTruckCase)
    assert case.duration == 0.3
    assert any("wedges.column_friction=0.45" in line for line in case.assumptions)
