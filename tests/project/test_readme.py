"""Statements of README and its pages: commands, files, keys, columns, snippets, figures are
real.
"""

import json
import os
import re
import shlex
import sys
from functools import cache

import matplotlib.pyplot
import pytest

from sweep.__main__ import main
from sweep.cli.parser import parser
from sweep.columns import COLUMNS, PER_GRAM
from sweep.config.case import Case
from sweep.config.grid import expand
from sweep.config.keys import case_keys, table_keys
from sweep.config.kinds.table import TABLES
from sweep.config.load import load_config
from sweep.config.materials.material_file import STRAINS, STRESSES
from sweep.config.materials.material_header import KEYS
from sweep.config.question import QUESTION
from sweep.config.structures.structure import Structure
from sweep.config.units import quantity
from sweep.design.infill import families
from sweep.simulation.simulate import simulate
from sweep.store.write import Writer
from tests.studies import verify as figures
from tests.support import optuna, readme
from tests.support.readme import NUMBER, QUOTED, ROOT, blocks, numbers, words

MADE_BY_RUNNING = {"bumper.toml", "results/bench/bench.md"}


def test_tables_are_narrow():
    fenced = [line for text in blocks("text") for line in text.splitlines()]
    lines = readme.TEXT.splitlines()
    assert max(len(line) for line in lines if line.startswith("|") or line in fenced) <= 104
    assert max(map(len, lines)) <= 128


def test_make_targets_exist():
    typed = re.findall(r"^make (\w+)", "\n".join(blocks("sh")), re.MULTILINE)
    quoted = [words.split()[1] for words in QUOTED if words.startswith("make ")]
    targets = re.findall(r"^(\w+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE)
    assert {"sweep", "test", "verify"} <= {*typed, *quoted} <= set(targets)


def test_commands_are_accepted():
    text = "\n".join([*blocks("sh"), *blocks("text")])
    commands = re.findall(r"^(?:\$ )?crumple (\w+ .*)", text, re.MULTILINE)
    verbs = {parser().parse_args(shlex.split(words, comments=True)).verb for words in commands}
    told = "run optimize rank status verify show report export materials published card"
    assert verbs == {*told.split()}


def test_files_exist():
    quoted = {words.removeprefix("error_") for words in QUOTED} - MADE_BY_RUNNING
    named = {words for words in quoted if re.fullmatch(r"[\w./]+\.(py|toml|cff|md)", words)}
    assert len(named) > 20
    missing = {name for name in named if not (ROOT / name).is_file()}
    assert [name for name in missing if not any(ROOT.glob(f"[!.]*/**/{name}"))] == []


@pytest.mark.parametrize("page", readme.PAGES)
def test_links_lead_somewhere(page):
    links = re.findall(r"\]\((\S+?)\)", readme.PAGES[page])
    assert [link for link in links if not (ROOT / page).parent.joinpath(link).is_file()] == []
    assert page != "README.md" or readme.PAGES.keys() - {page} <= set(links)


def test_every_config_is_named():
    named, folder = {row[0].strip("`") for row in readme.table("config")}, ROOT / "configs"
    files = {name: {*folder.glob(name)} for name in named}
    assert set().union(*files.values()) == set(folder.rglob("*.toml"))
    assert all(files.values())


def test_every_term_of_the_energy_is_named():
    paths = (ROOT / "kernels" / "terms").glob("*.py")
    terms = {path.name for path in paths if "def evaluate(" in path.read_text("utf-8")}
    assert len(terms) > 8
    assert terms | {"kernels/planar/potential.py"} <= QUOTED


def test_example_has_as_many_cases_as_it_says(tmp_path):
    path = tmp_path / "bumper.toml"
    path.write_text(blocks("toml")[0])
    config = load_config(path)
    cases = expand(config)
    assert (config.name, len(cases)) == ("bumper", 8)
    (shown,) = set(re.findall(r"results/bumper\.h5 ([0-9a-f]{4})\b", readme.TEXT))
    assert sum(case.case_id.startswith(shown) for case in cases) == 1


def keys_of(table):
    (text,) = re.findall(rf"^- `\[{table}\]`:\s(.*?)(?=^- |\n\n)", readme.TEXT, re.M | re.S)
    return " ".join(text.split())


@pytest.mark.parametrize("table", [*TABLES, *QUESTION])
def test_every_key_is_explained(table):
    known = table_keys(table) if table in QUESTION else case_keys()
    fields = {name.split(".")[1] for name in known if name.startswith(f"{table}.")}
    if table == "lattice":
        fields |= {*families()}
    unsaid = fields - {"load_steps"} - set(re.findall(r"[`\"](\w+)[`\"]", keys_of(table)))
    assert not unsaid, f"configs/README.md does not explain these keys or kinds of [{table}]"


@pytest.mark.parametrize("table", TABLES)
def test_defaults_are_those_of_a_case(table):
    said = re.findall(r'`(\w+)` ("[^"]+"|true|[\d.e-]+\d)', keys_of(table))
    modes = [Case.of(loading=dict(mode=mode)) for mode in ("force", "displacement", "impact")]
    modes.append(Case.of(damping=dict(model="kelvin_voigt")))
    assert len(said) >= 2
    for name, text in said:
        unit = case_keys()[f"{table}.{name}"].unit
        value = json.loads(text)
        value = quantity(value, unit) if unit and isinstance(value, str) else value
        kinds = [getattr(case, table) for case in modes]
        defaults = [getattr(kind, name) for kind in kinds if name in type(kind).model_fields]
        assert value in defaults, (
            f"configs/README.md: `{name}` {text} reads as the default of this key, which is "
            f"{defaults[0]}; before any other value write a word, as in: `{name}`, such as {text}"
        )


def test_structure_is_that_of_the_config_and_its_keys_are_explained_with_their_defaults():
    (drawn,) = blocks("json")
    assert drawn == (ROOT / "configs/custom.json").read_text("utf-8")
    fields = Structure.model_fields
    said = {row[0].strip("`"): row[2] for row in readme.table("key")}
    assert {*said} == {*fields}
    for name, text in said.items():
        if text:
            told = None if text == "none" else json.loads(text)
            default = fields[name].default
            assert told == (list(default) or None if isinstance(default, tuple) else default)


def test_columns_exist():
    quoted = {re.sub("^(error|correction)_", "", words) for words in QUOTED}
    named = {words for words in quoted if re.fullmatch(r"[a-z_]+_(J|N|g|m|Pa|s|J_per_g)", words)}
    keys = {name.split(".")[1] for name in case_keys()}
    known = {*COLUMNS, *STRAINS, *STRESSES, *KEYS, *Structure.model_fields, *keys}
    assert {"mass_g", "absorbed_energy_J"} <= named
    assert [name for name in named - known if not PER_GRAM.fullmatch(name)] == []


def test_refusal_reads_so(tmp_path, capsys):
    path = tmp_path / "bumper.toml"
    path.write_text('[lattice]\nwall_thicknes = "0.8 mm"\n[loading]\nforce = 12\n')
    assert main(["run", str(path)]) == 2
    assert capsys.readouterr().err in blocks("text")


def test_failure_reads_so():
    without_numbers = re.sub(NUMBER, "#", " ".join(readme.TEXT.split()))
    assert re.sub(NUMBER, "#", figures.failure()) in without_numbers


def test_snippets_run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, "optuna", optuna)  # which is no dependency
    names = {}
    for snippet in blocks("python"):
        exec(snippet, names)
    matplotlib.pyplot.close("all")
    assert capsys.readouterr().out.startswith("converged")
    assert len(names["table"]) == len(names["summary"]) == names["data"].sizes["case_id"] == 6
    assert names["study"].best_params["kind"] in ("hex", "square", "diamond")
    assert names["study"].best_value > 0.0


