"""What Python says of runs that mean nothing: a warning that names place, time and limit."""

import pytest

import wedgelab as wl


def test_a_run_that_means_nothing_is_a_warning() -> None:
    case = wl.Case("cdrun_toe_0_psi_0", contact={"stiffness": "1e3 lbf/in"}, simulation={"duration": "0.5 s"})
    with pytest.warns(wl.PlausibilityWarning, match="implausible: ") as caught:
        result = case.run()
    assert caught[0].filename == __file__
    assert "corner of the column penetrates its surface" in str(caught[0].message)
    assert any("the limit is 0.06125 in" in text for text in result.warnings)
