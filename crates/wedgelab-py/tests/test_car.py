"""Freight cars on track from Python: cases, runs, many at a time, and what goes wrong."""

import pickle
import warnings

import numpy as np
import pytest

import wedgelab as wl

# Little has been done after 0.1 s, and the ledger is judged by that: a method that does not damp.
SHORT = {"simulation.duration": "0.1 s", "start.settle": "0 s", "simulation.method": "rodas5p"}


def test_values_are_laid_over_a_case() -> None:
    case = wl.CarCase("car_tangent_loaded", {"speed.value": 10.0, "front_truck.friction.column": 0.1})
    document = case.to_dict()
    assert document["front_truck"]["friction"]["column"] == 0.1
    assert document["rear_truck"]["friction"]["column"] == 0.4
    assert document["speed"]["value"] == "10 m/s"
    assert wl.CarCase.parse(case.to_toml()) == case
    assert pickle.loads(pickle.dumps(case)) == case


def test_reproducible_for_any_number_of_workers_and_through_pickle() -> None:
    cases = [wl.CarCase("car_tangent_empty", SHORT | {"speed.value": speed}) for speed in ("20 mph", "30 mph")]
    alone = [case.run() for case in cases]
    for result, speed in zip(alone, (20, 30)):
        values, unit = result.array("speed")
        assert unit == "mph" and abs(values[0] / speed - 1) < 1e-6
    together = wl.run_many(cases, workers=2)
    for a, b in zip(alone, together):
        assert isinstance(b, wl.CarResult)
        assert np.array_equal(a["axle_1_left_vertical"], b["axle_1_left_vertical"])
    again = pickle.loads(pickle.dumps(alone[0]))
    assert np.array_equal(again["body_roll"], alone[0]["body_roll"])
    assert alone[0].summary.assumptions[0].startswith("Out of scope")


def test_input_mistakes_are_case_errors() -> None:
    with pytest.raises(wl.CaseError, match="coasting"):
        wl.CarCase("car_tangent_loaded", {"speed.value": "0 mph"})


# An empty car on rails that jump sideways: a wheel leaves its rail.
JUMP = """
model = "car"
start.settle = "0 s"
lading.kind = "empty"
speed.value = "60 mph"
[[track.segments]]
tangent = "600 ft"
[[track.irregularities]]
shape = "jog"
rails = "both"
direction = "lateral"
offset = "5 in"
length = "3 ft"
start = "70 ft"
[simulation]
duration = "0.4 s"
"""


def test_issue_047_a_derailed_run_is_an_error_that_has_its_result() -> None:
    case = wl.CarCase.parse(JUMP)
    with pytest.raises(wl.RunError, match="derailed at .* and is incomplete: the .* left its rail") as caught:
        case.run()
    result = caught.value.result
    assert result is not None and result.outcome == "derailed" and not result.is_complete
    assert result.derailed is not None and result.stopped is None and result.failed is None
    time, what = result.derailed
    assert time == result["time"][-1] and "left its rail" in what
    assert result.summary.complete is False
    with warnings.catch_warnings():
        # It is implausible, too.
        warnings.simplefilter("ignore")
        kept = case.run(incomplete="keep")
    assert kept.rows == result.rows and repr(kept).endswith("derailed>")
