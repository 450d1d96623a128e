"""What is built is the same wherever it is built, and takes nothing from the system by chance."""

import subprocess

import pytest
from conftest import BUILT, PROGRAMS, ROOT


def test_program_has_the_same_bytes_wherever_it_is_built(smoke, binaries):
    """So that a folder that was moved computes nothing again; no program names its folder."""
    assert {path.name for path in binaries.iterdir()} == set(PROGRAMS)
    contents = {name: (binaries / name).read_bytes() for name in PROGRAMS}
    assert [name for name, content in contents.items() if bytes(ROOT) in content] == []
    elsewhere = (smoke.folder / "build" / "release" / "bin" / BUILT).read_bytes()
    assert bytes(smoke.folder) not in elsewhere
    assert elsewhere == contents[BUILT]


@pytest.mark.parametrize("program", ["linear_stability", "hopf"])
def test_another_lapack_of_the_system_is_not_used(programs, good_inputs, monkeypatch, program):
    """OpenBLAS, under the same name, gives other last bits, by the number of its threads."""
    programs.made_by(program, good_inputs[program])
    before = programs.output.read_bytes()
    source = programs.folder / "another.c"
    routines = ("dgeev_", "zgesv_", "zgesvd_")
    ends = "".join(f"void {name}(void) {{ abort(); }}\n" for name in routines)
    source.write_text(f"#include <stdlib.h>\n{ends}")
    another = programs.folder / "liblapack.so.3"
    subprocess.run(["gcc", "-shared", "-fPIC", "-o", another, source], check=True)
    (programs.folder / "libblas.so.3").symlink_to(another)
    monkeypatch.setenv("LD_LIBRARY_PATH", str(programs.folder))
    programs.made_by(program, good_inputs[program])
    assert programs.output.read_bytes() == before
