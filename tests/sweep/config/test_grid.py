"""From a config to its cases: products, zips, exclusions, and faults of many cases."""

from dataclasses import replace

import pytest

from sweep.config.faults import ConfigError
from sweep.config.grid import chosen_case, expand, sweep_of
from sweep.config.materials import material_file

THOUSAND = [round(0.01 + 1e-4 * i, 6) for i in range(1000)]
HUGE = "".join(f"{key} = {THOUSAND}\n" for key in ("lattice.grading", "contact.friction"))
PAIR = "[grid]\nlattice.cells = [2, 3]\n[[exclude]]\nlattice.cells = "
FOUR = "[[exclude]]\nlattice.cells = 4\ncontact.friction = 0.3"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (f"[grid]\n{HUGE}contact.stiffness = {THOUSAND}", "[grid] makes 1,000,000,000 cases; all"),
        (f"{PAIR}2\n{FOUR}", "[[exclude]] of lattice.cells, contact.friction, number 2: drops no"),
        (f"{PAIR}[2, 3]", "[[exclude]] drops all 2 cases; allowed: tables that leave at least"),
    ],
)
def test_a_sweep_that_is_refused_as_a_whole(lines, text, words):
    (line,) = lines(text)
    assert line.startswith(words)


def test_grid_is_a_product(load):
    walls = 'lattice.wall_thickness = ["0.4 mm", "0.8 mm", "1 mm"]'
    config = load(f'[grid]\n"lattice.cells" = [2, 3]\n{walls}')
    cases = expand(config)
    assert config.recipe.count == len(cases) == 6
    assert cases[1].axes == {"lattice.cells": 2, "lattice.wall_thickness": 0.8e-3}
    assert (cases[-1].lattice.cells_x, cases[-1].lattice.cells_y) == (3, 3)
    assert expand(config) == cases
    cases.clear()  # a list of one's own
    assert len(expand(config)) == 6


def test_zip_advances_together(load):
    config = load(
        "[grid]\nlattice.cells = [2, 3]\n"
        '[[zip]]\nloading.mode = ["force", "displacement"]\nloading.force = ["5 N", ""]\n'
        "[[zip]]\ncontact.friction = [0.2, 0.5]\nsolver.tolerance = [1e-7, 1e-9]"
    )
    cases = expand(config)
    assert len(cases) == 2 * 2 * 2
    loads = {case.loading.mode: case.loading for case in cases}
    assert list(loads) == ["force", "displacement"]
    assert loads["force"].force == 5.0
    assert {(c.contact.friction, c.solver.tolerance) for c in cases} == {(0.2, 1e-7), (0.5, 1e-9)}


def test_empty_text_in_a_zip_leaves_the_config_s_own_value(load):
    config = load('[loading]\nforce = "7 N"\n[[zip]]\nloading.force = ["", "3 N"]')
    assert [case.loading.force for case in expand(config)] == [7.0, 3.0]
    assert [case.axes["loading.force"] for case in expand(config)] == [7.0, 3.0]


def test_exclude_drops_what_matches_all_its_keys(load):
    config = load(
        '[grid]\nlattice.cells = [2, 3, 5]\nlattice.wall_thickness = ["0.4 mm", "1.6 mm"]\n'
        '[[exclude]]\nlattice.cells = [3, 5]\nlattice.wall_thickness = "1600 um"'
    )
    kept = [tuple(case.axes.values()) for case in expand(config)]
    assert kept == [(2, 0.4e-3), (2, 1.6e-3), (3, 0.4e-3), (5, 0.4e-3)]


MODES = '[grid]\nloading.mode = ["force", "displacement"]\n'


def test_exclude_sees_values_that_are_filled_in(load):
    config = load(f'{MODES}[[exclude]]\nloading.platen = "none"')
    assert [case.loading.mode for case in expand(config)] == ["displacement"]


def test_exclude_sees_them_in_cases_that_are_refused_too(load):
    """Statics without bending would be, but for the table that drops it."""
    bends = 'material.bend = ["none", "linear"]\n'
    dropped = '[[exclude]]\nmaterial.bend = "none"\nsolver.integrator = "static"'
    assert len(expand(load(f"{MODES}{bends}{dropped}"))) == 3


def test_equal_cases_are_one(load):
    config = load(f'{MODES}loading.force = ["5 N", "10 N"]')
    assert config.recipe.count == 4
    assert [case.axes["loading.force"] for case in expand(config)] == [5.0, 10.0, None]


def test_labels_of_switches_are_numbers(load):
    cases = expand(load('[loading]\nmode = "displacement"\n[grid]\nloading.unload = [true, false]'))
    assert [case.axes["loading.unload"] for case in cases] == [1, 0]


def test_default_material_that_is_not_there(lines, tmp_path, monkeypatch):
    monkeypatch.setattr(material_file, "FOLDER", tmp_path)
    (line,) = lines("[lattice]")
    assert line.startswith('material.name: "ninjaflex" is no material; allowed: ')


MANY = {  # 112 faults each
    f"[grid]\nlattice.wall_thickness = {[*range(112)]}": "[grid] lattice.wall_thickness",
    "[contact]\n" + "".join(f"key{n} = 1\n" for n in range(112)): "contact.key",
}


@pytest.mark.parametrize("text", MANY)
def test_of_many_faults_a_dozen_are_told_and_the_rest_counted(load, text):
    with pytest.raises(ConfigError) as caught:
        load(text)
    *told, last = str(caught.value).splitlines()
    assert len(told) == 12
    assert all(line.startswith(MANY[text]) for line in told)
    assert last == "and 100 more mistakes, shown after these are fixed"
    assert len(caught.value.faults) == 112


