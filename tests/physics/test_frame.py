"""Without contact the grid is a frame of beams: its force against the geometrically exact one."""

import pytest

from tests.studies.verify import FRAME
from tests.support.designs.scenes import at, is_sound, pressed, run


def crushed(elements):
    return run(pressed(elements, 0.3, 30, contact="none"))


def test_references_are_those_of_the_exact_frame():
    assert FRAME == {0.05: 11.62, 0.1: 12.04, 0.3: 13.93}


@pytest.mark.parametrize(("strain", "force"), FRAME.items())
def test_force_with_12_elements_a_wall(strain, force):
    result = crushed(12)
    assert is_sound(result)
    assert at(result, strain) == pytest.approx(force, rel=0.003)


@pytest.mark.parametrize(("strain", "force"), FRAME.items())
@pytest.mark.parametrize(("elements", "within"), [(2, 0.018), (3, 0.004)])
def test_coarse_walls_are_almost_as_good(elements, within, strain, force):
    assert at(crushed(elements), strain) == pytest.approx(force, rel=within)


def test_glued_rows_are_clamped():
    """11.62 N at 5 %; rows free to turn would bear 10.1 N."""
    assert at(crushed(3), 0.05) == pytest.approx(11.62, rel=0.001)


def test_reactions_of_both_platens_agree():
    history = crushed(12).history
    off = abs(history["reaction_top_N"] - history["reaction_bottom_N"]).max()
    assert off < 1e-6 * history["reaction_top_N"].max()
