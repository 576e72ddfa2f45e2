"""Without contact the grid is a frame of beams: its force against the geometrically exact one."""

import pytest

from tests.studies.verify import FRAME
from tests.support.designs.scenes import at, is_sound, pressed, run


@pytest.mark.parametrize(("elements", "within"), [(2, 0.018), (3, 0.004), (12, 0.003)])
def test_force_of_the_exact_frame(elements, within):
    """11.62 N at 5 %; rows free to turn would bear 10.1 N."""
    result = run(pressed(elements, 0.3, 30, contact="none"))
    assert is_sound(result)
    for strain, force in FRAME.items():
        assert at(result, strain) == pytest.approx(force, rel=within)
    top, bottom = (result.history[f"reaction_{end}_N"] for end in ("top", "bottom"))
    assert abs(top - bottom).max() < 1e-6 * top.max()
