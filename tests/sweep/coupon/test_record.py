"""Records of coupons: both kinds of columns, and a sentence for each fault."""

import numpy as np
import pytest

from sweep.coupon.record import Coupon, CouponError, coarse_modulus, read_coupon
from tests.support.materials.coupons import written

STRAIN = np.r_[np.linspace(0.0, 0.3, 201), np.linspace(0.3, 0.02, 201)[1:]]
TEST = Coupon("trial", 20.0 * np.r_[0.0, np.cumsum(np.abs(np.diff(STRAIN)))], STRAIN, 1e7 * STRAIN)


def changed(**columns):
    """`TEST` with other columns."""
    return Coupon("trial", *(columns.get(name, getattr(TEST, name)) for name in NAMES))


NAMES = ("time", "strain", "stress")


def test_strains_and_stresses_are_read_as_they_are(tmp_path):
    found = read_coupon(written(tmp_path, TEST))
    for name in NAMES:
        assert getattr(found, name) == pytest.approx(getattr(TEST, name))
    assert (found.name, found.sign) == ("coupon", 1.0)


def test_displacements_and_forces_need_the_size(tmp_path):
    heads = "time_s,displacement_mm,force_N"
    path = written(tmp_path, TEST, heads, (1.0, 33.0, 8e-6))
    found = read_coupon(path, gauge=33e-3, area=8e-6)
    assert found.strain == pytest.approx(TEST.strain)
    assert found.stress == pytest.approx(TEST.stress)
    with pytest.raises(CouponError, match=r"displacement_mm .* needed: --gauge"):
        read_coupon(path, area=8e-6)
    with pytest.raises(CouponError, match=r"force_N .* needed: --area"):
        read_coupon(path, gauge=33e-3)


def test_pressed_puck_has_negative_strains(tmp_path):
    found = read_coupon(written(tmp_path, TEST, scales=(1.0, -1.0, -1.0)))
    assert found.sign == -1.0
    assert coarse_modulus(found) == pytest.approx(coarse_modulus(TEST))


def test_modulus_is_the_slope_between_one_and_four_percent():
    strain = np.linspace(0.0, 0.1, 101)
    stress = 2e7 * np.minimum(strain, 0.05) + 1e4
    assert coarse_modulus(Coupon("trial", strain, strain, stress)) == pytest.approx(2e7)


@pytest.mark.parametrize(
    ("heads", "scales", "wrong"),
    [
        ("time_s,strain,stress_Pa", (1, 1, 1e-6), "is stress_Pa in MPa or kPa .*, a force"),
        ("time_s,strain,stress_Pa", (1, 1, 8e-6), "a modulus of .* Pa"),
        ("time_s,strain,stress_Pa", (1, 1, 1e6), "in another unit"),
        ("time_s,strain,stress_Pa", (1, 100, 1), "a strain of 30: .*percent"),
        ("time_s,strain,stress_Pa", (1, 0.1, 1), "up to 0.03; needed: at least 0.04"),
        ("time_s,strain,stress_Pa", (1, -1, 1), "opposite signs"),
        ("time_s,strain,stress_Pa", (1, -4, -1), "a strain of -1 or less"),
        ("time_s,strain,stress_Pa", (-1, 1, 1), "time_s does not .* row 1 to row 2"),
        ("time,strain,stress_Pa", (1, 1, 1), "no column time_s; .*: time, strain, stress_Pa"),
        ("time_s,e,stress_Pa", (1, 1, 1), "no column strain, .*displacement_mm"),
        ("time_s,strain,stress_MPa", (1, 1, 1e-6), "no column stress_Pa, .*, stress_MPa; units"),
        ("time_s,strain,stress_Pa,strain", (1, 1, 1), "two columns strain; needed: one"),
        ("Time,Strain,Stress", (1, 1, 1), "first row is Time, Strain, Stress; needed"),
        ("time_s,strain,stress_Pa", (1, 1, 0), "does not rise .*1 and 4 %"),
    ],
)
def test_what_has_other_units_or_columns_is_refused(tmp_path, heads, scales, wrong):
    with pytest.raises(CouponError, match=rf"coupon.csv: .*{wrong}"):
        read_coupon(written(tmp_path, TEST, heads, scales))


