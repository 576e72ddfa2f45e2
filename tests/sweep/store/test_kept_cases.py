"""The case of every row: kept in parts and in the folded file, read only when it is requested."""

import h5py
import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.load import load_config
from sweep.result import Status, failed_result
from sweep.store import parts
from sweep.store.batch import FORMAT
from sweep.store.read import (
    StoreError,
    changed_cases,
    read_case,
    read_curves,
    read_history,
    read_runs,
    read_summary,
)
from sweep.store.write import Writer
from tests.support.results.specimens import summary
from tests.support.results.specimens import write as write_made_up
from tests.support.results.standin import blank, cases, forge, parts_of, write


@pytest.mark.parametrize("folded", [False, True])
def test_cases_are_read_as_they_were(path, folded, monkeypatch):
    """Cases of very different texts, which failed before they had curves."""
    monkeypatch.setattr(parts, "MERGE_AT", 3)
    batch = [
        load_config("custom").cases[0],
        Case.of(lattice=dict(slicer="orca", pattern="grid", mass=5e-3, width=25e-3)),
        Case.of(lattice=dict(boundary="periodic"), loading=dict(strain=0.3)),
        Case.of(loading=dict(direction="out_of_plane")),
        *cases(8),
    ]
    with Writer(path) as writer:
        for begin in range(0, len(batch), 5):
            five = batch[begin : begin + 5]
            writer.append([failed_result(case, Status.WORKER_DIED, "Lost.") for case in five])
        if folded:
            writer.fold()
    assert bool(parts_of(path)) is not folded
    for case in batch:
        stored = read_case(path, case.case_id)
        assert (stored, stored.axes) == (case, case.axes)


def test_texts_of_neighbours_cost_few_bytes(path):
    write(path, cases(100), fold=True, size=100)
    with h5py.File(path) as file:
        data = file["cases/values/json"]
        assert data.shape[0] == sum(len(case.to_json()) for case in cases(100))
        assert data.id.get_storage_size() < 150 * 100


def test_only_who_asks_for_a_case_reads_it(path):
    write(path, cases(5), fold=True)
    blank(path)
    ids = list(read_summary(path)["case_id"])
    assert len(list(read_runs(path, ids))) == 5
    with pytest.raises(StoreError, match="is damaged"):
        read_case(path, ids[0])


def test_text_that_is_no_case_and_a_case_of_another_id_are_refused_by_name(path):
    write_made_up(path, summary({"case_id": "ab"}))
    with pytest.raises(StoreError, match=r"armor.h5 holds no usable case ab: lattice: Field"):
        read_case(path, "ab")
    path.unlink()
    write(path, cases(1), fold=True)
    other = "0123456789abcdef"
    forge(path, "summary/case_id", lambda ids: ids.__setitem__(0, other))
    with pytest.raises(StoreError, match=f"{other}: it is case {cases(1)[0].case_id}"):
        read_case(path, other)


@pytest.mark.parametrize("other", [FORMAT - 1, FORMAT + 1])
def test_file_of_another_format_is_refused_with_advice(path, other):
    write(path, cases(2), fold=True)
    with h5py.File(path, "r+") as file:
        file.attrs["format"] = other
    wrong = f"of format {other}; this Crumple reads format {FORMAT}: move it away, and `crumple run"
    for ask in (read_summary, lambda path: write(path, cases(1))):
        with pytest.raises(StoreError, match=wrong) as refused:
            ask(path)
        assert "\n" not in str(refused.value)


def edited(path, old, new):
    """Change a text in the stored cases, as a tool for HDF5 can."""
    with h5py.File(path, "r+") as file:
        text = file["cases/values/json"]
        assert (len(old), old in text[:].tobytes()) == (len(new), True)
        text[:] = np.frombuffer(text[:].tobytes().replace(old, new, 1), np.uint8)


KNOWN = {case.case_id: case for case in cases(7)}


@pytest.mark.parametrize("fold", [False, True])
def test_a_row_that_holds_another_case_is_found(path, fold):
    batch = cases(5)
    assert changed_cases(path, KNOWN, KNOWN.get) == set()  # without a file
    write(path, batch, fold, size=5)
    assert changed_cases(path, KNOWN, KNOWN.get) == set()
    (sealed,) = [path] if fold else parts_of(path)
    edited(sealed, b'"imperfection":0.003', b'"imperfection":0.009')
    assert changed_cases(path, KNOWN, KNOWN.get) == {batch[3].case_id}
    assert changed_cases(path, {batch[1].case_id}, KNOWN.get) == set()
    with h5py.File(sealed, "r+") as file:
        del file["cases/values/json"]
    assert changed_cases(path, KNOWN, KNOWN.get) == {case.case_id for case in batch}


def test_labels_of_another_sweep_are_no_other_case_but_what_follows_them_is(path):
    batch = cases(3)
    relabelled = [case.model_copy(update={"axes": {"lattice.depth": 0.01}}) for case in batch]
    write(path, relabelled, fold=True)
    assert changed_cases(path, KNOWN, KNOWN.get) == set()
    edited(path, b'"axes":{"lattice.depth":0.01}', b'"axes":{},"solver":{"mode":1}')
    assert changed_cases(path, KNOWN, KNOWN.get) == {batch[0].case_id}


def test_texts_written_otherwise_are_compared_by_their_ids(path):
    """An older Crumple wrote some numbers in another form."""
    batch = cases(3)
    write(path, batch, fold=True)
    edited(path, b'"imperfection":0.002', b'"imperfection":2e-03')
    edited(path, b'"imperfection":0.001', b'"imperfection":3e-03')
    assert changed_cases(path, KNOWN, KNOWN.get) == {batch[1].case_id}


def test_curves_of_many_cases_are_those_of_each(path, monkeypatch):
    monkeypatch.setattr("sweep.store.batch.CHUNK", 40)
    batch = cases(9)
    write(path, batch[:5], fold=True)
    write(path, batch[3:])
    ids, names = [case.case_id for case in batch[1:]], ["strain", "work_in_J"]
    curves = dict(read_curves(path, ids, names))
    assert curves.keys() == {*ids}
    for case_id in ids:
        history = read_history(path, case_id)
        for name in names:
            np.testing.assert_array_equal(curves[case_id][name], history[name])
    with pytest.raises(StoreError, match="holds no case ff"):
        list(read_curves(path, ["ff"], ["strain"]))
