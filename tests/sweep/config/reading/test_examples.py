"""Examples are found by their names, files by their paths; all that ship are sweeps."""

from pathlib import Path

import pytest

from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.config.reading.examples import FOLDER, examples, find_config


def test_every_config_that_is_shipped_is_an_example():
    assert {FOLDER / f"{name}.toml" for name in examples()} == set(FOLDER.rglob("*.toml"))
    assert {"smoke", "custom", "accuracy/impact"} < set(examples())


@pytest.mark.parametrize("name", ["smoke", "accuracy/impact", "custom"])
def test_example_is_found_away_from_its_folder(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    assert load_config(name).path == FOLDER / f"{name}.toml"


def test_file_comes_before_the_example_of_its_name_and_a_folder_does_not(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("smoke").mkdir()
    assert find_config("smoke") == FOLDER / "smoke.toml"
    Path("armor").touch()
    assert find_config("armor") == Path("armor")
    assert find_config("smoke.toml") == Path("smoke.toml")


CONFIGS = Path(__file__).parents[4] / "configs"


@pytest.mark.parametrize(
    ("name", "cases"),
    [
        ("smoke", 6),
        ("armor", 140),
        ("infills", 13),
        ("panel", 23),
        ("rammed", 102),
        ("thousand", 1000),
        ("custom", 1),
        ("drawn", 4),
        ("seed", 14),
        ("impact", 24),
        ("drop", 8),
        ("slicer", 14),
        ("gyroid", 18),
        ("khatri_egan_square", 72),
        ("khatri_egan_square_out_of_plane", 9),
        ("khatri_egan_hexagon_out_of_plane", 5),
        ("which_way", 16),
        ("which_way_lost", 16),
    ],
)
def test_shipped_configs_expand(name, cases):
    config = load_config(CONFIGS / f"{name}.toml")
    assert config.name == name
    assert len({case.case_id for case in expand(config)}) == len(expand(config)) == cases


def test_every_shipped_config_is_pinned():
    studies = {"custom", "seed", "impact", "khatri_egan_square", "extreme", "reuse", "search"}
    names = {"smoke", "armor", "rammed", "drop", "infills", "panel", "slicer", "thousand"}
    names |= {f"khatri_egan_{cells}_out_of_plane" for cells in ("square", "hexagon")}
    names |= {"which_way", "which_way_lost", "gyroid", "drawn"}
    assert {path.stem for path in CONFIGS.glob("*.toml")} == names | studies
