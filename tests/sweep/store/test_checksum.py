"""Checksums of rows: nothing changes one value, or the name of a column, without changing them."""

import numpy as np
import pytest

from sweep.store.checksum import attribute_checksum, row_checksums

TEXTS = np.array(["square", "", "ein Würfel"], object)
COLUMNS = {
    "energy": np.array([0.0, -1.5, np.nan]),
    "count": np.array([3, -1, 2**62]),
    "kind": TEXTS,
}


@pytest.mark.parametrize("name", ["energy", "count"])
def test_every_bit_counts_in_its_row_alone(name):
    for bit in range(64):
        changed = COLUMNS[name].view(np.uint64).copy()
        changed[1] ^= np.uint64(1) << np.uint64(bit)
        other = COLUMNS | {name: changed.view(COLUMNS[name].dtype)}
        differ = row_checksums(COLUMNS) != row_checksums(other)
        assert list(differ) == [False, True, False], bit


@pytest.mark.parametrize("text", ["squarf", "square ", "", "Square"])
def test_texts_count(text):
    other = row_checksums(COLUMNS | {"kind": np.array([text, *TEXTS[1:]], object)})
    assert list(row_checksums(COLUMNS) != other) == [True, False, False]


def test_names_count_and_order_does_not():
    turned = dict(reversed(COLUMNS.items()))
    assert np.array_equal(row_checksums(COLUMNS), row_checksums(turned))
    renamed = {("mass" if name == "energy" else name): data for name, data in COLUMNS.items()}
    assert not np.any(row_checksums(COLUMNS) == row_checksums(renamed))
    swapped = COLUMNS | {"energy": COLUMNS["count"], "count": COLUMNS["energy"]}
    assert not np.any(row_checksums(COLUMNS) == row_checksums(swapped))


def test_attributes_are_the_same_after_they_were_stored():
    written = {"config": "a", "folded": 3, "share": 0.1}
    read = {"share": np.float64(0.1), "folded": np.int64(3), "config": "a", "checksum": 5}
    assert attribute_checksum(written) == attribute_checksum(read)
    assert attribute_checksum(written | {"folded": 4}) != attribute_checksum(written)
