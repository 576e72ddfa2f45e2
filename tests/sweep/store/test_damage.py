"""A results file or a part that is not what it was: one line that names it and says what to do."""

import h5py
import pytest

from sweep.store.read import (
    StoreError,
    damaged_ids,
    finished_ids,
    read_attributes,
    read_frames,
    read_history,
    read_summary,
)
from tests.support.results.standin import cases, parts_of, write


@pytest.fixture
def path(tmp_path):
    return tmp_path / "results" / "armor.h5"


@pytest.mark.parametrize("content", [b"", b"not HDF5", None])
def test_file_of_something_else_is_refused_in_one_line(path, content):
    path.parent.mkdir()
    if content is None:
        h5py.File(path, "w").close()
    else:
        path.write_bytes(content)
    with pytest.raises(StoreError, match="not a results file") as refusal:
        read_summary(path)
    assert "\n" not in str(refusal.value)
    with pytest.raises(StoreError, match="not a results file"):
        write(path, cases(1))
    path.unlink()
    write(path, cases(1))
    assert len(read_summary(path)) == 1


READS = {
    "summary": lambda path: read_summary(path),
    "ids": lambda path: finished_ids(path),
    "attributes": lambda path: read_attributes(path),
    "history": lambda path: read_history(path, cases(1)[0].case_id),
    "frames": lambda path: read_frames(path, cases(1)[0].case_id),
    "fold": lambda path: write(path, [], fold=True),
}


@pytest.mark.parametrize("read", READS)
@pytest.mark.parametrize("fold", [False, True])
@pytest.mark.parametrize("left", [0.2, 0.6, 0.99])
def test_truncated_file_is_named_with_advice(path, read, fold, left):
    write(path, cases(5), fold)
    sealed = path if fold else parts_of(path)[1]
    sealed.write_bytes(sealed.read_bytes()[: int(left * sealed.stat().st_size)])
    with pytest.raises(StoreError, match="is damaged: move it away") as refusal:
        READS[read](path)
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
    with h5py.File(part) as file:
        piece = file[damaged].id.get_chunk_info(0)
    content = bytearray(part.read_bytes())
    content[piece.byte_offset : piece.byte_offset + piece.size] = bytes(piece.size)
    part.write_bytes(content)
    assert len(read_summary(path)) == 5
    for read in reads:
        with pytest.raises(StoreError, match=f"{part.name} .* is damaged"):
            READS[read](path)
    part.unlink()
    assert len(finished_ids(path)) == 3


def test_file_that_the_system_does_not_let_us_read_is_not_called_damaged(path):
    path.mkdir(parents=True)
    with pytest.raises(StoreError, match=r"armor\.h5 cannot be read: Is a directory"):
        read_summary(path)


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


@pytest.mark.parametrize("name", ["summary/mass_g", "summary/loaded", "points/start", "cases/rows"])
@pytest.mark.parametrize("fold", [False, True])
@pytest.mark.parametrize("bit", [0, 62])
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


def test_a_flipped_attribute_is_damage(path):
    write(path, cases(2), fold=True)
    with h5py.File(path, "r+") as file:
        file.attrs["folded"] = 7
    with pytest.raises(StoreError, match="is damaged: move it away"):
        finished_ids(path)