def test_faults_of_one_key_do_not_hide_those_of_others(lines):
    bad = ", ".join(["0"] * 12)
    told = lines(f"[grid]\nlattice.depth = [{bad}]\nsolver.tol = [1]")
    assert ["lattice.depth" in line for line in told] == [True] * 11 + [False] * 2
    assert "solver.tol = [1]: unknown key" in told[11]
    assert told[12] == "and 1 more mistake, shown after these are fixed"


MASSES = '[grid]\nlattice.mass = ["0.8 g", "1.4 g"]\nlattice.kind = ["hex", "circle"]\n'


def test_impossible_combinations_are_left_out_and_each_value_is_named(load):
    thick = MASSES.replace('"1.4 g"', '"1.4 g", "1.5 g"')
    config = load(f"{thick}contact.friction = [0.1, 0.2]")
    assert len(config.cases) == 8
    assert (config.left_out.impossible, config.left_out.of) == (4, 12)
    for mass, line in zip(("1.4 g", "1.5 g"), config.left_out.reasons, strict=True):
        assert line.startswith(f'lattice.mass = "{mass}": does not fit; allowed: between ')
        assert line.endswith('(2 of 12 combinations, all with lattice.kind = "circle")')


def test_a_value_that_no_combination_can_use_is_refused(lines):
    (line,) = lines(MASSES.replace('"1.4 g"', '"1.4 g", "9 kg"'))
    assert line.startswith('lattice.mass = "9 kg": does not fit')
    assert line.endswith("(2 of 6 combinations)")


KINDS_OF_ONE_MASS = (
    '[lattice]\nmass = "50 g"\nwidth = "100 mm"\ndepth = "50 mm"\nheight = "15 mm"\n'
    '[grid]\nlattice.kind = ["square", "kagome", "gyroid"]\n'
    'lattice.cell_size = ["10 mm", "15 mm"]\n'
)


def test_a_kind_that_does_not_fit_values_of_others_is_left_out(load):
    config = load(KINDS_OF_ONE_MASS)
    assert len(config.cases) == 3
    assert config.left_out.impossible == 3
    kagome, gyroid = config.left_out.reasons
    assert kagome.startswith('lattice.mass = "50 g": does not fit; allowed: between ')
    assert kagome.endswith('with lattice.kind = "kagome", lattice.cell_size = "10 mm")')
    assert "where walls are below a fifth of the period (2 of 6" in gyroid


def test_a_kind_that_lacks_a_key_or_has_a_bad_value_of_its_own_is_refused(lines):
    told = lines(KINDS_OF_ONE_MASS.replace("gyroid", "drawn"))
    assert any(line.startswith("lattice.file is missing; needed: ") for line in told)
    (line,) = lines(
        '[[zip]]\nlattice.kind = ["square", "hex"]\nlattice.wall_thickness = ["0.8 mm", "9 mm"]'
    )
    assert line.startswith('lattice.wall_thickness = "9 mm": does not fit')


def test_what_is_excluded_does_not_make_a_value_usable(lines):
    excluded = '[[exclude]]\nlattice.mass = "1.4 g"\nlattice.kind = "hex"'
    (line,) = lines(MASSES + excluded)
    assert line.startswith('lattice.mass = "1.4 g": does not fit')


def test_one_bad_value_is_one_line_in_many_cases(lines):
    (line,) = lines(
        '[lattice]\nwall_thickness = "2 mm"\n'
        "[grid]\nlattice.cells = [2, 3, 4, 5]\ncontact.friction = [0.1, 0.2]"
    )
    assert line.endswith("(4 of 8 combinations)")


SEARCH = """
[search]
"lattice.kind" = ["square", "hex"]
lattice.cells_x = {from = 2, to = 6}
"lattice.wall_thickness" = {from = "0.4 mm", to = "3 mm"}
"""


def test_a_search_has_no_cases_of_its_own(load):
    """Walls of 3 mm fit into no cell of 2 mm: not all combinations need to exist."""
    config = load(SEARCH)
    with pytest.raises(ConfigError, match="only `crumple optimize` searches"):
        expand(config)
    chosen = {key: axis.at(0.0) for key, axis in config.recipe.search.items()}
    case = chosen_case(config.recipe, chosen)
    assert case.axes == {
        "lattice.kind": "square",
        "lattice.cells_x": 2,
        "lattice.wall_thickness": 0.4e-3,
    }
    assert expand(replace(config, cases=(case,), seed=3)) == [case]
    thick = {key: axis.at(1.0) for key, axis in config.recipe.search.items()}
    assert chosen_case(config.recipe, thick) is None


def test_search_that_finds_nothing_is_refused(refused):
    text = '[search]\nlattice.wall_thickness = {from = "20 mm", to = "30 mm"}'
    assert refused(text, "lattice.wall_thickness = 0.025 m", "does not fit; allowed: below half")
    text = '[search]\nlattice.orientation = ["flat", "pointy"]'
    assert refused(text, '[search] lattice.orientation = ["pointy", "flat"]', "no effect, as")


@pytest.mark.parametrize("source", ["smoke", None, 3, ["a"], {1: 2}, [None]])
@pytest.mark.parametrize("ask", [expand, sweep_of])
def test_what_is_no_sweep_is_a_fault_of_the_config(ask, source):
    with pytest.raises(ConfigError, match=r"is no sweep; needed: .*crumple\.load_config returns"):
        ask(source)