@pytest.mark.parametrize(
    ("test", "wrong"),
    [
        (changed(time=TEST.time[:, None] @ [[0.0]]), "time_s does not increase from row 1"),
        (changed(stress=TEST.stress * np.nan), "three finite numbers"),
        (changed(stress=TEST.stress + 1e6), "begins at .* 0 and 1e.06 Pa"),
        (changed(strain=TEST.strain + 0.01), "begins at a strain of 0.01"),
        (Coupon("short", *(getattr(TEST, name)[:19] for name in NAMES)), "19 rows are too few"),
    ],
)
def test_what_is_no_test_is_refused(tmp_path, test, wrong):
    flat = Coupon(test.name, test.time.reshape(-1), test.strain, test.stress)
    with pytest.raises(CouponError, match=wrong):
        read_coupon(written(tmp_path, flat))


def test_options_without_effect_and_files_that_are_none_are_refused(tmp_path):
    path = written(tmp_path, TEST)
    with pytest.raises(CouponError, match=r"--area has no effect, .*stress_Pa"):
        read_coupon(path, area=8e-6)
    with pytest.raises(CouponError, match="No such file"):
        read_coupon(tmp_path / "none.csv")
    path.write_text("")
    with pytest.raises(CouponError, match="no rows"):
        read_coupon(path)
    path.write_text("time_s,strain,stress_Pa\n" + "0,1\n" * 30)
    with pytest.raises(CouponError, match=r"row 1 has 2 values, .*3 heads"):
        read_coupon(path)
    path.write_text("time_s,strain,stress_Pa\n" + "0,1,soft\n" * 30)
    with pytest.raises(CouponError, match='stress_Pa in row 1 is "soft"'):
        read_coupon(path)


def columns(separator=",", point=".", first=""):
    """The text of a record with other signs; first: a row below its heads."""
    rows = np.column_stack([TEST.time, TEST.strain, TEST.stress])
    texts = [separator.join(f"{v:.8g}".replace(".", point) for v in row) for row in rows]
    heads = [separator.join(["time_s", "strain", "stress_Pa"]), *filter(None, [first])]
    return "\n".join([*heads, *texts, ""])


@pytest.mark.parametrize(
    ("text", "coding", "wrong"),
    [
        (columns(";"), "utf-8", "semicolons; needed: commas"),
        (columns(";", ","), "utf-8", "semicolons; .* points"),
        (columns("\t"), "utf-8", "separated by tabs"),
        (columns(",", ","), "utf-8", "3 heads; .*0.1, not 0,1"),
        (columns(first="s,-,Pa"), "utf-8", 'time_s in row 1 is "s".*needed: numbers'),
        (columns().replace("time_s,strain,stress_Pa", "0,0,0"), "utf-8", "first row is 0, 0, 0"),
        (columns(), "utf-16", "not UTF-8 text; needed: .*csv"),
        (columns().replace("time_s", "# 20 °C\ntime_s"), "latin-1", "not UTF-8 text"),
        ("# a comment alone\n", "utf-8", "no rows; needed: columns time_s, strain, stress_Pa"),
        ("stress_Pa\n" + "1\n" * 30, "utf-8", "no column time_s; its columns: stress_Pa"),
    ],
)
def test_files_of_other_programs_are_refused_with_what_is_needed(tmp_path, text, coding, wrong):
    path = tmp_path / "coupon.csv"
    path.write_bytes(text.encode(coding))
    with pytest.raises(CouponError, match=rf"coupon.csv: .*{wrong}"):
        read_coupon(path)


def test_marks_of_spreadsheets_and_blanks_do_no_harm(tmp_path):
    path = tmp_path / "coupon.csv"
    path.write_text(columns(", ").replace("\n", ",\n"), encoding="utf-8-sig")
    found = read_coupon(path)
    for name in NAMES:
        assert getattr(found, name) == pytest.approx(getattr(TEST, name))
