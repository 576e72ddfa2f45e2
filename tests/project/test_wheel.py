"""A wheel, made from an sdist and installed where nothing else of ours is, as users get it.

Kernels run as plain Python, since compiling them all takes longer than everything else here. One of
them shows that they are also compiled and cached from a wheel.
"""

import ast
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import venv
import zipfile
from email.parser import Parser
from importlib.util import find_spec
from pathlib import Path

import pytest

import crumple
from sweep.config.reading.examples import examples

ROOT = Path(__file__).parents[2]
FOLDERS = ("configs", "kernels", "sweep")
SOURCES = {"crumple/__init__.py": ROOT / "crumple.py"} | {
    f"crumple/{path.relative_to(ROOT).as_posix()}": path
    for folder in FOLDERS
    for path in sorted((ROOT / folder).rglob("*.*"))
    if path.suffix != ".pyc"
}
TRIAL = """
material.name = "cheetah"
lattice = {cells = 1, nodes_per_wall = 1}
loading = {strain = 0.005}
solver.load_steps = 2
"""
LINK = re.compile(r"(!?)\[[^\]]*\]\(([^)\s]+)\)")
NAMES = """
import pydoc
from importlib.resources import files
from importlib.util import find_spec
import crumple
from crumple.sweep.config.reading.examples import examples

print(find_spec("sweep"), find_spec("kernels"), files(crumple).joinpath("py.typed").is_file())
print(*dir(crumple))
print("simulate(case: crumple.sweep.config.case.Case" in pydoc.plain(pydoc.render_doc(crumple)))
print(*examples())
print(crumple.load_config("accuracy/vibration").name)
"""
KEPT = """
import numpy as np
from crumple.kernels.arrays import dot

print(dot(np.ones(3), np.ones(3)), sum(dot.entry.stats.cache_hits.values()))
"""


