"""Tables whose columns are made on request have the values of tables in memory."""

import numpy as np
import pytest

from sweep.store import sealed_file
from sweep.store.batch import newest
from sweep.store.read import _union, finished_ids, read_statuses, read_summary
from sweep.store.tables import arrange, relabel, slim, stack, tabulate, take
from tests.support.results.standin import cases, write

NAMES = ["mass_g", "lattice.depth", "message", "steps", "own"]


def drawn(rng, first, count):
    """Rows with ids and some of the names, as whole numbers, fractions, texts and gaps."""
    values = {"mass_g": 0.5, "lattice.depth": 3, "message": "stopped", "steps": 7, "own": "a"}
    rows = []
    for number in range(first, first + count):
        names = [name for name in NAMES if rng.random() < 0.7]
        row = {name: values[name] * int(rng.integers(1, 4)) for name in names}
        rows.append({"case_id": f"{number:x}"} | row)
    return rows


def equal(table, rows):
    """Whether a table has these rows, as one that is made of all of them at once."""
    eager = tabulate(rows)
    assert set(table) == set(eager)
    for name, column in eager.items():
        assert table[name].dtype.kind in (column.dtype.kind, "f"), name
        assert table[name].tolist() == pytest.approx(column.tolist(), nan_ok=True), name
    return True


@pytest.mark.parametrize("seed", range(20))
def test_rows_are_those_of_a_table_in_memory(seed):
    rng = np.random.default_rng(seed)
    batches = [drawn(rng, 100 * k, int(rng.integers(1, 6))) for k in range(4)]
    rows = [row for batch in batches for row in batch]
    table = stack([tabulate(batch) for batch in batches])
    assert equal(table, rows)
    order = rng.permutation(len(rows))[:-1]
    some = [rows[k] for k in order]
    axes = {
        row["case_id"]: {"lattice.depth": 0.1 * k} | ({"new": "b"} if k % 2 else {})
        for k, row in enumerate(some)
        if k % 3
    }
    names = dict.fromkeys(name for row in rows for name in row)
    filled = [{name: row.get(name) for name in names} for row in some]
    labelled = arrange(relabel(take(table, order), axes))
    assert equal(labelled, [row | axes.get(row["case_id"], {}) for row in filled])
    assert next(iter(labelled)) == "case_id"
    assert [*labelled].index("lattice.depth") < [*labelled].index("mass_g")


@pytest.mark.parametrize(
    ("values", "alike"),
    [
        (np.full(9, 0.1), True),
        (np.full(9, np.nan), True),
        (np.array([0.0, -0.0]), False),  # other bits
        (np.arange(9), False),
        (np.array(["a"] * 9, object), True),
        (np.array(["a", "b"], object), False),
        (np.zeros(0), False),
    ],
)
def test_a_column_of_one_value_takes_the_memory_of_one(values, alike):
    column = slim(values)
    assert (column.dtype, column.tobytes()) == (values.dtype, values.tobytes())
    assert (column is not values) is alike
    assert column is values or column.base.nbytes == 8


@pytest.fixture
def path(tmp_path):
    """Nine cases, in a file that this process has checked, with no numbers kept."""
    write(tmp_path / "a.h5", cases(9), fold=True)
    read_summary(tmp_path / "a.h5")
    return tmp_path / "a.h5"


@pytest.fixture
def made(monkeypatch):
    names, usual = [], sealed_file._column

    def column(data):
        names.append(data.name.rsplit("/", 1)[-1])
        return usual(data)

    monkeypatch.setattr(sealed_file, "_column", column)
    monkeypatch.setattr(sealed_file, "FEW", 0)
    return names


def test_no_column_is_read_that_nobody_asks_for(path, made):
    assert len(read_statuses(path)) == 9
    assert sorted(made) == ["case_id", "status"]
    made.clear()
    finished_ids(path)
    assert sorted(made) == ["case_id", "model_version", "status"]


def test_columns_are_read_one_at_a_time(path, made):
    with _union(path) as blocks:
        table = newest(blocks)
        assert made == ["case_id"]
        table["mass_g"], table["mass_g"], table["case_id"]
        assert made == ["case_id", "mass_g", "mass_g"]
    with pytest.raises(KeyError):
        table["no such column"]
