"""Exports of testing machines: the same strip, however it is written, is the same record."""

import numpy as np
import pytest

from sweep.coupon.answers import Answers
from sweep.coupon.record import CouponError, read_coupon
from tests.support.materials.exports import AREA, GAUGE, PUCK, measured, puck, strip, text

ROWS = strip()
SIZES = {"gauge": GAUGE, "area": AREA}
OURS = ["time_s,displacement_mm,force_N"]
ZWICK = ['"Specimen width",4.89,"mm"', '"Cross-section",8,"mm²"', '"Gage length",50,"mm"']
ZWICK += ['"Operator",""', '"v1",1,"mm/min"']
ZWICK += ['"Time","Crosshead absolute","Standard force","Standard travel"', '"s","mm","N","mm"']
MTS = ["File Path: C:\\DAQ- Crosshead; … - (Timed).txt   ", "Date: 06/11/2019 09:45:38", "", ""]
MTS += ["_Extension \t_Load \t_Time ", "mm\tkN\tsec"]
MACHINE = ["Results Table 1", "", "Time,Displacement,Force", "(s),(mm),(kN)"]
BLUEHILL = ["Dimension : Length,50,mm", "", "Time,Extension,Load,Tensile strain,Tensile stress"]
BLUEHILL += ["(sec),(mm),(N),(mm/mm),(MPa)"]
WALTER = ["S/No;C_1_Temps[s];C_1_Force[kN];C_1_Cycles[];C_1_Déplacement[mm];"]
GERMAN = ["Zeit  1 - Messrate [s]\tKraft [N]\tStandardwegaufnehmer [mm]\tPyrometer [°C]"]
TIME, WAY, FORCE, NONE = ROWS.time, ROWS.displacement, ROWS.force, 0.0 * ROWS.time
SLIDE = 0.4 * WAY + 0.01 * TIME  # of another sensor
RATIOS, STATED = [TIME, ROWS.strain / 0.01, ROWS.stress / 1e6], {"gauge": None, "area": None}
NUMBERS = {
    "columns": {"time": "1", "displacement": "2", "force": "3"},
    "units": {"time": "s", "displacement": "mm", "force": "N"},
}


EXPORTS = {
    "kN": (text(OURS, measured(ROWS, 1e3), "{:.4f}"), {"units": {"force": "kN"}}),
    "machine": (text(MACHINE, measured(ROWS, 1e3), ['"{:.4f}"'] * 3), {}),
    "percent_MPa": (
        text(["time_s,strain,stress_Pa"], RATIOS),
        {"units": {"strain": "%", "stress": "MPa"}} | STATED,
    ),
    "preload": (text(OURS, [TIME, WAY + 1.2, FORCE + 0.4]), {}),
    "semicolon_comma": (
        text(["time_s;displacement_mm;force_N"], measured(ROWS), separator=";", decimal=","),
        {},
    ),
    "walter and bai": (
        text(WALTER, [TIME, TIME, FORCE / 1e3, NONE, WAY], [*["{:.7f}"] * 4, "{:.7f};"], ";"),
        {},
    ),
    "testXpert": (
        text(ZWICK, [TIME + 9.5, SLIDE - 755.4, FORCE, WAY], "{:.6f}"),
        {"columns": {"displacement": "standard travel"}} | STATED,
    ),
    "TestSuite": (text(MTS, [WAY, FORCE / 1e3, TIME], "{:.9f}", "\t", ","), {}),
    "german": (text(GERMAN, [TIME, FORCE, WAY, NONE + 300.0], "{:.5f}", "\t"), {}),
    "Bluehill": (text(BLUEHILL, [TIME, WAY, FORCE, ROWS.strain, ROWS.stress / 1e6]), STATED),
    "no heads": (text([], measured(ROWS)), NUMBERS),
    "no time": (
        text(["Index,Force [ kN ],Déplacement [ mm ]"], [TIME, FORCE / 1e3, WAY - 0.17], "{:.9f}"),
        {"speed": 2.5e-3},
    ),
}
ENCODINGS = {"testXpert": "cp1252", "TestSuite": "utf-16", "german": "cp1252"}


def stored(folder, name, content):
    path = folder / f"{name}.csv"
    path.write_bytes(content.encode(ENCODINGS.get(name, "utf-8")))
    return path


@pytest.mark.parametrize("name", EXPORTS)
def test_however_it_is_written_it_is_the_same_record(tmp_path, name):
    content, answers = EXPORTS[name]
    found = read_coupon(stored(tmp_path, name, content), Answers(**{**SIZES, **answers}))
    assert found.time == pytest.approx(ROWS.time, abs=1e-6)
    assert found.strain == pytest.approx(ROWS.strain, abs=1e-5)
    within = 1e-3 if name in ("kN", "machine") else 1e-5  # rounded to 0.1 N
    assert found.stress == pytest.approx(ROWS.stress, abs=within * ROWS.stress.max())


@pytest.mark.parametrize(
    ("name", "answers", "options"),
    [
        ("kN", SIZES, ["--units force=kN"]),
        ("percent_MPa", {}, ["--units strain=%", "--units stress=MPa"]),
        ("machine", {}, ["--gauge", "--area"]),
    ],
)
def test_what_cannot_be_decided_is_asked_for_at_once(tmp_path, name, answers, options):
    with pytest.raises(CouponError) as asked:
        read_coupon(stored(tmp_path, name, EXPORTS[name][0]), Answers(**answers))
    needed = str(asked.value).split("needed", 1)[1]
    assert [option for option in options if option not in needed] == []
    assert needed.count("--") == len(options)
    assert str(asked.value).count("\n") < 12


def test_all_that_is_needed_of_a_puck_is_asked_for_at_once(tmp_path):
    content = text(["Time,Travel,Load"], measured(puck(1.0)))
    with pytest.raises(CouponError) as asked:
        read_coupon(stored(tmp_path, "puck", content))
    for option in ("--units time=s displacement=mm force=N", "--gauge", "--area"):
        assert option in str(asked.value)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_puck_is_pressed_whatever_its_sign_or_it_is_asked_for(tmp_path, sign):
    rows = puck(sign)
    path = stored(tmp_path, "puck", text(OURS, measured(rows)))
    if sign > 0.0:
        with pytest.raises(CouponError, match=r"needed: --test pulled or --test pressed: .* grows"):
            read_coupon(path, Answers(**PUCK))
    found = read_coupon(path, Answers(**PUCK, test="pressed" if sign > 0.0 else None))
    assert found.sign == -1.0
    assert found.strain == pytest.approx(-np.abs(rows.strain), abs=1e-5)
    assert found.stress == pytest.approx(-np.abs(rows.stress), rel=1e-4, abs=1e2)


@pytest.mark.parametrize(("rows", "sizes"), [(puck(1.0), PUCK), (ROWS, SIZES)])
def test_a_test_whose_file_says_that_it_is_pressed_is_not_asked_for(tmp_path, rows, sizes):
    content = text(["Compression test 3", *OURS], measured(rows))
    found = read_coupon(stored(tmp_path, "puck", content), Answers(**sizes))
    assert found.sign == -1.0
    assert found.notes[-1] == "pressed, as the file says, not its signs"
