"""A results file by its path, and by the name and the config of its sweep."""

from pathlib import Path

from sweep.__main__ import main
from sweep.cli.named_files import results_file
from sweep.config.reading.examples import FOLDER, find_config


def test_a_name_and_a_config_stand_for_the_results_of_a_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("bot.toml").write_text('name = "bumper"\n')
    Path("plain.toml").write_text("[lattice]\n")
    Path("hostile.toml").write_text('name = "../../elsewhere"\n')
    Path("broken.toml").write_text('name = "')
    for name in ("mine.h5", "odd.hdf"):
        Path(name).touch()
    means = {
        "mine": "mine.h5",  # is there
        "odd.hdf": "odd.hdf",
        "bumper": "results/bumper.h5",
        "bot.toml": "results/bumper.h5",
        "plain.toml": "results/plain.h5",
        "hostile.toml": "results/hostile.h5",
        "broken.toml": "results/broken.h5",
        "absent.toml": "results/absent.h5",
        "results/armor": "results/armor.h5",
        "results/armor.1-of-2.h5": "results/armor.1-of-2.h5",
    }
    assert {text: results_file(text) for text in means} == means


def test_a_config_by_the_name_of_its_sweep(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("bot.toml").touch()
    assert find_config("bot").name == find_config("results/bot.h5").name == "bot.toml"
    assert find_config("smoke") == find_config("results/smoke.h5") == FOLDER / "smoke.toml"
    Path("smoke.toml").touch()  # one's own comes first
    assert find_config("smoke").resolve() == tmp_path / "smoke.toml"
    assert find_config("nothing").name == "nothing"


def test_without_words_there_is_help(capsys):
    assert main([]) == 0
    assert "exit status" in capsys.readouterr().out
