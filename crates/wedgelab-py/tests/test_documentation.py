"""The Python code of the pages runs, block after block, in a folder with the files that it names."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import wedgelab as wl

ROOT = Path(__file__).parents[3]
NUCARS = ROOT / "crates/nucars/data"
YAWED = "bolst_wedge_sf_bolst-vrt-displ-w-yaw_69_const.run"
WHEEL = ROOT / "crates/wheelrail/tests/data/manchester/MBench_S1002_v3.prw"

# Its blocks load FMUs, which the tests of functional mock-up units do.
ELSEWHERE = {"fmi.md"}
# Cars run shorter and at fewer speeds here than a reader has them.
SHORTER = {
    '"speed.value": "18 mph"': '"speed.value": "18 mph", "simulation.duration": "3 s", "start.settle": "1 s"',
    'conditions=["new", "rise_0.75"]': 'conditions=["new", "rise_0.75"], speeds=["60 mph"]',
}
# Needs a cluster; tests of their own start one.
CLUSTER = "\nfrom dask.distributed import Client"


def blocks(page: Path, language: str) -> list[str]:
    """Returns the blocks of code in a language."""
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def with_code() -> list[str]:
    """Returns the names of the pages that have code, the README's first."""
    pages = sorted(page.name for page in (ROOT / "docs").glob("*.md") if blocks(page, "python"))
    return ["../README.md", *(name for name in pages if name not in ELSEWHERE)]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with the files that the pages name."""
    (tmp_path / "my.toml").write_text(wl.Case("cdrun_toe_0_psi_0").to_toml())
    for file in NUCARS.iterdir():
        shutil.copy(file, tmp_path)
    shutil.copy(NUCARS / "sngl_trk_69.dat", tmp_path / "sngl_trk.DAT")
    shutil.copy(NUCARS / "bolst_displ_input36.inp", tmp_path / "bolst_displ_input_36.INP")
    shutil.copy(NUCARS / YAWED, tmp_path / "half_truck.run")
    shutil.copy(NUCARS / "bolst_wedge_sf_69_const.sys", tmp_path / "half_truck.sys")
    shutil.copy(WHEEL, tmp_path / "worn.prw")
    (tmp_path / "my_track.toml").write_text('[[segments]]\ntangent = "500 ft"\n')
    (tmp_path / "my_car.toml").write_text(wl.CarCase("car_twist_and_roll_loaded").to_toml())
    (tmp_path / "my_truck.toml").write_text(wl.TruckCase("truck_warp_nest_constant_rising").to_toml())
    study = 'name = "friction_and_angle"\ncase = "cdrun_toe_0_psi_0"\nsampling = "full_factorial"\n'
    study += '[set]\n"simulation.duration" = "2 s"\n[vary]\n"friction.column" = { from = 0.2, to = 0.4, count = 20 }\n'
    (tmp_path / "friction.toml").write_text(study)
    return tmp_path


@pytest.mark.parametrize("page", with_code())
def test_the_code_of_a_page_runs(page: str, folder: Path) -> None:
    code = [block.split(CLUSTER)[0] for block in blocks(ROOT / "docs" / page, "python")]
    if page == "study.md":
        code = code[::-1]  # the table is read first, and written last
    if page == "python-api.md":
        code = ["from wedgelab import *", *(re.sub("^>>> ", "", block, flags=re.MULTILINE) for block in code)]
    text = "\n".join(code)
    for whole, part in SHORTER.items():
        text = text.replace(whole, part)
    program = folder / "page.py"
    program.write_text(text)
    environment = {"MPLBACKEND": "agg", "PATH": ""}
    done = subprocess.run([sys.executable, program], cwd=folder, capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stderr


def test_the_pages_are_found() -> None:
    assert {"../README.md", "python.md", "study.md", "car.md", "regimes.md"} <= set(with_code())
