"""The study of mutants: its mutations, and its report of the tests that notice."""

import ast
from pathlib import Path

import pytest

from tests.studies.mutants.__main__ import main, table
from tests.studies.mutants.flips import FLIPPED, ROOT, mutants, mutated, sample
from tests.studies.mutants.trial import ENDLESS, Copy, StudyError, Verdict

TERMS = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "kernels/terms").glob("*.py"))
INERTIA, SPRING = "kernels/terms/inertia.py", "kernels/terms/spring.py"


def named(path, change):
    """The first mutant of a file that changes this."""
    return next(mutant for mutant in mutants(path) if mutant.change.startswith(change))


ENERGY = named(INERTIA, "total += ")
KILLED = Verdict(ENERGY, "tests/test_it.py::test_it", 1.25, False)
SURVIVES = Verdict(ENERGY, None, 60.0, True)
HANGS = Verdict(ENERGY, ENDLESS, 900.0, True)


def operators(text):
    return [type(node) for node in ast.walk(ast.parse(text))]


def test_mutants_of_terms_differ_in_one_sign():
    found = [mutant for path in TERMS for mutant in mutants(path)]
    without = {f"kernels/terms/{name}.py" for name in ("__init__", "rayleigh")}
    assert {mutant.path for mutant in found} == set(TERMS) - without
    for mutant in found[::15]:
        source = (ROOT / mutant.path).read_text("utf-8")
        pairs = zip(operators(source), operators(mutated(source, mutant)), strict=True)
        ((before, after),) = [pair for pair in pairs if pair[0] is not pair[1]]
        assert FLIPPED[before] is after


def test_indices_and_counts_keep_their_signs(monkeypatch, tmp_path):
    monkeypatch.setattr("tests.studies.mutants.flips.ROOT", tmp_path)
    (tmp_path / "some.py").write_text(
        "def f(x, n):\n    k = n - 1\n    k += 2\n    return x[k - n] - 2.0 * -x[-1], -1\n"
    )
    found = list(mutants("some.py"))
    assert [(mutant.function, mutant.line, mutant.change) for mutant in found] == [
        ("f", 4, "x[k - n] - 2.0 * -x[-1] -> x[k - n] + 2.0 * -x[-1]"),
        ("f", 4, "-x[-1] -> +x[-1]"),
    ]


def test_a_sample_is_the_same_each_time_and_has_its_tests():
    found = list(sample(2))
    assert found == list(sample(2))
    assert {mutant.path for mutant in found} >= {INERTIA, SPRING, "kernels/arrays.py"}
    assert not any(mutant.path.startswith("kernels/compile") for mutant in found)
    assert all((ROOT / mutant.own_tests).is_file() for mutant in found)
    assert ENERGY.own_tests == "tests/kernels/terms/test_inertia.py"


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    return Copy(tmp_path_factory.mktemp("mutants") / "copy")


def test_a_mutant_turns_a_test_red_in_a_copy(copy):
    source = (ROOT / INERTIA).read_text("utf-8")
    verdict = copy.tried(ENERGY)
    assert verdict.red.startswith(f"{ENERGY.own_tests}::test_")
    assert not verdict.compiled
    assert (copy.folder / INERTIA).read_text("utf-8") == source
    assert (ROOT / INERTIA).read_text("utf-8") == source


def test_a_test_that_is_red_anyway_kills_nothing(copy, monkeypatch):
    source = (copy.folder / SPRING).read_text("utf-8")
    (copy.folder / SPRING).write_text(mutated(source, named(SPRING, "d - ")), "utf-8")
    other = named(SPRING, "total +=")
    with pytest.raises(StudyError, match="is red without a mutant too"):
        copy.tried(other)
    (copy.folder / SPRING).write_text(source, "utf-8")


def test_the_table_counts_survivors():
    survivors = []
    *_, one, two, three, note = table([KILLED, SURVIVES, HANGS], survivors)
    assert one.endswith(" | tests/test_it.py::test_it | 1.2 | plain Python |")
    assert two.endswith(" | none: it survives | 60.0 | machine code |")
    assert three.endswith(f" | {ENDLESS} | 900.0 | machine code |")
    assert note == "\n2 of 3 turn a test red."
    assert survivors == [ENERGY]


@pytest.mark.parametrize(("verdict", "failed"), [(KILLED, False), (SURVIVES, True)])
def test_a_survivor_is_a_failure(verdict, failed, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("tests.studies.mutants.__main__.tried", lambda mutants: [verdict])
    assert main(Path(tmp_path / "mutants")) == failed
    told = capsys.readouterr().out
    assert ENERGY.function in told
    assert (tmp_path / "mutants" / "mutants.md").read_text("utf-8") == told
