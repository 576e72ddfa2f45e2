"""Files in the folder of the parts that do not belong to this sweep are refused, and stay."""

import errno
import os
import shutil
from stat import S_ISDIR

import pytest

from sweep.running.sweep import run_sweep
from sweep.store import parts
from sweep.store.read import StoreError, read_summary
from sweep.store.write import Writer
from tests.support.results.standin import cases, parts_of, simulate, write


def run(count, out):
    return run_sweep(cases(count), out, simulate=lambda case, stop: simulate(case))


@pytest.mark.parametrize(("finished", "name"), [(0, "bumper"), (3, "bumper"), (0, None)])
def test_a_part_of_another_sweep_is_refused_and_stays(tmp_path, finished, name):
    """It has another name, or none, and no case of the sweep."""
    out, part = tmp_path / "armor.h5", tmp_path / "armor.parts" / "00000009-00000009.h5"
    if finished:
        run(finished, out)
    about = {"config": f'{{"name": "{name}"}}'} if name else {}
    write(tmp_path / "other.h5", cases(2, first=50), **about)
    part.parent.mkdir(exist_ok=True)
    shutil.copy(parts_of(tmp_path / "other.h5")[0], part)
    with pytest.raises(StoreError) as refusal:
        run(5, out)
    whose = f"{part} is a part of another sweep{f', {name}' if name else ''}: move it away"
    assert str(refusal.value).startswith(whose)
    part.rename(tmp_path / "aside.h5")
    run(5, out)
    assert {*read_summary(out)["case_id"]} == {case.case_id for case in cases(5)}
    with Writer(out) as writer:
        writer.fold(files=[tmp_path / "aside.h5"])
    assert len(read_summary(out)) == 7


@pytest.mark.parametrize(("first", "name"), [(1, "bumper"), (50, "armor")])
def test_parts_of_a_grid_that_has_changed_are_its_own(tmp_path, first, name):
    """They share a case with it, or its name."""
    out = tmp_path / "armor.h5"
    write(out, cases(4, first), config=f'{{"name": "{name}"}}')
    run(3, out)
    ids = {case.case_id for case in cases(3) + cases(4, first)}
    assert {*read_summary(out)["case_id"]} == ids


@pytest.mark.parametrize("is_file", [False, True])
def test_a_link_in_place_of_parts_is_refused_and_not_followed(tmp_path, is_file):
    write(tmp_path / "other.h5", cases(2), size=2)
    (theirs,) = parts_of(tmp_path / "other.h5")
    (theirs.parent / "00000001-00000001.h5.tmp").touch()
    link = tmp_path / "armor.parts"
    if is_file:
        link.mkdir()
        link = link / theirs.name
        link.symlink_to(theirs)
    else:
        link.symlink_to(theirs.parent)
    for use in (read_summary, lambda out: run_sweep(cases(5), out)):
        with pytest.raises(StoreError) as refusal:
            use(tmp_path / "armor.h5")
        assert str(refusal.value).startswith(f"{link} is a link: remove it; allowed: ")
    assert len(parts_of(tmp_path / "other.h5")) == 2


@pytest.fixture
def reader(tmp_path, monkeypatch):
    """A reader of armor.h5, which Windows therefore refuses to replace while the list has items."""
    usual, moments = os.replace, []

    def refuse(source, target):
        if target == tmp_path / "armor.h5" and moments:
            moments.pop()
            raise PermissionError(errno.EACCES, "Permission denied")
        usual(source, target)

    monkeypatch.setattr(os, "replace", refuse)
    monkeypatch.setattr(parts, "MOMENT", 0.001)
    write(tmp_path / "armor.h5", cases(2), fold=True)
    return moments


def test_a_file_that_a_reader_has_open_is_replaced_a_moment_later(tmp_path, reader):
    reader += [None] * 3
    write(tmp_path / "armor.h5", cases(4), fold=True)
    assert len(read_summary(tmp_path / "armor.h5")) == 4
    assert reader == []


def test_of_a_reader_that_stays_the_next_run_takes_the_parts(tmp_path, reader, monkeypatch):
    reader += [None] * 10_000
    monkeypatch.setattr(parts, "LONGEST", 0.01)
    out = tmp_path / "armor.h5"
    with pytest.raises(StoreError, match=r"armor\.h5 cannot be written: Permission denied"):
        write(out, cases(4), fold=True)
    assert len(read_summary(out)) == 4
    assert not [*tmp_path.rglob("*.tmp")]
    reader.clear()
    write(out, cases(5), fold=True)
    assert len(read_summary(out)) == 5
    assert [path.name for path in tmp_path.iterdir()] == ["armor.h5"]


@pytest.mark.parametrize("number", [errno.EINVAL, errno.EIO])
def test_a_folder_is_written_to_the_disk_where_the_file_system_can(tmp_path, monkeypatch, number):
    usual = os.fsync

    def refuse(descriptor):
        if S_ISDIR(os.fstat(descriptor).st_mode):
            raise OSError(number, os.strerror(number))
        usual(descriptor)

    monkeypatch.setattr(os, "fsync", refuse)
    if number == errno.EIO:
        with pytest.raises(StoreError, match="Input/output error"):
            write(tmp_path / "armor.h5", cases(2), fold=True)
    else:
        write(tmp_path / "armor.h5", cases(2), fold=True)
        assert len(read_summary(tmp_path / "armor.h5")) == 2
