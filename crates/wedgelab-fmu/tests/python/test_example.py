"""The example for FMPy."""

import re
import subprocess
import sys
from pathlib import Path

EXAMPLE = Path(__file__).parents[4] / "examples" / "fmu_in_fmpy.py"


def test_the_example_runs(fmus):
    done = subprocess.run([sys.executable, EXAMPLE, fmus("2")], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    low, high = map(int, re.search(r"bolster: (-?\d+) to (-?\d+) N", done.stdout).groups())
    # Constant damping: thousands of newtons either way of the load.
    assert high - low > 5000, done.stdout
