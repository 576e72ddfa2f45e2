"""A damaged results file or part: one line that names it and says what to do."""

import os
import subprocess
import sys

import h5py
import numpy as np
import pandas as pd
import pytest

from sweep.store.read import (
    Rerun,
    StoreError,
    damaged_ids,
    finished_ids,
    read_attributes,
    read_frames,
    read_history,
    read_summary,
    unreadable,
)
from tests.support.command import crumple
from tests.support.results.standin import NODES, blank, cases, forge, parts_of, write


@pytest.mark.parametrize("content", [b"not HDF5", None])
def test_file_of_something_else_is_refused_in_one_line(path, content):
    path.parent.mkdir()
    if content is None:
        h5py.File(path, "w").close()
    else:
        path.write_bytes(content)
    for use in (read_summary, lambda path: write(path, cases(1))):
        with pytest.raises(StoreError, match="not a results file") as refusal:
            use(path)
        assert "\n" not in str(refusal.value)
    assert content is None or path.read_bytes() == content


@pytest.mark.parametrize("content", [b"", bytes(4096)])
@pytest.mark.parametrize("fold", [False, True])
def test_what_a_full_disk_leaves_is_damaged(path, fold, content):
    write(path, cases(5), fold)
    sealed = path if fold else parts_of(path)[1]
    sealed.write_bytes(content)
    with pytest.raises(StoreError, match="is damaged: move it away"):
        read_summary(path)


READS = {
    "summary": read_summary,
    "ids": finished_ids,
    "attributes": read_attributes,
    "history": lambda path: read_history(path, cases(1)[0].case_id),
    "frames": lambda path: read_frames(path, cases(1)[0].case_id),
    "fold": lambda path: write(path, [], fold=True),
}


@pytest.mark.parametrize("fold", [False, True])
@pytest.mark.parametrize("left", [0.2, 0.6, 0.99])
def test_truncated_file_is_named_with_advice(path, fold, left):
    write(path, cases(5), fold)
    sealed = path if fold else parts_of(path)[1]
    sealed.write_bytes(sealed.read_bytes()[: int(left * sealed.stat().st_size)])
    for read in READS.values():
        with pytest.raises(StoreError, match="is damaged: move it away") as refusal:
            read(path)
        assert str(refusal.value).startswith(str(sealed))
        assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("damaged", "reads"),
    [
        ("histories/values/strain", ["history", "fold"]),
        ("points/values/position_m", ["frames", "fold"]),
    ],
)
def test_damage_that_shows_only_on_reading_is_named_too(path, damaged, reads):
    write(path, cases(5))
    part = parts_of(path)[0]
    blank(part, damaged)
    assert len(read_summary(path)) == 5
    for read in reads:
        with pytest.raises(StoreError, match=f"{part.name}.* is damaged"):
            READS[read](path)
    part.unlink()
    assert len(finished_ids(path)) == 3


def test_file_that_the_system_does_not_let_us_read_is_not_called_damaged(path):
    path.mkdir(parents=True)
    with pytest.raises(StoreError, match=r"armor\.h5 cannot be read: Is a directory"):
        read_summary(path)
    os.mkfifo(path.with_name("pipe.h5"))
    with pytest.raises(StoreError, match="no regular file"):
        read_summary(path.with_name("pipe.h5"))


HOLDER = """
import h5py, sys
with h5py.File(sys.argv[1], "r+", libver="latest"):
    print("open", flush=True)
    sys.stdin.read()
"""


def test_a_file_that_another_program_has_open_is_not_called_damaged(path):
    write(path, cases(2), fold=True)
    words, pipe = [sys.executable, "-c", HOLDER, str(path)], subprocess.PIPE
    with subprocess.Popen(words, stdin=pipe, stdout=pipe) as holder:
        assert holder.stdout.readline() == b"open\n"
        with pytest.raises(StoreError, match="open for writing in another program") as refusal:
            read_summary(path)
        holder.stdin.close()
    assert "damaged" not in str(refusal.value)
    assert len(read_summary(path)) == 2


def flipped(path, at, bit):
    """The file with one bit of its byte `at` flipped."""
    content = bytearray(path.read_bytes())
    content[at] ^= 1 << bit
    path.write_bytes(content)


