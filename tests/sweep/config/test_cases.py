"""Cases that are made when they are requested equal the cases from which they were made."""

from itertools import islice

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.cases import Cases, compact
from sweep.config.kinds.table import TABLES
from sweep.config.load import case, load_config
from sweep.config.reading.examples import examples

MOST = 20  # cases of an example that are compared
# To expand "extreme" takes three seconds.
EXAMPLES = sorted({*examples()} - {"extreme"})


def same(one, other):
    """Whether two sets of cases cannot be distinguished, by content or order."""
    assert (one, one.case_id) == (other, other.case_id)
    assert one.to_json() == other.to_json()
    assert [(k, type(v)) for k, v in one.axes.items()] == [
        (k, type(v)) for k, v in other.axes.items()
    ]
    for name in TABLES:
        mine, its = getattr(one, name), getattr(other, name)
        assert type(mine) is type(its)
        assert list(mine) == list(its)
    assert {**one.__dict__, "case_id": ""} == {**other.__dict__, "case_id": ""}
    return True


@pytest.mark.parametrize("name", EXAMPLES)
def test_cases_of_every_example(name):
    """Each is completed from its own values again, packed again, and written and read."""
    for each in islice(load_config(name).cases, MOST):
        again = Case.of(axes=each.axes, **{table: getattr(each, table) for table in TABLES})
        (packed,) = Cases([again])
        assert same(packed, again)
        assert packed == each
        read = Case.from_json(each.to_json())
        assert (read, read.case_id, read.to_json()) == (each, each.case_id, each.to_json())


def many(count=60):
    """Cases whose labels, kinds of tables and given keys differ, drawn at random."""
    rng = np.random.default_rng(4)
    for number in range(count):
        kind = str(rng.choice(["square", "hex", "gyroid"]))
        side = "height" if kind == "gyroid" else "depth"
        modes = ["displacement", "impact" if kind == "gyroid" else "force"]
        made = case(
            lattice={"kind": kind, side: f"{rng.integers(10, 30)} mm"},
            loading={"mode": str(rng.choice(modes))},
        )
        labels = {"lattice.kind": kind, "lattice.layers": None, "n": number, "x": 0.5 * number}
        names = rng.permutation([*labels])[: rng.integers(0, 5)]
        yield made.model_copy(update={"axes": {str(name): labels[name] for name in names}})


def test_sequence_is_that_of_a_list():
    eager = [*{made.case_id: made for made in many()}.values()]
    lazy = Cases(eager)
    assert len(lazy) == len(eager) > 20
    assert all(map(same, lazy, eager))
    assert all(same(lazy[k], eager[k]) for k in (0, 7, -1))
    for part in (slice(3, 9), slice(None, None, 3), slice(-4, None)):
        assert lazy[part] == eager[part]
    assert [*lazy.ids] == [made.case_id for made in eager]
    assert dict(lazy.labels) == {made.case_id: made.axes for made in eager}
    assert "none" not in lazy.labels
    assert all(same(lazy.of(made.case_id), made) for made in eager)
    with pytest.raises(IndexError):
        lazy[len(eager)]


def test_of_cases_with_one_id_the_last_counts_at_the_place_of_the_first():
    first, other = islice(many(), 2)
    last = first.model_copy(update={"axes": {"n": 7}})
    lazy = Cases([first, other, last])
    assert [each.axes for each in lazy] == [{"n": 7}, other.axes]


def test_some_of_the_cases():
    lazy = Cases(many())
    ids = [*lazy.ids]
    assert [*lazy.only([ids[5], ids[2]]).ids] == [ids[5], ids[2]]
    rest = lazy.without(ids[1:])
    assert (len(rest), len(lazy)) == (1, len(ids))
    assert same(rest[0], lazy[0])
    assert compact(rest) is rest


def test_no_case_is_made_to_know_ids_and_labels(monkeypatch):
    lazy = Cases(many())
    monkeypatch.setattr("sweep.config.cases._case_of", None)
    assert len(lazy.without([*lazy.ids][:3]).ids) == len(lazy) - 3
    assert len([*lazy.labels.values()]) == len(lazy)


def test_tables_that_cases_share_are_kept_once():
    cases = load_config("thousand").cases
    made = [*cases]
    assert len({id(each.material) for each in made}) == len({each.material for each in made}) == 2
    assert len({id(each.lattice) for each in made}) == len(made)
