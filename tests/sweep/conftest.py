"""Shared by the tests of the program."""

import pytest


@pytest.fixture
def own_record(tmp_path):
    """Write the text of a record; its path."""

    def write(text):
        path = tmp_path / "own.csv"
        path.write_text(text)
        return path

    return write
