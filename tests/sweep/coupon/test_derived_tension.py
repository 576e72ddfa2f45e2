"""Comments on a derived tension: the rule, and how far others are apart."""

import numpy as np

from sweep.coupon.derived_tension import tension_lines
from sweep.coupon.hyperelastic import Rubber

STRAIN = np.array([0.05, 0.1, 0.2, 0.3, 0.4])
BOTH = np.r_[-STRAIN[::-1], STRAIN]


def test_a_rubber_is_told_with_the_range_of_other_rules():
    """Neo-Hookean, 4 MPa: 3.05 MPa at -20 %, 2.02 MPa at 20 %."""
    rule, ends = tension_lines(BOTH, Rubber(4e6, 0.0).at(BOTH))
    assert rule.startswith("# Tension [A]: of the rubber (Mooney and Rivlin)")
    assert ends.startswith("#   At 20 % strain 2.02 MPa; other rules give 1.7")
    assert ends.endswith("to 3.05 MPa (nominal).")


def test_what_is_no_rubber_is_told():
    yields = np.sign(BOTH) * 1e6 * np.minimum(np.abs(BOTH), 0.1) + 1e4 * BOTH
    rule, _ = tension_lines(BOTH, yields)
    assert rule.endswith("no rubber (Mooney and Rivlin) follows that.")


def test_a_short_record_is_compared_at_its_end():
    part = BOTH[np.abs(BOTH) < 0.15]
    *_, ends = tension_lines(part, Rubber(4e6, 0.0).at(part))
    assert ends.startswith("#   At 10 % strain 1.09 MPa; ")
