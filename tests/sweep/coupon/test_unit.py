"""Units in heads: where they stand, how machines write them, and texts that are no unit."""

import pytest

from sweep.coupon.unit import is_unit, size_in_si, unit_in_head


@pytest.mark.parametrize(
    ("head", "name", "unit"),
    [
        ("Load (kN)", "Load", "kN"),
        ("Force [ kN ]", "Force", "kN"),
        ("Weg / mm", "Weg", "mm"),
        ("Kraft in N", "Kraft", "N"),
        ("Time, s", "Time", "s"),
        ("stress_N/mm²", "stress", "N/mm²"),
        ("strain_percent", "strain", "percent"),
        ("AVE 2 (%)", "AVE 2", "%"),
        ("Compressive strain (Extension)", "Compressive strain (Extension)", ""),
        ("Strain 1", "Strain 1", ""),
        ("", "", ""),
    ],
)
def test_a_head_is_parted_from_its_unit(head, name, unit):
    assert unit_in_head(head) == (name, unit)


SIZES = {
    "force": {"KN": 1e3, "lbs": 4.4482216152605, "kg": 9.80665, "mm": None},
    "stress": {"N/mm2": 1e6, "MPA": 1e6},
    "strain": {"mm/mm": 1.0, "-": 1.0, "%": 0.01, "°C": None},
    "time": {"sec": 1.0, "Sec": 1.0, "min": 60.0},
    "displacement": {"MM": 1e-3, "in": 0.0254},
}


@pytest.mark.parametrize("quantity", SIZES)
def test_sizes_of_units(quantity):
    for unit, size in SIZES[quantity].items():
        assert size_in_si(unit, quantity) == pytest.approx(size), unit


def test_what_is_a_unit():
    texts = ["(s)", "mm", "(mm²)", "", "5.96", "12", "Load", "(of the travel of the grip)"]
    assert [text for text in texts if is_unit(text)] == ["(s)", "mm", "(mm²)"]
