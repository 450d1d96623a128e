"""What is built is the same wherever it is built, and takes nothing from the system by chance."""

import subprocess

import pytest


def test_program_has_the_same_bytes_wherever_it_is_built(smoke, project):
    """So that a folder that was moved computes nothing again; no program names its folder."""
    programs = smoke.folder / "build" / "release" / "bin"
    found = {path.name: path.read_bytes() for path in programs.iterdir()}
    assert len(found) == 9
    assert [name for name, content in found.items() if bytes(smoke.folder) in content] == []
    run = project.snakemake("build/release/bin/spectrum")
    assert run.returncode == 0, run.stdout
    elsewhere = project.folder / "build" / "release" / "bin" / "spectrum"
    assert elsewhere.read_bytes() == found["spectrum"]


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
