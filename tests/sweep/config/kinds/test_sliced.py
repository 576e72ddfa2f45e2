"""The table `lattice` with a slicer: values that follow from its lines, and walls it does not
print.
"""

import math
import re

import pytest

from sweep.config.case import Case
from sweep.config.grid import expand
from sweep.config.kinds.table import RefusedError
from sweep.design.slicer.network import extruded_area
from tests.support.designs.tables import lattice_with

SLICED = '[lattice]\nwidth = "20 mm"\nheight = "20 mm"\nslicer = "prusa"\n'
GRID = f'{SLICED}pattern = "grid"\n'


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
    cura = sliced(slicer="cura")
    assert cura.wall_thickness == cura.line == cura.line_width == 0.4e-3
    assert cura.fill_distance == pytest.approx(2.0 * 0.4e-3 / 0.2)


def test_walls_of_a_printed_honeycomb_are_four_thirds_of_a_line():
    found = sliced(pattern="honeycomb")
    assert found.wall_thickness == pytest.approx(4.0 * found.line / 3.0)
    assert found.fill_distance == pytest.approx(2.0 * found.line / 0.2)


def test_names_of_keys_and_patterns_are_the_slicers(load):
    (case,) = expand(
        load(
            '[lattice]\nslicer = "orca"\npattern = "tri-hexagon"\ninfill = "15 %"\n'
            'extrusion_width = "0.42 mm"\nfill_angle = "30 deg"\nwidth = "25 mm"\nheight = "25 mm"'
        )
    )
    assert case.lattice.line_width == 0.42e-3
    assert math.degrees(case.lattice.fill_angle) == pytest.approx(30.0)
    assert case.lattice.geometry.sliced.pattern == "stars"


def test_what_is_printed_tells_designs_apart():
    ids = {
        Case.of(lattice=sliced(**lattice)).case_id
        for lattice in (
            *({}, {"infill": 0.21}, {"fill_angle": 0.5}, {"slicer": "cura"}, {"perimeters": 3}),
            *({"pattern": "stars"}, {"layer_height": 0.15e-3}),
        )
    }
    assert len(ids) == 7
    labelled = sliced(nozzle=0.5e-3, line_width=0.45e-3, printable=True)
    assert Case.of(lattice=labelled).case_id == Case.of(lattice=sliced(line_width=0.45e-3)).case_id


@pytest.mark.parametrize("pattern", ["grid", "triangles", "stars", "honeycomb"])
def test_a_mass_is_that_which_is_extruded(pattern):
    """At any density of the material."""
    case = Case.of(lattice=sliced(pattern=pattern, mass=2.1e-3))
    grams = case.material.density * case.lattice.depth * extruded_area(case.lattice.geometry)
    assert grams == pytest.approx(2.1e-3, rel=1e-9)
    again = Case.of(lattice=sliced(pattern=pattern, infill=case.lattice.infill))
    assert again.case_id == case.case_id


PATTERNS = '"grid", "triangles", "stars", "honeycomb", "alignedrectilinear", "gyroid"'
SHARED = f'{GRID}infill = "20 %"\n'
NO_PRISM = ("crosshatch is no prism", "would need prisms that turn: the nearest is")
LATERAL = GRID.replace("prusa", "orca").replace("grid", "lateral-lattice")
IDLE = ("no effect", "lattice.slicer is given")

