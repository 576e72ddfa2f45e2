"""The study of how many elements a wall needs: its arithmetic, and a small piece of it."""

import numpy as np
import pandas as pd
import pytest

from sweep.running.beside.error_bars import companions
from sweep.simulation.simulate import simulate
from tests.studies.mesh.certainty import covered, order
from tests.studies.mesh.crushes import (
    COLUMNS,
    DESIGNS,
    cases_of,
    compare,
    parted,
    slenderness,
    usual,
    without_contact,
)
from tests.studies.mesh.tables import by_column, by_design, by_group, verdict

FEW = [("square", ("glued", 1.2e-3)), ("hex", ("contact", 1.2e-3))]
COARSE, THREE, FINE, FINEST = 1, 3, 8, 12
STRAIN = np.linspace(0.0, 0.6, 61)


@pytest.fixture(scope="module")
def piece():
    """Two designs on four meshes, the third the usual one: cases, summary by id, curves by id."""
    cases = cases_of(FEW, (COARSE, THREE, FINE, FINEST))
    ranked = [case for (design, n), case in cases.items() if n == usual(design)]
    others = [companion.case for case in ranked for companion in companions(case)]
    results = {case.case_id: simulate(case) for case in (*cases.values(), *others)}
    rows = pd.DataFrame({key: result.summary for key, result in results.items()}).T
    rows["status"] = [str(result.status) for result in results.values()]
    histories = {key: result.history for key, result in results.items()}
    curves = {key: (curve["strain"], curve["work_in_J"]) for key, curve in histories.items()}
    return cases, rows.infer_objects(), curves


def work(force):
    """The curve of a crush with this force, (61,), over `STRAIN`."""
    mean = 0.5 * (force[1:] + force[:-1])
    return STRAIN, np.concatenate([[0.0], np.cumsum(mean * np.diff(STRAIN))])


def test_all_infills_glued_and_loose_on_every_mesh():
    cases = cases_of()
    assert len(DESIGNS) == 8 * 2 * 3
    assert len({case.case_id for case in cases.values()}) == len(cases) == 48 * 8
    alone = without_contact(cases)
    assert {case.contact.model for case in alone.values()} == {"none"}
    assert len({case.case_id for case in alone.values()}) == 24 * 8
    assert slenderness(cases[DESIGNS[0], 1]) == pytest.approx(slenderness(cases[DESIGNS[0], 6]))


def test_paths_part_where_forces_stay_apart():
    even = np.full(61, 10.0)
    assert np.isnan(parted(work(even), work(1.04 * even)))
    assert parted(work(even), work(np.where(STRAIN > 0.299, 12.0, 10.0))) == pytest.approx(0.3)
    assert parted(work(even), work(np.where(STRAIN > 0.299, 9.0, 10.0))) == pytest.approx(0.3)
    late_snap = np.where(abs(STRAIN - 0.31) < 0.005, 20.0, 10.0)
    assert np.isnan(parted(work(even), work(late_snap)))


def test_cheapest_mesh_has_small_errors_in_the_middle_and_in_nine_of_ten():
    def errors(*shares):
        return pd.DataFrame(dict.fromkeys(COLUMNS, shares))

    good, wide = errors(0.0, 0.009, 0.019), errors(0.0, 0.0, 0.04)
    off = errors(0.0, 0.012, 0.013)
    several = verdict({2: wide, 3: off, 4: good, 6: good}, good)
    assert several.endswith("every column: 4 elements a wall; so is the default.")
    assert verdict({2: wide, 3: off}, off).startswith("No mesh")
    assert verdict({2: good}, off).endswith("; the default is not.")
    one_bad = good.assign(packing_strain=0.03)
    assert verdict({2: one_bad}, good).startswith("No mesh")


def test_a_piece_of_the_study(piece):
    """Errors of single elements are per cents; eight and twelve elements agree within 1 %."""
    cases, rows, curves = piece
    found = compare(cases, rows, curves)
    assert len(found) == len(cases)
    assert not found["failed"].any()
    assert found["branches"].isna().all()
    worst = found.set_index(["infill", "elements"])[list(COLUMNS)].max(axis=1)
    for infill in ("square", "hex"):
        assert worst[infill, FINEST] == 0.0
        assert 0.0 < worst[infill, FINE] < 0.01 < worst[infill, COARSE] < 0.5
    sheets = by_column(found), by_group(found), by_design(found)
    assert [len(sheet.rows[0]) for sheet in sheets] == [len(sheet.heads) for sheet in sheets]
    least = min(n for n in (COARSE, THREE, FINE) if cheap(found, n))
    default = "so is the default" if cheap(found, FINE) else "the default is not"
    expected = f"Within 1 / 2 % in every column: {least} elements a wall; {default}."
    assert sheets[0].notes[-1] == expected


def cheap(found, n):
    """Whether in all columns the mean of both errors is below 1 %, and 9/10 of the way up 2 %."""
    errors = np.sort(found.loc[found["elements"] == n, list(COLUMNS)], axis=0)
    return (errors.mean(axis=0) <= 0.01).all() and (errors.T @ [0.1, 0.9] <= 0.02).all()


def test_design_without_a_truth_is_marked_and_enters_no_average(piece):
    cases, rows, curves = piece
    finest, near = (cases[FEW[0], n].case_id for n in (FINEST, FINE))
    strain, joules = curves[near]
    elsewhere = curves | {near: (strain, joules * np.where(strain > 0.3, 1.5, 1.0))}
    found = compare(cases, rows, elsewhere).set_index("infill")
    assert found.loc["square", "branches"].between(0.25, 0.35).all()
    assert by_group(found.reset_index()).rows[0][0] == "loose"

    stopped = rows.assign(status=rows["status"].where(rows.index != finest, "stopped"))
    found = compare(cases, stopped, curves)
    assert found.loc[found["infill"] == "square", "branches"].eq(0.0).all()
    assert by_design(found).rows[0][4] == "0 %"


def test_wrong_orders_and_ties_are_counted_in_pairs():
    """Limits have the last two in the other order; corrections let these and the first two tie."""
    values, limits = np.array([10.0, 9.0, 5.0, 4.0]), np.array([10.0, 9.0, 4.0, 5.0])
    corrections = np.array([0.5, -0.5, -0.5, 0.5])
    assert list(order(values, corrections, limits)) == [6, 1, 1, 1]
    assert list(order(values, 0.0 * corrections, limits)) == [6, 1, 0, 0]


def test_error_bars_of_the_default_mesh_are_measured_and_cheap(piece):
    cases, rows, _ = piece
    sheet = covered(cases, rows)
    assert sheet.rows[0][:2] == ["crushed", "all"]
    assert float(sheet.rows[0][3]) > 50.0
    factor = float(sheet.notes[0].split()[-4])
    assert 1.2 < factor < 3.0
    assert sheet.notes[1].startswith("Of 0 pairs")  # a design of each platen
