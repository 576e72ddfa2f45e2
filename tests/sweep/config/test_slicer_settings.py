"""The settings of a slicer agree with the drawing, the columns and the export of a design."""

from math import degrees, hypot, pi, sqrt

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.reading.other_names import present_choice
from sweep.config.slicer_settings import slicer_settings, unlike
from sweep.design.drawing import clipped, extent
from sweep.design.infill import families, trait
from sweep.design.lattice import build_network
from sweep.design.slicer.network import infill
from sweep.design.slicer.patterns import LIKE, NEAREST, PATTERNS, PROGRAMS, SLICERS, line_of
from sweep.export.errors import ExportError
from sweep.export.slicer import orca_keys, prusa_keys, prusa_reads, settings_of
from sweep.report.figures.design_style import OF_FAMILY, _signs
from sweep.result import design_columns
from tests.support.designs.tables import lattice_with

LAID = [(slicer, own) for slicer, patterns in SLICERS.items() for own in patterns]
SIDE = 4e-3  # m, of the unit of a drawing
LINE = line_of("prusa", 0.45e-3, 0.2e-3)
SHARES = {  # x wall / line
    "square": 2.0, "diamond": 2.0 * sqrt(2.0), "triangle": 2.0 * sqrt(3.0), "kagome": sqrt(3.0),
    "hex": 2.0 / sqrt(3.0),
}  # fmt: skip


def laid(slicer, pattern, **changes):
    """A lattice of a slicer in a box of 60 mm."""
    angle = 0.0 if PATTERNS[SLICERS[slicer][pattern]].slopes else 0.3
    box = {"width": 60e-3, "height": 60e-3, "infill": 0.2, "fill_angle": angle, "nodes_per_wall": 1}
    return lattice_with(slicer=slicer, pattern=pattern, **box | changes)


def regular(kind, way, **changes):
    """A drawn lattice of cells that are regular, with walls of the pattern that it is like."""
    low, high = extent(kind, way, (4, 4))
    width, height = SIDE * (high - low)
    wall = PATTERNS[LIKE[kind, way].pattern].wall
    size = {"width": float(width), "height": float(height), "wall_thickness": wall * LINE}
    return lattice_with(kind=kind, orientation=way, cells_x=4, cells_y=4, **size | changes)


def directions(segments):
    """Directions of lines (s, 2, 2), degrees from the width, in [0, 180)."""
    across, up = (segments[:, 1] - segments[:, 0]).T
    return {round(angle % 180.0, 4) % 180.0 for angle in np.degrees(np.arctan2(up, across))}


def length_per_area(segments, box):
    """Length of lines in a box / its area, 1/m."""
    inside = clipped(segments, np.array(box), [True, True])
    return sum(hypot(*line) for line in inside[:, 1] - inside[:, 0]) / (box[0] * box[1])


@pytest.mark.parametrize(("slicer", "pattern"), LAID)
def test_of_a_slicer(slicer, pattern):
    lattice = laid(slicer, pattern)
    settings, sliced = slicer_settings(lattice), lattice.geometry.sliced
    assert (settings.slicer, settings.pattern, settings.infill) == (slicer, pattern, 0.2)
    assert sliced.share == pytest.approx(0.2)
    assert sliced.angle == settings.fill_angle
    width = settings.line_width
    assert sliced.line == line_of(slicer, width, settings.layer_height)
    drawn = length_per_area(infill(sliced, lattice.geometry.box), lattice.geometry.box)
    printed = PATTERNS[SLICERS[slicer][pattern]]
    wall = printed.wall if printed.slopes else 1.0
    assert drawn * wall * sliced.line == pytest.approx(0.2, rel=0.05)
    columns = design_columns(Case.of(lattice=lattice))
    assert (columns["lattice_kind"], columns["infill_share"]) == (pattern, 0.2)
    start = f"{PROGRAMS[slicer].title}: {pattern}, 20 %, line {1e3 * width:.3g} mm"
    assert columns["slicer_settings"].startswith(start)
    assert f"angle {degrees(lattice.fill_angle):.3g} degrees" in columns["slicer_settings"]
    if family := printed.family:
        assert printed.slopes or present_choice("lattice.kind", pattern) == family
        assert _signs([pattern]) == {pattern: OF_FAMILY[family]}


@pytest.mark.parametrize(("slicer", "pattern"), LAID)
def test_of_an_export(slicer, pattern):
    lattice = laid(slicer, pattern)
    if slicer == "cura":
        with pytest.raises(ExportError, match=r"cura.* allowed .*: prusa and orca\. .* in Cura;"):
            settings_of(lattice)
        return
    settings = settings_of(lattice)
    prusa, orca = prusa_keys(settings), orca_keys(settings)
    assert prusa["fill_pattern"] == SLICERS[slicer][pattern]
    assert SLICERS["orca"][orca["sparse_infill_pattern"]] == SLICERS[slicer][pattern]
    assert prusa["fill_density"] == orca["sparse_infill_density"] == "20%"
    angle = f"{degrees(lattice.fill_angle):.4g}"
    assert prusa["fill_angle"] == orca["infill_direction"] == angle
    layers = "4" if lattice.lateral else "0"
    assert prusa["top_solid_layers"] == orca["bottom_shell_layers"] == layers
    assert lattice.lateral != prusa_reads(settings)
    assert prusa["infill_extrusion_width"] == f"{1e3 * lattice.line_width:.4g}"


