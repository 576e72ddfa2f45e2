"""The search: it finds a narrow peak, is resumed by replay, and survives what fails."""

import json

import pytest

from sweep.config.units import load_config
from sweep.running.design_space import DesignSpace
from sweep.running.search import Search, Settings
from sweep.store.read import read_attributes, read_summary
from tests.support.results.searches import BEST, THIN, TOML, simulate

QUESTION = {"budget": None, "panel": None, "by": "absorbed_energy_J", "allowed_force": None}


@pytest.fixture
def searched(tmp_path):
    """A finished search, and the cases that it ran."""

    def run(evaluations=100, seed=1, text=TOML, by="absorbed_energy_J"):
        path, log = tmp_path / "sought.toml", []
        path.write_text(text)

        def logged(case, control):
            log.append(case.case_id)
            return simulate(case)

        space, how = DesignSpace(load_config(path)), Settings(evaluations, seed, workers=1)
        search = Search(space, QUESTION | {"by": by}, tmp_path / "sought.h5", how, logged)
        search.run()
        return search, log

    return run


@pytest.mark.parametrize("seed", [1, 2])
def test_a_narrow_peak_of_one_pattern_is_found(searched, seed):
    """The peak takes 1/3 x 1/5 x 1/10 of the cube."""
    search, log = searched(seed=seed)
    (best, value), *_ = search.found.by_id.items()
    kind, cells, walls = BEST
    lattice = search.cases[best].lattice
    assert (lattice.kind, lattice.cells_x) == (kind, cells)
    assert 1e3 * lattice.wall_thickness == pytest.approx(walls, abs=0.02)
    assert value > 0.9
    assert len(log) == len(set(log)) == len(search.cases) == 100


def test_same_seed_runs_nothing_again_and_continues(searched):
    _, first = searched(evaluations=20)
    search, more = searched(evaluations=60)
    assert len(first) == 20
    assert not {*first} & {*more}
    assert search.cases.keys() == {*first, *more}
    again, none = searched(evaluations=60)
    assert none == []
    assert again.found.by_id == search.found.by_id
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
    kinds = {search.cases[case_id].lattice.kind for case_id in search.found.by_id}
    assert kinds == {"square", "hex"}
    assert any(case.lattice.kind == "brick" for case in search.cases.values())
    assert search.found.doubtful > 0
    thin = [search.cases[case_id].lattice.wall_thickness for case_id in search.found.by_id]
    assert min(thin) >= THIN


def test_all_failed_is_no_exception(searched):
    text = TOML.replace('["square", "hex", "diamond"]', '["brick"]')
    search, _ = searched(evaluations=20, text=text)
    assert len(search.cases) == 20
    assert search.found.by_id == {}


def test_least_is_sought_where_less_is_better(searched):
    search, _ = searched(evaluations=60, by="mass_g")
    value = next(iter(search.found.by_id.values()))
    assert value == pytest.approx(1e3 * THIN, abs=0.01)
    assert value == min(search.found.by_id.values())


def test_few_designs_end_the_search(searched):
    text = TOML.split("[search]")[0] + '[search]\n"lattice.kind" = ["square", "hex"]'
    search, log = searched(text=text)
    assert len(log) == len(search.cases) == 2
