"""The study of dead loads in long steps: one load, and its table."""

from tests.studies.rankings.loads import Run, cell, loads, runs, table


def test_the_loads_are_those_of_armor():
    cases = list(loads())
    assert len(cases) == 24
    assert {case.loading.force for case in cases} == {125.0, 500.0}


def test_what_errs_in_long_steps_has_a_local_error():
    case = next(case for case in loads() if case.lattice.wall_thickness == 8e-4)
    case = case.changed(loading={"release_time": 4e-3, "duration": 4e-3})
    long, short = runs(case, errors=(), integrators=("bdf2",))
    assert long.strain > 3.0 > short.strain
    assert long.local > 0.5 > short.local


def test_errors_stand_in_the_row_of_their_local_error():
    every = [Run("bdf2", 0.05, 0.1), Run("bdf2", 0.3, 1.0), Run("bdf2", 0.4, 3.0)]
    every += [Run("newmark", 5.0, 9.0), Run("stated", 0.6, 2.0)]
    rows = [text.split(" | ") for text in table(every)]
    assert rows[2][1:] == ["–", "1: 0.1 (0.1)", "– |"]
    assert rows[4][2] == "2: 2 (3)"
    assert rows[7][3] == "1: 9 (9) |"
    assert rows[-2] == ["with step_error, not marked: –"]
    assert rows[-1] == ["with step_error, marked: 1: 2 (2)"]
    assert cell([]) == "–"
