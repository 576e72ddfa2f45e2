"""One design looks the same wherever it is drawn; the legend says how; the winners are named."""

from dataclasses import replace

import numpy as np
import pandas
import pytest

from sweep.ranking.rank import ranked
from sweep.report.figures.design_style import budget_winners, looks
from tests.support.results.specimens import designs, summary


@pytest.fixture
def ranking():
    rows = designs([1.0, 2.0, 3.0, 4.0], [0.1, 0.4, 0.3, 1.6])
    cells, walls = [10, 2, 3, 2], [0.8e-3, 0.4e-3, 0.8e-3, 0.8e-3]
    table = summary(*rows).assign(cells_x=cells, cells_y=cells, wall_thickness_m=walls)
    ranking = ranked(table, top=None)
    return replace(ranking, table=ranking.table.sort_values("mass_g", ignore_index=True))


@pytest.fixture
def table(ranking):
    return ranking.table


def entries(designs, **chosen):
    return [entry["label"] for entry in looks(designs).legend(**chosen)]


def test_a_design_keeps_its_look_in_a_part_of_the_ranking(table):
    look = looks(table)
    assert (list(look.colors), look.colors[2, 2]) == ([(2, 2), (3, 3), (10, 10)], "#440154")
    assert len({*look.colors.values()}) == 3
    whole, part = look.of(table), look.of(table.tail(1))
    assert (part["c"][0], part["s"][0]) == (whole["c"][3], whole["s"][3])
    assert part["marker"] == whole["marker"]
    assert whole["s"][1] < whole["s"][0]


def test_legend_lists_what_varies_and_explains_what_is_drawn(table):
    usual = ["cells", "2 x 2", "3 x 3", "10 x 10", "wall", "0.4 mm", "0.8 mm"]
    assert entries(table) == usual
    assert entries(table, walls=False) == usual[:4]
    assert entries(table, barred=True) == [*usual, "± estimated error"]
    for mark in ("beyond_model", "crossed"):
        assert entries(table.assign(**{mark: [False, True] * 2}))[-1] == "unreliable"


def test_materials_have_signs_and_many_words_a_ramp_of_colours(table):
    signs = looks(table.assign(material=["cheetah", "ninjaflex"] * 2)).signs
    assert list(signs) == ["cheetah", "ninjaflex"]
    assert len({*signs.values()}) == 2
    many = pandas.concat([table.iloc[:1]] * 12).assign(lattice_kind=[f"p{k}" for k in range(12)])
    assert len({*looks(many).colors.values()}) == 12


def test_patterns_have_colours_and_signs_where_there_are_several(table):
    kinds = table.assign(lattice_kind=["brick", "hex", "hex", "square"])
    look = looks(kinds)
    assert (look.tint, look.sign) == (["lattice_kind"], "lattice_kind")
    assert entries(kinds)[:4] == ["pattern", "brick", "hex", "square"]
    assert (look.signs["hex"], look.signs["square"]) == ("h", "s")
    assert len({*look.signs.values()}) == len({*look.colors.values()}) == 3
    assert [look.of(kinds[k : k + 1])["marker"] for k in (1, 3)] == ["h", "s"]
    named = {entry["label"]: entry for entry in look.legend()}
    assert (named["hex"]["color"], named["hex"]["marker"]) == (look.colors["hex",], "h")
    assert "cells" not in named


def test_the_words_with_most_choices_have_colours_and_the_next_ones_signs(table):
    materials = ["cheetah", "ninjaflex", "ninjaflex", "cheetah"]
    both = table.assign(lattice_kind=["hex", "square", "kagome", "hex"], material=materials)
    assert (looks(both).tint, looks(both).sign) == (["lattice_kind"], "material")
    words = ["pattern", "hex", "kagome", "square", "material", "cheetah", "ninjaflex"]
    assert entries(both)[:7] == words
    more = both.assign(lattice_kind=["hex", "square"] * 2, material=["a", "b", "c", "a"])
    assert (looks(more).tint, looks(more).sign) == (["material"], "lattice_kind")
    ways = ["in_plane", "in_plane", "out_of_plane", "in_plane"]
    turned = looks(both.assign(direction=ways))
    assert turned.tint[0] == "lattice_kind"
    assert {turned.tint[1], turned.sign} == {"material", "direction"}


def test_colours_tell_the_direction_where_there_are_both(table):
    ways = ["in_plane", "out_of_plane", "in_plane", "in_plane"]  # of 10, 2, 3 and 2 cells
    both = looks(table.assign(direction=ways))
    assert both.tint == ["cells_x", "cells_y", "direction"]
    assert len(set(both.colors.values())) == len(both.colors) == 4
    labels = entries(table.assign(direction=ways, cells_x=2, cells_y=2))
    assert labels[:3] == ["pressed", "across", "along"]


def test_of_many_walls_the_legend_has_some():
    walls = [{"wall_thickness_m": thickness * 1e-4} for thickness in range(4, 17)]
    many = ranked(summary(*walls), top=None).table
    assert entries(many) == ["wall", "0.4 mm", "0.7 mm", "1 mm", "1.3 mm", "1.6 mm"]


def test_a_winner_may_weigh_the_budget_but_for_round_off(ranking):
    ranking.table["mass_g"] *= 1.0 + 5e-14
    asked = replace(ranking, budgets_g=(2.0,))
    ((words, *point),) = budget_winners(asked.table, asked)
    assert words == "up to 2 g: cells 2 x 2, wall 0.4 mm, 400 mJ"
    assert point == pytest.approx([2.0, 0.4])


def test_of_equal_winners_the_one_named_tells_its_own_error():
    table = summary(*designs([1.0, 2.0], [0.3, 0.3])).assign(case_id=["f" * 16, "0" * 16])
    table["error_absorbed_energy_until_packed_J"] = [0.01, 0.1]
    table["error_peak_force_until_packed_N"] = 0.0
    ranking = ranked(table, top=None, budget="9 g")
    ((words, *_),) = budget_winners(ranking.table, ranking)
    assert words.endswith("300 mJ ± 3.3 %, a tie of 2")


def test_without_a_merit_no_design_wins(ranking):
    assert budget_winners(ranking.table.assign(**{ranking.energy: np.nan}), ranking) == []
