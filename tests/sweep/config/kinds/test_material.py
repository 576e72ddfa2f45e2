"""The law of a material: the curve or the modulus that it uses."""

import pytest

from sweep.config.kinds.material import by_curve


@pytest.mark.parametrize(
    ("stretch", "bend", "key"),
    [
        ("nonlinear", "section", "stretch"),
        ("nonlinear", "linear", "stretch"),
        ("linear", "fibres", "bend"),
        ("linear", "none", None),
        ("of a formula", "section", None),
    ],
)
def test_laws_that_go_by_the_curve(stretch, bend, key):
    """Sections of a law with a formula go by that."""
    assert by_curve(stretch, bend) == key
