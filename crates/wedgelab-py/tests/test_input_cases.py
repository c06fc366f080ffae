"""Cases: what may be given, and what is said when it is wrong."""

from __future__ import annotations

import dataclasses
import math
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import wedgelab as wl
from wedgelab import Case, CaseError, Quantity, Sine


def test_names_files_texts_and_keywords_give_the_same_case(tmp_path: Path) -> None:
    by_name = Case("vdrun_toe_0_psi_0")
    file = tmp_path / "vdrun_toe_0_psi_0.toml"
    file.write_text(by_name.to_toml())
    assert Case(file) == Case(str(file)) == Case.read(file) == by_name
    assert Case.parse(by_name.to_toml()) == Case.built_in("vdrun_toe_0_psi_0") == by_name
    assert Case.from_dict(by_name.to_dict()) == by_name
    assert hash(Case(by_name)) == hash(by_name)


def test_a_file_wins_over_a_built_in_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("warp_none").write_text('name = "mine"\n')
    assert Case("warp_none").name == "mine"


def test_bare_numbers_are_si_and_texts_have_units() -> None:
    typed = Case(
        wedge=wl.WedgeSection(angle="30 deg", height="0.15 m"),
        side_frame={"toe": "0.2 deg in"},
        bolster=wl.BolsterSection(vertical=Sine("20 mm", "0.5 Hz")),
        contact={"stiffness": "5e7 N/m"},
    )
    numbers = Case(
        wedge={"angle": math.radians(30.0), "height": np.float64(0.15)},
        side_frame=wl.SideFrameSection(toe=math.radians(-0.2)),
        bolster={"vertical": {"shape": "sine", "amplitude": 0.02, "frequency": math.pi}},
        contact=wl.ContactSection(stiffness=50_000_000),
    )
    a, b = typed.replace({"simulation.duration": 0.2}).run(), numbers.replace({"simulation.duration": 0.2}).run()
    for name in a:
        np.testing.assert_allclose(a[name], b[name], rtol=1e-6, atol=1e-6 * (1.0 + np.abs(a[name]).max()))
    assert numbers.side_frame.toe == f"{math.radians(0.2)} rad in"
    assert typed.wedge.angle == Quantity("30 deg")


def test_sections_are_typed_and_complete() -> None:
    case = Case("cdrun_toe_out_0.2_psi_0.012")
    for name in ("wedge", "control_coil", "contact", "friction", "environment", "simulation"):
        section = getattr(case, name)
        missing = [f.name for f in dataclasses.fields(section) if getattr(section, f.name) is None]
        assert missing in ([], ["table"], ["rise"]), name
    assert case.wedge.damping == "constant"
    assert case.wedge.free_coordinates == ("x", "z", "pitch", "yaw")
    assert isinstance(case.wedge.inertia, tuple) and case.wedge.inertia[0] == Quantity("100 lb in^2")
    assert isinstance(case.bolster.vertical, Sine) and case.bolster.vertical.amplitude == Quantity("1 in")
    assert case.bolster.yaw == wl.Constant(Quantity("0.012 rad"))
    assert case.friction.column == 0.4
    sections = {f: getattr(case, f) for f in ("wedge", "control_coil", "friction", "side_frame", "bolster", "simulation")}
    assert Case(name=case.name, title=case.title, **sections) == case


def test_motions_and_tables(tmp_path: Path) -> None:
    times = np.linspace(0.0, 1.0, 11)
    case = Case(
        bolster=wl.BolsterSection(
            vertical=[wl.Triangle("10 mm", "1 Hz"), wl.SweptSine(0.001, "1 Hz", "5 Hz", "1 s")],
            lateral=wl.Table.of(times, 0.001 * np.sin(times)),
            yaw=wl.Ramp("0.01 rad", "0.1 s", profile="linear"),
        ),
        control_coil=wl.ControlCoilSection(table=np.array([[0.0, 0.0], [0.1, 40e3]])),
        simulation={"duration": 0.1},
    )
    vertical = case.bolster.vertical
    assert isinstance(vertical, tuple) and isinstance(vertical[0], wl.Triangle) and isinstance(vertical[1], wl.SweptSine)
    assert isinstance(case.bolster.lateral, wl.Table)
    assert Case(case, bolster=case.bolster) == case
    assert case.run().is_complete
    # A stiffness replaces a table, and the reverse.
    assert case.replace({"control_coil.stiffness": "3000 lbf/in"}).control_coil.table is None
    (tmp_path / "motion.csv").write_text("time [s], value [in]\n0, 0\n1, 0.1\n2, 0.2\n3, 0.3\n")
    text = '[bolster]\nvertical = { shape = "table", file = "motion.csv" }\n[simulation]\nduration = "1 s"\n'
    from_file = Case.parse(text, folder=tmp_path)
    assert pickle.loads(pickle.dumps(from_file)) == from_file


