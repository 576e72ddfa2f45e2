"""The results file of the tests of the store."""

import pytest


@pytest.fixture
def path(tmp_path):
    """A results file that is not there yet, in a folder that is not either."""
    return tmp_path / "results" / "armor.h5"
