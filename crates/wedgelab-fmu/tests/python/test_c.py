"""A program in C that loads the library of an FMU and calls every function of the standard's headers, in order and out of order; by
itself, under Valgrind, and with AddressSanitizer in the program.
"""

import re
import shutil
import subprocess
from pathlib import Path

import fmpy
import pytest
from conftest import CASE, PORTABLE, STEP
from test_state import Wedge

SOURCES = Path(__file__).resolve().parent.parent / "c"
HEADERS = Path(fmpy.__file__).parent / "c-code"
VALGRIND = [
    "valgrind",
    "--quiet",
    "--error-exitcode=9",
    "--leak-check=full",
    "--errors-for-leak-kinds=definite,indirect,possible",
    "--num-callers=30",
]
OUTPUTS = [
    "force_on_bolster_x",
    "force_on_bolster_z",
    "moment_on_bolster_yaw",
    "force_on_side_frame_z",
    "side_frame_friction_loss",
    "coil_force",
]


def build(folder, *options):
    """Compiles the program against the standard's headers, whose functions it lists first."""
    for version in "23":
        text = (HEADERS / f"fmi{version}Functions.h").read_text()
        names = re.findall(rf"FMI{version}_Export\s+(fmi{version}\w+)TYPE\s+fmi{version}\w+;", text)
        assert len(names) == {"2": 44, "3": 75}[version], len(names)
        lines = " \\\n".join(f"    X({name})" for name in names)
        (folder / f"fmi{version}_list.h").write_text(f"#define FUNCTIONS \\\n{lines}\n")
    program = folder / "check"
    command = ["gcc", "-std=c11", "-D_GNU_SOURCE", "-Wall", "-Wextra", "-Werror", "-g", "-O1", *options]
    command += ["-isystem", HEADERS, "-I", folder, *sorted(SOURCES.glob("*.c")), "-o", program, "-ldl", "-lm"]
    subprocess.run(list(map(str, command)), check=True)
    return program


class Unpacked:
    """An FMU as the program wants it."""

    def __init__(self, path, version, folder):
        self.folder = Path(fmpy.extract(path, folder / f"unpacked {version}"))
        description = fmpy.read_model_description(path)
        platform = {"2": "linux64", "3": "x86_64-linux"}[version]
        self.library = self.folder / "binaries" / platform / "FrictionWedge.so"
        resources = self.folder / "resources"
        self.resources = resources.as_uri() if version == "2" else str(resources) + "/"
        self.token = description.guid if version == "2" else description.instantiationToken
        self.variables = self.folder / "variables.txt"
        lines = [f"{variable.name} {variable.valueReference}\n" for variable in description.modelVariables]
        self.variables.write_text("".join(lines))

    def arguments(self, version, corruptions):
        return [version, self.library, self.resources, self.token, self.variables, corruptions]


def run(command, seconds=120, **environment):
    done = subprocess.run(
        list(map(str, command)), capture_output=True, text=True, timeout=seconds, env={"PATH": "/usr/bin:/bin", **environment}
    )
    assert done.returncode == 0, f"{done.returncode}\n{done.stdout[-3000:]}\n{done.stderr[-6000:]}"
    print(done.stdout)
    return done.stdout


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    return build(tmp_path_factory.mktemp("c"))


@pytest.mark.parametrize("version", ["2", "3"])
def test_input_every_function_in_and_out_of_order(fmus, program, version, tmp_path):
    path = fmus(version)
    text = run([program, *Unpacked(path, version, tmp_path).arguments(version, 600)])
    # The same bits as through another importer.
    found = [float.fromhex(word) for word in text.split("\n")[0].split()[1:]]
    wedge = Wedge(path).start()
    for k in range(60):
        time = k * STEP
        wedge.set(bolster_z=0.05 * time * (1.0 - 4.0 * time), bolster_z_rate=0.05 * (1.0 - 8.0 * time))
        wedge.fmu.doStep(currentCommunicationPoint=time, communicationStepSize=STEP)
    assert found == list(wedge.get(*OUTPUTS))
    wedge.free()


@pytest.mark.parametrize("version", ["2", "3"])
def test_cross_code_the_same_bits_whatever_processors_it_was_compiled_for(fmus, program, version, tmp_path):
    paths = [fmus(version), fmus(version, "wedge", CASE, *PORTABLE)]
    unpacked = [Unpacked(path, version, tmp_path / str(number)) for number, path in enumerate(paths)]
    assert unpacked[0].library.read_bytes() != unpacked[1].library.read_bytes()
    texts = [run([program, *one.arguments(version, 24)]) for one in unpacked]
    lines = [text.split("\n")[0] for text in texts]
    assert len(lines[0].split()) > len(OUTPUTS)
    assert lines[0] == lines[1]


@pytest.mark.skipif(shutil.which("valgrind") is None, reason="valgrind is not installed")
@pytest.mark.parametrize("version", ["2", "3"])
def test_input_every_function_under_valgrind(fmus, program, version, tmp_path):
    # Valgrind 3.19 does not know all instructions of newer processors.
    path = fmus(version, "wedge", CASE, *PORTABLE)
    run([*VALGRIND, program, *Unpacked(path, version, tmp_path).arguments(version, 24)], 300)


@pytest.mark.parametrize("version", ["2", "3"])
def test_input_every_function_under_the_address_sanitizer(fmus, version, tmp_path):
    program = build(tmp_path, "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    arguments = Unpacked(fmus(version), version, tmp_path).arguments(version, 60)
    run([program, *arguments], ASAN_OPTIONS="detect_leaks=1:strict_string_checks=1")
