"""Sheets of slicers: period and line by their formulas, the nearest share that fits."""

from math import pi, radians, sqrt

import pytest

from sweep.config.case import Case
from sweep.config.faults import ConfigError
from sweep.config.kinds.table import RefusedError
from sweep.config.load import case as make_case
from sweep.design.slicer.patterns import ROUNDED

MM = 1e-3
LINE = 0.45 * MM - 0.2 * MM * ROUNDED


def sheet(**lattice):
    values = {"slicer": "prusa", "pattern": "gyroid", "infill": 0.15, "height": 25 * MM}
    return Case.of(lattice=values | lattice, loading={"mode": "displacement"}).lattice


@pytest.mark.parametrize(
    ("slicer", "pattern", "line", "period"),
    [
        ("prusa", "gyroid", LINE, 2 * pi / 2.44),
        ("orca", "gyroid", LINE, 2 * pi / 2.44),
        ("cura", "gyroid", 0.4 * MM, 2.41),
        ("orca", "tpmsd", LINE, 2 * pi / 2.1),
    ],
)
def test_the_share_is_the_nearest_whose_period_fits(slicer, pattern, line, period):
    values = {"slicer": slicer, "pattern": pattern}
    made = sheet(**values)
    assert made.infill == pytest.approx(0.15, rel=0.06)
    assert made.period == pytest.approx(period * line / made.infill, rel=1e-12)
    assert sheet(**values, infill=made.infill).infill == pytest.approx(made.infill, rel=1e-12)
    case = Case.of(lattice=values | {"infill": 0.2}, loading={"mode": "displacement"})
    assert Case.from_json(case.to_json()).case_id == case.case_id


@pytest.mark.parametrize(("pattern", "filled"), [("gyroid", 0.955), ("tpmsd", 1.0186)])
def test_what_is_extruded_is_nearly_the_share_of_the_box(pattern, filled):
    """2.44 and 2.1 are numbers of the slicer's makers."""
    made = sheet(slicer="orca", pattern=pattern, infill=0.2)
    share = made.extruded / (made.width * made.height * made.depth)
    assert share == pytest.approx(filled * made.infill, rel=2e-3)


@pytest.mark.parametrize(("degrees", "turned"), [(45, False), (0, True), (90, True), (-45, False)])
def test_the_fill_angle_turns_a_panel_that_is_pressed_across(degrees, turned):
    made = sheet(fill_angle=radians(degrees))
    assert made.turned == turned
    assert made.width == pytest.approx(made.period * (sqrt(2) if turned else 1))
    lattice = {"slicer": "orca", "pattern": "gyroid", "infill": 0.15, "fill_angle": 0.3}
    assert not Case.of(lattice=lattice, loading={"direction": "out_of_plane"}).lattice.turned


def test_several_lines_make_a_thicker_wall_at_the_same_share():
    one, two = sheet(slicer="orca"), sheet(slicer="orca", fill_multiline=2)
    assert two.wall_thickness == pytest.approx(2 * one.wall_thickness)
    assert two.period == pytest.approx(2 * one.period, rel=0.15)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"infill": 0.01}, "at least 2 %"),
        ({"infill": None}, 'a share such as "15 %"'),
        ({"fill_multiline": 2}, 'more with lattice.slicer "orca"'),
        ({"layer_height": 0.6 * MM}, "at most the line width"),
        ({"infill": 0.6}, "below a fifth of the period"),
        ({"pattern": "tpmsd"}, '"tpmsd" with lattice.slicer "orca"'),
        ({"fill_angle": 0.3}, "0, 45 or 90 degrees"),
        ({"slicer": "cura", "fill_angle": 0.0}, "waves of cura lie along the sides"),
        ({"slicer": "kiri"}, "prusa, orca, cura"),
    ],
)
def test_what_a_slicer_does_not_print_is_refused(values, words):
    with pytest.raises(RefusedError, match=words):
        sheet(**values)


def test_the_sides_of_a_block_are_refused_beside_its_share():
    wrong = {"infill": "90 %", "sides": "periodic"}
    with pytest.raises(ConfigError) as refusal:
        make_case(lattice={"slicer": "orca", "pattern": "gyroid", "perimeters": 2} | wrong)
    assert {fault.key for fault in refusal.value.faults} == {"lattice.infill", "lattice.sides"}


def block(direction="out_of_plane", **lattice):
    sizes = {"width": 14 * MM, "height": 11 * MM, "depth": 12 * MM, "perimeters": 2}
    values = {"slicer": "orca", "pattern": "gyroid", "infill": 0.2} | sizes | lattice
    return Case.of(lattice=values, loading={"direction": direction})


@pytest.mark.parametrize("direction", ["in_plane", "out_of_plane"])
@pytest.mark.parametrize("pattern", ["gyroid", "tpmsd"])
def test_the_sides_of_a_block_are_whole_halves_of_the_period(pattern, direction):
    case = block(direction, pattern=pattern)
    made = case.lattice
    halves = [2 * side / made.period for side in (made.width, made.height, made.depth)]
    assert halves == pytest.approx([round(half) for half in halves])
    assert case.height == (12 * MM if case.along else 11 * MM)
    assert made.width == pytest.approx(14 * MM, abs=0.25 * made.period)
    assert made.outer_size == pytest.approx((made.width + 2 * LINE, made.height + 2 * LINE))
    assert not made.tied_sides
    assert made.cells_x == round(0.5 * halves[0])
    assert Case.from_json(case.to_json()).case_id == case.case_id


def test_a_block_is_its_perimeters_and_the_sheet_between_them():
    made, panel = block().lattice, sheet(infill=block().lattice.infill, height=12 * MM)
    frame = 2 * 2 * LINE * (made.width + made.height) * made.depth
    inside = (made.width - 2 * LINE) * (made.height - 2 * LINE) * made.depth
    share = panel.extruded / (panel.width * panel.height * panel.depth)
    assert made.extruded == pytest.approx(frame + share * inside, rel=1e-12)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"fill_angle": 0.0}, "45 degrees"),
        ({"perimeters": 20}, "0 to 13"),
        ({"infill": 0.02}, "at least 2.63 % where 12 mm are pressed"),
    ],
)
def test_a_block_that_does_not_fit_is_refused(values, words):
    with pytest.raises(RefusedError, match=words):
        block(**values)
