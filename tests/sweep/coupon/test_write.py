"""The file of a fitted material is one that a config can name, and reports the results."""

import re
from dataclasses import replace

import numpy as np
import pytest

from sweep.config.materials.material_file import read_record
from sweep.config.materials.material_header import assumed, source
from sweep.coupon.fit import fit
from sweep.coupon.hyperelastic import Rubber
from sweep.coupon.record import Coupon
from sweep.coupon.write import fit_sentence, material_text, sentences_on_fit, tension_lines
from tests.support.designs.tables import material_with
from tests.support.materials.coupons import coupon

NAMES = ("time", "strain", "stress")
BOTH = {"loss": 0.35, "softening_r": 2.5, "softening_m": 3e5}


@pytest.fixture(scope="module")
def both():
    return fit(coupon(0.5, 0.07, 0.5, **BOTH))


def read(own_record, *given):
    """The record of the file of a fit."""
    return read_record(own_record(material_text(*given)))


def test_material_is_read_with_what_was_fitted(own_record, both):
    record = read(own_record, both)
    assert record.memory == pytest.approx(BOTH | {"softening_beta": 0.1}, rel=0.01)
    assert record.reference_time == pytest.approx(both.reference_time, rel=1e-3)
    assert record.stress == pytest.approx(both.stress.tolist(), rel=1e-5)
    assert source(record.comments) == "own coupon"
    assert assumed(record.comments) == ("Density", "Poisson's ratio", "Softening beta")
    assert max(map(len, material_text(both).splitlines())) <= 100
    measured = material_with(name=str(own_record(material_text(both))), memory="measured")
    assert measured.loss == record.memory["loss"]


def test_ranges_are_standard_errors_within_what_a_file_may_state(own_record, both):
    low, high = read(own_record, both).ranges["loss"]
    assert (high - low) / 2.0 == pytest.approx(both.errors["loss"], rel=0.05)
    errors = {"modulus": 3.0, "loss": 9.0, "softening_r": 9.0, "softening_m": 9e9}
    ranges = read(own_record, replace(both, errors=errors)).ranges
    assert 0.0 < ranges["loss"][0] < 0.01 < ranges["loss"][1] == 0.8
    assert 1.0 < ranges["softening_r"][0] < 1.02
    assert min(ranges["softening_m"][0], ranges["modulus"][0]) > 0.0
    sure = replace(both, errors={"modulus": 0.0})
    assert {"modulus", "loss", "softening_r"}.isdisjoint(read(own_record, sure).ranges)


def test_how_a_record_was_read_is_in_the_file_and_in_the_words(own_record, both):
    noted = replace(both, coupon=replace(both.coupon, notes=("401 rows", "force from Load [N]")))
    assert "\n#   401 rows, force from Load [N].\n" in material_text(noted)
    lines = [*sentences_on_fit(noted, read(own_record, noted))]
    assert lines[:2] == ["read            401 rows", "read            force from Load [N]"]


def test_density_is_assumed_unless_it_is_given(own_record, both):
    assert read(own_record, both).ranges["density"] == (1190.0, 1220.0)
    weighed = read(own_record, both, 1234.5)
    assert (weighed.density, "density" in weighed.ranges) == (1234.5, False)


def test_puck_says_that_its_tension_is_derived(own_record):
    record = read(own_record, fit(coupon(-0.4, -0.06, -0.4, loss=0.3)))
    assert "Tension" in assumed(record.comments)
    assert min(record.strain) == pytest.approx(-0.4)


def test_what_was_found_is_told(own_record, both):
    lines = [*sentences_on_fit(both, read(own_record, both))]
    words = "\n".join(lines)
    assert re.search(r"loss            0.35 ± 0.00\d+, without softening", words)
    assert re.search(r"r 2.5 ± 0.0\d+, m 0.3 ± 0.00\d+ MPa, beta 0.1, which is assumed", words)
    assert lines[0].startswith("first loading   to a strain of 0.5: the curve, of 2 loadings; loss")
    assert lines[-1] == fit_sentence(both)
    assert "within 0.0" in lines[-1]


@pytest.mark.parametrize(
    ("scales", "noise", "wrong"),
    [
        ((1e3, 1.0, 1.0), 0.0, "at 5e-05 1/s.* --units time=ms$"),
        ((1 / 60, 1.0, 1.0), 0.0, "at 3 1/s.* --units time=min$"),
        ((1.0, 9.0, 1.0), 0.0, "above 5 MPa: .*percent"),
        ((1.0, 1.0, 1.0), 0.05, "more than 3 %.*picture"),
        ((1.0, 1.0, 1.0), 0.0, None),
    ],
)
def test_what_is_unusual_is_a_warning(own_record, scales, noise, wrong):
    test = coupon(0.5, noise=noise)
    columns = (scale * getattr(test, name) for scale, name in zip(scales, NAMES, strict=True))
    found = fit(Coupon("odd", *columns))
    lines = sentences_on_fit(found, read(own_record, found))
    warnings = [line for line in lines if "Warning" in line]
    assert len(warnings) == (wrong is not None)
    assert wrong is None or re.search(wrong, warnings[0])


@pytest.mark.parametrize(
    ("ends", "lines"),
    [
        ((0.5,), ["loss            not known, as "]),
        ((0.5, 0.0), ["softening       not known, as "]),
        (
            (0.5, 0.0, 0.5, 0.0),
            ["loss            none: ", "softening       none: ", "0 % and 0 % of "],
        ),
    ],
)
def test_what_is_not_known_is_told(own_record, ends, lines):
    found = fit(coupon(*ends))
    words = "\n".join(sentences_on_fit(found, read(own_record, found)))
    assert [line for line in lines if line not in words] == []


STRAIN = np.array([0.05, 0.1, 0.2, 0.3, 0.4])
BOTH_WAYS = np.r_[-STRAIN[::-1], STRAIN]


def test_a_rubber_is_told_with_the_range_of_other_rules():
    """Neo-Hookean, 4 MPa: 3.05 MPa at -20 %, 2.02 MPa at 20 %."""
    rule, ends = tension_lines(BOTH_WAYS, Rubber(4e6, 0.0).at(BOTH_WAYS))
    assert rule.startswith("# Tension [A]: of the rubber (Mooney and Rivlin)")
    assert ends.startswith("#   At 20 % strain 2.02 MPa; other rules give 1.7")
    assert ends.endswith("to 3.05 MPa (nominal).")


def test_what_is_no_rubber_is_told_and_a_short_record_is_compared_at_its_end():
    yields = np.sign(BOTH_WAYS) * 1e6 * np.minimum(np.abs(BOTH_WAYS), 0.1) + 1e4 * BOTH_WAYS
    rule, _ = tension_lines(BOTH_WAYS, yields)
    assert rule.endswith("no rubber (Mooney and Rivlin) follows that.")
    part = BOTH_WAYS[np.abs(BOTH_WAYS) < 0.15]
    *_, ends = tension_lines(part, Rubber(4e6, 0.0).at(part))
    assert ends.startswith("#   At 10 % strain 1.09 MPa; ")
