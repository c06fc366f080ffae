"""What tests share: short runs, made once."""

from __future__ import annotations

import matplotlib

matplotlib.use("Agg")

import pytest
import wedgelab as wl

SHORT = {"simulation.duration": "0.5 s"}
YAWED = "cdrun_toe_out_0.2_psi_0.012"


@pytest.fixture(scope="session")
def short_case() -> wl.Case:
    """Half a second of a yawed run."""
    return wl.Case(YAWED).replace(SHORT)


@pytest.fixture(scope="session")
def short(short_case: wl.Case) -> wl.Result:
    """What comes out of it."""
    return short_case.run()


@pytest.fixture(scope="session")
def yawed() -> wl.Result:
    """A whole run of the thesis, yawed."""
    return wl.Case(YAWED).run()
