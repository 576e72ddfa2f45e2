"""Units in heads: where they stand, how machines write them, and texts that are no unit."""

import pytest

from sweep.coupon.unit import is_unit, size_in_si, unit_in_head


@pytest.mark.parametrize(
    ("head", "found"),
    [
        ("Load (kN)", ("Load", "kN")),
        ("Force [ kN ]", ("Force", "kN")),
        ("C_1_Temps[s]", ("C_1_Temps", "s")),
        ("Weg / mm", ("Weg", "mm")),
        ("Kraft in N", ("Kraft", "N")),
        ("Time, s", ("Time", "s")),
        ("stress_N/mm²", ("stress", "N/mm²")),
        ("strain_percent", ("strain", "percent")),
        ("AVE 2 (%)", ("AVE 2", "%")),
        ("Compressive strain (Extension)", ("Compressive strain (Extension)", "")),
        ("Strain 1", ("Strain 1", "")),
        ("strain", ("strain", "")),
        ("", ("", "")),
    ],
)
def test_a_head_is_parted_from_its_unit(head, found):
    assert unit_in_head(head) == found


@pytest.mark.parametrize(
    ("unit", "quantity", "size"),
    [
        ("KN", "force", 1e3),
        ("lbs", "force", 4.4482216152605),
        ("kg", "force", 9.80665),
        ("N/mm2", "stress", 1e6),
        ("MPA", "stress", 1e6),
        ("mm/mm", "strain", 1.0),
        ("-", "strain", 1.0),
        ("%", "strain", 0.01),
        ("sec", "time", 1.0),
        ("Sec", "time", 1.0),
        ("MM", "displacement", 1e-3),
        ("min", "time", 60.0),
        ("in", "displacement", 0.0254),
        ("mm", "force", None),
        ("°C", "strain", None),
    ],
)
def test_sizes_of_units(unit, quantity, size):
    assert size_in_si(unit, quantity) == pytest.approx(size)


def test_what_is_a_unit():
    texts = ["(s)", "mm", "(mm²)", "", "5.96", "12", "Load", "(of the travel of the grip)"]
    assert [text for text in texts if is_unit(text)] == ["(s)", "mm", "(mm²)"]
