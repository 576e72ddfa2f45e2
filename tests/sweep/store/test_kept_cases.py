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


def every_kind():
    """Cases of very different texts, some of which failed before they had curves."""
    return [
        load_config("custom").cases[0],
        Case.of(lattice=dict(slicer="orca", pattern="grid", mass=5e-3, width=25e-3)),
        Case.of(lattice=dict(boundary="periodic"), loading=dict(strain=0.3)),
        Case.of(loading=dict(direction="out_of_plane")),
        *cases(8),
    ]


def failed(batch):
    return [failed_result(case, Status.WORKER_DIED, "Lost.") for case in batch]


@pytest.mark.parametrize("folded", [False, True])
def test_cases_are_read_as_they_were(path, folded, monkeypatch):
    monkeypatch.setattr(parts, "MERGE_AT", 3)
    batch = every_kind()
    with Writer(path) as writer:
        for begin in range(0, len(batch), 5):
            writer.append(failed(batch[begin : begin + 5]))
        if folded:
            writer.fold()
    assert bool(parts_of(path)) is not folded
    for case in batch:
        found = read_case(path, case.case_id)
        assert (found, found.axes) == (case, case.axes)


def test_fold_after_fold_keeps_the_cases_of_all_runs(path):
    """Rows of the file are computed again, and others come between them."""
    write(path, cases(5), fold=True)
    write(path, cases(5, first=3))
    with Writer(path, {case.case_id: case.axes for case in reversed(cases(10))}) as writer:
        writer.append(failed(cases(2, first=7)))
        writer.fold(failed(cases(2, first=8)))
    assert list(read_summary(path)["case_id"]) == [c.case_id for c in reversed(cases(10))]
    for case in cases(10):
        assert read_case(path, case.case_id) == case


def test_texts_of_neighbours_cost_few_bytes(path):
    write(path, cases(300), fold=True, size=300)
    with h5py.File(path) as file:
        data = file["cases/values/json"]
        assert data.shape[0] == sum(len(case.to_json()) for case in cases(300))
        assert data.id.get_storage_size() < 150 * 300


def test_only_who_asks_for_a_case_reads_it(path):
    write(path, cases(5), fold=True)
    blank(path)
    ids = list(read_summary(path)["case_id"])
    assert len(list(read_runs(path, ids))) == 5
    with pytest.raises(StoreError, match="is damaged"):
        read_case(path, ids[0])


def test_text_that_is_no_case_is_refused_by_name(path):
    write_made_up(path, summary({"case_id": "ab"}))
    with pytest.raises(
        StoreError, match=r"armor.h5 holds no usable case ab: lattice: Field required"
    ):
        read_case(path, "ab")
    with pytest.raises(StoreError, match="holds no case zz"):
        read_case(path, "zz")


def test_forged_stretches_beyond_their_arrays_are_damage(path):
    write(path, cases(5), fold=True)
    forge(path, "histories/rows", lambda rows: rows.write_direct(np.full(5, 1 << 40)))
    with pytest.raises(StoreError, match="is damaged"):
        read_summary(path)


def test_case_of_another_id_is_refused(path):
    with Writer(path) as writer:
        writer.append(failed(cases(1)))
        writer.fold()
    other = np.array(["0123456789abcdef"], dtype=object)
    forge(path, "summary/case_id", lambda ids: ids.__setitem__(slice(None), other))
    with pytest.raises(StoreError, match=f"0123456789abcdef: it is case {cases(1)[0].case_id}"):
        read_case(path, "0123456789abcdef")


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


def edited(path, old, new, name="cases/values/json"):
    """Change a text in the stored cases, as a tool for HDF5 can."""
    with h5py.File(path, "r+") as file:
        text = file[name][:].tobytes()
        assert len(old) == len(new)
        assert old in text
        file[name][:] = np.frombuffer(text.replace(old, new, 1), np.uint8)


@pytest.mark.parametrize("fold", [False, True])
def test_a_row_that_holds_another_case_is_found(path, fold):
    batch = cases(5)
    write(path, batch, fold, size=5)
    known = {case.case_id: case for case in cases(7)}
    assert changed_cases(path, known, known.get) == set()
    (sealed,) = [path] if fold else parts_of(path)
    edited(sealed, b'"imperfection":0.003', b'"imperfection":0.009')
    assert changed_cases(path, known, known.get) == {batch[3].case_id}
    assert changed_cases(path, {batch[1].case_id}, known.get) == set()


def test_labels_of_another_sweep_are_no_other_case_but_what_follows_them_is(path):
    batch = cases(3)
    relabelled = [case.model_copy(update={"axes": {"lattice.depth": 0.01}}) for case in batch]
    write(path, relabelled, fold=True)
    known = {case.case_id: case for case in batch}
    assert changed_cases(path, known, known.get) == set()
    edited(path, b'"axes":{"lattice.depth":0.01}', b'"axes":{},"solver":{"mode":1}')
    assert changed_cases(path, known, known.get) == {batch[0].case_id}


def test_texts_written_otherwise_are_compared_by_their_ids(path):
    """An older Crumple wrote some numbers in another form."""
    batch = cases(3)
    write(path, batch, fold=True)
    edited(path, b'"imperfection":0.002', b'"imperfection":2e-03')
    edited(path, b'"imperfection":0.001', b'"imperfection":3e-03')
    known = {case.case_id: case for case in batch}
    assert changed_cases(path, known, known.get) == {batch[1].case_id}


def test_no_file_has_no_changed_case(path):
    known = {case.case_id: case for case in cases(2)}
    assert changed_cases(path, known, known.get) == set()


def test_curves_of_many_cases_are_those_of_each(path, monkeypatch):
    monkeypatch.setattr("sweep.store.batch.CHUNK", 40)
    batch = cases(9)
    write(path, batch[:5], fold=True)
    write(path, batch[3:])
    ids = [case.case_id for case in batch[1:]]
    read = dict(read_curves(path, ids, ["strain", "work_in_J"]))
    assert read.keys() == {*ids}
    for case_id in ids:
        history = read_history(path, case_id)
        for name in ("strain", "work_in_J"):
            np.testing.assert_array_equal(read[case_id][name], history[name])
    with pytest.raises(StoreError, match="holds no case ff"):
        list(read_curves(path, ["ff"], ["strain"]))
