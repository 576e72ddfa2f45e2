"""A block of shells within perimeters against bricks of the solid, whose joints have a width."""

import pytest

from tests.studies.surfaces import block

THICKNESS = 1.0 / 16.0
BLOCK = 0.5, THICKNESS, THICKNESS


@pytest.mark.parametrize("walled", [(0, 1), (0, 2)])
def test_a_block_of_shells_is_nearly_as_stiff_as_the_solid(walled):
    """Joints are a quarter as wide as the sheet between them is high."""
    solid = block.limit(16, *BLOCK, walled, 0.45)
    found = block.of_shells(12, *BLOCK, walled, 0.45)
    assert -0.07 < found / solid - 1.0 < -0.04


def test_perimeters_alone_are_a_tube():
    """The sheet has no thickness: four walls in plane stress remain, whose ends cannot widen."""
    found = block.of_shells(8, 0.5, 1e-6, THICKNESS, (0, 1), 0.0)
    assert found == pytest.approx(4 * THICKNESS, rel=1e-3)
