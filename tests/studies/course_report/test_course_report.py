"""The figures of the report: their cases, and that each is a picture and a caption of numbers."""

from pathlib import Path

import numpy as np
import pytest

from tests.studies.course_report import __main__ as drawn
from tests.studies.course_report.cases import history, ours, report, run, share, varied

PACKAGE = Path(drawn.__file__).parent
PNG = b"\x89PNG"


def test_every_file_of_a_figure_is_drawn():
    shared = {"__init__", "__main__", "cases", "panels"}
    files = {path.stem for path in PACKAGE.glob("*.py")} - shared
    assert {draw.__module__.split(".")[-1] for draw in drawn.FIGURES.values()} == files


@pytest.mark.parametrize(
    ("name", "pictures"),
    [
        ("fig03_springs", {"fig03_springs"}),
        ("damping", {"damping"}),
        ("cycles", {"cycles"}),
    ],
)
def test_a_figure_is_a_picture_and_a_caption(name, pictures, tmp_path):
    drawn.caption(tmp_path / f"{name}.md", drawn.FIGURES[name](tmp_path))
    assert {path.stem for path in tmp_path.glob("*.png")} == pictures
    assert all(path.read_bytes().startswith(PNG) for path in tmp_path.glob("*.png"))
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
    assert varied(case) == case.model_copy(update={"axes": {}})
    pressed = varied(
        case, loading={"mode": "displacement", "strain": 0.2}, contact={"model": "none"}
    )
    assert (pressed.loading.strain, pressed.loading.force) == (0.2, None)
    assert pressed.solver.integrator == "static"
    assert varied(case, material={"stretch": "linear"}).material.curve_strain == ()


def test_a_case_is_run_once():
    case = varied(ours(), loading={"duration": 1e-3, "release_time": 1e-3})
    assert run(case) is run(varied(case))


def test_bending_in_times_of_stretching():
    case = varied(ours(), loading={"duration": 1e-3, "release_time": 1e-3})
    past = history(case)
    assert share(past, 1e-3) == pytest.approx((past["bend_J"] / past["stretch_J"]).iloc[-1])
    assert np.isfinite(share(past, 5e-4))
