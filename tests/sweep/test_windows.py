"""Whole sweeps where Windows is simulated, as far as it can be (`tests/support/windows.py`)."""

import os
import subprocess
import sys

from sweep.store.read import read_statuses, read_summary
from tests.support.command import crumple
from tests.support.windows import FORBIDDEN

PROGRAM = """
from tests.support.windows import pretend
pretend()

import sys
from pathlib import Path
from matplotlib.figure import Figure
from sweep.__main__ import main
from sweep.store.write import Writer

Figure.savefig = lambda _, path, **how: open(path, "w").close()  # painting takes long
config, text = Path("small.toml"), Path(sys.argv[1]).read_text("utf-8")

def crumple(words):
    assert main(words.split()) == 0, words

config.write_text(text.replace("[2, 3]", "[2]"), "utf-8")
crumple("run small.toml --out a.h5")
config.write_text(text, "utf-8")
crumple("run small.toml --out a.h5")  # replaces the file whose rows it takes over
crumple("run small.toml --out b.h5 --processes 1")
crumple("run small.toml --dry-run --out none.h5")
crumple("merge c.h5 a.h5 b.h5")
for words in ("rank", "status", "verify", "report"):
    crumple(f"{words} c.h5")
for words in ("--csv", "--json", "--markdown", "--out tables"):
    crumple(f"rank c.h5 {words}")
crumple("show c.h5 1 --out pictures")
crumple("export c.h5 1 --to part.stl")
for words in ("materials", "materials cheetah", "published", "new mine", "card smoke"):
    crumple(words)
with Writer("c.h5"):
    assert main("run small.toml --out c.h5".split()) == 2
"""


def run(program, folder, *words):
    """Run a program in another folder, on a terminal of Western Europe; return its output."""
    here = {"PYTHONPATH": os.getcwd(), "PYTHONIOENCODING": "cp1252:strict", "COLUMNS": "100"}
    process = subprocess.run(
        [sys.executable, "-c", program, *words],
        cwd=folder, env=os.environ | here, capture_output=True, timeout=600,
    )  # fmt: skip
    assert process.returncode == 0, process.stderr.decode("cp1252")
    return process.stdout.decode("cp1252"), process.stderr.decode("cp1252")


def test_a_whole_sweep(tmp_path, capsys):
    """Its kernels are compiled before, as Numba would compile them for Windows."""
    smoke = os.path.abspath("configs/smoke.toml")
    assert crumple(capsys, "run", "smoke", "--out", str(tmp_path / "linux.h5"))[0] == 0
    out, err = run(PROGRAM, tmp_path, smoke)
    assert "Traceback" not in err
    assert "usable" in out
    assert "?" not in out
    refused = err.splitlines()[-1]
    assert refused.startswith("crumple run: Another run is writing into c.h5 (process ")
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {
        "a.h5", "b.h5", "c.h5", "c.html", "crumple.schema.json", "linux.h5", "mine.toml",
        "part.stl", "pictures", "small.toml", "tables",
    }  # fmt: skip
    assert not [path for path in tmp_path.rglob("*") if {*path.name}.intersection(FORBIDDEN)]
    usual = read_summary(tmp_path / "linux.h5")["absorbed_energy_J"]
    for name in ("a.h5", "b.h5", "c.h5"):
        assert [*read_statuses(tmp_path / name).values()] == ["converged"] * 6
        assert read_summary(tmp_path / name)["absorbed_energy_J"].equals(usual)
