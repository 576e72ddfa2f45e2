"""From TOML to the cases of a sweep: units, axes, the configs that ship."""

import subprocess
import sys
from pathlib import Path

import pint
import pytest

from sweep.config.case import Case
from sweep.config.grid import case_count, expand
from sweep.config.keys import QUANTITIES, case_keys
from sweep.config.units import ConfigError, load_config, quantity

CONFIGS = Path(__file__).parents[3] / "configs"
PINT = pint.UnitRegistry()


@pytest.fixture
def load(tmp_path):
    def loaded(text):
        path = tmp_path / "sweep.toml"
        path.write_text(text)
        return load_config(path)

    return loaded


@pytest.mark.parametrize(
    ("name", "cases"),
    [
        ("smoke", 6),
        ("armor", 140),
        ("infills", 13),
        ("thousand", 1000),
        ("custom", 1),
        ("seed", 14),
        ("impact", 24),
        ("khatri_egan_square", 60),
    ],
)
def test_shipped_configs_expand(name, cases):
    config = load_config(CONFIGS / f"{name}.toml")
    assert config.name == name
    assert len({case.case_id for case in expand(config)}) == len(expand(config)) == cases


def test_every_shipped_config_is_pinned():
    studies = {"custom", "seed", "impact", "khatri_egan_square", "extreme"}
    names = {"smoke", "armor", "infills", "thousand"}
    assert {path.stem for path in CONFIGS.glob("*.toml")} == names | studies


def test_empty_config_is_the_seed(load):
    (case,) = expand(load(""))
    assert case == Case()


def test_config_keeps_its_name_and_path(load, tmp_path):
    assert load("").name == "sweep"
    config = load('name = "armour-2"')
    assert (config.name, config.path) == ("armour-2", tmp_path / "sweep.toml")


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("0.8 mm", "m", 0.8e-3),
        ("0.8mm", "m", 0.8e-3),
        ("400 um", "m", 0.4e-3),
        ("0.5 in", "m", 0.0127),
        ("2 oz", "kg", 0.0566990462500),
        ("1 lb", "kg", 0.45359237),
        ("100 mm/min", "m/s", 0.1 / 60),
        ("5 1/s", "1/s", 5.0),
        ("5/s", "1/s", 5.0),
        ("1e-4 s", "s", 1e-4),
        ("12 MPa", "Pa", 12e6),
        ("12 N/mm^2", "Pa", 12e6),
        ("1.19 g/cm^3", "kg/m^3", 1190.0),
        ("1 kgf", "N", 9.80665),
    ],
)
def test_quantities(text, unit, value):
    assert quantity(text, unit) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("unit", "si"),
    [
        *[(length, "m") for length in ("inch", "foot", "thou", "ft")],
        *[(mass, "kg") for mass in ("ounce", "pound", "oz", "lb")],
        *[(force, "N") for force in ("kgf", "lbf")],
        *[(stress, "Pa") for stress in ("psi", "bar", "GPa")],
        ("km/hour", "m/s"),
    ],
)
def test_units_are_those_of_pint(unit, si):
    standard = PINT.Quantity(1.0, unit).m_as(si)
    assert quantity(f"1 {unit}", si) == pytest.approx(standard, rel=1e-12)


@pytest.mark.parametrize(
    "text", ["25", "g", "", "25 N", "25 gg", "nan g", "1e999 g", "3 ((", "1 1/0"]
)
def test_bad_quantities_are_refused_in_one_line(text):
    with pytest.raises(ConfigError, match=r'allowed: a mass with a unit, such as "25 g"') as caught:
        quantity(text, "kg")
    assert len(str(caught.value).splitlines()) == 1


def test_every_unit_of_the_keys_is_described():
    units = {key.unit for key in case_keys().values() if key.unit}
    assert units <= set(QUANTITIES)


def test_grid_is_a_product(load):
    config = load(
        '[grid]\n"lattice.cells" = [2, 3]\nlattice.wall_thickness = ["0.4 mm", "0.8 mm", "1 mm"]'
    )
    cases = expand(config)
    assert case_count(config) == len(cases) == 6
    assert cases[1].axes == {"lattice.cells": 2, "lattice.wall_thickness": 0.8e-3}
    assert (cases[-1].lattice.cells_x, cases[-1].lattice.cells_y) == (3, 3)


def test_zip_advances_together(load):
    config = load(
        "[grid]\nlattice.cells = [2, 3]\n"
        '[[zip]]\nloading.mode = ["force", "displacement"]\nloading.force = ["5 N", ""]\n'
        "[[zip]]\ncontact.friction = [0.2, 0.5]\nsolver.tolerance = [1e-7, 1e-9]"
    )
    cases = expand(config)
    assert len(cases) == 2 * 2 * 2
    assert {(c.loading.mode, c.loading.force) for c in cases} == {
        ("force", 5.0),
        ("displacement", None),
    }
    assert {(c.contact.friction, c.solver.tolerance) for c in cases} == {(0.2, 1e-7), (0.5, 1e-9)}


