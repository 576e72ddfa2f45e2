"""The verb `verify`: it names unreadable parts, and numbers that cannot be reproduced."""

import re

import h5py
import pytest

from sweep.store.read import read_summary
from tests.support.command import crumple
from tests.support.results.standin import blank, cases, write


def test_a_whole_file_whose_numbers_are_made_up(capsys, tmp_path):
    write(tmp_path / "trial.h5", cases(5), fold=True)
    file = str(tmp_path / "trial.h5")
    assert crumple(capsys, "verify", file, "--again", "0")[:2] == (
        0, f"{file}: 5 of 5 cases intact\n0 of 0 cases simulated again: identical\n"
    )  # fmt: skip
    status, said, _ = crumple(capsys, "verify", file, "--again", "2")
    one, other, last = said.splitlines()[1:]
    known = {*read_summary(file)["case_id"]}
    for line in (one, other):
        assert re.match(r"case (\w{16}): \w+ is .*, stored .*model version \d", line)[1] in known
    assert (status, last) == (1, "0 of 2 cases simulated again: identical")


def test_what_cannot_be_read_is_named_and_nothing_is_simulated(capsys, tmp_path):
    write(tmp_path / "trial.h5", cases(3), fold=True)
    path = tmp_path / "trial.h5"
    blank(path)
    status, said, _ = crumple(capsys, "verify", str(path))
    *lines, count, advice = said.splitlines()
    assert (status, len(lines), count) == (1, 3, f"{path}: 0 of 3 cases intact")
    assert "--renew" in advice
    ids = [re.match(r"case (\w{16}): .* is damaged", line)[1] for line in lines]
    assert sorted(ids) == sorted(case.case_id for case in cases(3))


CRUSH = """
name = "trial"
[lattice]
cells = 1
[loading]
strain = 0.1
[solver]
load_steps = 60
"""


def swapped(file):
    one, other = (file[f"histories/values/{name}"] for name in ("work_in_J", "strain"))
    one[:], other[:] = other[:], one[:]


def moved(file):
    file["points/values/position_m"][-1] += 1e-4


@pytest.mark.parametrize(("change", "named"), [(swapped, "strain"), (moved, "position_m")])
def test_curves_and_shapes_that_a_tool_has_changed_are_named(
    capsys, tmp_path, monkeypatch, change, named
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "trial.toml").write_text(CRUSH)
    assert crumple(capsys, "run", "trial.toml", "--out", "trial.h5")[0] == 0
    assert crumple(capsys, "verify", "trial.h5")[0] == 0
    with h5py.File("trial.h5", "r+") as file:
        change(file)
    status, said, _ = crumple(capsys, "verify", "trial.h5")
    assert status == 1
    assert f"the stored {named} is not what comes out" in said


def test_numbers_that_are_infinite_are_compared_too(capsys, tmp_path):
    """The error of two load steps is not known, and stored as infinite."""
    config, file = tmp_path / "trial.toml", tmp_path / "trial.h5"
    config.write_text(CRUSH.replace("load_steps = 60", "load_steps = 2"))
    assert crumple(capsys, "run", str(config), "--out", str(file))[0] == 0
    assert read_summary(file)["load_step_error"].tolist() == [float("inf")]
    assert crumple(capsys, "verify", str(file))[0] == 0
