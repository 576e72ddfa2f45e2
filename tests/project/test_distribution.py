"""Files that build, test and describe Crumple elsewhere: the same packages, versions and pages."""

import os
import re
import subprocess
import tomllib
from pathlib import Path

import pytest
import yaml

import crumple

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
VERSIONS = {
    found[1]
    for line in PROJECT["classifiers"]
    if (found := re.fullmatch(r"Programming Language :: Python :: (3\.\d+)", line))
}
CONDA = {"matplotlib": "matplotlib-base"}  # names there of the same packages


def read(name):
    return yaml.safe_load((ROOT / name).read_text("utf-8"))


def test_the_workflow_tests_the_versions_of_python_that_are_promised():
    workflow = read(".github/workflows/tests.yml")
    matrix = workflow["jobs"]["tests"]["strategy"]["matrix"]
    assert {*matrix["python"]} == VERSIONS
    assert PROJECT["requires-python"] == f">={min(VERSIONS)}"
    assert [system.split("-")[0] for system in matrix["system"]] == ["ubuntu", "macos", "windows"]


@pytest.mark.parametrize("name", ["tests", "release"])
def test_workflows_name_versions_of_actions(name):
    text = (ROOT / f".github/workflows/{name}.yml").read_text("utf-8")
    assert re.findall(r"uses: (?!\S+@(release/)?v\d+$).*", text, re.MULTILINE) == []


def test_the_workflow_names_folders_that_exist():
    text = (ROOT / ".github/workflows/tests.yml").read_text("utf-8")
    folders = re.findall(r"\btests/[\w/]+", text)
    assert len(folders) > 5
    assert all((ROOT / folder).is_dir() for folder in folders)


@pytest.mark.parametrize("tag", [f"v{PROJECT['version']}", "v0.1", "v0.1.00", "main"])
def test_a_release_has_the_tag_of_its_version(tag):
    steps = read(".github/workflows/release.yml")["jobs"]["release"]["steps"]
    (check,) = [step["run"] for step in steps if step.get("name") == "The tag is the version"]
    environment = {**os.environ, "GITHUB_REF_NAME": tag}
    done = subprocess.run(["bash", "-ec", check], cwd=ROOT, env=environment, check=False)
    assert (done.returncode == 0) == (tag == f"v{PROJECT['version']}")


def test_the_recipe_has_the_version_and_the_packages_of_the_project():
    recipe = read("recipe/recipe.yaml")
    assert recipe["context"] == {"version": PROJECT["version"], "python_min": min(VERSIONS)}
    names = {re.sub(r"[>=].*", "", line): line for line in PROJECT["dependencies"]}
    needed = {line.replace(name, CONDA.get(name, name) + " ") for name, line in names.items()}
    assert {*recipe["requirements"]["run"]} == needed | {"python >=${{ python_min }}"}
    assert recipe["about"]["license"] == PROJECT["license"]


def test_the_image_has_a_promised_version_of_python():
    text = (ROOT / "Dockerfile").read_text("utf-8")
    assert {*re.findall(r"^FROM python:([\d.]+)-slim", text, re.MULTILINE)} == {max(VERSIONS)}


def test_the_site_names_files_that_exist_and_leaves_out_no_page():
    nav = (ROOT / "mkdocs.yml").read_text("utf-8").partition("\nnav:")[2]
    named = {*re.findall(r"[\w/]+\.(?:md|ipynb)", nav)}
    assert [page for page in named if not (ROOT / page).is_file()] == []
    docs = {path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").glob("*.md")}
    assert docs <= named


def test_the_reference_has_every_public_name():
    text = (ROOT / "docs/reference.md").read_text("utf-8")
    names = re.findall(r"^::: sweep\.(\w+)$", text, re.MULTILINE)
    assert sorted(names) == sorted({*crumple.__all__} - {"__version__"})


def test_the_gallery_shows_every_picture():
    text, folder = (ROOT / "docs/gallery.md").read_text("utf-8"), ROOT / "docs/pictures"
    assert [p.name for p in folder.iterdir() if f"(pictures/{p.name})" not in text] == []
