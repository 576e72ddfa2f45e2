"""Shared by the tests of configs."""

import pytest

from sweep.config.faults import ConfigError
from sweep.config.load import load_config


@pytest.fixture
def load(tmp_path):
    """The config of a text."""

    def loaded(text):
        path = tmp_path / "sweep.toml"
        path.write_text(text)
        return load_config(path)

    return loaded


@pytest.fixture
def lines(load):
    """The lines of the error that a config answers with."""

    def refused(text):
        with pytest.raises(ConfigError) as caught:
            load(text)
        return str(caught.value).splitlines()

    return refused
