"""Causes that may part the rows of a crush: each change is a case of its own, and one parts all
three.
"""

from tests.studies.khatri_egan.across import load_peaks
from tests.studies.khatri_egan.rows import CHANGES, cases
from tests.support.converged import converged


def test_every_change_is_a_case_of_its_own():
    every = cases()
    assert len({case.case_id for case in every.values()}) == len(every) == 3 * len(CHANGES)
    assert {case.loading.stroke for case in every.values()} == {9.6e-3}


def test_a_flat_stress_and_unequal_walls_part_three_rows():
    result = converged(cases()["flat beyond 4 MPa, 1.1", "glued"])
    assert load_peaks(result.history["reaction_top_N"]) == 3
