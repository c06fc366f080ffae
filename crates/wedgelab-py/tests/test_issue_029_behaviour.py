"""Issue 29: values that ended the interpreter, or never ended."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

import pytest
import wedgelab as wl
from wedgelab import Case, CaseError, Quantity


@pytest.mark.parametrize("pairs", [17, 1000, 100_000, 1_000_000])
def test_issue_029_brackets_in_units(pairs: int) -> None:
    text = "32 " + "(" * pairs + "deg" + ")" * pairs
    with pytest.raises(wl.WedgelabError) as wrong:
        Quantity(text)
    assert len(str(wrong.value)) < 2000
    with pytest.raises(CaseError):
        Case(wedge={"angle": text})


def test_issue_029_a_list_that_holds_itself() -> None:
    itself: list[Any] = []
    itself.append(itself)
    with pytest.raises(CaseError, match="nested more than 16 deep"):
        Case(bolster={"vertical": itself})
    mapping: dict[str, Any] = {}
    mapping["wedge"] = mapping
    with pytest.raises(CaseError, match="nested more than 16 deep"):
        Case.from_dict(mapping)


def test_issue_029_an_iterator_that_never_ends() -> None:
    with pytest.raises(CaseError, match="more than 1000000 values"):
        Case(bolster={"vertical": itertools.count()})


def test_issue_029_at_most_20_mistakes_are_told() -> None:
    with pytest.raises(CaseError, match="the case has 3000 mistakes; the first 20 are") as wrong:
        Case.from_dict({f"key_{number}": 1 for number in range(3000)})
    assert len(wrong.value.problems) == 20 and len(str(wrong.value)) < 20_000


def test_issue_029_files_of_another_kind(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text('case = "vdrun_toe_0_psi_0"\nsampling = "list"\n')
    with pytest.raises(CaseError, match="is a study file; a case file is expected"):
        Case.read(study)
    with pytest.raises(CaseError, match="is not text"):
        Case.read("/dev/zero")


def test_issue_029_values_that_overflow() -> None:
    with pytest.raises(CaseError, match="at most 1e3 m"):
        Case("vdrun_toe_0_psi_0", bolster={"vertical": "1e308 in"})