def test_replace_changes_what_is_named_and_nothing_else() -> None:
    case = Case("vdrun_toe_0_psi_0")
    softer = case.replace({"friction.column": 0.3, "wedge.angle": "35 deg"}, name="softer")
    assert (softer.name, softer.friction.column, softer.wedge.angle) == ("softer", 0.3, Quantity("35 deg"))
    back = softer.replace({"friction.column": 0.4, "wedge.angle": "32 deg", "name": case.name})
    assert back == case
    assert case.replace() == case


def test_cases_pickle_as_their_toml() -> None:
    case = Case("warp_none" if "warp_none" in wl.built_in()["warp"].cases else "vdrun_toe_0_psi_0")
    again = pickle.loads(pickle.dumps(case))
    assert again == case and again.run().summary.to_dict() == case.run().summary.to_dict()
    assert case.to_toml().encode() in pickle.dumps(case)


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"wedge": {"angle": "3 in"}}, "an angle is expected"),
    ({"wedge": {"angle": "32 degree"}}, "did you mean deg"),
    ({"wedge": {"angel": "32 deg"}}, "did you mean `angle`"),
    ({"wedge": {"angle": 32.0}}, "between 0 deg and 90 deg"),
    ({"wedge": {"angle": math.nan}}, "not a finite number"),
    ({"wedge": {"height": math.inf}}, "not a finite number"),
    ({"wedge": {"height": -1}}, "greater than zero"),
    ({"wedge": {"angle": 1j}}, "is a complex"),
    ({"wedge": {"angle": object()}}, "is a object"),
    ({"wedge": {"angle": [1, 2]}}, "is a list"),
    ({"wedge": {"angle": True}}, "true or false"),
    ({"wedge": {"inertia": np.ones((2, 2))}}, "three are expected"),
    ({"wedge": {"damping": "both"}}, "one of"),
    ({"wedge": 3}, "a table is expected"),
    ({"wedge": {3: 4}}, "which is no text"),
    ({"wedge": wl.ContactSection()}, "a WedgeSection is expected"),
    ({"contact": {"stiffness": "5e7 N"}}, "a stiffness is expected"),
    ({"friction": {"column": "0.4 deg"}}, "a number without quotes"),
    ({"friction": {"column": 10**400}}, "column"),
    ({"side_frame": {"toe": 1.0}}, "22.5 deg"),
    ({"side_frame": {"toe": "0.2 deg"}}, "in or out"),
    ({"bolster": {"vertical": wl.Sine("1 in", -2.0)}}, "greater than zero"),
    ({"bolster": {"vertical": {"shape": "cosine"}}}, "cosine"),
    ({"bolster": {"vertical": wl.Table.of([0, 1, 2], [0, 0, 0])}}, "at least 4"),
    ({"bolster": {"vertical": []}}, "empty sum"),
    ({"simulation": {"duration": "-1 s"}}, "greater than zero"),
    ({"simulation": {"output_units": "metric"}}, '"us", "si"'),
    ({"name": "a/b"}, "folder"),
]


@pytest.mark.parametrize(("given", "said"), WRONG, ids=[str(i) for i in range(len(WRONG))])
def test_wrong_values_are_explained(given: dict[str, Any], said: str) -> None:
    with pytest.raises(CaseError) as caught:
        Case(**given)
    text = str(caught.value)
    assert said in text, text
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, wl.WedgelabError)
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == text and again.problems == caught.value.problems


def test_errors_carry_what_the_command_line_shows() -> None:
    with pytest.raises(CaseError) as caught:
        Case.parse('[wedge]\nangle = "3 in"\nheigth = "6 in"\n', source="my.toml")
    error = caught.value
    assert [(p.source, p.line, p.column, p.marked) for p in error.problems] == [
        ("my.toml", 2, 12, "in"),
        ("my.toml", 3, 1, "heigth"),
    ]
    assert error.problems[0].label == "not an angle" and "height" in (error.problems[1].help or "")
    for part in ("the case has 2 mistakes", "my.toml:2", '2 │ angle = "3 in"', "help: did you mean `height`?"):
        assert part in str(error), str(error)


