"""Results for a Python session: table, curves and pictures of the cases that are meant."""

from xml.etree import ElementTree

import numpy as np
import pytest

from sweep.config.faults import MisfitError
from sweep.ranking.question import RankError
from sweep.ranking.rank import ranked
from sweep.results import Picture, Results
from sweep.store.errors import StoreError
from sweep.store.read import read_history
from tests.support.results.specimens import designs, summary, write

PNG = b"\x89PNG"


@pytest.fixture
def file(tmp_path):
    """Three designs with curves and shapes, the last of which has failed."""
    rows = designs([1.0, 2.0, 3.0], [0.1, 0.3, 0.2])
    rows[2]["status"] = "stopped"
    return write(tmp_path / "trial.h5", summary(*rows))


def test_table_has_the_cases_of_the_sweep_in_its_order(file):
    ids = [f"{2:016x}", f"{0:016x}", "not run"]
    results = Results(file, ids)
    assert list(results.table["case_id"]) == ids[:2]
    assert list(results.table.index) == [0, 1]
    assert len(results) == 2
    assert len(Results(file)) == 3
    assert list(results.failed["case_id"]) == ids[:1]
    assert repr(results) == f"<Results of 2 cases, 1 failed, in {file}>"


def test_curve_is_that_of_the_row_or_id(file):
    results = Results(file, [f"{1:016x}", f"{0:016x}"])
    expected = read_history(file, f"{0:016x}")
    for case in (1, f"{0:016x}"):
        np.testing.assert_array_equal(results.curve(case), expected)
    assert results.shapes(1)["position_m"].shape[2] == 2
    for case, error, told in (
        (2, IndexError, "no case 2; allowed: 0 to 1, or an id"),
        (-1, IndexError, "no case -1"),
        ("0", KeyError, '"0" begins 2 ids of 2'),
        (results.table.iloc[0], MisfitError, r"Results.curve: case = .*; allowed: a whole number"),
    ):
        with pytest.raises(error, match=told):
            results.curve(case)


def test_a_file_whose_cases_failed_is_a_line_without_pictures(tmp_path):
    file = write(tmp_path / "trial.h5", summary({"status": "stopped"}))
    assert Results(file)._repr_html_() == f"<p>Results of 1 case, 1 failed, in {file}</p>"
    with pytest.raises(ValueError, match="there is nothing to draw"):
        Results(file).plot()
    with pytest.raises(StoreError, match="3 is no path; needed: the path of a results file"):
        Results(3)


def test_results_stand_for_their_file(file):
    results = Results(file)
    assert list(ranked(results).table["mass_g"]) == [2.0, 1.0]
    with pytest.raises(
        MisfitError, match=r"Results.rank: .*'bugdet'; its arguments: budget, panel"
    ):
        results.rank(bugdet="2 g")


def test_ranking_asks_what_the_config_asks_unless_told_otherwise(file):
    plain = Results(file)
    asked = Results(file, question={"budget": ["1.5 g"], "require": {"max_mass": "1 g"}})
    for results, question, masses in (
        (plain, {}, [2.0, 1.0]),
        (asked, {}, [1.0]),
        (asked, {"budget": "3 g"}, [1.0]),
        (asked, {"budget": "3 g", "require": {"max_mass": "2 g"}}, [2.0, 1.0]),
        (asked, {"budget": None}, [1.0]),
        (asked, {"budget": None, "require": None}, [2.0, 1.0]),
        (asked, {"budget": None, "require": None, "top": 1}, [2.0]),
    ):
        assert list(results.rank(**question)["mass_g"]) == masses
    best = plain.rank(panel=("100 mm", "100 mm"), allowed_force="300 N", per="panel")
    assert (best["panel_specimens"] > 1).all()
    with pytest.raises(RankError, match="budget"):
        plain.rank(budget=2.0)


def test_a_notebook_shows_the_ranking_with_a_drawing_of_each_design(file):
    shown = Results(file)._repr_html_()
    assert "Results of 3 cases, 1 failed" in shown
    rows = ElementTree.fromstring(f"<div>{shown}</div>").findall(".//tbody/tr")
    assert [row[2].text for row in rows] == ["2.00", "1.00"]
    assert all(row[0].find("{*}svg/{*}path") is not None for row in rows)
    assert len(shown) < 10_000
    within = Results(file, question={"budget": ["1.5 g"]})._repr_html_()
    assert within.count("<svg") == 1


def test_a_notebook_shows_no_markup_of_a_file(tmp_path):
    rows = designs([1.0, 2.0], [0.1, 0.2])
    rows[0]["material"] = "<script>alert(1)</script>"
    shown = Results(write(tmp_path / "a<b>.h5", summary(*rows)))._repr_html_()
    assert "&lt;script&gt;" in shown
    assert "a&lt;b&gt;.h5" in shown
    assert "<script" not in shown


def test_the_page_is_written_beside_the_results(file, tmp_path):
    assert Results(file).report() == tmp_path / "trial.html"
    assert "<script>" in (tmp_path / "trial.html").read_text("utf-8")
    own = Results(file).report(tmp_path / "pages" / "own.html")
    assert own.exists()


def test_picture_of_a_case_and_of_all(file, tmp_path):
    results = Results(file)
    first, energies = results.plot(0), results.plot(0, "energies")
    for picture in (first, energies, results.plot(0, "shapes"), results.plot()):
        assert isinstance(picture, Picture)
    assert first._repr_png_().startswith(PNG)
    path = energies.save(tmp_path / "energies.png")
    assert path.read_bytes().startswith(PNG)
    force, energy = (picture.figure.axes[0].get_ylabel() for picture in (first, energies))
    assert force != energy
    assert results.plot(0, "force").figure.axes[0].get_ylabel() == force
    with pytest.raises(ValueError, match='no picture "heat"; there are force, energies, shapes'):
        results.plot(0, "heat")
