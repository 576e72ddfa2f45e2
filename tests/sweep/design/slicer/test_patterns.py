"""Lines and patterns of slicers: spacings, walls, names."""

from math import cos, pi, sqrt

import pytest

from sweep.design.infill import families
from sweep.design.slicer.patterns import (
    LIKE,
    NEAREST,
    NO_PRISMS,
    PATTERNS,
    SLICERS,
    InfillLines,
    distance_of,
    family_of,
    line_of,
    width_of,
)

LINE = line_of("prusa", 0.45e-3, 0.2e-3)


def test_a_line_with_round_sides_fills_less_than_its_width():
    assert pytest.approx(0.407e-3, abs=0.0005e-3) == LINE
    assert line_of("orca", 0.45e-3, 0.2e-3) == LINE
    assert line_of("cura", 0.45e-3, 0.2e-3) == 0.45e-3
    for slicer in SLICERS:
        assert width_of(slicer, line_of(slicer, 0.45e-3, 0.2e-3), 0.2e-3) == pytest.approx(0.45e-3)


@pytest.mark.parametrize(
    ("pattern", "side", "wall", "most"),
    [
        ("grid", 2.0, 1.0, 1.0),
        ("triangles", 2.0 * sqrt(3.0), 1.0, 1.0),
        ("stars", sqrt(3.0), 1.0, 0.5),
        ("honeycomb", 2.0 / sqrt(3.0), 4.0 / 3.0, 0.75),
        ("alignedrectilinear", 1.0, 1.0, 0.5),
        ("lateral-lattice", 2.0, cos(pi / 4.0), 1.0),
        ("lateral-honeycomb", 4.0 / sqrt(27.0), (1.0 + 2.0 * cos(pi / 3.0)) / 3.0, 2.0 / 3.0),
    ],
)
def test_sides_and_walls_are_those_of_the_slicer(pattern, side, wall, most):
    """Sides in s / r; mean walls in s; at most of r, cells are twice as wide as thickest walls."""
    made = PATTERNS[pattern]
    distance = distance_of(pattern, 0.2, LINE)
    assert made.side * distance == pytest.approx(side * LINE / 0.2)
    assert (made.wall, made.most) == (pytest.approx(wall), pytest.approx(most))
    assert InfillLines(pattern, distance, 0.0, LINE, (0.0, 0.0)).share == pytest.approx(0.2)


def test_walls_of_honeycomb_are_double_in_every_third_layer():
    """2 s, s and s in turn; they bend as a wall of (10/3)^(1/3) s."""
    comb = PATTERNS["honeycomb"]
    assert comb.wall**3 * comb.gyration**2 == pytest.approx((2.0**3 + 1.0 + 1.0) / 3.0)


def test_names_lead_to_patterns_and_families():
    assert {name for own in SLICERS.values() for name in own.values()} == {*PATTERNS}
    assert {pattern.family for pattern in PATTERNS.values()} - {""} <= {*families()}
    assert not {*NO_PRISMS} & {name for own in SLICERS.values() for name in own}
    assert {nearest for _, nearest in NO_PRISMS.values()} <= {*PATTERNS}
    assert {*LIKE} <= {(kind, way) for kind in families() for way in (None, "pointy", "flat")}
    assert {*NEAREST} <= {*families()} - {kind for kind, _ in LIKE}
    assert {*NEAREST.values()} <= {kind for kind, _ in LIKE}
    assert [family_of(name) for name in ("trihexagon", "alignedrectilinear", "brick")] == [
        *("kagome", "", "brick")
    ]
