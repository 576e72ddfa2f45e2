"""Exports of testing machines: the same strip, however it is written, is the same record."""

import numpy as np
import pytest

from sweep.coupon.answers import Answers
from sweep.coupon.record import CouponError, read_coupon
from tests.support.materials.exports import AREA, GAUGE, PUCK, measured, puck, strip, text

ROWS = strip()
SIZES = {"gauge": GAUGE, "area": AREA}
OURS = ["time_s,displacement_mm,force_N"]
QUOTED = ['"{:.4f}"', '"{:.4f}"', '"{:.4f}"']
ZWICK = ['"Specimen width",4.89,"mm"', '"Cross-section",8,"mm²"', '"Gage length",50,"mm"']
ZWICK += ['"Operator",""', '"v1",1,"mm/min"']
MTS = ["File Path: C:\\DAQ- Crosshead; … - (Timed).txt   ", "Date: 06/11/2019 09:45:38", "", ""]
WAY = [ROWS.displacement, ROWS.force / 1e3, ROWS.time]
SLIDE = 0.4 * ROWS.displacement + 0.01 * ROWS.time  # of another sensor
BLUEHILL = ["Dimension : Length,50,mm", "", "Time,Extension,Load,Tensile strain,Tensile stress"]


NINE = {
    "kN": (text(OURS, measured(ROWS, 1e3), "{:.4f}"), {"units": {"force": "kN"}}),
    "machine": (
        text(
            ["Results Table 1", "", "Time,Displacement,Force", "(s),(mm),(kN)"],
            measured(ROWS, 1e3),
            QUOTED,
        ),
        {},
    ),
    "percent_MPa": (
        text(["time_s,strain,stress_Pa"], [ROWS.time, ROWS.strain / 0.01, ROWS.stress / 1e6]),
        {"units": {"strain": "%", "stress": "MPa"}, "gauge": None, "area": None},
    ),
    "preload": (
        text(OURS, [ROWS.time, ROWS.displacement + 1.2, ROWS.force + 0.4]),
        {},
    ),
    "quoted": (text(OURS, measured(ROWS), ['"{:.5f}"'] * 3), {}),
    "semicolon_comma": (
        text(["time_s;displacement_mm;force_N"], measured(ROWS), separator=";", decimal=","),
        {},
    ),
    "tabs": (text(["time_s\tdisplacement_mm\tforce_N"], measured(ROWS), separator="\t"), {}),
    "units_in_heads": (text(["Time [s],Displacement [mm],Force [N]"], measured(ROWS)), {}),
    "utf16": (text(OURS, measured(ROWS)), {}),
}
MACHINES = {
    "walter and bai": (
        text(
            ["S/No;C_1_Temps[s];C_1_Force[kN];C_1_Cycles[];C_1_Déplacement[mm];"],
            [ROWS.time, ROWS.time, ROWS.force / 1e3, 0.0 * ROWS.time, ROWS.displacement],
            [*["{:.7f}"] * 4, "{:.7f};"],
            ";",
        ),
        {},
    ),
    "trapezium": (
        text(['"C35",,', '"Temps","Force","Stroke"', '"sec","N","mm"'], [ROWS.time, ROWS.force,
             ROWS.displacement], ['"{:.7f}"'] * 3),
        {},
    ),
    "testXpert": (
        text(
            [
                *ZWICK,
                '"Time","Crosshead absolute","Standard force","Standard travel"',
                '"s","mm","N","mm"',
            ],
            [ROWS.time + 9.5, SLIDE - 755.4, ROWS.force, ROWS.displacement],
            "{:.6f}",
        ),
        {"columns": {"displacement": "standard travel"}, "gauge": None, "area": None},
    ),
    "TestSuite": (
        text([*MTS, "_Extension \t_Load \t_Time ", "mm\tkN\tsec"], WAY, "{:.9f}", "\t", ","),
        {},
    ),
    "german": (
        text(["Zeit  1 - Messrate [s]\tKraft [N]\tStandardwegaufnehmer [mm]\tPyrometer [°C]"],
             [ROWS.time, ROWS.force, ROWS.displacement, 300.0 + 0.0 * ROWS.time],
             "{:.5f}", "\t"),
        {},
    ),
    "Bluehill": (
        text(
            [*BLUEHILL, "(sec),(mm),(N),(mm/mm),(MPa)"],
            [ROWS.time, ROWS.displacement, ROWS.force, ROWS.strain, ROWS.stress / 1e6],
        ),
        {"gauge": None, "area": None},
    ),
    "no heads": (
        text([], measured(ROWS)),
        {
            "columns": {"time": "1", "displacement": "2", "force": "3"},
            "units": {"time": "s", "displacement": "mm", "force": "N"},
        },
    ),
    "no time": (
        text(["Index,Force [ kN ],Déplacement [ mm ]"], [ROWS.time, WAY[1], WAY[0] - 0.17],
             "{:.9f}"),
        {"speed": 2.5e-3},
    ),
}  # fmt: skip
ENCODINGS = {"utf16": "utf-16", "testXpert": "cp1252", "TestSuite": "utf-16", "german": "cp1252"}


def stored(folder, name, content):
    path = folder / f"{name}.csv"
    path.write_bytes(content.encode(ENCODINGS.get(name, "utf-8")))
    return path


@pytest.mark.parametrize("name", [*NINE, *MACHINES])
def test_however_it_is_written_it_is_the_same_record(tmp_path, name):
    content, answers = (NINE | MACHINES)[name]
    found = read_coupon(stored(tmp_path, name, content), Answers(**{**SIZES, **answers}))
    assert found.time == pytest.approx(ROWS.time, abs=1e-6)
    assert found.strain == pytest.approx(ROWS.strain, abs=1e-5)
    within = 1e-3 if name in ("kN", "machine") else 1e-5  # rounded to 0.1 N
    assert found.stress == pytest.approx(ROWS.stress, abs=within * ROWS.stress.max())


QUESTIONS = {
    "kN": ["--units force=kN"],
    "percent_MPa": ["--units strain=%", "--units stress=MPa"],
}


@pytest.mark.parametrize("name", NINE)
def test_what_cannot_be_decided_is_asked_for_at_once(tmp_path, name):
    path = stored(tmp_path, name, NINE[name][0])
    answers = Answers(**SIZES) if name == "kN" else Answers()
    with pytest.raises(CouponError) as asked:
        read_coupon(path, answers)
    needed = str(asked.value).split("needed", 1)[1]
    for option in QUESTIONS.get(name, ["--gauge", "--area"]):
        assert option in needed
    assert needed.count("--") == len(QUESTIONS.get(name, ["--gauge", "--area"]))
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


def test_a_position_and_a_preload_are_one_question(tmp_path):
    way = [ROWS.time, ROWS.displacement - 794.864, ROWS.force + 5.0]
    with pytest.raises(CouponError, match=r"needed: --zero first or --zero line: .* 9 %"):
        read_coupon(stored(tmp_path, "strip", text(OURS, way)), Answers(**SIZES))
