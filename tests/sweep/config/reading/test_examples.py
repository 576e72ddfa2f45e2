"""Examples are found by their names, files by their paths."""

from pathlib import Path

from sweep.config.load import load_config
from sweep.config.reading.examples import FOLDER, find_config


def test_example_is_found_away_from_its_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("custom", "accuracy/impact"):
        assert load_config(name).path == FOLDER / f"{name}.toml"


def test_file_comes_before_the_example_of_its_name_and_a_folder_does_not(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("smoke").mkdir()
    assert find_config("smoke") == FOLDER / "smoke.toml"
    Path("armor").touch()
    assert find_config("armor") == Path("armor")
    assert find_config("smoke.toml") == Path("smoke.toml")
