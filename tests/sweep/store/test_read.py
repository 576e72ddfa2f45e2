"""The results file: sealed results are read back, whatever happens to the writer."""

import subprocess
import sys
import threading
from contextlib import ExitStack
from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import pytest

from sweep.columns import COLUMNS, HISTORY_COLUMNS
from sweep.result import Status, failed_result
from sweep.store import parts
from sweep.store.read import (
    Rerun,
    StoreError,
    finished_ids,
    open_sealed,
    read_attributes,
    read_case,
    read_frames,
    read_history,
    read_runs,
    read_summary,
)
from sweep.store.write import Writer
from tests.support.results.standin import cases, frames, parts_of, simulate, write

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize("fold", [False, True])
def test_what_was_written_is_read_back(path, fold):
    batch = cases(9)
    ids = [case.case_id for case in batch]
    write(path, batch, fold)
    table = read_summary(path)
    assert list(table["case_id"]) == ids
    assert list(table["steps"]) == [10 + number for number in range(9)]
    assert table["lattice.imperfection"].tolist() == pytest.approx(np.arange(9) * 1e-3)
    assert list(table.columns[:4]) == ["case_id", "status", "message", "lattice.imperfection"]
    assert set(COLUMNS) < set(table.columns)
    assert table["status"].tolist() == ["converged"] * 7 + ["stopped", "converged"]
    assert "time_step" in table["message"][7]
    assert bool(parts_of(path)) is not fold
    assert len([*path.parent.iterdir()]) == 1 or not fold
    for number in (8, 0, 5):
        history = read_history(path, ids[number])
        assert list(history.columns) == list(HISTORY_COLUMNS)
        strains = number + np.linspace(0, 1, 10 + number)
        assert history["strain"].to_numpy() == pytest.approx(strains)
        assert_same_arrays(read_frames(path, ids[number]), frames(number), rtol=1e-6)
    many = list(read_runs(path, [ids[k] for k in (8, 0, 5)]))
    assert [case.case_id for case in many] == [ids[k] for k in (8, 0, 5)]
    for case in many:
        pd.testing.assert_frame_equal(case.history, read_history(path, case.case_id))
        assert_same_arrays(case.frames, read_frames(path, case.case_id))


def assert_same_arrays(one, other, rtol=0.0):
    assert one.keys() == other.keys()
    for name, array in one.items():
        np.testing.assert_allclose(array, other[name], rtol=rtol)


def test_results_of_a_writer_that_never_folded_are_folded_by_the_next(path):
    """Between them cases are computed again, others are new; the last come without a part."""
    write(path, cases(5), fold=True)
    write(path, cases(5, first=3))
    with Writer(path, {case.case_id: case.axes for case in reversed(cases(10))}) as writer:
        writer.append(lost(cases(2, first=7)))
        writer.fold(lost(cases(2, first=8)))
    table = read_summary(path)
    assert list(table["case_id"]) == [case.case_id for case in reversed(cases(10))]
    assert table["status"].tolist() == ["worker_died"] * 3 + ["converged"] * 7
    for number, case in enumerate(cases(10)):
        assert len(read_history(path, case.case_id)) == (10 + number if number < 7 else 0)
        assert read_case(path, case.case_id) == case


def lost(batch):
    return [failed_result(case, Status.WORKER_DIED, "Lost.") for case in batch]


def test_many_parts_are_merged_on_the_way(path, monkeypatch):
    monkeypatch.setattr(parts, "MERGE_AT", 3)
    write(path, cases(14), size=1)
    names = [part.name for part in parts_of(path)]
    assert [name.lstrip("0")[:-3].split("-0")[0] for name in names] == ["1", "10", "13", "14"]
    assert set(read_summary(path)["case_id"]) == {case.case_id for case in cases(14)}


def test_parts_that_killed_runs_have_left_become_one_in_their_order(path, monkeypatch):
    monkeypatch.setattr(parts, "MERGE_AT", 3)
    for first in (0, 2, 4):
        with Writer(path) as writer:
            for case in cases(2, first):
                writer.append([simulate(case)])
    names = [part.name[7:-3] for part in parts_of(path)]
    assert names == ["1-00000004", "5-00000005", "6-00000006"]
    assert list(read_summary(path)["case_id"]) == [case.case_id for case in cases(6)]


