"""The wedge in a loop of one's own."""

from __future__ import annotations

import math
import pickle
import subprocess
import sys
from typing import Any

import numpy as np
import pytest
import wedgelab as wl
from wedgelab import Motion, StepError, Wedge

YAWED = "cdrun_toe_out_0.2_psi_0.012"


def bolster(time: float) -> Motion:
    """The thesis's motion: 1 in at 2 rad/s, yaw held."""
    return Motion(
        {"vertical": 0.0254 * math.sin(2.0 * time), "yaw": 0.012}, {"vertical": 0.0508 * math.cos(2.0 * time)}
    )


def drive(wedge: Wedge, count: int, step: float = 1e-3) -> list[wl.Forces]:
    """Steps along the thesis's motion."""
    first = round(wedge.time / step)
    return [wedge.step(bolster(step * (first + k + 1)), step) for k in range(count)]


def test_reproduction_of_a_run() -> None:
    run = wl.Case(YAWED).replace({"simulation.duration": "4 s", "simulation.output_interval": 0.01}).run()
    wedge = Wedge(wl.Case(YAWED), bolster=bolster(0.0))
    vertical = [wedge.outputs["vertical_wedge_force"]]
    for _ in range(400):
        drive(wedge, 10)
        vertical.append(wedge.outputs["vertical_wedge_force"])
    # After the first half period both follow the same loop; events fall at slightly other times.
    after = run["time"] > 1.6
    difference = np.abs(np.array(vertical)[after] - run["vertical_wedge_force"][after])
    assert difference.mean() < 0.005 * np.abs(run["vertical_wedge_force"]).max()


def test_forces_are_those_of_the_outputs() -> None:
    wedge = Wedge(YAWED, bolster=bolster(0.0))
    forces = drive(wedge, 200)[-1]
    out = wedge.outputs
    assert forces.on_bolster[2] == pytest.approx(out["net_force_on_bolster_z"], rel=1e-9)
    assert forces.on_side_frame[0] == pytest.approx(out["net_force_on_side_frame_x"], rel=1e-9)
    assert forces.coil_force == pytest.approx(out["coil_force"], rel=1e-12)
    assert min(forces.normal_forces) > 0.0 and min(forces.friction_losses) >= 0.0
    assert wedge.time == pytest.approx(0.2) and out["time"] == wedge.time
    assert wedge.bolster.position[2] == pytest.approx(0.0254 * math.sin(0.4))  # type: ignore[index]


def test_saved_states_go_on_with_the_same_bits(tmp_path: Any) -> None:
    wedge = Wedge(YAWED, bolster=bolster(0.0))
    drive(wedge, 150)
    state = wedge.save()
    first = drive(wedge, 50)
    wedge.restore(state)
    again = drive(wedge, 50)
    other = Wedge(YAWED)
    other.restore(state)
    third = drive(other, 50)
    for a, b, c in zip(first, again, third):
        for name in ("on_bolster", "moment_on_bolster", "on_side_frame", "moment_on_side_frame"):
            assert np.array_equal(getattr(a, name), getattr(b, name)) and np.array_equal(getattr(a, name), getattr(c, name))
    assert pickle.loads(pickle.dumps(wedge)).outputs == wedge.outputs
    (tmp_path / "state").write_bytes(state)
    code = (
        "import sys, wedgelab as wl\n"
        f"w = wl.Wedge({YAWED!r}); w.restore(open(sys.argv[1], 'rb').read())\n"
        "print(repr(w.step({'vertical': 0.0075, 'yaw': 0.012}, 1e-3).on_bolster.tolist()))"
    )
    printed = subprocess.run([sys.executable, "-c", code, str(tmp_path / "state")], capture_output=True, text=True, check=True)
    wedge.restore(state)
    assert printed.stdout.strip() == repr(wedge.step({"vertical": 0.0075, "yaw": 0.012}, 1e-3).on_bolster.tolist())


def test_texts_have_units_and_names_may_be_left_out() -> None:
    a, b = Wedge(YAWED), Wedge(YAWED)
    start = a.bolster.position
    assert start[5] == 0.012  # type: ignore[index]
    x = a.step({"vertical": "1 mm", "yaw": "0.012 rad"}, "1 ms")
    y = b.step(np.array([0.0, 0.0, 0.001, 0.0, 0.0, 0.012]), 0.001, side_frame_motion=[0.0] * 6)
    assert np.array_equal(x.on_bolster, y.on_bolster)
    assert a.bolster.rate[2] == pytest.approx(1.0)  # type: ignore[index]


