"""The study of tied sides: its table, and a small piece of it."""

import pandas as pd
import pytest

from sweep.simulation.simulate import simulate
from tests.studies.sides import panels, wide
from tests.studies.sides.panels import NARROW, WIDE, crush, strips
from tests.studies.sides.table import middle, table


def test_every_infill_between_all_platens_in_all_widths():
    cases = [crush(strip) for strip in strips()]
    assert len({case.case_id for case in cases}) == 8 * (3 * (2 * len(NARROW) + len(WIDE)) + 1)
    assert sum(case.widens for case in cases) == 8 * len(NARROW)


def test_a_piece_of_the_study(monkeypatch):
    """Few cells with tied sides are the middle of the panel; with free sides they are not."""
    monkeypatch.setattr(panels, "STEPS", 50)
    piece = strips(kinds=("square",), platens=("glued", "smooth"), narrow=(3,))
    rows = {strip: pd.Series(simulate(crush(strip)).summary) for strip in piece}
    sheet = table(rows)
    assert [line[:2] for line in sheet.rows] == [
        ["square", platens] for platens in ("glued", "smooth")
    ]
    for *_, free, tied in sheet.rows:
        assert abs(float(tied)) < 0.1
        assert abs(float(free)) > 1.0


def test_the_middle_is_what_a_wider_strip_has_more():
    edges, cell = (2.0, 1.0), (0.3, 0.1)  # energy in J and mass in g
    wide = (
        {"absorbed_energy_J": edges[0] + n * cell[0], "mass_g": edges[1] + n * cell[1]}
        | {"status": "converged"}
        for n in WIDE
    )
    assert middle(*wide) == pytest.approx(3e3)


def test_what_stopped_has_no_error():
    piece = strips(kinds=("square",), platens=("glued",), narrow=(3,))
    one = {"absorbed_energy_J": 1.0, "mass_g": 1.0, "specific_absorption_J_per_g": 1.0}
    rows = {
        strip: one | {"status": "stopped" if strip.cells == 48 else "converged"} for strip in piece
    }
    assert table(rows).rows[0][4:] == ["-", "-", "-"]


def test_a_piece_of_the_study_of_wide_panels():
    """Narrow panels take part; a slicer's pattern has nothing to be compared with."""
    few, tied = wide.Panel("square", "glued", 3), wide.Panel("square", "glued", 3, "periodic")
    sliced = wide.Panel("grid", "round", 0)
    rows = {panel: pd.Series(simulate(wide.pressed(panel)).summary) for panel in (few, tied)}
    rows |= {sliced: rows[few], few._replace(cells=24): rows[tied]}
    (line, other), (_, count) = (sheet := wide.table(rows)).rows, sheet.notes
    assert (line[0], line[-1], other[-2:]) == ("square", "+0.0", ["-", "-"])
    assert abs(float(line[-2])) > 1.0
    assert count == "4 of 4 crushes converge."
    assert wide.pressed(sliced).loading.striker_radius == 5e-3


def test_wide_panels_are_of_all_infills_and_of_a_slicer():
    cases = [wide.pressed(panel) for panel in wide.panels()]
    assert len({case.case_id for case in cases}) == 8 * 9 + 15