def place(path, name, row):
    """Offset in the file of a value of a column of numbers."""
    with h5py.File(path) as file:
        data = file[name]
        return data.id.get_offset() + data.dtype.itemsize * row


@pytest.mark.parametrize(
    ("name", "bit"),
    [("summary/mass_g", 0), ("summary/loaded", 62), ("points/start", 0), ("cases/rows", 62)],
)
@pytest.mark.parametrize("fold", [False, True])
def test_a_flipped_bit_is_found_and_its_case_alone_runs_again(path, name, fold, bit):
    write(path, cases(5), fold)
    sealed, row = (path, 3) if fold else (parts_of(path)[1], 1)
    flipped(sealed, place(sealed, name, row) + bit // 8, bit % 8)
    (lost,) = damaged_ids(path)
    assert lost == cases(5)[3].case_id
    with pytest.raises(StoreError, match=f"damaged rows of cases {lost}; `crumple run`"):
        read_summary(path)
    with pytest.raises(StoreError, match=f"no case {lost}"):
        read_history(path, lost)
    assert finished_ids(path) == {case.case_id for case in cases(5)} - {lost}
    write(path, [cases(5)[3]], fold=True)
    assert (len(read_summary(path)), damaged_ids(path)) == (5, [])


def test_a_case_whose_curves_are_damaged_runs_again_where_asked(path):
    """Reading its summary alone does not show it."""
    write(path, cases(5), fold=True)
    blank(path, "histories/values/strain")
    assert len(finished_ids(path)) == 5
    assert finished_ids(path, Rerun(damaged=True)) == set()
    write(path, cases(5), fold=True)
    assert unreadable(path) == {}


@pytest.mark.parametrize("fold", [False, True])
def test_no_text_lies_in_a_heap(path, fold):
    """A damaged heap of HDF5 has no checksum, and can keep a reader for ever. The only one holds
    references to the scale of the rows, which other programs read.
    """
    write(path, cases(3), fold)
    (sealed,) = [path] if fold else parts_of(path)[:1]
    assert sealed.read_bytes().count(b"GCOL") == int(fold)
    in_heaps = set()

    def note(_, inner):
        stored = [(name, inner.attrs.get_id(name).dtype) for name in inner.attrs]
        stored += [("values", inner.dtype)] if isinstance(inner, h5py.Dataset) else []
        in_heaps.update(name for name, dtype in stored if dtype.kind == "O")

    with h5py.File(sealed) as file:
        file.visititems(note)
    assert in_heaps <= {"DIMENSION_LIST", "REFERENCE_LIST"}


def test_the_references_to_the_scale_are_not_read(path):
    """A heap without an end, which `h5dump` would read for ever too."""
    write(path, cases(2), fold=True)
    before = read_summary(path), read_history(path, cases(1)[0].case_id)
    flipped(path, path.read_bytes().find(b"GCOL") + 16, 0)
    pd.testing.assert_frame_equal(read_summary(path), before[0])
    pd.testing.assert_frame_equal(read_history(path, cases(1)[0].case_id), before[1])


@pytest.mark.parametrize("name", ["summary/message", "checksums", "histories/start", "attribute"])
def test_values_in_a_heap_are_refused_unread(path, name):
    write(path, cases(2), fold=True)
    with h5py.File(path, "r+") as file:
        if name == "attribute":
            file.attrs["config"] = "{}"
        else:
            del file[name]
            file.create_dataset(name, data=["a", "b"], dtype=h5py.string_dtype())
    assert path.read_bytes().count(b"GCOL") == 2
    flipped(path, path.read_bytes().rfind(b"GCOL") + 16, 0)  # and with it the heap has no end
    with pytest.raises(StoreError, match="is damaged: move it away"):
        read_summary(path)


CHANGES = {
    "attribute": lambda file, _: file.attrs.__setitem__("folded", 7),
    "no group": lambda file, _: file.__delitem__("edges"),
    "of another file": lambda _, other: h5py.ExternalLink(other, "/summary/mass_g"),
    "loop": lambda file, _: file["summary"],
    "one for all": lambda *_: [1.0],
}


@pytest.mark.parametrize("name", [*CHANGES, "virtual"])
def test_what_no_writer_makes_is_damage(path, name):
    write(path, cases(2), fold=True)
    other = path.with_name("other.h5")
    other.write_bytes(path.read_bytes())
    with h5py.File(path, "r+") as file:
        if name == "virtual":
            layout = h5py.VirtualLayout((2,), "f8")
            layout[:] = h5py.VirtualSource("other.h5", "summary/mass_g", (2,))
            del file["summary/mass_g"]
            file.create_virtual_dataset("summary/mass_g", layout)
        elif (column := CHANGES[name](file, "other.h5")) is not None:
            del file["summary/mass_g"]
            file["summary/mass_g"] = column
    with pytest.raises(StoreError, match="is damaged: move it away"):
        read_summary(path)


def test_forged_stretches_and_ids_are_damage(path):
    """With checksums that fit: the file comes from elsewhere."""
    write(path, cases(2), fold=True)
    forge(path, "summary/case_id", lambda ids: ids.__setitem__(0, b"../../a"))
    with pytest.raises(StoreError, match=r"damaged rows of cases \.\./\.\./a;"):
        read_summary(path)
    forge(path, "histories/rows", lambda rows: rows.write_direct(np.full(2, 1 << 40)))
    with pytest.raises(StoreError, match="is damaged"):
        read_summary(path)


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("/summary/mass_g", lambda rows: np.full(rows, b"a")),  # text for numbers
        ("/summary/message", np.ones),
        ("/histories/values/strain", lambda rows: np.full(rows, b"a")),
        ("/histories/values/strain", lambda rows: np.zeros((rows, 2))),
        ("/edges/values/edges", lambda rows: np.zeros((rows, 3), int)),
    ],
)
def test_arrays_of_another_kind_are_named(path, name, values, capsys):
    """With checksums that fit: the file comes from elsewhere."""
    write(path, cases(2), fold=True)
    with h5py.File(path, "r+") as file:
        other = values(len(file[name]))
        del file[name]
        file[name] = other
    with pytest.raises(StoreError, match=f"damaged: {name} has values of another kind, or rows"):
        read_summary(path)
    for words in (["show", str(path)], ["status", str(path)]):
        status, _, said = crumple(capsys, *words)
        assert (status, name in said) == (2, True)


