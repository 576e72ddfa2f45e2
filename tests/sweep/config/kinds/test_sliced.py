"""The table `lattice` with a slicer: values that follow from its lines, and walls it does not
print.
"""

import math

import pytest

from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError
from sweep.design.slicer.network import extruded_area
from tests.support.designs.tables import lattice_with

SLICED = '[lattice]\nwidth = "20 mm"\nheight = "20 mm"\nslicer = "prusa"\n'
GRID = f'{SLICED}pattern = "grid"\n'
NARROW = GRID.replace("prusa", "orca").replace("20 mm", "4 mm")
NARROW += 'infill = "20 %"\nfill_multiline = 6\n'
ALONG = 'direction = "out_of_plane"'


def sliced(**lattice):
    usual = {"slicer": "prusa", "pattern": "grid", "width": 20e-3, "height": 20e-3}
    share = {} if "mass" in lattice else {"infill": 0.2}
    return lattice_with(**usual | share | lattice)


def test_a_slicer_fills_in_its_own_defaults():
    """Lines of 1.125 nozzles, at 45 degrees; Cura's are as wide as the nozzle, and are w apart."""
    found = sliced()
    assert found.line_width == pytest.approx(0.45e-3)
    assert (found.layer_height, found.perimeters) == (0.2e-3, 2)
    assert found.fill_angle == pytest.approx(math.pi / 4.0)
    assert found.wall_thickness == found.line == pytest.approx(0.407e-3, abs=0.5e-6)
    assert found.fill_distance == pytest.approx(2.0 * found.line / 0.2)
    assert found.outline == (2 * found.line,) * 2
    assert found.geometry.sliced.inset == pytest.approx([(1.0 - 0.25) * found.line] * 2)
    assert sliced(nozzle=0.6e-3).line_width == pytest.approx(0.675e-3)
    assert sliced(pattern="honeycomb").wall_thickness == pytest.approx(4.0 * found.line / 3.0)
    cura = sliced(slicer="cura")
    assert cura.wall_thickness == cura.line == cura.line_width == 0.4e-3
    assert cura.fill_distance == pytest.approx(2.0 * 0.4e-3 / 0.2)


@pytest.mark.parametrize("pattern", ["grid", "triangles", "stars", "honeycomb"])
def test_a_mass_is_that_which_is_extruded(pattern):
    """At any density of the material."""
    case = Case.of(lattice=sliced(pattern=pattern, mass=2.1e-3))
    grams = case.material.density * case.lattice.depth * extruded_area(case.lattice.geometry)
    assert grams == pytest.approx(2.1e-3, rel=1e-9)
    again = Case.of(lattice=sliced(pattern=pattern, infill=case.lattice.infill))
    assert again.case_id == case.case_id


PATTERNS = '"grid", "triangles", "stars", "honeycomb", "alignedrectilinear", "gyroid"'
TWENTY = 'infill = "20 %"\n'
NO_PRISM = ["crosshatch is no prism", "would need prisms that turn: the nearest is honeycomb"]
LATERAL = f'{SLICED.replace("prusa", "orca")}{TWENTY}pattern = "lateral-lattice"\n'
IDLE = ["no effect", "lattice.slicer is given"]
STRAIGHT = f'{GRID}fill_angle = "0 deg"\n'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (SLICED + TWENTY + 'pattern = "crosshatch"', [f"{PATTERNS};", *NO_PRISM]),
        (
            SLICED.replace("prusa", "cura") + TWENTY + 'pattern = "crosshatch"',
            ['"trihexagon", "'],
        ),
        (SLICED + TWENTY + 'pattern = "cubic"', ["need their joints", "the nearest is triangles"]),
        (
            SLICED + TWENTY + 'pattern = "2D honeycomb"',
            ['"lateral-honeycomb" with lattice.sl'],
        ),
        (SLICED + TWENTY + 'pattern = "tri-hexagon"', ['here it is "stars"']),
        (SLICED + TWENTY + 'pattern = "stripes"', [PATTERNS]),
        (LATERAL + 'fill_angle = "45 deg"', ["0 degrees: lines of lateral-lattice run along"]),
        (LATERAL + "solid_layers = 0", IDLE),
        (GRID + TWENTY + 'kind = "hex"', IDLE),
        (GRID + TWENTY + 'wall_thickness = "0.8 mm"', IDLE),
        (GRID + TWENTY + "cells = 3", IDLE),
        (GRID + TWENTY + "perimeters = 0", ["1 to 23", "lattice.slicer is given"]),
        (GRID + TWENTY + 'layer_height = "0.5 mm"', ["at most", "0.45 mm"]),
        (GRID + TWENTY + 'mass = "2 g"', ["none where lattice.infill is given"]),
        (GRID + 'mass = "1 g"', ["between 1.249 g and 6.301 g"]),
        (GRID.replace("grid", "stars") + 'infill = "60 %"', ["below 50 %", "twice as wide"]),
        (
            STRAIGHT + 'perimeters = 1\ninfill = "50 %"',
            ["49 %, for example", "weigh 13 % less"],
        ),
        (STRAIGHT + 'mass = "2.5 g"', ["2.057 g, for example", "weigh 18 % less than is extruded"]),
        (NARROW + "perimeters = 2", ["or a larger box", "weigh 32 % less", "any infill near 20 %"]),
        ('[lattice]\npattern = "grid"', ["no effect", "needed: a lattice.slicer"]),
    ],
)
def test_what_is_asked_of_a_slicer_must_go_together(last_refused, text, words):
    assert last_refused(text, *words)


