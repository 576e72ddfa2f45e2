"""One design looks the same wherever it is drawn; the legend says how; the winners are named."""

import numpy as np
import pytest
from specimens import designs, summary

from sweep.report.design_style import budget_winners, looks, merits
from sweep.ranking.rank import rank


@pytest.fixture
def ranking():
    cells, walls = [10, 2, 3, 2], [0.8e-3, 0.4e-3, 0.8e-3, 0.8e-3]
    rows = designs([1.0, 2.0, 3.0, 4.0], [0.1, 0.4, 0.3, 1.6])
    for row, n, wall in zip(rows, cells, walls, strict=True):
        row |= {"cells_x": n, "cells_y": n, "wall_thickness_m": wall}
    return rank(summary(*rows), top=None).sort_values("mass_g", ignore_index=True)


def entries(ranking, **chosen):
    return [entry["label"] for entry in looks(ranking).legend(**chosen)]


def test_colours_go_by_number_of_cells(ranking):
    colors = looks(ranking).colors
    assert list(colors) == [(2, 2), (3, 3), (10, 10)]
    assert colors[2, 2] == "#440154"
    assert len({*colors.values()}) == 3


def test_a_design_keeps_its_look_in_a_part_of_the_ranking(ranking):
    of = looks(ranking).of
    whole, part = of(ranking), of(ranking.tail(1))
    assert (part["c"][0], part["s"][0]) == (whole["c"][3], whole["s"][3])
    assert part["marker"] == whole["marker"]
    assert whole["s"][1] < whole["s"][0]


def test_legend_lists_what_varies_under_headings(ranking):
    assert entries(ranking) == ["cells", "2 x 2", "3 x 3", "10 x 10", "wall", "0.4 mm", "0.8 mm"]
    assert entries(ranking, walls=False) == ["cells", "2 x 2", "3 x 3", "10 x 10"]


def test_legend_explains_open_signs_where_there_are_any(ranking):
    for mark in ("beyond_model", "crossed"):
        assert entries(ranking.assign(**{mark: [False, True] * 2}))[-1] == "not to be trusted"


def test_legend_explains_error_bars_where_there_are_any(ranking):
    assert entries(ranking, barred=True) == [*entries(ranking), "± estimated error"]


def test_materials_have_signs(ranking):
    signs = looks(ranking.assign(material=["cheetah", "ninjaflex"] * 2)).signs
    assert list(signs) == ["cheetah", "ninjaflex"]
    assert len({*signs.values()}) == 2


def test_winners_of_budgets_are_the_most_that_is_light_enough(ranking):
    ranking.attrs["budgets_g"] = [0.5, 1.5, 2.0, 9.0]
    assert budget_winners(ranking, ranking) == [
        ("up to 1.5 g: cells 10 x 10, wall 0.8 mm, 100 mJ", 1.0, 0.1),
        ("up to 2 g: cells 2 x 2, wall 0.4 mm, 400 mJ", 2.0, 0.4),
        ("up to 9 g: cells 2 x 2, wall 0.8 mm, 1.60 J", 4.0, 1.6),
    ]


def test_without_a_budget_the_first_in_the_table_wins(ranking):
    ((words, *point),) = budget_winners(ranking.assign(beyond_model=True), ranking)
    assert words == "best: cells 2 x 2, wall 0.8 mm, 1.60 J, 0.400 J/g, beyond the model"
    ((words, *point),) = budget_winners(ranking.assign(crossed=True), ranking)
    assert words == "best: cells 2 x 2, wall 0.8 mm, 1.60 J, 0.400 J/g, walls cross"
    assert point == [4.0, 1.6]
    sparing = rank(summary(*designs([1.0, 3.0, 2.0], [0.3, 0.6, 0.5])), top=None)
    per_gram = sparing.assign(**{f"error_{sparing.attrs['per_gram']}": 0.03})
    ((words, *point),) = budget_winners(per_gram, per_gram)  # the least J
    assert words == "best: ninjaflex, 300 mJ, 0.300 J/g ± 10 %, a tie of 2"
    assert point == [1.0, 0.3]


def test_who_is_first_by_another_column_is_named_with_that():
    rows = designs([1.0, 3.0, 2.0], [0.3, 0.6, 0.5])
    for row, force in zip(rows, [20.0, 10.0, 30.0], strict=True):
        row["peak_force_N"] = force
    ranking = rank(summary(*rows), top=None, by="peak_force_N")
    sure = ranking.assign(error_peak_force_N=1.0, error_absorbed_energy_J=0.5)
    ((words, *point),) = budget_winners(sure.assign(beyond_model=True), sure)
    assert words == "best: ninjaflex, 600 mJ, peak_force_N 10.0 ± 10 %, beyond the model"
    assert point == [3.0, 0.6]
    nothing = ranking.assign(**{ranking.attrs["energy"]: np.nan})
    assert budget_winners(nothing, ranking) == []


def test_under_a_dead_load_the_least_sink_wins():
    sinks = zip([1.0, 2.0, 3.0], [0.5, 0.2, 0.3], [0.4e-3, 0.8e-3, 1.2e-3], strict=True)
    load = {"loading_mode": "force", "force_N": 5.0}
    rows = [load | {"mass_g": m, "peak_strain": e, "wall_thickness_m": t} for m, e, t in sinks]
    ranking = rank(summary(*rows), top=None)
    assert budget_winners(ranking, ranking) == [("best: wall 0.8 mm, sinks 20.0 %", 2.0, 20.0)]
    assert merits(ranking, "absorbed_energy_J").tolist() == [20.0, 30.0, 50.0]


def test_winners_say_how_sure_they_are_and_whom_they_tie_with(ranking):
    energy = ranking.attrs["energy"]
    ranking.attrs["budgets_g"] = [1.5, 3.0, 9.0]
    sure = ranking.assign(**{f"error_{energy}": [0.01, 0.06, 0.05, np.nan]})
    assert [words for words, *_ in budget_winners(sure, sure)] == [
        "up to 1.5 g: cells 10 x 10, wall 0.8 mm, 100 mJ ± 10 %",
        "up to 3 g: cells 2 x 2, wall 0.4 mm, 400 mJ ± 15 %, a tie of 2",
        "up to 9 g: cells 2 x 2, wall 0.8 mm, 1.60 J",
    ]


def test_of_equal_winners_the_one_named_tells_its_own_error():
    rows = designs([1.0, 2.0], [0.3, 0.3])
    error = "error_absorbed_energy_at_densification_J"
    force = {"error_peak_force_at_densification_N": 0.0}
    rows[0] |= {"case_id": "f" * 16, error: 0.01} | force
    rows[1] |= {"case_id": "0" * 16, error: 0.1} | force
    ranking = rank(summary(*rows), top=None, budget="9 g")
    ((words, *_),) = budget_winners(ranking, ranking)
    assert words.endswith("300 mJ ± 3.3 %, a tie of 2")