def test_coil_and_friction_from_outside() -> None:
    wedge = Wedge(YAWED, bolster=bolster(0.0))
    wedge.set_coil(force="1000 lbf")
    wedge.set_friction(0.0, 0.0)
    forces = drive(wedge, 20)[-1]
    assert forces.coil_force == pytest.approx(4448.2216152605) and forces.friction_losses == (0.0, 0.0)
    wedge.set_coil(stiffness=1e5)
    assert wedge.forces.coil_force == pytest.approx(1e5 * wedge.forces.coil_compression)
    wedge.set_coil()
    assert wedge.forces.coil_force == pytest.approx(wedge.outputs["coil_force"])


@pytest.mark.parametrize(
    ("motion", "dt", "said"),
    [
        ({}, 0.0, "must be positive"),
        ({}, -1e-3, "must be positive"),
        ({}, math.nan, "must be positive"),
        ({}, math.inf, "must be positive"),
        ({}, "1 in", "a time is expected"),
        ({}, None, "dt is None; a time is expected"),
        ({"vertical": math.nan}, 1e-3, "must be finite"),
        ({"vertical": "1 s"}, 1e-3, "the bolster, vertical: .*a length is expected"),
        ({"heave": 1.0}, 1e-3, "has no 'heave'"),
        ({"vertical": None}, 1e-3, "a length is expected"),
        ([0.0] * 5, 1e-3, "six are expected"),
        (np.zeros((2, 3)), 1e-3, "six values are expected"),
        ("up", 1e-3, "six values are expected"),
        (3.0, 1e-3, "six values are expected"),
        (Motion([0.0] * 6, [math.inf] * 6), 1e-3, "must be finite"),
    ],
)
def test_input_leaves_the_wedge_as_it_was(motion: Any, dt: Any, said: str) -> None:
    wedge = Wedge(YAWED)
    before = wedge.save()
    with pytest.raises((StepError, wl.UnitError), match=said):
        wedge.step(motion, dt)
    assert wedge.save() == before


def test_input_of_other_calls() -> None:
    wedge = Wedge(YAWED)
    for state, said in ((b"", "no saved state"), (b"{}", "no saved state"), ("text", "is bytes"), (None, "is bytes")):
        with pytest.raises(StepError, match=said):
            wedge.restore(state)  # type: ignore[arg-type]
    with pytest.raises(StepError, match="other parameters"):
        wedge.restore(Wedge("vdrun_toe_0_psi_0").save())
    with pytest.raises(StepError, match="give one|both"):
        wedge.set_coil(stiffness=1.0, force=1.0)
    for column in (-0.1, math.nan):
        with pytest.raises(StepError, match="zero or positive"):
            wedge.set_friction(column, 0.4)
    with pytest.raises(StepError, match="zero or positive"):
        wedge.set_coil(stiffness=-1.0)
    with pytest.raises(wl.UnitError):
        wedge.set_coil(stiffness="3 N")
    with pytest.raises(wl.UnitError, match="column"):
        wedge.set_friction("a lot", 0.4)  # type: ignore[arg-type]
    with pytest.raises(wl.CaseError):
        Wedge("nothing")


def test_issue_048_a_refused_step_changes_nothing() -> None:
    wedge, fresh = Wedge(YAWED), Wedge(YAWED)
    # Places in inches, given as if they were metres.
    with pytest.raises(StepError, match="at most 1 m"):
        wedge.step({"vertical": 10.0, "longitudinal": -5.0}, 1e-3)
    with pytest.raises(StepError, match="1e-300 s"):
        wedge.step({}, 1e-300)
    assert wedge.time == 0.0
    assert (wedge.step(bolster(1e-3), 1e-3).on_bolster == fresh.step(bolster(1e-3), 1e-3).on_bolster).all()


def test_after_a_failed_step_a_state_helps() -> None:
    wedge = Wedge(YAWED)
    state = wedge.save()
    with pytest.raises(StepError, match="not finite"):
        wedge.step(Motion({"vertical": 0.0}, {"vertical": 1e300}), 1e-3)
    with pytest.raises(StepError, match="earlier step failed"):
        wedge.step({}, 1e-3)
    wedge.restore(state)
    assert np.isfinite(wedge.step({"yaw": 0.012}, 1e-3).on_bolster).all()
