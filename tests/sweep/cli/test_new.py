"""First configs: each runs unchanged, is explained, and overwrites nobody's file."""

import re
import shlex
import tomllib
from pathlib import Path

import pytest

from sweep.cli import new as cli_new
from sweep.cli.new import KINDS, template
from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.design.infill import families
from sweep.result import Status
from sweep.simulation.simulate import simulate
from tests.support.command import crumple

MODES = {"crush": "displacement", "drop": "impact", "load": "force"}


@pytest.mark.parametrize("kind", KINDS)
def test_config_of_every_kind_runs_as_it_is(capsys, tmp_path, monkeypatch, kind):
    monkeypatch.chdir(tmp_path)
    status, out, err = crumple(capsys, "new", "bumper", "--kind", kind)
    assert (status, out) == (0, "bumper.toml: change it, then: crumple run bumper.toml --dry-run\n")
    assert "`kind`" in Path(err.rpartition("all keys: ")[2].strip()).read_text("utf-8")
    assert crumple(capsys, "schema") == (0, Path("crumple.schema.json").read_text("utf-8"), "")
    config = load_config("bumper.toml")
    assert config.name == "bumper"
    cases = expand(config)
    assert [case.loading.mode for case in cases] == [MODES[kind]] * 4
    assert simulate(cases[-1]).status == Status.CONVERGED


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_commented_out_may_be_used(tmp_path, kind):
    path = tmp_path / "a.toml"
    text = template("a", kind, path)
    for line in re.findall(r"^# [\w\"].* = .*$", text, re.MULTILINE):
        used = text.replace(line, line.removeprefix("# "))
        path.write_text(re.sub("drop_height.*", "", used) if "energy" in line else used)
        assert len(expand(load_config(path))) in (4, 8)


def test_file_that_is_there_is_left_as_it_is(capsys, tmp_path):
    path = tmp_path / "bumper.toml"
    path.write_text("mine")
    status, _, err = crumple(capsys, "new", "bumper", "--out", str(path))
    assert (status, path.read_text()) == (2, "mine")
    assert err == f"crumple new: {path} already exists; allowed: another name, or --out\n"


def test_name_may_have_its_ending_and_is_checked(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert crumple(capsys, "new", "pad.toml")[0] == 0
    assert load_config("pad.toml").name == "pad"
    refused = {("a b",): "is not a name; allowed", ("a", "--out", "a.txt"): "ends in .toml"}
    refused[("a", "--out", "/dev/full/a.toml")] = "is or lies in a file"
    for words, why in refused.items():
        status, out, err = crumple(capsys, "new", *words)
        assert (status, out) == (2, "")
        assert why in err
    assert {path.name for path in tmp_path.iterdir()} == {"pad.toml", "crumple.schema.json"}


def test_every_family_is_offered(monkeypatch):
    """On as many lines as they take."""
    many = ("square", *(f"family_{number}" for number in range(20)))
    for offered in (families(), many):
        monkeypatch.setattr(cli_new, "families", lambda offered=offered: offered)
        text = template("a", "crush", Path("a.toml"))
        assert tomllib.loads(text)["lattice"]["kind"] == "square"
        assert max(map(len, text.splitlines())) <= 100
        assert {*offered} <= {*re.findall(r"\w+", text)}


@pytest.mark.parametrize("kind", KINDS)
def test_keys_and_commands_of_the_config_are_explained(kind):
    text = template("a", kind, Path("my pad.toml"))
    case = text.partition("[lattice]")[2].partition("[grid]")[0]
    keys = [line for line in case.splitlines() if " = " in line]
    assert len(keys) > 8
    assert all("  # " in line for line in keys)
    assert max(map(len, text.splitlines())) <= 100
    commands = [line for line in text.splitlines() if "crumple " in line][:3]
    run = ["crumple", "run", "my pad.toml"]
    words = [shlex.split(line)[1:4] for line in commands]
    assert words == [run, run, ["crumple", "show", "results/a.h5"]]
