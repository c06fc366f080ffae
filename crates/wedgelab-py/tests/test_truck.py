"""Three-piece trucks from Python: cases, runs, many at a time, studies, and what goes wrong."""

import pickle
from pathlib import Path

import numpy as np
import pytest

import wedgelab as wl

POUND_FORCE = 4.4482216152605


def test_analytic_bolster_follows_its_motion() -> None:
    case = wl.TruckCase("truck_vertical_variable", {"simulation.duration": "2 s"})
    result = case.run()
    time, z = result.array("time")[0], result["bolster_z"]
    assert np.allclose(z, 0.5 * 0.0254 * np.sin(2 * time), atol=1e-12)
    assert result.summary.ledger.largest_relative_residual < 1e-5
    assert result.is_complete and not result.warnings


def test_values_are_laid_over_one_wedge() -> None:
    values = {"wedge.leading_left.friction.column": 0.1, "friction.slope": 0.3, "simulation.duration": 0.5}
    case = wl.TruckCase("truck_vertical_variable", values)
    document = case.to_dict()
    assert document["wedge"]["leading_left"]["friction"]["column"] == 0.1
    assert document["friction"]["slope"] == 0.3
    assert wl.TruckCase.parse(case.to_toml()) == case
    result = case.run()
    one, other = (abs(result[f"{wedge}_column_friction_z"]).max() for wedge in ("leading_left", "trailing_right"))
    assert one < 0.7 * other


def test_reproducible_for_any_number_of_workers_and_through_pickle() -> None:
    names = ["truck_vertical_constant", "truck_roll_variable"]
    cases = [wl.TruckCase(name, {"simulation.duration": "0.5 s"}) for name in names]
    alone = [case.run() for case in cases]
    for workers in (1, 2):
        together = wl.run_many(cases, workers=workers)
        for a, b in zip(alone, together):
            assert isinstance(b, wl.TruckResult)
            assert (a["bolster_z"] == b["bolster_z"]).all()
            assert (a["leading_left_column_normal"] == b["leading_left_column_normal"]).all()
    again = pickle.loads(pickle.dumps(alone[0]))
    assert (again["bolster_z"] == alone[0]["bolster_z"]).all()
    assert pickle.loads(pickle.dumps(cases[1])) == cases[1]


def test_worn_wedges_have_a_plateau_in_warp() -> None:
    result = wl.TruckCase("truck_warp_nest_constant_rising", {"truck.condition": "mu_0.25"}).run()
    stiffness = result.summary.warp_stiffness
    moments = [stiffness[f"{angle} mrad"].value * angle * 1e-3 for angle in (10, 20)]
    assert moments[1] / moments[0] < 1.15
    assert abs(moments[1] / 225e3 - 1) < 0.05  # lbf in


def test_input_mistakes_are_case_errors() -> None:
    with pytest.raises(wl.CaseError, match="leading_lft"):
        wl.TruckCase("truck_vertical_variable", {"wedge.leading_lft.angle": "30 deg"})
    with pytest.raises(wl.CaseError, match="no built-in truck"):
        wl.TruckCase("truck_vertical_varied")
    with pytest.raises(wl.CaseError, match="single wedge"):
        wl.TruckCase.parse("[wedge]\nangle = '30 deg'")
    with pytest.raises(wl.WedgelabError, match="CarCase or VehicleCase is expected"):
        wl.run_many([1])  # type: ignore[list-item]


def test_results_are_written(tmp_path: Path) -> None:
    result = wl.TruckCase("truck_drop_constant", {"simulation.duration": "0.1 s"}).run()
    names = result.write(tmp_path / "drop")
    assert names == ["result.csv", "result.mat", "case.toml", "summary.json"]
    assert wl.TruckCase(tmp_path / "drop" / "case.toml").name == "truck_drop_constant"


def test_a_study_over_single_wedges(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(
        'case = "truck_vertical_variable"\nsampling = "full_factorial"\n[set]\nsimulation.duration = "4 s"\n'
        "[vary]\nwedge.leading_left.friction.column = [0.2, 0.4]\n"
    )
    outcome = wl.Study(study).run(tmp_path / "out")
    assert outcome.runs == 2 and outcome.table.is_file()
    assert isinstance(wl.Study(study).case(0), wl.TruckCase)
