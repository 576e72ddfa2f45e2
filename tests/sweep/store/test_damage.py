"""A results file or a part that is not what it was: one line that names it and says what to do."""

import h5py
import pytest

from sweep.store.read import (
    StoreError,
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


def test_stretches_beyond_their_arrays_are_damage(path):
    write(path, cases(5), fold=True)
    with h5py.File(path, "r+") as file:
        file["histories/rows"][2] = 1 << 40
    with pytest.raises(StoreError, match="is damaged"):
        read_history(path, cases(1)[0].case_id)


def test_file_that_the_system_does_not_let_us_read_is_not_called_damaged(path):
    path.mkdir(parents=True)
    with pytest.raises(StoreError, match=r"armor\.h5 cannot be read: Is a directory"):
        read_summary(path)
