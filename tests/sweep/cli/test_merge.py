"""The verbs `run --part` and `merge`: a sweep as a job array."""

import pandas as pd
import pytest

from sweep.store.read import read_case, read_history, read_summary
from tests.support.command import crumple

TOML = """
name = "array"
[lattice]
cells = 1
[loading]
strain = 0.1
[solver]
load_steps = 5
[grid]
"lattice.imperfection" = [0.01, 0.02, 0.03, 0.04, 0.05]
[rank]
budgets = ["50 g"]
"""


@pytest.fixture
def array(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "array.toml").write_text(TOML)
    return tmp_path


def test_merged_parts_are_the_sweep(array, capsys):
    for part in ("1/2", "2/2"):
        status, _, err = crumple(capsys, "run", "array.toml", "--part", part)
        assert status == 0, err
        assert "crumple merge OUT.h5" in err
    parts = ["results/array.1-of-2.h5", "results/array.2-of-2.h5"]
    assert [len(read_summary(part)) for part in parts] == [3, 2]
    status, said, err = crumple(capsys, "merge", "all.h5", *parts)
    assert (status, said) == (0, "all.h5: 5 cases\n")
    assert "configs" not in err
    assert crumple(capsys, "run", "array.toml", "--out", "whole.h5")[0] == 0
    status, _, err = crumple(capsys, "run", "array.toml", "--out", "all.h5")  # order and labels
    assert status == 0, err
    one, other = (read_summary(file).drop(columns="cpu_s") for file in ("all.h5", "whole.h5"))
    pd.testing.assert_frame_equal(one, other)
    for case_id in one["case_id"]:
        assert read_case("all.h5", case_id) == read_case("whole.h5", case_id)
        pd.testing.assert_frame_equal(
            read_history("all.h5", case_id), read_history("whole.h5", case_id)
        )
    assert sum(read_summary(part)["cpu_s"].sum() for part in parts) == pytest.approx(
        read_summary("all.h5")["cpu_s"].sum()
    )


def part(capsys, number, out):
    assert crumple(capsys, "run", "array.toml", "--part", number, "--out", out)[0] == 0


def test_a_file_that_is_there_gets_more_rows(array, capsys):
    part(capsys, "1/2", "one.h5")
    part(capsys, "2/2", "two.h5")
    for _ in range(2):
        assert crumple(capsys, "merge", "one.h5", "two.h5")[:2] == (0, "one.h5: 5 cases\n")
    assert crumple(capsys, "verify", "one.h5", "--again", "1")[0] == 0
    assert len(read_summary("two.h5")) == 2


def test_a_merged_file_knows_which_parts_it_has(array, capsys):
    for number in ("1", "2", "3"):
        part(capsys, f"{number}/3", f"{number}.h5")
    every = ["rank"], ["export", "1", "--to", "part.stl"], ["report"]
    for parts, told, said, shown in (
        (["3.h5", "1.h5"], "have 1/3, 3/3 of a sweep of 3", "has parts 1/3, 3/3 of a sweep", every),
        (["2.h5"], "", "", every[:1]),
    ):
        _, _, err = crumple(capsys, "merge", "few.h5", *parts)
        assert (told in err, "of a sweep of 3" in err) == (True, bool(told))
        for verb, *rest in shown:
            status, *output = crumple(capsys, verb, "few.h5", *rest)
            assert status == 0
            assert (said in "".join(output), "of a sweep" in "".join(output)) == (True, bool(said))


def test_what_cannot_be_run_in_parts_or_merged_is_refused(array, capsys):
    part(capsys, "1/5", "one.h5")
    run = ["run", "array.toml"]
    for words, why in (
        *(([*run, f"--part={number}"], "such as 2/8") for number in ("0/2", "3/2", "1", "a/b")),
        *(([*run, f"--part={number}"], "such as 2/8") for number in ("1/0", "-1/2")),
        ([*run, "--part", "6/6"], "has only 5 cases"),
        ([*run, "--part", "1/2", "--error-bars"], "--error-bars is of a whole"),
        (["merge", "all.h5", "none.h5"], "none.h5 does not exist"),
        (["merge", "one.h5", "one.h5"], "cannot be one of the files"),
    ):
        status, _, err = crumple(capsys, *words)
        assert (status, why in err) == (2, True), err
    assert not (array / "all.h5").exists()


def test_files_of_different_configs_are_told(array, capsys):
    part(capsys, "1/5", "one.h5")
    (array / "array.toml").write_text(TOML.replace("0.1\n", "0.05\n", 1))
    part(capsys, "1/5", "two.h5")
    status, said, err = crumple(capsys, "merge", "all.h5", "one.h5", "two.h5")
    assert (status, said) == (0, "all.h5: 2 cases\n")
    assert "of 2 configs; all.h5 keeps the config of one.h5" in err