@pytest.mark.parametrize(
    ("text", "key", "words"),
    [
        (SLICED + TWENTY, "lattice.pattern", [PATTERNS]),
        (GRID, "lattice.infill", ['"20 %"', "lattice.mass"]),
        (f"{LATERAL}[loading]\n{ALONG}", 'lattice.slicer = "orca"', ["give kind and cells"]),
    ],
)
def test_what_is_missing_is_told(refused, text, key, words):
    assert refused(text, key, *words)


def test_lines_side_by_side_are_as_many_times_farther_apart():
    """OrcaSlicer keeps the share: m lines are m s thick, at m times the distance."""
    one, three = (sliced(slicer="orca", fill_multiline=lines) for lines in (1, 3))
    assert three.wall_thickness == pytest.approx(3.0 * one.wall_thickness)
    assert three.fill_distance == pytest.approx(3.0 * one.fill_distance)
    assert three.outline == one.outline
    areas = [lattice.geometry.sliced.share for lattice in (one, three)]
    assert areas == pytest.approx([0.2, 0.2])
    assert Case.of(lattice=one).case_id == Case.of(lattice=sliced(slicer="orca")).case_id


@pytest.mark.parametrize(
    ("slicer", "pattern"), [("prusa", "grid"), ("orca", "honeycomb"), ("orca", "lateral-lattice")]
)
def test_several_lines_are_of_slicers_and_patterns_that_have_them(slicer, pattern):
    with pytest.raises(RefusedError, match=r"fill_multiline|1; more with lattice.slicer"):
        sliced(slicer=slicer, pattern=pattern, fill_multiline=2)
    with pytest.raises(RefusedError, match="a key of Cells: "):
        Case.of(lattice=dict(fill_multiline=2))


@pytest.mark.parametrize("wish", [{"infill": 0.49}, {"infill": 0.5, "fill_angle": 0.3}])
def test_what_a_refusal_of_a_drawing_allows_is_drawn(wish):
    assert sliced(**{"fill_angle": 0.0, "perimeters": 1} | wish).infill == wish["infill"]


BOX = dict(slicer="cura", pattern="grid", width=0.06, height=0.06)


def test_lines_may_be_given_by_their_distance():
    """The same case, whose share follows; s = w for Cura."""
    by_share, by_distance = (
        Case.of(lattice=BOX | size) for size in ({"infill": 0.2}, {"line_distance": 4e-3})
    )
    assert by_distance.case_id == by_share.case_id
    assert by_distance.lattice.infill == pytest.approx(0.2)
    wider = by_distance.changed(lattice={"line_width": 0.5e-3}).lattice
    assert (wider.fill_distance, wider.infill) == (4e-3, pytest.approx(0.25))
    denser = by_distance.changed(lattice={"infill": 0.3}).lattice
    assert denser.fill_distance == pytest.approx(2 * 0.4e-3 / 0.3)
    assert denser.line_distance is None


@pytest.mark.parametrize(
    ("sizes", "key", "allowed"),
    [
        ({"pattern": "trihexagon", "line_distance": 2e-3}, "line_distance", "above 0.0024 m, so"),
        ({"line_distance": 0.5e-3}, "line_distance", "above 0.0008 m"),
        ({"line_distance": 4e-3, "infill": 0.2}, "line_distance", "none where lattice.infill"),
        ({"line_distance": 4e-3, "mass": 4e-3}, "mass", "none where lattice.line_distance"),
        ({}, "infill", 'a share such as "20 %", a lattice.line_distance'),
    ],
)
def test_a_distance_that_does_not_fit_is_refused(sizes, key, allowed):
    with pytest.raises(RefusedError, match=allowed) as refusal:
        Case.of(lattice=BOX | sizes)
    assert refusal.value.key == f"lattice.{key}"


def test_several_lines_of_cura_stay_where_one_is():
    """Infill Line Multiplier: as many times the share is extruded."""
    one, two = (
        Case.of(lattice=BOX | {"infill": 0.1, "fill_multiline": lines}).lattice for lines in (1, 2)
    )
    assert (two.fill_distance, two.infill) == (one.fill_distance, 0.1)
    assert two.wall_thickness == 2 * one.wall_thickness
    assert two.geometry.sliced.share == pytest.approx(0.2)
    mass = Case.of(lattice=BOX | {"mass": 5e-3, "fill_multiline": 2}).lattice
    assert mass.infill == pytest.approx(0.5 * mass.geometry.sliced.share)
    with pytest.raises(RefusedError, match=r"below 16\.6 %"):
        Case.of(lattice=BOX | {"infill": 0.2, "fill_multiline": 6})


@pytest.mark.parametrize("pattern", ["lateral-lattice", "lateral-honeycomb"])
def test_a_prism_in_the_layers_has_them_up_the_height(pattern):
    """Solid layers at the bottom and top begin where the infill ends."""
    found = sliced(slicer="orca", pattern=pattern, infill=0.18)
    assert (found.lateral, found.fill_angle, found.solid_layers) == (True, 0.0, 4)
    assert found.outline == pytest.approx((2 * found.line, 0.8e-3))
    assert found.geometry.sliced.inset == pytest.approx((0.75 * found.line, 0.4e-3))
    assert Case.of(lattice=dict(found.inputs()) | {"solid_layers": 4}).lattice == found
    assert not sliced().lateral