UNFIT = {
    f'{SLICED}infill = "20 %"': ("lattice.pattern", PATTERNS),
    GRID: ("lattice.infill", '"20 %"', "lattice.mass"),
    SHARED.replace("grid", "crosshatch"): (
        *('lattice.pattern = "crosshatch"', f"{PATTERNS};", *NO_PRISM, "honeycomb"),
    ),
    SHARED.replace("prusa", "cura").replace("grid", "crosshatch"): (
        *('lattice.pattern = "crosshatch"', '"trihexagon", "gyroid";', *NO_PRISM),
    ),
    SHARED.replace("grid", "cubic"): (
        *('lattice.pattern = "cubic"', "would need their joints", "the nearest is triangles"),
    ),
    SHARED.replace("grid", "2D honeycomb"): (
        *('lattice.pattern = "2D honeycomb"', '"lateral-honeycomb" with lattice.slicer "orca"'),
    ),
    SHARED.replace("grid", "tri-hexagon"): (
        *('lattice.pattern = "tri-hexagon"', 'here it is "stars"'),
    ),
    f'{LATERAL}infill = "20 %"\nfill_angle = "45 deg"': (
        *('lattice.fill_angle = "45 deg"', "0 degrees: lines of lateral-lattice run along"),
    ),
    f'{LATERAL}infill = "20 %"\nsolid_layers = 0': ("lattice.solid_layers = 0", *IDLE),
    f'{LATERAL}infill = "20 %"\n\n[loading]\ndirection = "out_of_plane"': (
        *('lattice.slicer = "orca"', "give kind and cells"),
    ),
    SHARED.replace("grid", "stripes"): ('lattice.pattern = "stripes"', PATTERNS),
    f'{SHARED}kind = "hex"': ('lattice.kind = "hex"', *IDLE),
    f'{SHARED}wall_thickness = "0.8 mm"': ('lattice.wall_thickness = "0.8 mm"', *IDLE),
    f"{SHARED}perimeters = 0": ("lattice.perimeters = 0", "1 to 23", "lattice.slicer is given"),
    f'{SHARED}layer_height = "0.5 mm"': ('lattice.layer_height = "0.5 mm"', "at most", "0.45 mm"),
    SHARED.replace("grid", "stars").replace("20 %", "60 %"): (
        *('lattice.infill = "60 %"', "below 50 %", "twice as wide"),
    ),
    f'{GRID}infill = "50 %"\nfill_angle = "0 deg"\nperimeters = 1': (
        *('lattice.infill = "50 %"', "49 %, for example", "weigh 13 % less than is extruded"),
    ),
    f'{GRID}mass = "2.5 g"\nfill_angle = "0 deg"': (
        *('lattice.mass = "2.5 g"', "2.057 g, for example", "weigh 18 % less than is extruded"),
    ),
    f"{SHARED}fill_multiline = 6\nperimeters = 2".replace("prusa", "orca").replace("20 m", "4 m"): (
        *("lattice.perimeters = 2", "or a larger box", "weigh 32 % less", "any infill near 20 %"),
    ),
    f'{GRID}mass = "1 g"': ('lattice.mass = "1 g"', "between 1.249 g and 6.301 g"),
    f'{SHARED}mass = "2 g"': ('lattice.mass = "2 g"', "none where lattice.infill is given"),
    f"{SHARED}cells = 3": ("lattice.cells = 3", *IDLE),
    '[lattice]\npattern = "grid"': (
        *('lattice.pattern = "grid"', "no effect", "needed: a lattice.slicer"),
    ),
}


@pytest.mark.parametrize("text", UNFIT)
def test_what_is_asked_of_a_slicer_must_go_together(refused, text):
    assert refused(text, *UNFIT[text])


def test_lines_side_by_side_are_as_many_times_farther_apart():
    """OrcaSlicer keeps the share: m lines are m s thick, at m times the distance."""
    one, three = (sliced(slicer="orca", fill_multiline=lines, infill=0.2) for lines in (1, 3))
    assert three.wall_thickness == pytest.approx(3.0 * one.wall_thickness)
    assert three.fill_distance == pytest.approx(3.0 * one.fill_distance)
    assert three.outline == one.outline
    areas = [lattice.geometry.sliced.share for lattice in (one, three)]
    assert areas == pytest.approx([0.2, 0.2])
    assert (
        Case.of(lattice=one).case_id == Case.of(lattice=sliced(slicer="orca", infill=0.2)).case_id
    )


@pytest.mark.parametrize(
    "wish",
    [
        {"slicer": "prusa"},
        *({"slicer": "orca", "pattern": name} for name in ("honeycomb", "lateral-lattice")),
    ],
)
def test_several_lines_are_of_slicers_and_patterns_that_have_them(wish):
    with pytest.raises(RefusedError, match=r"fill_multiline|1; more with lattice.slicer"):
        sliced(**{"pattern": "grid", "infill": 0.2, "fill_multiline": 2} | wish)
    with pytest.raises(RefusedError, match="a key of Cells: "):
        Case.of(lattice=dict(fill_multiline=2))


@pytest.mark.parametrize("wish", [{"infill": 0.49}, {"infill": 0.5, "fill_angle": 0.3}])
def test_what_a_refusal_of_a_drawing_allows_is_drawn(wish):
    assert sliced(**{"fill_angle": 0.0, "perimeters": 1} | wish).infill == wish["infill"]


