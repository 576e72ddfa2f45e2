"""Records of coupons: how they are read and shifted, and a sentence for each fault."""

import numpy as np
import pytest

from sweep.coupon.answers import Answers
from sweep.coupon.record import Coupon, CouponError, read_coupon
from tests.support.materials.coupons import written

STRAIN = np.r_[np.linspace(0.0, 0.3, 201), np.linspace(0.3, 0.02, 201)[1:]]
TEST = Coupon("trial", 20.0 * np.r_[0.0, np.cumsum(np.abs(np.diff(STRAIN)))], STRAIN, 1e7 * STRAIN)
NAMES = ("time", "strain", "stress")


def changed(**columns):
    """`TEST` with other columns."""
    return Coupon("trial", *(columns.get(name, getattr(TEST, name)) for name in NAMES))


def test_strains_and_stresses_are_read_as_they_are(tmp_path):
    found = read_coupon(written(tmp_path, TEST))
    for name in NAMES:
        assert getattr(found, name) == pytest.approx(getattr(TEST, name))
    assert (found.name, found.sign) == ("coupon", 1.0)
    assert found.notes[1] == "time from time [s], strain from strain [1], stress from stress [Pa]"


def test_displacements_and_forces_need_the_size(tmp_path):
    heads = "time_s,displacement_mm,force_N"
    path = written(tmp_path, TEST, heads, (1.0, 1e3 * 33e-3, 8e-6))
    found = read_coupon(path, Answers(gauge=33e-3, area=8e-6))
    assert found.strain == pytest.approx(TEST.strain)
    assert found.stress == pytest.approx(TEST.stress)
    with pytest.raises(CouponError, match=r"coupon.csv: needed: --gauge .*displacement \[mm\]$"):
        read_coupon(path, Answers(area=8e-6))
    with pytest.raises(CouponError, match=r"needed, all in one command:\n  --gauge .*\n  --area "):
        read_coupon(path)


def test_pressed_puck_has_negative_strains(tmp_path):
    found = read_coupon(written(tmp_path, TEST, scales=(1.0, -1.0, -1.0)))
    assert found.sign == -1.0
    assert found.stress == pytest.approx(-TEST.stress)


def test_test_of_a_file_is_what_the_user_says(tmp_path):
    path = written(tmp_path, TEST, scales=(1.0, 1.0, -1.0))
    with pytest.raises(CouponError, match=r"needed: --test .*: .* opposite signs$"):
        read_coupon(path)
    for test, sign in (("pulled", 1.0), ("pressed", -1.0)):
        found = read_coupon(path, Answers(test=test))
        assert found.strain == pytest.approx(sign * TEST.strain)
        assert found.stress == pytest.approx(sign * TEST.stress)


READY = "time_s,strain,stress_Pa"


@pytest.mark.parametrize(
    ("heads", "scales", "wrong"),
    [
        (READY, (1, 1, 1e-6), "needed: --units stress=MPa if it is in MPa: a"),
        (READY, (1, 1, 0), r"--columns stress=..., or force.*: time, strain, stress \(constant\)"),
        (READY, (0, 1, 1), "--columns time=..."),
        ("day,strain,stress_Pa", (1, 1, 1), "--speed .*, or --columns time=...; its heads: day, "),
        ("time_s,e,stress_Pa", (1, 1, 1), "--columns strain=..., or displacement=... with --gaug"),
    ],
)
def test_what_has_other_units_or_columns_is_refused(tmp_path, heads, scales, wrong):
    with pytest.raises(CouponError, match=rf"coupon.csv: .*{wrong}"):
        read_coupon(written(tmp_path, TEST, heads, scales))


@pytest.mark.parametrize("name", ["strain", "stress"])
def test_a_chosen_column_of_one_number_is_refused(tmp_path, name):
    path = written(tmp_path, changed(**{name: 0.0 * TEST.strain}))
    number = str(1 + ["time", "strain", "stress"].index(name))
    with pytest.raises(CouponError, match=f"the same {name} in all rows; needed: a column"):
        read_coupon(path, Answers(columns={name: number}))


def test_preload_is_shifted_as_the_user_says_with_a_sentence(tmp_path):
    path = written(tmp_path, changed(strain=TEST.strain + 0.01, stress=TEST.stress + 1e6))
    with pytest.raises(CouponError, match=r"needed: --zero first or --zero line: .* begins with"):
        read_coupon(path)
    found = read_coupon(path, Answers(zero="first"))
    assert found.strain == pytest.approx(TEST.strain, abs=1e-9)
    assert found.stress == pytest.approx(TEST.stress, abs=1.0)
    assert found.notes[-1].startswith("the record begins at a strain of 0.01 and 1 MPa")
    line = read_coupon(path, Answers(zero="line"))
    assert line.stress[1:] == pytest.approx(1e7 * line.strain[1:], rel=1e-6)
    assert (line.strain[0], line.stress[0]) == (0.0, 0.0)
