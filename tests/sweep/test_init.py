"""What users import: the errors are those that the functions raise."""

import pytest

import crumple
from tests.support.results.specimens import summary


def test_errors_are_those_that_the_functions_raise(tmp_path):
    with pytest.raises(crumple.ConfigError, match=r"none\.toml: cannot be read"):
        crumple.load_config(tmp_path / "none.toml")
    with pytest.raises(crumple.StoreError, match=r"none\.h5 does not exist"):
        crumple.read_summary(tmp_path / "none.h5")
    with pytest.raises(crumple.RankError, match='cannot sort by "colour"'):
        crumple.rank(summary({}), by="colour")
