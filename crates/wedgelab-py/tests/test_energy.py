"""What Python says of energy ledgers that do not close: a warning above 1e-3, an error above 1e-2 that has the result."""

import warnings

import pytest

import wedgelab as wl


def loose(tolerance: float) -> wl.Case:
    settings = {"method": "tr-bdf2", "relative_tolerance": tolerance}
    return wl.Case("vdrun_toe_0_psi_0.012", simulation=settings)


def test_a_ledger_that_closes_badly_is_a_warning() -> None:
    with pytest.warns(wl.EnergyWarning, match="the energy ledger does not close") as caught:
        result = loose(1e-3).run()
    assert caught[0].filename == __file__
    assert 1e-3 < result.summary.ledger.largest_relative_residual <= 1e-2
    assert result.is_complete and result.failed is None
    assert any("does not close" in text for text in result.warnings)


def test_a_ledger_that_does_not_close_is_an_error_with_the_result() -> None:
    with pytest.raises(wl.RunError, match="has failed: the energy ledger does not close") as caught:
        loose(1e-2).run()
    result = caught.value.result
    assert result is not None and result.rows == 1001 and result.failed is not None
    with pytest.warns(wl.EnergyWarning):
        kept = loose(1e-2).run(incomplete="keep")
    assert kept.failed == result.failed
    with pytest.raises(wl.RunError) as caught:
        wl.run_many([loose(1e-6), loose(1e-2)], progress=False)
    assert isinstance(caught.value.results[0], wl.Result)


def test_a_sound_run_says_nothing() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert loose(1e-6).run().failed is None