def test_covered_parts_and_truncated_temporaries_are_ignored_and_cleared(path):
    write(path, cases(4), size=1)
    first, second, *_ = parts_of(path)
    first.with_name("00000001-00000002.h5").write_bytes(second.read_bytes())
    first.with_name("00000005-00000005.h5.tmp").write_bytes(first.read_bytes()[:1000])
    path.with_name("armor.h5.tmp").write_bytes(b"garbage")
    assert len(read_summary(path)) == 3
    write(path, [])
    assert len(parts_of(path)) == 3
    assert not path.with_name("armor.h5.tmp").exists()


def test_kill_between_fold_and_deletion_keeps_each_case_once(path):
    write(path, cases(4))
    saved = {part: part.read_bytes() for part in parts_of(path)}
    write(path, cases(4), fold=True)
    path.with_suffix(".parts").mkdir()
    for part, content in saved.items():
        part.write_bytes(content)
    assert len(read_summary(path)) == 4
    write(path, cases(1, first=4))
    assert (len(read_summary(path)), len(parts_of(path))) == (5, 1)


def statuses(path, batch):
    table = read_summary(path).set_index("case_id")
    return table.loc[[case.case_id for case in batch], "status"].tolist()


def test_newest_row_of_a_case_wins(path):
    batch = cases(4)
    with Writer(path) as writer:
        writer.append(lost(batch[:3]))
        writer.append([simulate(batch[0])])
        writer.fold()
        writer.append([simulate(batch[1]), simulate(batch[3])])
        assert statuses(path, batch) == ["converged", "converged", "worker_died", "converged"]
        writer.fold(lost(batch[3:]))
    assert statuses(path, batch) == ["converged", "converged", "worker_died", "worker_died"]
    assert [len(read_history(path, case.case_id)) for case in batch] == [10, 11, 0, 0]
    assert list(read_history(path, batch[2].case_id).columns) == list(HISTORY_COLUMNS)
    assert read_frames(path, batch[2].case_id) == {}
    with Writer(path) as writer:
        writer.append(lost(batch[:1]))
        (case,) = read_runs(path, [batch[0].case_id])
    assert (len(case.history), case.frames) == (0, {})


def test_failed_cases_are_finished_unless_they_are_to_be_tried_again(path):
    batch = cases(9)
    assert finished_ids(path) == set()
    write(path, batch)
    assert finished_ids(path) == {case.case_id for case in batch}
    assert finished_ids(path, Rerun(failed=True)) == finished_ids(path) - {batch[7].case_id}


def test_another_grid_into_the_same_file(path):
    """Old labels stand, shared cases get the new ones too, rows of the newest sweep come first."""
    old, new = cases(3), cases(3, first=2)
    write(path, old, fold=True)
    axes = {case.case_id: {"lattice.kind": "square"} for case in new}
    with Writer(path, axes) as writer:
        writer.append([simulate(case) for case in new[1:]])
        writer.fold()
    table = read_summary(path)
    assert list(table["case_id"]) == [case.case_id for case in (*new, *old[:2])]
    assert list(table["lattice.kind"]) == ["square"] * 3 + [""] * 2
    assert table["lattice.imperfection"].isna().tolist() == [False, True, True, False, False]


def test_fold_without_news_leaves_the_file_alone(path):
    write(path, cases(3), fold=True)
    before = path.stat().st_ino
    write(path, [], fold=True)
    assert path.stat().st_ino == before


def test_another_tool_reads_the_table_in_one_line(path):
    write(path, cases(9), fold=True)
    with h5py.File(path) as f:
        summary = {
            k: v.asstr()[:] if v.dtype.kind == "S" else v[:] for k, v in f["summary"].items()
        }
    table = read_summary(path)
    pd.testing.assert_frame_equal(pd.DataFrame(summary), table)
    few = read_summary(path, {"mass_g", "status", "unknown"}.__contains__)
    pd.testing.assert_frame_equal(few, table[["status", "mass_g"]])


