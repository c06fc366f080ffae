"""Issue 29: saved states, results and cases that were edited by hand are refused with a reason, or are what they say."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
import wedgelab as wl
from wedgelab import nucars, result
from wedgelab.errors import InternalError

# Numbers, texts, lists and maps of MessagePack that claim to be long, and what is none.
BYTES = [0x00, 0x7F, 0xC0, 0xC1, 0xCB, 0xCF, 0xDB, 0xDD, 0xDF, 0xFF]
CLAIMS = [struct.pack(">BI", kind, 0xFFFF_FFFF) for kind in (0xC6, 0xDB, 0xDD, 0xDF)] + [b"\xcf" + b"\xff" * 8]
MOST = 64 << 20


def damaged(data: bytes, places: int) -> Iterator[bytes]:
    """The bytes with something else at so many places, or cut off there."""
    for at in range(0, len(data), max(len(data) // places, 1)):
        yield data[:at]
        for byte in BYTES:
            yield data[:at] + bytes([byte]) + data[at + 1 :]
        for claim in CLAIMS:
            yield data[:at] + claim + data[at + len(claim) :]


def tally(all_damaged: Iterator[bytes], use: Callable[[bytes], object]) -> tuple[int, int]:
    """How many were refused, with a reason, and how many were not."""
    refused = taken = 0
    for data in all_damaged:
        try:
            use(data)
            taken += 1
        except wl.WedgelabError as error:
            assert not isinstance(error, InternalError), str(error)
            assert 20 < len(str(error)) < 2000
            refused += 1
    return refused, taken


def test_results_edited_by_hand(short: wl.Result) -> None:
    header, values = short._native.parts()
    case = short.case.to_toml()

    def use(data: bytes) -> None:
        again = result._result_of_parts("wedge", case, data, values)
        again.summary.to_dict()
        assert len(again.to_dict()) == len(again.keys())
        assert repr(again)

    refused, taken = tally(damaged(header, 200), use)
    assert refused > 1000 and taken > 50
    with pytest.raises(wl.WedgelabError, match="columns and values differ"):
        result._result_of_parts("wedge", case, header, values[1:])
    with pytest.raises(wl.WedgelabError, match=f"more than the {MOST} that are read"):
        result._result_of_parts("wedge", case, bytes(MOST + 1), np.zeros((0, 0)))


def test_trucks_edited_by_hand() -> None:
    case = wl.nucars.HalfTruckCase("nucars_68_variable_toe_in", duration=0.1)
    saved = case._native.saved()

    def use(data: bytes) -> None:
        again = nucars._half_truck_case(data)
        assert again.duration > 0.0 and again.assumptions and repr(again)

    refused, taken = tally(damaged(saved, 60), use)
    assert refused > 500 and taken > 5
    with pytest.raises(wl.WedgelabError, match=f"more than the {MOST} that are read"):
        nucars._half_truck_case(bytes(MOST + 1))


def test_states_of_wedges_edited_by_hand() -> None:
    wedge = wl.Wedge("cdrun_toe_out_0.2_psi_0.012")
    wedge.step(wl.Motion({"vertical": 1e-4}), 1e-3)
    good = wedge.save()

    def refuse(reason: str, edit: Callable[[Any], None]) -> None:
        state = json.loads(good)
        edit(state)
        with pytest.raises(wl.StepError, match=reason):
            wedge.restore(json.dumps(state).encode())

    refuse("statistics.steps", lambda state: state["integrator"]["statistics"].update(steps=2**64 - 1))
    refuse("contact state of corner 1", lambda state: state["integrator"]["discrete_states"].__setitem__(1, 3))
    refuse("time of the saved state is -1", lambda state: state["integrator"].update(time=-1.0))
    refuse("proposed_step", lambda state: state["integrator"].update(proposed_step=0.0))
    with pytest.raises(wl.StepError, match=f"more than the {MOST} that are read"):
        wedge.restore(b" " * (MOST + 1))
    wedge.restore(good)
    assert wedge.save() == good
