"""Files of a ranking: all designs in the order of the tables, and tables with their legend."""

import pandas as pd
import pytest

from sweep.loading_modes import LOADED
from sweep.ranking.question import Question, RankError
from sweep.report.publish import publish_case, publish_ranking
from sweep.report.tables.legend import MARKS
from tests.support.results.specimens import designs, summary, write

MERIT_OVER_MASS = "sweep.report.figures.ranking_plots.merit_over_mass"


LOAD = {"loading_mode": "force", "force_N": 5.0, "peak_strain": 0.1}


@pytest.fixture
def published(tmp_path):
    """A folder of two crushed designs, the heavier with more energy but fewer J/g, and a load."""
    usual = summary(*designs([1.0, 4.0], [0.2, 0.4]), LOAD)

    def publish(table=usual, drop_heights=(), about=None, **question):
        file, out = write(tmp_path / "f.h5", table, about), tmp_path / "out"
        paths = publish_ranking(file, table, Question(**question), out, drop_heights)
        return {path.name: path for path in paths}

    return publish


@pytest.fixture
def without_figures(monkeypatch):
    """Only tables are written."""
    monkeypatch.setattr("sweep.report.publish._sweep_figures", lambda *_: ())


@pytest.fixture
def pictured(monkeypatch):
    """The rankings of the maps that are drawn."""
    rankings = []
    monkeypatch.setattr(MERIT_OVER_MASS, lambda _, ranking: rankings.append(ranking))
    return rankings


@pytest.mark.usefixtures("without_figures")
def test_tables_come_with_their_legend_and_say_that_other_parts_may_have_better(published):
    text = published(about={"part": "1/3"})["ranking.md"].read_text("utf-8")
    assert MARKS.format("absorbs as much or is strained as little", "the part") in text
    assert f"{LOADED}\n" in text
    assert "\nThis file has part 1/3 of a sweep: " in text


@pytest.mark.usefixtures("without_figures")
@pytest.mark.parametrize(
    ("question", "masses"),
    [
        ({}, [1.0, 4.0]),  # by J/g
        ({"budget": [2e-3]}, [4.0, 1.0]),  # by J, beyond the budget too
        ({"budget": [2e-3], "by": "mass_g"}, [1.0, 4.0]),
    ],
)
def test_table_of_all_designs_is_sorted_like_the_ranking(published, question, masses):
    table = pd.read_csv(published(**question)["ranking.csv"])
    assert list(table.loc[table["loading_mode"] == "displacement", "mass_g"]) == masses


@pytest.mark.usefixtures("unpainted")
def test_pictures_have_all_designs_the_budgets_and_as_many_scenes_as_fit(
    published, pictured, monkeypatch
):
    published(budget=["2 g", "3 g"], top=1)
    assert [list(ranking.table["mass_g"]) for ranking in pictured] == [[4.0, 1.0], [1.0]]
    assert [ranking.budgets_g for ranking in pictured] == [(2.0, 3.0)] * 2
    pictured.clear()
    monkeypatch.setattr("sweep.report.publish.MAX_SCENES", 1)
    published(summary({}, {"platen": "contact"}))
    assert [list(ranking.table["platen"]) for ranking in pictured] == [["glued"]]


@pytest.mark.usefixtures("unpainted")
def test_pictures_say_that_they_draw_the_first_alone(published, monkeypatch):
    texts = []
    monkeypatch.setattr(
        "sweep.report.figures.case_plots.footnote", lambda _, text: texts.append(text)
    )
    three = summary({}, {"platen": "contact"}, {"platen": "sliding"})
    published(three)
    assert set(texts) == {""}
    monkeypatch.setattr("sweep.report.publish.MAX_SCENES", 2)
    monkeypatch.setattr("sweep.report.publish.MAX_WINNERS", 1)
    published(three)
    assert "The first 2 of 3 rankings." in texts
    assert "The first 1 of 3 winners." in texts


def test_each_kind_of_scene_and_each_drop_height_has_its_picture(published):
    pictures = [name for name in published(drop_heights=(0.5, 1.22)) if name.endswith(".png")]
    cushions = ["cushion_500mm.png", "cushion_1220mm.png"]
    usual = {"absorption.png", "sink.png", "energy_absorption.png", "winners.png"}
    assert {*pictures} == {*usual, *cushions}


def test_cushion_curves_need_a_crush(published, tmp_path):
    with pytest.raises(RankError, match="no crush with a place"):
        published(summary(LOAD), drop_heights=(0.5,))
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("unpainted")
def test_plates_are_drawn_whole_and_cut_open(tmp_path):
    table = summary({"direction": "out_of_plane", "solid_strain": 0.7}, {})
    file = write(tmp_path / "f.h5", table)
    drawn = [
        {path.name for path in publish_case(file, row, tmp_path / row["case_id"])}
        for _, row in table.iterrows()
    ]
    assert drawn[0] == {"force.png", "energies.png", "shapes.png", "inside.png"}
    assert drawn[1] == drawn[0] - {"inside.png"}


@pytest.mark.usefixtures("unpainted")
def test_patterns_of_both_directions_have_their_drawings(published):
    both = designs([1.0, 1.0], [0.2, 0.4])
    both[0] |= {"direction": "out_of_plane", "lattice_kind": "hex", "solid_strain": 0.7}
    assert {"patterns.png", "winners.png"} <= set(published(summary(*both)))


@pytest.mark.usefixtures("unpainted")
def test_masses_of_unequal_periods_are_in_no_picture(published):
    """Their ranking, too, has its Pareto front per pressed area."""
    table = summary(*designs([1.0, 4.0], [0.2, 0.4], sides="tied, fixed period"))
    assert "absorption.png" in published(table)
    assert "absorption.png" not in published(table.assign(outer_width_m=[0.02, 0.04]))
