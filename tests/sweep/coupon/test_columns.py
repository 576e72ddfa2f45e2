"""Columns by the words and units of their heads, and questions to the user."""

import numpy as np
import pytest

from sweep.config.faults import MisfitError
from sweep.coupon.columns import columns_of, heads_of, words_of
from sweep.coupon.table import Table

UP = np.linspace(0.0, 1.0, 30)


def table(*heads, **values):
    """A table of columns that rise, by heads with units after a slash."""
    names, units = zip(*(head.partition("/")[::2] for head in heads), strict=True)
    columns = [values.get(f"c{k}", (k + 1) * UP) for k in range(len(heads))]
    return Table(names, units, np.column_stack(columns), [], ".", ("read",))


@pytest.mark.parametrize(
    ("heads", "quantities"),
    [
        ("time/s displacement/mm force/N", "time displacement force"),
        ("Prüfzeit/s Standardweg/mm Standardkraft/N", "time displacement force"),
        ("Temps/s Course_standard/mm Force/kN", "time displacement force"),
        ("Tiempo/s Deformación/% Tensión/MPa", "time strain stress"),
        ("t/s Extension/% Tensile_stress/MPa", "time strain stress"),
        ("时间/s 位移/mm 力/kN", "time displacement force"),
        ("時間/s ひずみ/% 応力/MPa", "time strain stress"),
        ("Time/s True_strain/% Strain_rate/1/s Width/mm", "time"),
        ("/s /mm /N", "time displacement force"),
        ("TestTime/Sec XDisplacement/um LoadCell/mN", "time displacement force"),
    ],
)
def test_words_and_units_say_what_a_column_is(heads, quantities):
    found = columns_of(table(*(head.replace("_", " ") for head in heads.split())), {}, {})
    assert [*found.values] == quantities.split()
    assert found.questions == []


def test_columns_are_in_si():
    found = columns_of(table("time/ms", "strain/%", "stress/MPa"), {}, {})
    assert [values[-1] for values in found.values.values()] == pytest.approx([1e-3, 0.02, 3e6])
    assert found.words["stress"] == "stress [MPa]"
    assert columns_of(table("strain", "x/s"), {}, {}).values["strain"][-1] == 1.0


HEADS = ("Extension/mm", "Tensile extension/um", "Load/N", "Time/s")
HALVES = dict(c0=np.where(UP < 0.5, UP, np.nan), c1=np.where(UP < 0.5, np.nan, UP))


@pytest.mark.parametrize(
    ("columns", "undecided"),
    [
        ({"c1": 1e3 * UP + 7.0}, set()),
        ({"c1": np.where(UP < 0.1, np.nan, 1e3 * UP)}, set()),
        (HALVES, {"displacement"}),
        ({"c0": 0.0 * UP}, set()),
    ],
)
def test_of_columns_that_are_the_same_or_constant_one_counts(columns, undecided):
    assert columns_of(table(*HEADS, **columns), {}, {}).undecided == undecided


def test_of_several_columns_the_user_is_asked():
    (question,) = columns_of(table(*HEADS), {}, {}).questions
    wanted = '--columns displacement="Extension" or displacement="Tensile extension"'
    assert question.startswith(wanted)
    chosen = columns_of(table(*HEADS), {"displacement": "tensile EXTENSION"}, {})
    assert chosen.values["displacement"][-1] == pytest.approx(2e-6)
    (question,) = columns_of(table("Load/N", "Load/N", c1=UP**2), {}, {}).questions[:1]
    assert question.startswith('--columns force="1" or force="2"')


def test_of_tests_side_by_side_one_answer_chooses_the_test():
    heads = ("Time/s", "Force/N", "Stroke/mm") * 3
    side_by_side = columns_of(table(*heads), {}, {})
    assert side_by_side.undecided == {"time", "force", "displacement"}
    second = columns_of(table(*heads), {"force": "5"}, {})
    assert second.questions == []
    ends = [second.values[name][-1] for name in ("time", "force", "displacement")]
    assert ends == pytest.approx([4.0, 5.0, 6e-3])


def test_units_that_are_not_known_are_asked_for_at_once():
    heads = ("Time", "Strain", "Stress/bananas")
    (question,) = columns_of(table(*heads), {}, {}).questions
    assert question.startswith("--units time=s strain=% stress=MPa, or other units: none are known")
    assert question.endswith("Time, Strain, Stress [bananas]")
    assert columns_of(table("Load/N", "Load cell/V"), {}, {}).undecided == set()
    given = columns_of(table(*heads), {"stress": "3"}, {"time": "s", "strain": "%", "stress": "Pa"})
    assert [*given.values] == ["time", "strain", "stress"]


@pytest.mark.parametrize(
    ("chosen", "units", "wrong"),
    [
        ({"force": "9"}, {}, "--columns 9: no such column; its heads: Time, Load"),
        ({"force": "load"}, {"strain": "%"}, "--units strain has no effect"),
    ],
)
def test_answers_that_fit_no_column_are_refused(chosen, units, wrong):
    with pytest.raises(MisfitError, match=wrong):
        columns_of(table("Time/s", "Load/N"), chosen, units)


def test_heads_of_others_are_shown_short_and_plain():
    words = heads_of(table("a\x1b[2J", "b" * 90, *"cdefghij"))
    assert words == f"its heads: a\\x1b[2J, {'b' * 40}..., c, d, e, f, g, h and 2 more"
    assert words_of("C_1_Déplacement 2") == ["c", "deplacement"]
