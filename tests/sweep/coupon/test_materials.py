"""Materials from Python: the table, and a coupon fitted as the command does it."""

import pytest

from sweep.config.faults import ConfigError, MisfitError
from sweep.config.load import case
from sweep.config.materials.material_file import available, locate, read_record
from sweep.coupon.materials import fit_material, materials
from sweep.coupon.record import CouponError
from tests.support.command import crumple
from tests.support.materials.coupons import coupon, written


def test_every_material_has_a_row():
    table = materials()
    assert list(table.index) == available()
    record = read_record(locate("ninjaflex"))
    row = table.loc["ninjaflex"]
    low, high = record.ranges["modulus"]
    assert (row["modulus_Pa"], row["modulus_Pa_low"], row["modulus_Pa_high"]) == (
        record.modulus, low, high,
    )  # fmt: skip
    assert (table["modulus_Pa_low"] <= table["modulus_Pa"]).all()
    assert table["yield_stress_Pa"].notna().sum() == 2
    assert (table["source"] != "").all()


SIZES = {"gauge": "33 mm", "area": "8 mm^2", "density": "1.21 g/cm^3"}


@pytest.fixture
def record(tmp_path):
    """A strip as a machine exports it."""
    test = coupon(0.5, 0.05, 0.5, loss=0.35)
    return written(tmp_path, test, "time_s,displacement_mm,force_N", (1.0, 33.0, 8e-6))


def test_a_coupon_is_fitted_as_the_command_does_it(capsys, tmp_path, record):
    options = [word for name, text in SIZES.items() for word in (f"--{name}", text)]
    told = tmp_path / "told.csv"
    crumple(capsys, "materials", "fit", str(record), "--out", str(told), *options)
    fitted = fit_material(record, **SIZES)
    assert fitted == tmp_path / "coupon_material.csv"
    assert fitted.read_text("utf-8") == told.read_text("utf-8")
    material = case(**{"material.name": str(fitted), "material.memory": "measured"}).material
    assert material.loss == pytest.approx(0.35, rel=0.01)


def test_what_a_record_leaves_open_is_asked_for(record):
    with pytest.raises(CouponError, match="--gauge"):
        fit_material(record)
    with pytest.raises(ConfigError, match="a length with a unit"):
        fit_material(record, gauge="33")
    with pytest.raises(CouponError, match="--density: -1200 in SI; allowed: above 0"):
        fit_material(record, **SIZES | {"density": "-1200 kg/m^3"})
    for option, allowed in {"test": "pulled, pressed", "zero": "first, line"}.items():
        with pytest.raises(CouponError, match=f"--{option} last; allowed: {allowed}"):
            fit_material(record, **SIZES | {option: "last"})
    with pytest.raises(MisfitError, match="allowed: another file"):
        fit_material(record, record, **SIZES)