@pytest.mark.parametrize(
    ("name", "value", "why"),
    [
        ("edges/values/edges", NODES, "elements of nodes that they do not have"),
        ("edges/values/edges", -1, "elements of nodes that they do not have"),
        ("points/rows", 7, "frames without all nodes"),
    ],
)
def test_shapes_that_do_not_fit_together_are_named(path, capsys, name, value, why):
    write(path, cases(2), fold=True)
    forge(path, name, lambda values: values.__setitem__(0, value))
    case_id = cases(2)[0].case_id
    with pytest.raises(StoreError, match=f"no usable shapes of case {case_id}: {why}"):
        read_frames(path, case_id)
    status, _, said = crumple(capsys, "show", str(path), case_id)
    assert (status, why in said) == (2, True)
    status, said, _ = crumple(capsys, "verify", str(path))
    assert (status, why in said) == (1, True)


@pytest.mark.parametrize("number", [0, 5, -1])
def test_rows_that_are_read_in_runs_are_named_as_if_read_one_by_one(path, monkeypatch, number):
    """A damaged chunk of shapes hits the cases that it holds, and no others of its run."""
    monkeypatch.setattr("sweep.store.hdf5.LARGE_CHUNK", 4 * NODES)
    batch = cases(20)
    write(path, batch, fold=True)
    monkeypatch.setattr("sweep.store.batch.CHUNK", 15 * NODES)
    assert unreadable(path) == {}
    with h5py.File(path) as file:
        chunks = file["points/values/position_m"].id
        chunk = chunks.get_chunk_info(range(chunks.get_num_chunks())[number])
    flipped(path, chunk.byte_offset + 20, 0)
    damaged = set()
    for case in batch:
        try:
            read_frames(path, case.case_id)
        except StoreError:
            damaged.add(case.case_id)
    assert 0 < len(damaged) < 5
    assert unreadable(path).keys() == damaged