def test_every_column_says_what_it_is(path):
    write(path, cases(2), fold=True)
    with h5py.File(path) as file:
        for column in [*file["summary"].values(), *file["histories/values"].values()]:
            assert column.attrs["description"]
            assert "units" in column.attrs
        for name, units in {"absorbed_energy_at_50N_J": b"J", "peak_force_N": b"N"}.items():
            assert file["summary"][name].attrs["units"] == units


def test_attributes_are_those_of_the_last_run(path):
    long = "x" * 200_000
    write(path, cases(2), fold=True, config="first")
    write(path, cases(1, first=2), config=long)
    assert read_attributes(path)["config"] == long
    write(path, cases(3), fold=True, config="third")
    assert read_attributes(path)["config"] == "third"


def test_missing_file_and_missing_case(path):
    with pytest.raises(StoreError, match=r"armor\.h5 does not exist"):
        read_summary(path)
    write(path, cases(1))
    for read in (read_history, read_case, lambda path, name: list(read_runs(path, [name]))):
        with pytest.raises(StoreError, match="no case 0123"):
            read(path, "0123")


def test_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(StoreError, match="cannot be written"):
        write(tmp_path / "file" / "armor.h5", cases(1))


@pytest.mark.parametrize("name", [".", "..", "/", "armor", "armor.v2", ".h5"])
def test_names_that_could_share_their_parts_are_refused(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(StoreError, match="names that end in"):
        write(name, cases(1))
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(StoreError):
        read_summary(name)


def test_one_writer_at_a_time(path):
    with Writer(path) as writer:
        writer.append([simulate(cases(1)[0])])
        with pytest.raises(StoreError, match="Another run is writing"), Writer(path):
            pass
        script = f"from sweep.store.write import Writer; Writer({str(path)!r}).__enter__()"
        other = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True)
    assert b"Another run is writing" in other.stderr
    with Writer(path):
        assert len(read_summary(path)) == 1


def test_readers_never_meet_a_half_written_file(path, monkeypatch):
    monkeypatch.setattr(parts, "MERGE_AT", 3)
    batch, counts, done = cases(13), [], threading.Event()
    write(path, batch[:1])

    def read():
        while not done.is_set():
            counts.append(len(read_summary(path)))

    reader = threading.Thread(target=read)
    reader.start()
    for begin in range(1, len(batch), 6):
        write(path, batch[begin : begin + 6], fold=begin % 2 == 0)
    done.set()
    reader.join()
    assert len(counts) > 3
    assert counts == sorted(counts)
    assert len(read_summary(path)) == 13


def test_a_link_is_another_name_of_a_results_file(tmp_path):
    """It stays one, and both names have one lock and one folder of parts."""
    path, link = tmp_path / "armor.h5", tmp_path / "elsewhere" / "link.h5"
    link.parent.mkdir()
    link.symlink_to(path)
    write(link, cases(2))
    assert parts_of(path)
    assert finished_ids(link) == finished_ids(path) == {case.case_id for case in cases(2)}
    with Writer(path), pytest.raises(StoreError, match="Another run"), Writer(link):
        pass
    write(link, cases(3), fold=True)
    assert link.is_symlink()
    assert len(read_summary(path)) == len(read_summary(link)) == 3
    assert [*link.parent.iterdir()] == [link]


def test_a_file_that_is_read_keeps_few_chunks_in_memory(path, monkeypatch):
    """A merge has 64 parts open, of 30 arrays each: by default HDF5 would keep 1 MB of each."""
    write(path, cases(3), fold=True)
    opened, real = [], h5py.File

    def spied(*words, **how):
        opened.append(real(*words, **how))
        return opened[-1]

    monkeypatch.setattr(h5py, "File", spied)
    with ExitStack() as stack:
        open_sealed(path, stack)
        (file,) = opened
        assert file.id.get_access_plist().get_cache()[2] <= 1 << 16
