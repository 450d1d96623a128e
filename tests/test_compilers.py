"""What ./test compilers says of builds, which are made up."""

import os
import shutil
import subprocess

import pytest

from conftest import ROOT, write_script

CMAKE = """[[ $1 == --build ]] || exit 0
mkdir -p $2/bin
echo "echo cycle: $(<bits-$(basename $2))" >$2/bin/trajectory_bits
chmod +x $2/bin/trajectory_bits"""


@pytest.mark.parametrize(
    ("second", "failing", "said"),
    [
        ("3F", "none", "all tests pass, same bits"),
        ("40", "none", "other bits: build/gfortran-11/trajectories.txt build/gfortran-12"),
        ("3F", "gfortran-12", "failed; see build/gfortran-12/log"),
        # the others are compared without it
        ("3F", "gfortran-11", "all tests pass, same bits"),
    ],
)
def test_builds_that_differ_or_fail_are_named(tmp_path, second, failing, said):
    """With status 1; all builds are tried."""
    (tmp_path / "compilers").mkdir()
    shutil.copy(ROOT / "compilers" / "run", tmp_path / "compilers")
    (tmp_path / "apt-packages.txt").write_text("gfortran-11\ngfortran-12\n")
    for name, bits in {"gfortran-11": "3F", "gfortran-12": second, "sanitize": "3F"}.items():
        (tmp_path / f"bits-{name}").write_text(bits)
    write_script(tmp_path / "bin" / "cmake", CMAKE)
    write_script(tmp_path / "bin" / "ctest", f"[[ $2 != build/{failing} ]]")
    run = subprocess.run(
        ["compilers/run", "."],
        cwd=tmp_path,
        env={**os.environ, "PATH": f"{tmp_path}/bin:{os.environ['PATH']}"},
        capture_output=True,
        text=True,
    )
    lines = run.stdout.splitlines()
    assert [line.split(": ")[1] for line in lines] == ["gfortran-11", "gfortran-12", "sanitize"]
    assert said in lines[1]
    assert run.returncode == (not all("same bits" in line for line in lines))
