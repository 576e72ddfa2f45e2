"""The search: it finds a narrow peak, is resumed by replay, and survives failures."""

import json
from math import exp

import pytest

from sweep.config.load import load_config
from sweep.ranking.question import Question
from sweep.running.searching.design_space import DesignSpace
from sweep.running.searching.search import MOST_TRIED, Search, Settings
from sweep.store.read import read_attributes, read_summary
from tests.support.results.searches import BEST, THIN, TOML, energy, simulate
from tests.support.results.standin import Logged

QUESTION = {"budget": None, "panel": None, "by": "absorbed_energy_J", "allowed_force": None}


@pytest.fixture
def searched(tmp_path):
    """A finished search, and the cases that it ran."""

    def run(evaluations=100, seed=1, text=TOML, by="absorbed_energy_J", **question):
        path, logged = tmp_path / "sought.toml", Logged(simulate)
        path.write_text(text)
        space, how = DesignSpace(load_config(path)), Settings(evaluations, seed, workers=1)
        asked = Question(**QUESTION | {"by": by} | question)
        search = Search(space, asked, tmp_path / "sought.h5", how, logged)
        search.run()
        return search, logged

    return run


def test_a_narrow_peak_of_one_pattern_is_found(searched):
    """The peak takes 1/3 x 1/5 x 1/10 of the cube."""
    search, log = searched()
    (best, value), *_ = search.assessment.by_id.items()
    kind, cells, walls = BEST
    lattice = search.cases[best].lattice
    assert (lattice.kind, lattice.cells_x) == (kind, cells)
    assert 1e3 * lattice.wall_thickness == pytest.approx(walls, abs=0.02)
    assert value > 0.9
    assert len(log) == len(set(log)) == len(search.cases) == 100


def test_same_seed_runs_nothing_again_and_continues(searched):
    """An added requirement that all designs fulfil starts no evaluation either."""
    _, first = searched(evaluations=20)
    search, more = searched(evaluations=60)
    assert len(first) == 20
    assert not {*first} & {*more}
    assert search.cases.keys() == {*first, *more}
    for require in (None, {"max_mass": "1 kg"}):
        again, none = searched(evaluations=60, require=require)
        assert none == []
        assert again.assessment.by_id == search.assessment.by_id
    _, others = searched(evaluations=20, seed=2)
    assert len({*others} - {*first, *more}) > 10


def test_file_holds_every_design_and_what_was_sought(searched, tmp_path):
    search, _ = searched(evaluations=20)
    rows = read_summary(tmp_path / "sought.h5")
    assert set(rows["case_id"]) == search.cases.keys()
    about = read_attributes(tmp_path / "sought.h5")
    config = json.loads(about["config"])
    assert about["other_cases"] == 0
    assert config["search"]["lattice.wall_thickness"] == {"from": 0.4e-3, "to": 1.2e-3}
    assert config["search"]["lattice.kind"] == ["square", "hex", "diamond"]
    assert config["search_seed"] == 1


def test_failed_and_doubtful_designs_are_worth_nothing(searched):
    text = TOML.replace('"diamond"', '"brick"')
    search, _ = searched(evaluations=60, text=text)
    kinds = {search.cases[case_id].lattice.kind for case_id in search.assessment.by_id}
    assert kinds == {"square", "hex"}
    assert any(case.lattice.kind == "brick" for case in search.cases.values())
    assert search.assessment.doubtful > 0
    thin = [search.cases[case_id].lattice.wall_thickness for case_id in search.assessment.by_id]
    assert min(thin) >= THIN


def test_all_failed_is_no_exception(searched):
    text = TOML.replace('["square", "hex", "diamond"]', '["brick"]')
    search, _ = searched(evaluations=20, text=text)
    assert len(search.cases) == 20
    assert search.assessment.by_id == {}


def test_least_is_sought_where_less_is_better(searched):
    search, _ = searched(evaluations=60, by="mass_g")
    value = next(iter(search.assessment.by_id.values()))
    assert value == pytest.approx(1e3 * THIN, abs=0.01)
    assert value == min(search.assessment.by_id.values())


def test_few_designs_end_the_search(searched):
    text = TOML.split("[search]")[0] + '[search]\n"lattice.kind" = ["square", "hex"]'
    search, log = searched(text=text)
    assert len(log) == len(search.cases) == 2


def test_best_of_those_that_fulfil_a_requirement_is_found(searched):
    """Walls of 0.71 mm are the best, and weigh 0.71 g. Other patterns are 0.6 as good."""
    search, _ = searched(require={"max_mass": "0.65 g"})
    (best, value), *_ = search.assessment.by_id.items()
    walls = 1e3 * search.cases[best].lattice.wall_thickness
    assert 0.64 < walls <= 0.65
    assert value == energy(search.cases[best])
    assert value > 0.55 * exp(-((0.06 / 0.047) ** 2))
    assert all(
        1e3 * search.cases[i].lattice.wall_thickness <= 0.65 for i in search.assessment.by_id
    )


def test_search_approaches_requirements_that_none_fulfils(searched):
    """Both together: 1 J is absorbed at 0.71 mm only, which weighs 0.71 g."""
    need = {"max_mass": "0.65 g", "min_absorbed": "1 J"}
    search, _ = searched(require=need)
    assert search.assessment.by_id == {}
    nearest, missed = next(iter(search.assessment.missed.items()))
    assert missed == min(search.assessment.missed.values())
    kind, cells, _ = BEST
    lattice = search.cases[nearest].lattice
    assert (lattice.kind, lattice.cells_x) == (kind, cells)
    least = min(
        max(t / 0.65 - 1.0, 1.0 - exp(-(((t - 0.71) / 0.047) ** 2)))
        for t in [0.55 + 0.001 * k for k in range(200)]
    )
    assert missed == pytest.approx(least, rel=0.1)


@pytest.mark.parametrize(("share", "points"), [(1.0, 16), (0.01, 128), (0.0, MOST_TRIED)])
def test_a_first_design_is_sought_where_few_points_are_one(searched, monkeypatch, share, points):
    search, _ = searched(evaluations=1)

    def rare(_, point):
        return "a design" if point[0] <= share else None

    monkeypatch.setattr(DesignSpace, "case", rare)
    start = search._start(1000)
    assert len(start) == points
    assert any(search.space.case(point) for point in start) == (share > 0.0)
    assert not any(search.space.case(point) for point in start[: points // 2]) or points == 16


def test_mode_is_that_of_the_loading(searched):
    assert searched(evaluations=1)[0].start[0].loading.mode == "displacement"