@cache
def figures_now():
    found = [list(table()) for table in figures.TABLES]
    return {rows[0][0]: rows for rows in found}


def test_figures_are_those_of_make_verify():
    told = {rows[0][0]: rows for rows in readme.tables()}
    for head, rows in figures_now().items():
        for said, row in zip(told[head], rows, strict=True):
            assert words(said) == words(row)
            if row[0] not in figures.OF_THIS_RUN:
                assert numbers(said) == pytest.approx(numbers(row), rel=0.01, abs=0.05), row


def test_worst_book_is_below_a_millionth():
    rows = {row[0]: row[1:] for row in figures_now()["3 elements a wall, contact, loose platens"]}
    assert all(float(share) < 1e-6 for share in rows["energy left over / absorbed"])
    assert {*rows["walls that cross"]} == {"0"}
    assert {*rows["status"]} == {"converged"}


def test_winners_are_the_first_of_the_rankings():
    """README has a cell for each front and mass, docs/rammed.md the ranking behind it."""
    text = readme.PAGES["docs/rammed.md"]
    rankings = re.findall(r"^## (.*?)\n+```text\n(.*?)^```", text, re.M | re.S)
    names = {"hex": "honeycomb", "triangle": "triangles", "diamond": "diamonds"}
    names |= {"square": "squares", "kagome": "kagome", "reentrant": "re-entrant"}
    first = []
    for _, lines in rankings:
        (row,) = [line.split() for line in lines.splitlines() if line.startswith(("1*", " 1*"))]
        mark = f" ({row[0][2:]})" if row[0][2:] else ""
        first.append(f"{names[row[1]]}, {row[5]} mm: {row[7]} N{mark}")
    assert [cell for row in readme.table("front") for cell in row[1:]] == first
    assert [title.rpartition(" lb")[0][-1] for title, _ in rankings] == ["1", "3"] * 3


@pytest.fixture(scope="module")
def quick_armor(tmp_path_factory):
    """A folder with the results of the designs of armor.toml that take no time."""
    folder, config = tmp_path_factory.mktemp("readme"), load_config(ROOT / "configs/armor.toml")
    quick = {(6, t) for t in (0.4e-3, 0.8e-3, 1.2e-3, 1.6e-3)} | {(9, 0.4e-3)}
    quick |= {(cells, 0.8e-3) for cells in (9, 12)}
    cases = [
        case
        for case in expand(config)
        if case.loading.platen == "glued"
        and (case.lattice.cells_x, case.lattice.wall_thickness) in quick
    ]
    ranked = {"rank": {"budgets": config.rank.budgets, "panel": config.rank.panel}}
    with Writer(folder / "results/armor.h5", attributes={"config": json.dumps(ranked)}) as writer:
        writer.append([simulate(case) for case in cases])
        writer.fold()
    return folder


@pytest.mark.parametrize("example", readme.examples(), ids=lambda example: example.command)
def test_rankings_are_those_of_the_sweep(example, quick_armor, monkeypatch):
    monkeypatch.chdir(quick_armor)
    monkeypatch.setitem(os.environ, "COLUMNS", "104")
    printed = [line.split() for line in figures.answer(example) if line]
    told = [line.split() for line in example.lines if "9 x 3" in line or "6 x 2" in line]
    assert len(told) >= 2
    for said in told:
        same = [numbers(line) for line in printed if words(line) == words(said)]
        assert pytest.approx(numbers(said), rel=0.01) in same
