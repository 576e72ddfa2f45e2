"""Shared by the tests of configs."""

import re

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

    def answer(text):
        with pytest.raises(ConfigError) as caught:
            load(text)
        return str(caught.value).splitlines()

    return answer


@pytest.fixture
def refused(lines):
    """Return the one line of a refused config; it must contain a key, its value and other words."""

    def line_of(config, key, *words):
        (line,) = lines(config)
        assert line.startswith((f"{key}: ", f"{key} is missing; needed: "))
        assert [word for word in words if word not in line.removeprefix(key)] == []
        return line

    return line_of


@pytest.fixture
def last_refused(refused):
    """Return the one line of a config whose last line is refused; it must contain some words."""

    def line_of(config, *words):
        table = re.findall(r"^\[+(\w+)\]+$", config, re.MULTILINE)[-1]
        key = config.splitlines()[-1]
        prefix = {"grid": "[grid] ", "zip": "[[zip]] ", "exclude": "[[exclude]] "}
        return refused(config, prefix.get(table, f"{table}.") + key, *words)

    return line_of
