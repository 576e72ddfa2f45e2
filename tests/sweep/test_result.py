"""The result of a case: its status, the row of its design, and the result of a case that failed."""

from math import isnan

from sweep.columns import (
    COLUMNS,
    cycle_columns,
)
from sweep.config.case import Case
from sweep.config.kinds.material import BY_NUMBERS
from sweep.result import MODEL_VERSION, Result, Status, design_columns, failed_result


def test_a_material_given_by_numbers_says_so():
    case = Case.of(material=dict(modulus=12e6, density=1190.0))
    assert design_columns(case)["material"] == BY_NUMBERS
    assert f'"{BY_NUMBERS}"' in COLUMNS["material"].description


def test_design_of_a_case_is_known_before_it_runs():
    row = design_columns(Case.of(lattice=dict(cells_y=2), loading=dict(stroke=6e-3)))
    assert row["cells_y"] == 2
    assert row["stroke_m"] == 6e-3
    assert isnan(row["force_N"])
    assert row["model_version"] == MODEL_VERSION
    assert set(row) <= set(COLUMNS)


def test_failed_result_keeps_the_design_and_measures_nothing():
    case = Case.of(loading=dict(allowed_forces=(50.0,)))
    result = failed_result(case, Status.WORKER_DIED, "It took its worker with it.")
    assert isinstance(result, Result)
    assert list(result.summary) == [*list(COLUMNS)[3:], "absorbed_energy_at_50N_J"]
    assert result.summary["wall_thickness_m"] == 8e-4
    assert result.summary["newton_iterations"] == 0
    assert isnan(result.summary["absorbed_energy_at_50N_J"])


def test_failed_result_has_the_columns_of_all_cycles():
    cases = [Case.of(loading=dict(strain=0.5, cycles=n)) for n in (1, 2)]
    once, twice = (set(failed_result(case, Status.STOPPED, "").summary) for case in cases)
    assert twice - once == {*cycle_columns(1), *cycle_columns(2)}
