"""Measures of a measured curve, against closed forms."""

import numpy as np
import pandas as pd
import pytest

from sweep.published.curve import measure_of, read_curve
from sweep.published.table import PublishedError

SPECIMEN = pd.Series({"stroke_m": 6e-3, "height_m": 10e-3, "outer_width_m": 20e-3, "depth_m": 5e-3})


def written(folder, travel, force):
    """A csv file of a curve (mm, N) that begins at 1 mm, with a comment and one more column."""
    rows = [f"{n},{1.0 + x},{f}" for n, (x, f) in enumerate(zip(travel, force, strict=True))]
    file = folder / "curve.csv"
    file.write_text("\n".join(["# my press", "row,displacement_mm,force_N", *rows, ""]))
    return file


@pytest.mark.parametrize(
    ("measure", "expected"),
    [
        ("absorbed_energy_J", 0.5 * 12.0 * 6e-3),
        ("peak_force_N", 12.0),
        ("plateau_stress_iso_Pa", 6.0 / 1e-4),
        ("energy_to_50_J_per_m3", 0.5 * 10.0 * 5e-3 / 1e-6),
    ],
)
@pytest.mark.parametrize("rows", [14, 81])
def test_force_that_rises_with_travel(tmp_path, rows, measure, expected):
    """F = 2 N/mm x, recorded beyond the simulated stroke, which may end between two rows."""
    travel = np.linspace(0.0, 8.0, rows)
    file = written(tmp_path, travel, 2.0 * travel)
    within = 1e-6 if rows == 81 or "absorbed" in measure or "peak" in measure else 0.02
    assert measure_of(file, measure, SPECIMEN) == pytest.approx(expected, rel=within)


def test_travel_counts_from_the_first_row(tmp_path):
    travel, force = read_curve(written(tmp_path, np.arange(12.0), np.ones(12)))
    assert (travel[0], travel[-1], force[0]) == pytest.approx((0.0, 11e-3, 1.0))


@pytest.mark.parametrize(
    ("travel", "measure", "wrong"),
    [
        (np.linspace(0.0, 5.0, 20), "absorbed_energy_J", "ends at 5 mm; needed: the whole"),
        (np.linspace(0.0, 7.0, 20), "mass_g", "allowed of a curve: plateau_stress_iso_Pa, "),
        ([*range(8), *range(8)], "peak_force_N", "travel that never falls"),
        (range(8), "peak_force_N", "8 rows; needed: 10 rows or more"),
    ],
)
def test_curves_that_do_not_do_are_refused(tmp_path, travel, measure, wrong):
    file = written(tmp_path, travel, np.ones(len(travel)))
    with pytest.raises(PublishedError, match=wrong):
        measure_of(file, measure, SPECIMEN)


@pytest.mark.parametrize("text", ["", "a,b\n1,2\n", "displacement_mm,force_N\n1,x\n"])
def test_other_files_are_refused(tmp_path, text):
    (tmp_path / "c.csv").write_text(text)
    with pytest.raises(PublishedError, match="needed: a csv file with the heads displacement_mm"):
        read_curve(tmp_path / "c.csv")
