"""The names that users import: the errors are the ones that the functions raise."""

import pytest

import crumple
from sweep.ranking.rank import ranked
from sweep.result import failed_result
from tests.support.results.specimens import summary


def test_errors_are_those_that_the_functions_raise(tmp_path):
    with pytest.raises(crumple.ConfigError, match=r"none\.toml: cannot be read"):
        crumple.load_config(tmp_path / "none.toml")
    with pytest.raises(crumple.StoreError, match=r"none\.h5 does not exist"):
        crumple.read_summary(tmp_path / "none.h5")
    with pytest.raises(crumple.RankError, match='cannot sort by "colour"'):
        crumple.rank(summary({}), by="colour")


def test_what_a_session_shows_is_one_short_line():
    case, config = crumple.case(lattice={"kind": "hex"}), crumple.load_config("smoke")
    result = failed_result(case, crumple.Status.STOPPED, "no equilibrium")
    shown = [*map(repr, (case, config, result, ranked(summary({}))))]
    assert all(len(line) < 120 and "\n" not in line for line in shown)
    assert shown[0] == str(case) == f"<Case {case.case_id}: hex of ninjaflex, force>"
    assert "no equilibrium" in shown[2]
