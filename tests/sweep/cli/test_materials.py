"""The verb `materials`: its lists, pictures, fits and refusals."""

import re

import numpy as np
import pytest

from sweep.config.materials.material_file import available
from tests.support.command import crumple
from tests.support.designs.tables import material_with
from tests.support.materials.coupons import coupon, written
from tests.support.materials.exports import measured, puck, text


def test_coupon_becomes_a_material(capsys, tmp_path):
    """It lies beside its coupon, unless --out says where."""
    test = coupon(0.5, 0.05, 0.5, loss=0.35)
    heads = "time_s,displacement_mm,force_N"
    file = written(tmp_path, test, heads, (1.0, 33.0, 8e-6))
    words = ["fit", str(file), "--gauge", "33 mm", "--area", "8 mm^2", "--density", "1.21 g/cm^3"]
    status, out, err = crumple(capsys, "materials", *words)
    assert (status, err) == (0, "")
    assert re.search(r"loss            0.35( ± 0.0\d+)?, without softening", out)
    found = material_with(name=str(tmp_path / "coupon_material.csv"), memory="measured")
    assert found.loss == pytest.approx(0.35, rel=0.01)
    assert found.density == pytest.approx(1210.0)
    assert crumple(capsys, "materials", *words, "--out", str(tmp_path / "mine.csv"))[0] == 0
    assert {path.name for path in tmp_path.iterdir()} == {
        *("coupon.csv", "coupon_material.csv", "coupon_material.png", "mine.csv", "mine.png")
    }


def test_answers_of_options_are_used_and_all_questions_are_asked_at_once(capsys, tmp_path):
    rows = puck(1.0)
    file = tmp_path / "puck.csv"
    file.write_text(text(["Time,Travel,Load"], measured(rows, 1e3), "{:.7f}"))
    status, out, err = crumple(capsys, "materials", "fit", str(file))
    assert (status, out) == (2, "")
    assert [line.split()[0] for line in err.splitlines()[1:]] == ["--units", "--gauge", "--area"]
    words = ["--gauge", "10 mm", "--area", "314.159265 mm^2", "--test", "pressed"]
    words += ["--units", "time=s", "displacement=mm", "force=kN", "--zero", "first"]
    words += ["--columns", "force=3", "--density", "1200 kg/m^3"]
    status, out, err = crumple(capsys, "materials", "fit", str(file), *words)
    assert (status, err) == (0, "")
    assert "force from Load [kN]" in out
    found = material_with(name=str(tmp_path / "puck_material.csv"))
    assert np.interp(-0.2, found.curve_strain, found.curve_stress) == pytest.approx(
        -np.interp(0.2, rows.strain[:161], rows.stress[:161]), rel=0.03
    )


@pytest.mark.parametrize(
    ("words", "wrong"),
    [
        (["chetah"], '"chetah" is no material; allowed: abs, '),
        (["plot", "chetah"], '"chetah" is no material'),
        (["plot", "--out", "a.pdf"], "a.pdf; allowed: "),
        (["cheetah", "--out", "a.png"], "--out belongs to"),
        (["--area", "8 mm^2"], "--area belongs to fit"),
        (["--units", "force=N"], "--units belongs to fit"),
        (["fit", "COUPON", "--units", "load=N"], "--units load; allowed: time=..., "),
        (["fit"], "one coupon"),
        (["fit", "none.csv"], "none.csv: "),
        (["fit", "COUPON", "--out", "COUPON"], "allowed: another file, "),
        (["fit", "COUPON", "--out", "a.txt"], "allowed: another file, "),
        (["fit", "COUPON", "--gauge", "33"], "a bare number"),
        (["fit", "COUPON", "--area", "8 mm"], "another kind"),
        (["fit", "COUPON", "--area", "8 mm^2"], "--area has no effect"),
    ],
)
def test_refusals_take_a_line_and_exit_with_2(capsys, tmp_path, words, wrong):
    file = str(written(tmp_path, coupon(0.3)))
    given = [file if word == "COUPON" else word for word in words]
    status, out, err = crumple(capsys, "materials", *given)
    assert (status, out) == (2, "")
    assert err.startswith("crumple materials: ")
    assert wrong in err
    assert err.count("\n") == 1


def test_materials_are_listed_told_and_drawn(capsys, tmp_path):
    _, out, _ = crumple(capsys, "materials")
    assert all(name in out for name in available())
    _, out, _ = crumple(capsys, "materials", "cheetah", "ninjaflex")
    assert out.startswith("cheetah\n  Cheetah (95A), printed")
    assert "doi 10.1089/3dp.2023.0010" in out
    assert "\nninjaflex\n" in out
    picture = tmp_path / "two.png"
    words = ("plot", "cheetah", "ninjaflex", "--out", str(picture))
    assert crumple(capsys, "materials", *words) == (0, f"{picture}\n", "")
    assert picture.read_bytes().startswith(b"\x89PNG")
