"""The crushes along the cells: their cases are as stated, and the values read from their
results.
"""

import numpy as np
import pytest

from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.running.sweep import run_sweep
from tests.studies.course_report.cases import varied
from tests.studies.khatri_egan import across
from tests.studies.khatri_egan.along import (
    COMPARED,
    CONFIGS,
    MEASURED,
    NAMES,
    PLATENS,
    first_peak,
    predictions,
    report,
)

CASES = {cells: expand(load_config(CONFIGS / f"{name}.toml")) for cells, name in NAMES.items()}
STRAIN = 0.03


def short(case):
    """A crush to the first rise only, with few quads."""
    return varied(
        case,
        lattice={"nodes_per_wall": 1, "layers": 4},
        loading={"stroke": STRAIN * 12e-3, "strain": STRAIN},
        solver={"load_steps": 4},
    )


def loose(cases):
    return [case for case in cases if case.loading.platen == "contact"]


@pytest.mark.parametrize("cells", NAMES)
def test_cases_vary_platens_and_friction_only(cells):
    found = {(case.loading.platen, case.contact.friction) for case in CASES[cells]}
    if cells == "square":
        assert found == {(platen, friction) for platen in PLATENS for friction in (0.2, 0.5, 0.9)}
    else:
        assert found == {(platen, 0.5) for platen in PLATENS} | {("glued", 0.2), ("glued", 0.9)}
    assert any(case.contact.friction == COMPARED for case in CASES[cells])
    assert {case.material for case in CASES[cells]} == {CASES["square"][0].material}
    assert {case.loading.stroke for case in CASES[cells]} == {9.6e-3}


def test_specimens_are_those_of_the_paper():
    square, hexagon = CASES["square"][0].lattice, CASES["hexagon"][0].lattice
    assert square.outer_size == pytest.approx((12.4e-3, 12.4e-3))
    flats = hexagon.width / 3.5  # each second row is shifted by half a cell
    assert flats - hexagon.wall_thickness == pytest.approx(3.1e-3)
    assert hexagon.height == pytest.approx(6.5 * flats / np.sqrt(3.0), rel=1e-4)
    assert square.depth == hexagon.depth == 12e-3


def test_results_become_a_table_and_a_picture(tmp_path):
    bases = {c.loading.platen: c for c in reversed(expand(load_config(across.CONFIG)))}
    coarse = [
        varied(c, lattice={"nodes_per_wall": 2}, solver={"load_steps": 120})
        .model_copy(update={"axes": c.axes})
        for c in bases.values()
    ]  # fmt: skip
    assert run_sweep(coarse, tmp_path / f"{across.CONFIG.stem}.h5") == 0
    path = tmp_path / f"{NAMES['square']}.h5"
    cases = [short(case).model_copy(update={"axes": case.axes}) for case in loose(CASES["square"])]
    assert run_sweep(cases, path) == 0
    text = report(tmp_path)
    assert (tmp_path / "along.md").read_text("utf-8") == text
    assert (tmp_path / "along.png").exists()
    assert text.count("| loose ") == 3
    mean, scatter = MEASURED["square"]
    assert f"Measured: {mean:g} +/- {scatter:g} J; 0 of 3 cases are within it." in text
    table = predictions(path)
    (base,) = (r for r in across.predictions(tmp_path / f"{across.CONFIG.stem}.h5").itertuples()
               if r.platen == "glued")  # fmt: skip
    (compared,) = table[table["contact.friction"] == COMPARED]["absorbed_energy_J"]
    ratio = compared / base.absorbed_energy_J
    assert f"stuck, {base.absorbed_energy_J:.3f} J: {ratio:.1f} to {ratio:.1f}" in text


def test_the_first_peak_is_followed_by_a_drop():
    assert first_peak(np.array([0.0, 1.0, 3.0, 2.0, 5.0, 1.0])) == 3.0
    assert np.isnan(first_peak(np.array([0.0, 1.0, 2.0])))
