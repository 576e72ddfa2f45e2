"""The figures of the report: their cases, and that each is a picture and a caption of numbers."""

from pathlib import Path

import numpy as np
import pytest
from pandas import DataFrame

from tests.studies.course_report import __main__ as drawn
from tests.studies.course_report import frames, springs
from tests.studies.course_report.cases import (
    converges,
    first,
    history,
    ours,
    report,
    run,
    share,
    varied,
)

PACKAGE = Path(drawn.__file__).parent
PNG = b"\x89PNG"


def test_every_file_of_a_figure_is_drawn():
    shared = {"__init__", "__main__", "cases", "test_course_report"}
    files = {path.stem for path in PACKAGE.glob("*.py")} - shared
    assert {draw.__module__.split(".")[-1] for draw in drawn.FIGURES.values()} == files


@pytest.mark.parametrize("name", ["fig03_springs", "damping", "cycles"])
def test_a_figure_is_a_picture_and_a_caption(name, tmp_path):
    drawn.caption(tmp_path / f"{name}.md", drawn.FIGURES[name](tmp_path))
    (picture,) = tmp_path.glob("*.png")
    assert picture.stem == name
    assert picture.read_bytes().startswith(PNG)
    text = (tmp_path / f"{name}.md").read_text("utf-8")
    assert [part.split(".**")[0] for part in text.split("\n\n")] == [
        "**The report",
        "**Here",
        "**Where they differ, and why",
    ]
    assert "nan" not in text


def test_report_and_ours_differ_in_the_model_alone():
    one, other = report(), ours()
    assert (one.lattice, one.material, one.loading) == (
        other.lattice,
        other.material,
        other.loading,
    )
    assert one.damping == other.damping
    assert (one.contact.model, other.contact.model) == ("position_based", "barrier")
    assert (one.solver.hessian, other.solver.hessian) == ("tangent_modulus", "exact")
    assert (one.solver.element, other.solver.element) == ("classical", "cubic")
    assert (one.solver.bend_measure, other.solver.bend_measure) == ("tangent", "angle")


def test_a_varied_case_differs_in_what_is_named():
    case = report()
    assert varied(case) == case
    pressed = varied(
        case, loading={"mode": "displacement", "strain": 0.2}, contact={"model": "none"}
    )
    assert (pressed.loading.mode, pressed.loading.strain) == ("displacement", 0.2)
    assert pressed.solver.integrator == "static"
    assert pressed.axes == case.axes | {
        "loading.mode": "displacement",
        "loading.strain": 0.2,
        "contact.model": "none",
    }
    assert varied(case, material={"stretch": "linear"}).material.curve_strain == ()


def test_springs_fold_below_the_row_that_is_held():
    loose = springs.loose()
    assert history(loose)["strain"].iloc[-1] == pytest.approx(2.067, rel=1e-3)
    assert len(run(loose).frames["time_s"]) > 20


def test_no_picture_is_drawn_of_a_case_that_stops(monkeypatch, tmp_path):
    """With steps of 0.1 ms walls cross."""
    stops = varied(report(), solver={"time_step": 1e-4}, loading=springs.SHORT)
    assert not converges(stops)
    monkeypatch.setattr(frames, "report", lambda: stops)
    with pytest.raises(
        SystemExit, match=rf"^case {stops.case_id}, .*solver.time_step = 0.0001.*: the solution d"
    ):
        frames.draw(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_what_never_happens_has_no_time():
    curves = DataFrame({"time_s": [0.0, 1.0, 2.0], "strain": [0.0, 0.3, 0.6]})
    assert first(curves, curves["strain"] > 0.5) == 2.0
    with pytest.raises(ValueError, match="never happens"):
        first(curves, curves["strain"] > 0.7)


def test_a_case_is_run_once():
    case = varied(ours(), loading={"duration": 1e-3, "release_time": 1e-3})
    assert run(case) is run(varied(case))


def test_bending_in_times_of_stretching():
    case = varied(ours(), loading={"duration": 1e-3, "release_time": 1e-3})
    past = history(case)
    assert share(past, 1e-3) == pytest.approx((past["bend_J"] / past["stretch_J"]).iloc[-1])
    assert np.isfinite(share(past, 5e-4))
