"""Shared by the tests of the program."""

from pathlib import Path

import pytest


@pytest.fixture
def unpainted(monkeypatch):
    """Figures are put together, but not painted: for tests of which pictures there are."""
    saved = "matplotlib.figure.Figure.savefig"
    monkeypatch.setattr(saved, lambda _, path, **how: Path(path).touch())


@pytest.fixture
def own_record(tmp_path):
    """Write the text of a record; its path."""

    def write(text):
        path = tmp_path / "own.csv"
        path.write_text(text)
        return path

    return write


@pytest.fixture
def executions(tmp_path, monkeypatch):
    """The file with the id of every case that the stand-in `slow` has run, a line each."""
    path = tmp_path / "executions"
    monkeypatch.setenv("EXECUTIONS", str(path))
    path.touch()
    return path
