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
    Sliced,
    distance_of,
    family_of,
    line_of,
    share_of,
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
    ("pattern", "side"),
    [
        ("grid", 2.0),
        ("triangles", 2.0 * sqrt(3.0)),
        ("stars", sqrt(3.0)),
        ("honeycomb", 2.0 / sqrt(3.0)),
        ("alignedrectilinear", 1.0),
        ("lateral-lattice", 2.0),
        ("lateral-honeycomb", 4.0 / 3.0 / sqrt(3.0)),
    ],
)
def test_sides_are_those_of_the_slicer(pattern, side):
    """In s / r."""
    assert PATTERNS[pattern].side * distance_of(pattern, 0.2, 1.0) == pytest.approx(side / 0.2)


def test_share_is_that_of_the_lines():
    assert share_of("grid", 4e-3, 0.4e-3) == pytest.approx(0.2)
    for name in PATTERNS:
        distance = distance_of(name, 0.2, LINE)
        assert Sliced(name, distance, 0.0, LINE, (0.0, 0.0)).share == pytest.approx(0.2)


def test_walls_of_honeycomb_are_double_in_every_third_layer():
    """2 s, s and s in turn: 4 s / 3 in the mean; they bend as a wall of (10/3)^(1/3) s."""
    comb = PATTERNS["honeycomb"]
    assert comb.wall == pytest.approx((2.0 + 1.0 + 1.0) / 3.0)
    moment = comb.wall**3 * comb.gyration**2
    assert moment == pytest.approx((2.0**3 + 1.0 + 1.0) / 3.0)
    others = [pattern for pattern in PATTERNS.values() if pattern != comb and not pattern.slopes]
    assert {(pattern.wall, pattern.gyration) for pattern in others} == {(1.0, 1.0)}


def test_a_wall_of_layers_is_as_much_thinner_as_it_is_inclined():
    """All walls of the lattice, and two of three equal sides of the honeycomb."""
    assert PATTERNS["lateral-lattice"].wall == pytest.approx(cos(pi / 4.0))
    assert PATTERNS["lateral-honeycomb"].wall == pytest.approx((1.0 + 2.0 * cos(pi / 3.0)) / 3.0)


@pytest.mark.parametrize(
    ("pattern", "most"),
    [("grid", 1.0), ("stars", 0.5), ("lateral-lattice", 1.0), ("lateral-honeycomb", 2.0 / 3.0)],
)
def test_at_most_cells_are_twice_as_wide_as_their_thickest_walls(pattern, most):
    """Upright walls s of a lateral honeycomb, at 4/3 s / r = 2 s."""
    assert PATTERNS[pattern].most == pytest.approx(most)


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