def test_several_lines_and_perimeters_are_told():
    lines = {"fill_multiline": 2, "perimeters": 3, "layer_height": 0.15e-3, "infill": 0.25}
    settings = slicer_settings(laid("orca", "tri-hexagon", **lines))
    assert (settings.exact, settings.perimeters) == (True, 3)
    assert "25 %, 2 lines a wall, line 0.45 mm, layer 0.15 mm" in str(settings)
    assert str(settings).endswith(", 3 perimeters")


@pytest.mark.parametrize(("kind", "way"), LIKE)
def test_of_a_family(kind, way):
    """The slicer's lines have the directions, the density and the thickness of the drawn walls."""
    drawn = regular(kind, way)
    settings = settings_of(drawn)
    assert not settings.exact
    assert settings.infill == pytest.approx(SHARES[kind] * LINE / SIDE, rel=1e-6)
    assert design_columns(Case.of(lattice=drawn))["slicer_settings"] == str(settings)
    assert str(settings).startswith(f"PrusaSlicer, nearly: {settings.pattern}, ")
    lines = dict(fill_angle=settings.fill_angle, line_width=settings.line_width)
    printed = laid("prusa", settings.pattern, infill=settings.infill, **lines)
    assert printed.wall_thickness == pytest.approx(drawn.wall_thickness)
    lines = infill(printed.geometry.sliced, printed.geometry.box)
    larger = drawn.model_copy(update={"cells_x": 40, "cells_y": 40}).geometry
    low, high = extent(kind, way, (40, 40))
    network = build_network(larger._replace(box=tuple(SIDE * (high - low))))
    walls = network.points[network.walls]
    assert directions(lines) == directions(walls)
    printed_density = length_per_area(lines, printed.geometry.box)
    drawn_density = length_per_area(walls, tuple(SIDE * (high - low)))
    assert printed_density == pytest.approx(drawn_density, rel=0.05)


@pytest.mark.parametrize("kind", [kind for kind in families() if not trait(kind, "ORIENTED")])
def test_of_families_without_a_pattern(kind):
    if (kind, None) in LIKE:
        assert unlike(regular(kind, None)) == ""
        return
    lattice = lattice_with(kind=kind)
    assert slicer_settings(lattice) is None
    assert design_columns(Case.of(lattice=lattice))["slicer_settings"] == ""
    with pytest.raises(ExportError, match=f"no slicer draws {kind} cells; allowed: square, ") as no:
        settings_of(lattice)
    assert (kind in NEAREST) == (f"nearest is {NEAREST.get(kind)}" in str(no.value))


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"grading": 2.0}, "lattice.grading = 2.0"),
        ({"solid_layers": 2}, "lattice.solid_layers = 2"),
        ({"boundary": "periodic"}, "lattice.boundary = periodic"),
        ({"width": 4.3 * SIDE}, "lattice.width = 17.2 mm; allowed for a slicer: 16 mm"),
        ({"wall_thickness": 1.2e-3}, "lattice.wall_thickness = 1.2 mm; allowed for a slicer: 0.35"),
    ],
)
def test_of_what_no_infill_can_be(changes, why):
    lattice = regular("square", None, **changes)
    assert slicer_settings(lattice) is None
    with pytest.raises(ExportError, match=f"^{why}.*--kind lattice prints every design"):
        settings_of(lattice)


def test_stretch_within_bounds_is_averaged():
    settings = slicer_settings(regular("square", None, width=4.1 * SIDE))
    assert settings.infill == pytest.approx(2 * LINE / (SIDE * 1.025**0.5), rel=1e-9)


def test_walls_round_a_grid_are_a_perimeter():
    plain, outlined = (
        slicer_settings(regular("square", None, **more)) for more in ({}, {"perimeters": 3})
    )
    assert (plain.perimeters, outlined.perimeters) == (1, 3)
    assert plain.perimeter_width == pytest.approx(0.45e-3)
    assert outlined.perimeter_width - 0.2e-3 * (1.0 - pi / 4.0) == pytest.approx(0.4e-3)
    assert slicer_settings(regular("kagome", None)).perimeters == 0


def test_walls_are_lines_of_one_or_two_nozzles():
    least = line_of("prusa", 0.4e-3, 0.2e-3)
    for wall, printed in ((0.999 * least, False), (least, True), (0.8e-3, True), (0.801e-3, False)):
        assert (slicer_settings(regular("square", None, wall_thickness=wall)) is None) != printed
    fine = regular("square", None, wall_thickness=0.49e-3, width=4e-3, height=4e-3)
    assert slicer_settings(fine).infill == pytest.approx(0.98)
