"""From TOML to a sweep in SI: refusals, light imports."""

import subprocess
import sys
from pathlib import Path

import pytest

from sweep.config.case import Case
from sweep.config.faults import ConfigError
from sweep.config.load import case, case_of, load_config
from sweep.config.units import quantity
from tests.support.readme import ROOT


@pytest.mark.parametrize("text", ["25", "", "25 N", "nan g", "1e999 g", "3 (("])
def test_bad_quantities_are_refused_in_one_line(text):
    with pytest.raises(ConfigError, match=r'allowed: a mass with a unit, such as "25 g"') as caught:
        quantity(text, "kg")
    assert len(str(caught.value).splitlines()) == 1


def test_what_is_no_path_is_refused():
    with pytest.raises(ConfigError, match=r'^\["a"\] is no path; needed: the path of a TOML'):
        load_config(["a"])


HEAVY = ["numpy", "scipy", "pandas", "numba", "dask", "h5py", "matplotlib", "shapely"]
SCRIPT = f"""
import sys
from sweep.config.faults import ConfigError
from sweep.config.load import load_config
try:
    load_config({{"lattice": {{"width": "1 kg"}}}})
except ConfigError:
    print(*[name for name in {HEAVY} if sys.modules.get(name)])
"""


def test_a_refused_config_loads_nothing_heavy():
    run = dict(cwd=ROOT, capture_output=True, text=True, check=True)
    assert subprocess.run([sys.executable, "-c", SCRIPT], **run).stdout == "\n"


TABLES = {"lattice": {"kind": "hex"}, "grid": {"lattice.cells": [2, 3]}}


def test_a_dict_is_a_config(load):
    config = load_config(TABLES)
    assert config.cases == load('[lattice]\nkind = "hex"\n[grid]\n"lattice.cells" = [2, 3]').cases
    assert (config.name, config.path) == ("unnamed", None)
    assert load_config({**TABLES, "name": "hexagons"}).name == "hexagons"


def test_faults_of_a_dict_are_those_of_a_file(lines):
    (line,) = lines("[lattice]\nwidth = 3\n")
    with pytest.raises(ConfigError) as caught:
        load_config({"lattice": {"width": 3}})
    assert str(caught.value) == line
    with pytest.raises(ConfigError, match="an empty config; needed: tables"):
        load_config({})


def test_files_named_in_a_dict_are_looked_for_here(tmp_path, monkeypatch):
    (tmp_path / "arch.json").write_text((ROOT / "configs/custom.json").read_text("utf-8"))
    monkeypatch.chdir(tmp_path)
    config = load_config({"lattice": {"kind": "custom", "file": Path("arch.json")}})
    assert config.cases[0].lattice.file == "arch.json"


def test_a_case_of_keys():
    by_dots = case(**{"lattice.kind": "hex", "lattice.width": "25 mm"})
    assert by_dots == case(lattice={"kind": "hex", "width": "25 mm"})
    assert by_dots == Case.of(lattice={"kind": "hex", "width": 0.025})
    assert case() == Case.of()


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ({"grid": {"lattice.cells": [2]}}, "grid = .*: of no case; allowed: the tables lattice"),
        ({"lattice.cells": [2, 3]}, "a list, which belongs in"),
        ({"lattice.kynd": "hex"}, "unknown key; the nearest is lattice.kind"),
        ({"lattice": "hex"}, "not a table"),
    ],
)
def test_what_is_no_key_of_a_case_is_refused(keys, told):
    with pytest.raises(ConfigError, match=told):
        case(**keys)


@pytest.mark.parametrize("source", ["x", None, 3, ["a"], {1: 2}, {"a": 1}])
def test_what_is_no_case_is_a_fault_of_the_config(source):
    with pytest.raises(ConfigError, match=r"is no case;|is no text;|of no case;"):
        case_of(source)


def test_a_case_is_itself_and_a_dict_of_tables_is_the_case_of_them():
    made = case(lattice={"kind": "hex"})
    assert case_of(made) is made
    assert case_of({"lattice": {"kind": "hex"}, "loading": None}) == made