def test_unknown_names_and_files(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="did you mean vdrun_toe_0_psi_0"):
        Case("vdrun_toe_0_psi_00")
    with pytest.raises(CaseError, match=r"wedgelab.built_in\(\) lists all"):
        Case("nothing")
    with pytest.raises(CaseError, match="there is no case file"):
        Case("nothing.toml")
    with pytest.raises(CaseError, match="is a folder"):
        Case(tmp_path)
    with pytest.raises(CaseError, match="this is not TOML"):
        Case.parse("[wedge")
    (tmp_path / "latin.toml").write_bytes(b"\xff\xfe\xfa")
    with pytest.raises(CaseError, match="is not text"):
        Case(tmp_path / "latin.toml")
    with pytest.raises(CaseError, match="cannot be made from a int"):
        Case(3)  # type: ignore[arg-type]
    with pytest.raises(CaseError, match="is set twice|set one of them"):
        Case().replace({"friction.column": 0.3, "friction.column.x": 0.2})
    with pytest.raises(CaseError, match="given twice"):
        Case().replace({"friction.column": 0.3}, friction={"slope": 0.2})
    with pytest.raises(TypeError):
        Case(wedgee={})  # type: ignore[call-arg]


def test_quantities() -> None:
    stiffness = Quantity("3000 lbf/in")
    assert (stiffness.value, stiffness.unit, str(stiffness)) == (3000.0, "lbf/in", "3000 lbf/in")
    assert stiffness.si == pytest.approx(525380.505739429, rel=1e-12)
    assert stiffness.to("N/mm") == pytest.approx(525.380505739429, rel=1e-12)
    assert Quantity(1, "in") == Quantity("25.4 mm") and hash(Quantity("1 in")) == hash(Quantity("25.4 mm"))
    assert Quantity("1 in") < Quantity("1 ft") and Quantity("1 in") != Quantity("1 s")
    assert pickle.loads(pickle.dumps(stiffness)) == stiffness and float(stiffness) == stiffness.si
    for wrong in ("3 foos", "", "3", "x in", "1e999 in"):
        with pytest.raises(wl.UnitError):
            Quantity(wrong)
    with pytest.raises(wl.UnitError, match="cannot be expressed"):
        stiffness.to("s")
    with pytest.raises(wl.UnitError, match=r"\^\^\^\^"):
        Quantity("3 foos")
    with pytest.raises(TypeError):
        Quantity([1])  # type: ignore[arg-type]
    with pytest.raises(TypeError):
        _ = Quantity("1 in") < Quantity("1 s")


def test_a_panic_becomes_an_exception(capfd: pytest.CaptureFixture[str]) -> None:
    from wedgelab import _wedgelab

    with pytest.raises(wl.InternalError, match="on purpose"):
        _wedgelab._fail_inside()
    assert Case().name == "case"
    capfd.readouterr()


def test_issue_036_names_of_built_in_cases_are_understood() -> None:
    for kind, name, help_text in [
        (wl.Case, "vdrun_toe_0_psi_1", "did you mean vdrun_toe_0_psi_0?"),
        (wl.Case, "vdrun_toe", "did you mean vdrun_toe_0_psi_0?"),
        (wl.Case, "truck_vertical_variable", "`TruckCase` takes it"),
        (wl.Case, "nucars_69_constant_toe_out", "`HalfTruckCase` takes it"),
        (wl.TruckCase, "truck_vertcal_variable", "did you mean truck_vertical_variable?"),
        (wl.TruckCase, "vdrun_toe_0_psi_0", "`Case` takes it"),
        (wl.CarCase, "car_hunting_emty", "did you mean car_hunting_empty?"),
        (wl.CarCase, "truck_vertical_variable", "`TruckCase` takes it"),
    ]:
        with pytest.raises(wl.CaseError) as caught:
            kind(name)
        assert help_text in str(caught.value), str(caught.value)
    with pytest.raises(wl.WedgelabError, match="did you mean nucars_69_constant_toe_out"):
        wl.HalfTruckCase("nucars_69_constant_toe_ut")
