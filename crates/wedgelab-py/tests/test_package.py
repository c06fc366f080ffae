"""The package as it is installed: types, stubs, optional packages, the notebooks."""

from __future__ import annotations

import subprocess
import sys
from importlib import metadata
from pathlib import Path

import nbformat
import pytest
import wedgelab as wl
from nbclient import NotebookClient

NOTEBOOKS = sorted((Path(__file__).parent.parent / "notebooks").glob("*.ipynb"))


def test_the_package_is_typed_and_has_its_version() -> None:
    folder = Path(wl.__file__).parent
    assert (folder / "py.typed").is_file() and (folder / "_wedgelab.pyi").is_file()
    assert metadata.version("wedgelab") == wl.__version__
    assert all(getattr(wl, name).__doc__ for name in wl.__all__ if name not in ("COORDINATES", "__version__"))


@pytest.mark.parametrize("package", ["pandas", "xarray", "matplotlib"])
def test_missing_packages_are_explained(package: str) -> None:
    code = (
        f"import sys; sys.modules[{package!r}] = None\n"
        "import wedgelab as wl\n"
        "result = wl.Case('cdrun_toe_0_psi_0.012').replace({'simulation.duration': 0.05}).run()\n"
        "calls = {'pandas': result.to_pandas, 'xarray': result.to_xarray, 'matplotlib': result.plot_hysteresis}\n"
        f"try: calls[{package!r}]()\n"
        "except wl.MissingDependencyError as error: print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert f"pip install {package}" in done.stdout, done.stdout + done.stderr


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_notebooks_run(path: Path) -> None:
    notebook = nbformat.read(path, as_version=4)  # type: ignore[no-untyped-call]
    NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    images = [o for cell in notebook.cells for o in cell.get("outputs", []) if "image/png" in o.get("data", {})]
    assert len(images) >= 2


def test_there_is_a_notebook() -> None:
    assert NOTEBOOKS