def build(folder, verb, into):
    """Call setuptools in a folder, as pip, build and uv do."""
    script = f"from setuptools import build_meta; build_meta.{verb}({str(into)!r})"
    subprocess.run([sys.executable, "-c", script], cwd=folder, check=True)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel, from a folder in which a module that is gone was built before."""
    folder = tmp_path_factory.mktemp("wheel")
    unneeded = shutil.ignore_patterns(".*", "build", "dist", "*.egg-info", "results", "tests")
    shutil.copytree(ROOT, folder / "checkout", ignore=unneeded)
    build(folder / "checkout", "build_sdist", folder)
    shutil.unpack_archive(next(folder.glob("*.tar.gz")), folder)
    source = folder / f"crumple-{crumple.__version__}"
    (source / "build/lib/sweep").mkdir(parents=True)
    (source / "build/lib/sweep/gone.py").touch()
    build(source, "build_wheel", folder)
    return next(folder.glob("*.whl"))


@pytest.fixture(scope="module")
def environment(wheel, tmp_path_factory):
    """The programs of an environment with the wheel, and with everything else from this
    environment.

    It lies in a git repository, which is not the repository of the source.
    """
    folder = tmp_path_factory.mktemp("environment")
    git = ["git", "-C", folder]
    for setting in ("user.name=a", "user.email=a", "commit.gpgSign=false"):
        git += ["-c", setting]
    for words in (["init", "-q"], ["commit", "-q", "--allow-empty", "-m", "a"]):
        subprocess.run([*git, *words], check=True)
    venv.create(folder / "venv", symlinks=True)
    python = folder / "venv/bin/python"
    (packages,) = (folder / "venv/lib").glob("*/site-packages")
    # What a line here names is a place of packages, but no place whose own .pth files count:
    # an editable install of the checkout stays out of sight.
    others = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    (packages / "others.pth").write_text("\n".join(others))
    pip = [sys.executable, "-m", "pip", "--python", python, "install"]
    uv = ["uv", "pip", "install", "--python", python]
    install = [*(pip if find_spec("pip") else uv), "--no-index", "--no-deps", wheel]
    subprocess.run(install, check=True)
    return python.parent


@pytest.fixture
def run(environment, tmp_path, monkeypatch):
    """Run a program of that environment in another folder, and return its output."""
    monkeypatch.chdir(tmp_path)
    usual = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "CRUMPLE"))}
    usual |= {"PYTHONNOUSERSITE": "1", "CRUMPLE_CACHE_DIR": str(tmp_path / "cache")}

    def printed(program, *words, **more):
        command = [environment / program, *words]
        done = subprocess.run(command, env=usual | more, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        if "run" in words:  # its progress is on stderr
            assert "Warning" not in done.stderr
            return done.stderr + done.stdout
        assert done.stderr == ""
        return done.stdout

    return printed


def read(wheel, name):
    with zipfile.ZipFile(wheel) as archive:
        return archive.read(name).decode()


def test_wheel_is_one_package_with_all_that_it_needs(wheel):
    own = {*SOURCES, "crumple/__main__.py", "crumple/py.typed"}
    about = f"crumple-{crumple.__version__}.dist-info"
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if not name.startswith(about)}
    assert names == own
    assert read(wheel, f"{about}/top_level.txt") == "crumple\n"


@pytest.mark.parametrize("url", ["", "https://forge.example/own/crumple"])
def test_links_lead_to_the_repository_of_a_release(wheel, url, tmp_path, monkeypatch):
    """Its address is in one variable of the environment; without it, nothing is changed."""
    monkeypatch.setenv("PROJECT_URL", url)
    folder = wheel.parent / f"crumple-{crumple.__version__}"
    build(folder, "prepare_metadata_for_build_wheel", tmp_path)
    told = Parser().parsestr(next(tmp_path.rglob("METADATA")).read_text("utf-8"))
    readme = (ROOT / "README.md").read_text("utf-8")
    assert told["Description-Content-Type"] == "text/markdown"
    if not url:
        assert (told["Project-URL"], told.get_payload().strip()) == (None, readme.strip())
        return
    assert f"Source, {url}" in told.get_all("Project-URL")
    before, after = LINK.findall(readme), LINK.findall(told.get_payload())
    assert len(before) == len(after) > 15
    for (picture, link), (_, absolute) in zip(before, after, strict=True):
        kind = "raw" if picture else "blob"
        assert absolute == f"{url}/{kind}/v{crumple.__version__}/{link}"
        assert (ROOT / link).exists()


def test_modules_differ_only_in_where_they_import_from(wheel):
    for name in (name for name in SOURCES if name.endswith(".py")):
        before, after = SOURCES[name].read_text("utf-8"), read(wheel, name)
        nodes = ast.walk(ast.parse(after))
        froms = [node.module.split(".")[0] for node in nodes if isinstance(node, ast.ImportFrom)]
        assert not {*froms} & {*FOLDERS}, name
        for old, new in zip(before.splitlines(), after.splitlines(), strict=True):
            moved = re.sub(r"^( *from )(kernels|sweep)\b", r"\1crumple.\2", old)
            assert new in (old, moved), name


def test_programs_tell_the_version(run):
    told = [run("crumple", "--version"), run("python", "-m", "crumple", "--version")]
    assert told == [f"crumple {crumple.__version__}\n"] * 2


def test_names_are_found_below_one_package(run):
    below, names, explained, known, loaded = run("python", "-I", "-c", NAMES).splitlines()
    assert (below, explained, loaded) == ("None None True", "True", "vibration")
    assert (names.split(), known.split()) == (dir(crumple), examples())


def test_sweeps_run_with_the_materials_and_examples_of_the_wheel(run):
    Path("trial.toml").write_text(TRIAL)
    assert "1/1 cases" in run("crumple", "run", "trial.toml", NUMBA_DISABLE_JIT="1")
    told = run("crumple", "status", "results/trial.h5")
    assert all(words in told for words in ("1 converged", "revision unknown"))
    told = run("python", "-m", "crumple", "run", "custom", NUMBA_DISABLE_JIT="1")
    assert re.search(r"example custom: .*/site-packages/crumple/configs/custom\.toml ", told)
    assert all(words in told for words in ("1/1 cases", "loaded as in its file"))


def test_kernels_are_compiled_once(run):
    assert run("python", "-I", "-c", KEPT) == "3.0 0\n"
    assert run("python", "-I", "-c", KEPT) == "3.0 1\n"
