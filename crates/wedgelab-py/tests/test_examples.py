"""The examples run, and print what they promise."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[3] / "examples"

# The one for FMPy runs with the tests of functional mock-up units.
OUTPUT = {
    "first_run.py": "friction energy a cycle at the side frame: +[0-9.]+ lbf·in",
    "truck_on_a_rig.py": "worn: column load of a wedge [0-9]+ to [0-9]+ lbf",
    "warp_curve.py": "friction 0.25: largest moment [0-9]+ kip in",
    "car_on_a_curve.py": "axle 4, right: V +[0-9]+ lbf",
    "study.py": "0.4 +35.0 +[0-9.]+",
    "fit.py": "column 0.3200, slope 0.2700; misfit before this step 0.0[0-9] N",
    "coupling.py": "turning points, mm: -[0-9.]+, ",
    "reading_nucars.py": "wedge 127: friction [0-9.]+ lbf while the body rises, -[0-9.]+ lbf",
}


def test_every_example_is_listed() -> None:
    assert {path.name for path in EXAMPLES.glob("*.py")} == {*OUTPUT, "fmu_in_fmpy.py"}
    listed = (EXAMPLES / "README.md").read_text(encoding="utf-8")
    assert all(f"[{name}]({name})" in listed for name in [*OUTPUT, "fmu_in_fmpy.py"])


@pytest.mark.parametrize("name", OUTPUT)
def test_an_example_runs(name: str, tmp_path: Path) -> None:
    command = [sys.executable, str(EXAMPLES / name)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, env={"MPLBACKEND": "agg", "PATH": ""})
    assert done.returncode == 0, done.stderr
    assert re.search(OUTPUT[name], done.stdout), done.stdout