def test_lines_may_be_given_by_their_distance():
    """The same case, whose share follows; s = w for Cura."""
    by_share, by_distance = (
        Case.of(lattice=dict(slicer="cura", pattern="grid", width=0.06, height=0.06) | size)
        for size in ({"infill": 0.2}, {"line_distance": 4e-3})
    )
    assert by_distance.case_id == by_share.case_id
    assert by_distance.lattice.infill == pytest.approx(0.2)
    wider = by_distance.changed(lattice={"line_width": 0.5e-3}).lattice
    assert (wider.fill_distance, wider.infill) == (4e-3, pytest.approx(0.25))
    denser = by_distance.changed(lattice={"infill": 0.3}).lattice
    assert denser.fill_distance == pytest.approx(2 * 0.4e-3 / 0.3)
    assert denser.line_distance is None


@pytest.mark.parametrize(
    ("sizes", "told"),
    [
        (
            {"pattern": "trihexagon", "line_distance": 2e-3},
            "line_distance|above 0.0024 m, so that cells are twice as wide as their walls",
        ),
        ({"line_distance": 0.5e-3}, "line_distance|above 0.0008 m"),
        ({"line_distance": 4e-3, "infill": 0.2}, "line_distance|none where lattice.infill"),
        ({"line_distance": 4e-3, "mass": 4e-3}, "mass|none where lattice.line_distance"),
        ({}, 'infill|a share such as "20 %", a lattice.line_distance'),
    ],
)
def test_a_distance_that_does_not_fit_is_refused(sizes, told):
    key, allowed = told.split("|")
    with pytest.raises(RefusedError, match=re.escape(allowed)) as refusal:
        Case.of(lattice=dict(slicer="cura", pattern="grid", width=0.06, height=0.06) | sizes)
    assert refusal.value.key == f"lattice.{key}"


def test_several_lines_of_cura_stay_where_one_is():
    """Infill Line Multiplier: as many times the share is extruded."""
    box = dict(slicer="cura", pattern="grid", width=0.06, height=0.06, infill=0.1)
    one, two = (Case.of(lattice=box | {"fill_multiline": lines}).lattice for lines in (1, 2))
    assert two.fill_distance == one.fill_distance
    assert two.wall_thickness == 2 * one.wall_thickness
    assert two.geometry.sliced.share == pytest.approx(2 * two.infill)
    heavy = Case.of(lattice=box | {"fill_multiline": 2}).lattice
    mass = Case.of(lattice={**box, "infill": None, "mass": 5e-3, "fill_multiline": 2}).lattice
    assert heavy.infill == 0.1
    laid = mass.geometry.sliced.share
    assert mass.infill == pytest.approx(0.5 * laid)
    with pytest.raises(RefusedError, match=r"below 16\.6 %"):
        Case.of(lattice=box | {"infill": 0.2, "fill_multiline": 6})


@pytest.mark.parametrize(
    ("name", "pattern"),
    [
        *[("2DLattice", "lateral-lattice"), ("Lateral Lattice", "lateral-lattice")],
        *[("2dhoneycomb", "lateral-honeycomb"), ("laterallattice", "lateral-lattice")],
    ],
)
def test_a_prism_in_the_layers_has_older_names(load, name, pattern):
    (case,) = load(LATERAL.replace("lateral-lattice", name) + 'infill = "18 %"\n').cases
    assert case.lattice.name == case.lattice.pattern == pattern


@pytest.mark.parametrize("pattern", ["lateral-lattice", "lateral-honeycomb"])
def test_a_prism_in_the_layers_has_them_up_the_height(pattern):
    """Solid layers at the bottom and top begin where the infill ends."""
    found = sliced(slicer="orca", pattern=pattern, infill=0.18)
    assert (found.lateral, found.fill_angle, found.solid_layers) == (True, 0.0, 4)
    assert found.outline == pytest.approx((2 * found.line, 0.8e-3))
    assert found.geometry.sliced.inset == pytest.approx((0.75 * found.line, 0.4e-3))
    assert Case.of(lattice=dict(found.inputs()) | {"solid_layers": 4}).lattice == found
    assert not sliced().lateral
