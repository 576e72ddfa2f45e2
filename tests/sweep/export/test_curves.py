"""Curves as CSV."""

import pandas as pd
import pytest

from sweep.export.curves import with_stress, write_curves
from tests.support.results.specimens import summary, there_and_back

ROW = summary({}).iloc[0]  # 13 mm wide, 10 mm deep


def test_stress_is_force_per_area_over_all():
    found = with_stress(there_and_back(), ROW)
    area = 13e-3 * 10e-3
    assert found["stress_Pa"].max() == pytest.approx(28.0 / area)
    assert list(found)[4:6] == ["reaction_bottom_N", "stress_Pa"]


def test_file_has_all_columns_with_their_units(tmp_path):
    history = there_and_back()
    write_curves(tmp_path / "c.csv", history, ROW)
    read = pd.read_csv(tmp_path / "c.csv")
    needed = {"top_displacement_m", "reaction_top_N", "strain", "stress_Pa", "work_in_J", "bend_J"}
    assert needed <= {*read}
    pd.testing.assert_frame_equal(read[list(history)], history, check_dtype=False, rtol=1e-7)
    assert "stress_Pa" not in history


@pytest.mark.parametrize(
    ("row", "kinetic", "timed"),
    [
        ({}, 0.0, False),
        ({}, 1e-6, True),
        ({"material_memory": "relaxes"}, 0.0, True),
        ({"loading_mode": "impact"}, 0.0, True),
    ],
)
def test_a_crush_that_takes_no_time_has_none(row, kinetic, timed):
    history = there_and_back().assign(kinetic_J=kinetic)
    assert ("time_s" in with_stress(history, {**ROW, **row})) == timed
