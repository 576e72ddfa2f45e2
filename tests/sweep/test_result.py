"""The result of a case: its status, the row of its design, and that of a case that failed."""

from math import isnan
from types import SimpleNamespace

from sweep.columns import (
    COLUMNS,
    cycle_columns,
)
from sweep.config.case import Case, Material
from sweep.config.material_table import BY_NUMBERS
from sweep.result import MODEL_VERSION, Result, Status, design_columns, failed_result


def a_case(**loading):
    """A stand-in with the attributes that a row of the design needs."""
    lattice = {"kind": "square", "cells_x": 3, "cells_y": 2, "wall_thickness": 8e-4}
    lattice |= {"width": 0.0125, "height": 0.0125, "depth": 0.012, "outer_size": (0.0133, 0.0133)}
    lattice |= {"grading": 1.0, "nozzle": 4e-4, "opening": 4e-3, "boundary": "periodic"}
    unused = ("orientation", "structure", "slicer", "pattern", "infill", "line_width")
    lattice |= dict.fromkeys(unused)
    loads = {"mode": "force", "platen": "none", "force": 10.0, "stroke": None}
    loads |= {"direction": "in_plane"}
    loads |= dict.fromkeys(("striker_mass", "striker_speed", "energy", "cycles"))
    return SimpleNamespace(
        case_id="0123456789abcdef",
        lattice=SimpleNamespace(**lattice),
        material=SimpleNamespace(name="ninjaflex", modulus=12e6, inelasticity="none"),
        loading=SimpleNamespace(**(loads | {"allowed_forces": (50.0,)} | loading)),
        contact=SimpleNamespace(model="barrier"),
    )


def test_a_material_given_by_numbers_says_so():
    case = Case(material=Material(modulus=12e6, density=1190.0))
    assert design_columns(case)["material"] == BY_NUMBERS
    assert f'"{BY_NUMBERS}"' in COLUMNS["material"].description


def test_status_is_its_word():
    assert Status("timed_out") is Status.TIMED_OUT
    assert f"{Status.CONVERGED}" == "converged"


def test_design_of_a_case_is_known_before_it_runs():
    row = design_columns(a_case(mode="displacement", force=None, stroke=6e-3))
    assert row["cells_y"] == 2
    assert row["stroke_m"] == 6e-3
    assert isnan(row["force_N"])
    assert row["model_version"] == MODEL_VERSION
    assert set(row) <= set(COLUMNS)


def test_failed_result_keeps_the_design_and_measures_nothing():
    result = failed_result(a_case(), Status.WORKER_DIED, "It took its worker with it.")
    assert isinstance(result, Result)
    assert list(result.summary) == [*list(COLUMNS)[3:], "absorbed_energy_at_50N_J"]
    assert result.summary["wall_thickness_m"] == 8e-4
    assert result.summary["newton_iterations"] == 0
    assert isnan(result.summary["absorbed_energy_at_50N_J"])


def test_failed_result_has_the_columns_of_all_cycles():
    named = {*cycle_columns(1), *cycle_columns(2)}
    once, twice = (set(failed_result(a_case(cycles=n), Status.STOPPED, "").summary) for n in (1, 2))
    assert twice - once == named
