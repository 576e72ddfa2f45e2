"""Headers of materials: numbers with their ranges, the source, and assumptions."""

import pytest

from sweep.config.materials.material_file import (
    PLASTICITY,
    RecordError,
    available,
    locate,
    read_record,
)
from sweep.config.materials.material_header import Stated, assumed, comments, source, stated
from tests.support.materials.records import HEADER

ROWS = "0.01,2e4\n0.05,1e5\n"


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("67e6", Stated(67e6)),
        ("67e6 +- 6e6", Stated(67e6, 61e6, 73e6)),
        ("0.48 (0.45 .. 0.48)", Stated(0.48, 0.45, 0.48)),
        ("1e6..2e6", Stated(None, 1e6, 2e6)),
        (" .5 ", Stated(0.5)),
    ],
)
def test_a_number_may_have_a_range(text, number):
    assert stated([f"# modulus_Pa: {text}"]) == {"modulus": number}


@pytest.mark.parametrize("text", ["about 12", "1.2 g/cm3"])
def test_what_is_no_number_is_refused(text):
    with pytest.raises(ValueError, match=r"# poisson: .* is no number; allowed: .*1\.1 \.\. 1\.4"):
        stated([f"# poisson: {text}"])


@pytest.mark.parametrize("text", ["0.4 (0.45 .. 0.48)", "0.48 (0.48 .. 0.45)", "2 .. 2"])
def test_what_is_no_range_is_refused(text):
    with pytest.raises(ValueError, match=r"# poisson: .* is no range; allowed: "):
        stated([f"# poisson: {text}"])


def test_comments_go_on_where_a_line_is_indented():
    lines = ["# A spool.", "# Source: A and B 2023: a", "#   strip.", "# poisson: 0.4", "strain,s"]
    texts = comments(lines)
    assert texts == ("A spool.", "Source: A and B 2023: a strip.")
    assert source(texts) == "A and B 2023"
    assert source(("A spool.",)) == ""


def test_assumptions_are_those_that_are_marked():
    texts = ("Marks: [A] an assumption.", "Density [A]: guessed. Curve [A]: too.", "Loss [Q]: 1")
    assert assumed(texts) == ("Density", "Curve")


@pytest.mark.parametrize("name", available())
def test_every_material_states_its_source_and_what_is_assumed(name):
    record = read_record(locate(name))
    assert source(record.comments)
    assert "Poisson's ratio" in assumed(record.comments)
    assert record.plasticity or {"modulus", "poisson"} <= record.ranges.keys()
    for key, (low, high) in record.ranges.items():
        value = record.plasticity[key] if key in PLASTICITY else getattr(record, key)
        assert low <= value * (1.0 + 1e-3)
        assert value <= high


@pytest.mark.parametrize(("name", "time"), [("cheetah", 0.33), ("polymaker_tpu90", 0.1)])
def test_reference_time_is_that_of_the_test(name, time):
    """A strain of 2.5 % at the rate that the source says."""
    record = read_record(locate(name))
    rate = next(text for text in record.comments if "strain rate" in text).split("strain rate ")[1]
    assert record.reference_time == time == pytest.approx(0.025 / float(rate.split()[0]), rel=0.01)


def test_measured_memory_and_ranges_are_kept(own_record):
    memory = "# loss: 0.3 +- 0.05\n# softening_r: 2\n# softening_m_Pa: 1e5\n"
    record = read_record(own_record(memory + "# friction: 0.2 .. 0.9\n" + HEADER + ROWS))
    assert record.memory == {"loss": 0.3, "softening_r": 2.0, "softening_m": 1e5}
    assert record.ranges["loss"] == pytest.approx((0.25, 0.35))
    assert record.ranges["friction"] == (0.2, 0.9)


@pytest.mark.parametrize(
    ("line", "wrong"),
    [
        ("# softening_r: 2\n", "softening needs the lines"),
        ("# loss: 0.2 .. 0.4\n", "loss needs a number beside its range"),
    ],
)
def test_half_of_a_memory_is_refused(own_record, line, wrong):
    with pytest.raises(RecordError, match=f"own.csv: {wrong}"):
        read_record(own_record(line + HEADER + ROWS))
