"""Unit columns: which cases they are, how their values are scaled, and that none runs twice."""

from math import nan

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.design.infill import families
from sweep.design.network import mass
from sweep.ranking.question import Question
from sweep.result import Result, Status, design_columns
from sweep.running.beside.run_beside import How, file_beside
from sweep.running.beside.screen import best_of, has_column, run_columns, unit_column
from sweep.store.read import read_summary
from tests.support.results.standin import Logged
from tests.support.results.standin import simulate as invent

ALONG = dict(direction="out_of_plane", strain=0.3, allowed_forces=(50.0,))


def along(kind="square", **lattice):
    box = {"width": 12e-3, "height": 12e-3, "depth": 12e-3, "nodes_per_wall": 3}
    cells = {"cells_x": 3, "cells_y": 3, "wall_thickness": 4e-4}
    return Case.of(lattice=dict(kind=kind, **box | cells | lattice), loading=ALONG)


def pitch(case):
    """Length of the longest wall."""
    network = case.lattice.network
    start, end = network.points[network.walls].swapaxes(0, 1)
    return np.linalg.norm(end - start, axis=1).max()


def grams(case):
    return 1e3 * mass(case.lattice.network, case.lattice.depth, case.material.density)


@pytest.mark.parametrize("kind", families())
def test_column_is_one_cell_with_the_walls_of_the_design(kind):
    design = along(kind)
    column = unit_column(design)
    whole, cell = design.lattice, column.lattice
    assert (cell.cells_x, cell.cells_y) == (1, 1)
    assert pitch(column) == pytest.approx(pitch(design), rel=1e-9)
    same = ("wall_thickness", "depth", "layers", "nodes_per_wall", "imperfection")
    assert [getattr(cell, key) for key in same] == [getattr(whole, key) for key in same]
    assert grams(column) < grams(design)


def test_walls_that_follow_from_a_mass_stay():
    design = Case.of(lattice=dict(cells_x=3, cells_y=3, mass=1e-3), loading=ALONG)
    column = unit_column(design)
    assert column.lattice.wall_thickness == design.lattice.wall_thickness
    assert column.lattice.mass is None


def test_column_of_a_material_with_loss_is_strained_as_fast():
    design = Case.of(lattice=dict(cells_x=3, cells_y=3), material=dict(loss=0.4), loading=ALONG)
    assert unit_column(design).loading.strain_rate == design.loading.strain_rate


def test_quarter_stays_where_the_cell_has_mirror_planes():
    assert unit_column(along(symmetry="quarter")).lattice.symmetry == "quarter"
    assert unit_column(along()).lattice.symmetry == "none"


def test_only_crushes_along_equal_cells_have_a_column():
    assert has_column(along())
    assert not has_column(along(grading=1.5))
    assert not has_column(along(cells_x=1, cells_y=1))
    assert has_column(along(cells_x=2, cells_y=1))
    assert not has_column(along(perimeters=1))
    across = dict(mode="displacement", strain=0.3)
    assert not has_column(Case.of(lattice=along().lattice, loading=across))
    struck = dict(direction="out_of_plane", mode="impact", striker_mass=0.05, striker_speed=1.0)
    assert not has_column(Case.of(lattice=along().lattice, loading=struck))


WORTH = {"square": 2.0, "hex": 3.0, "triangle": 1.0}  # J/g
DESIGNS = [along(kind) for kind in WORTH]


def crush(case, stop=None):
    """A result whose energy is given by its walls, as are its forces and stresses; brick fails."""
    kind, weight = case.lattice.kind, grams(case)
    width, height = case.lattice.outer_size
    density = weight / (1e3 * case.material.density * case.lattice.depth * width * height)
    worth = WORTH.get(kind, nan)
    found = invent(case)
    measures = dict(found.summary) | design_columns(case)
    measures |= {
        "mass_g": weight,
        "printed_mass_g": nan,
        "relative_density": density,
        "solid_strain": 1.0 - density,
        "absorbed_energy_J": worth * weight,
        "absorbed_energy_until_packed_J": worth * weight,
        "specific_absorption_J_per_g": worth,
        "specific_absorption_until_packed_J_per_g": worth,
        "peak_force_N": 10.0 * weight,
        "plateau_stress_Pa": 1e5 * density,
        "peak_strain": 0.3,
    }
    status = Status.STOPPED if kind == "brick" else Status.CONVERGED
    measures["loaded"] = int(kind != "brick")
    return Result(case, status, "", measures, found.history, found.frames)


def test_estimates_are_those_of_the_whole_where_walls_are_alike(tmp_path):
    """Fails if energies, forces or stresses are not scaled: a cell has a tenth of the mass."""
    found = run_columns(DESIGNS, tmp_path / "trial.h5", How(simulate=crush)).set_index("case_id")
    for design in DESIGNS:
        whole = crush(design).summary
        for name in (
            *("mass_g", "absorbed_energy_J", "peak_force_N", "plateau_stress_Pa"),
            *("relative_density", "solid_strain", "specific_absorption_J_per_g", "cells_x"),
            "outer_width_m",
        ):
            assert found.loc[design.case_id, name] == pytest.approx(whole[name], rel=1e-9), name
    cells = read_summary(file_beside(tmp_path / "trial.h5", "screen"))
    assert cells["mass_g"].max() < 0.3 * found["mass_g"].min()


def test_no_column_runs_twice_and_a_stopped_one_gives_no_estimate(tmp_path):
    logged, out = Logged(crush), tmp_path / "trial.h5"
    run_columns(DESIGNS[:1], out, How(simulate=logged))
    designs = [*DESIGNS, along("brick")]
    for _ in range(2):
        found = run_columns(designs, out, How(simulate=logged))
    assert sorted(logged) == sorted(unit_column(design).case_id for design in designs)
    assert set(found["case_id"]) == {design.case_id for design in DESIGNS}
    assert file_beside(out, "screen").name == "trial.screen.h5"
    assert not out.exists()


def test_the_best_are_those_of_the_ranking_of_each_infill(tmp_path):
    """Between infills estimates do not order designs, and the worst one keeps its best."""
    thick = [along(kind, wall_thickness=5e-4, nodes_per_wall=4) for kind in WORTH]
    found = run_columns([*DESIGNS, *thick], tmp_path / "trial.h5", How(simulate=crush))
    question = Question(by="absorbed_energy_J")
    best = best_of(found, question, 1)
    assert best == [design.case_id for design in thick]
    assert len(best_of(found, question, 2)) == 6
    unmet = question._replace(require={"max_force": 1e-3})
    assert best_of(found, unmet, 1) == best
