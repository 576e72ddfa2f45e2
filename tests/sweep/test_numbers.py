"""Numbers as text."""

from sweep.numbers import NOTHING, percent, short, tenths, three_digits, with_unit

NAN = float("nan")


def test_numbers_show_three_digits():
    numbers = [0.01234, 0.5, 9.996, 12345.6, -7.0, 0.0, NAN, float("inf")]
    expected = ["0.0123", "0.500", "10.00", "12346", "-7.00", "0", "–", "–"]
    assert [three_digits(number) for number in numbers] == expected


def test_shares_are_percent():
    assert [percent(share) for share in (0.996, NAN)] == ["100", NOTHING]
    assert [tenths(share) for share in (0.0994, 0.0996, NAN)] == ["9.9", "10", NOTHING]


def test_values_of_keys_are_short():
    assert [short(value) for value in (0.123456, 3, "hex", None)] == ["0.1235", "3", "hex", "–"]


def test_quantities_are_in_a_unit_of_their_size():
    pairs = [(1e-4, "s"), (0.5, "s"), (90.0, "s"), (0.06, "J"), (5e5, "Pa"), (0.4, "1")]
    shown = [with_unit(value, unit) for value, unit in pairs]
    assert shown == ["100 us", "500 ms", "90 s", "60 mJ", "500 kPa", "40 %"]
    assert [with_unit(v, "s") for v in ("bdf2", NAN, None)] == ["bdf2", NOTHING, NOTHING]
    assert [with_unit(v, u) for v, u in ((0.0, "s"), (3, ""), (5.0, "N"))] == ["0 s", "3", "5 N"]