def test_empty_text_in_a_zip_leaves_the_config_s_own_value(load):
    config = load('[loading]\nforce = "7 N"\n[[zip]]\nloading.force = ["", "3 N"]')
    assert [case.loading.force for case in expand(config)] == [7.0, 3.0]
    assert [case.axes["loading.force"] for case in expand(config)] == [7.0, 3.0]


def test_a_strain_may_be_a_number_or_a_share_in_percent(load):
    number, percent = (
        expand(load(f"[loading]\nstrain = {strain}")) for strain in ("0.6", '"60 %"')
    )
    assert [case.case_id for case in number] == [case.case_id for case in percent]
    config = load(
        '[grid]\nloading.strain = ["40 %", 0.5, "60 %"]\n[[exclude]]\nloading.strain = "50 %"'
    )
    assert [case.axes["loading.strain"] for case in expand(config)] == [0.4, 0.6]


def test_exclude_drops_what_matches_all_its_keys(load):
    config = load(
        "[grid]\nlattice.cells = [2, 3, 5]\n"
        'lattice.wall_thickness = ["0.4 mm", "1.6 mm"]\n'
        '[[exclude]]\nlattice.cells = [3, 5]\nlattice.wall_thickness = "1600 um"'
    )
    kept = [tuple(case.axes.values()) for case in expand(config)]
    assert kept == [(2, 0.4e-3), (2, 1.6e-3), (3, 0.4e-3), (5, 0.4e-3)]


def test_exclude_sees_values_that_are_filled_in(load):
    config = load(
        '[grid]\nloading.mode = ["force", "displacement"]\n[[exclude]]\nloading.platen = "none"'
    )
    assert [case.loading.mode for case in expand(config)] == ["displacement"]


def test_exclude_sees_them_in_cases_that_are_refused_too(load):
    """Statics without bending would be, but for the table that drops it."""
    config = load(
        '[grid]\nmaterial.bend = ["none", "linear"]\nloading.mode = ["force", "displacement"]\n'
        '[[exclude]]\nmaterial.bend = "none"\nsolver.integrator = "static"'
    )
    assert len(expand(config)) == 3


def test_equal_cases_are_one(load):
    config = load(
        '[grid]\nloading.mode = ["displacement", "force"]\nloading.force = ["5 N", "10 N"]'
    )
    assert case_count(config) == 4
    assert [case.axes["loading.force"] for case in expand(config)] == [None, 5.0, 10.0]


def test_cases_are_found_once_and_handed_out_as_a_list_of_one_s_own(load):
    config = load("[grid]\nlattice.cells = [2, 3]")
    first = expand(config)
    assert all(again is case for again, case in zip(expand(config), first, strict=True))
    first.clear()
    assert len(expand(config)) == 2


def test_labels_of_switches_are_numbers(load):
    cases = expand(load('[loading]\nmode = "displacement"\n[grid]\nloading.unload = [true, false]'))
    assert [case.axes["loading.unload"] for case in cases] == [1, 0]


def test_load_steps_has_two_names(load):
    (case,) = expand(load('[loading]\nmode = "displacement"\nload_steps = 50'))
    assert case.solver.load_steps == 50


def test_own_material_is_found_beside_the_config(load, tmp_path):
    header = "# density_kg_m3: 1100\n# poisson: 0.4\nstrain,stress_Pa\n"
    (tmp_path / "mine.csv").write_text(header + "0.01,1e5\n0.05,4e5\n1,2e6\n")
    config = load(
        '[grid]\nmaterial.name = ["ninjaflex", "mine.csv"]\nmaterial.density = ["1 g/cm^3"]'
    )
    mine = expand(config)[1]
    assert (mine.material.name, mine.material.density) == ("mine", 1000.0)
    assert mine.axes["material.name"] == "mine"
    dropped = load(
        '[grid]\nmaterial.name = ["ninjaflex", "mine.csv"]\n[[exclude]]\nmaterial.name = "mine.csv"'
    )
    assert len(expand(dropped)) == 1


def test_rank_is_in_si(load):
    rank = load('[rank]\nbudgets = ["20 g", "1 oz"]\npanel = ["100 mm", "2 in"]').rank
    assert rank.budgets == pytest.approx((0.02, 0.028349523125))
    assert rank.panel == pytest.approx((0.1, 0.0508))


def test_a_refused_config_loads_nothing_heavy(tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text('[lattice]\nwidth = "1 kg"')
    heavy = ["numpy", "scipy", "pandas", "numba", "dask", "h5py", "matplotlib", "shapely"]
    script = f"""
import sys
from sweep.config.units import ConfigError, load_config
try:
    load_config({str(path)!r})
except ConfigError:
    print(*[name for name in {heavy} if sys.modules.get(name)])
"""
    done = subprocess.run(
        [sys.executable, "-c", script],
        cwd=CONFIGS.parent,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.strip() == ""
