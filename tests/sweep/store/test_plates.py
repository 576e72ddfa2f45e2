"""Shapes of plates, whose nodes have three coordinates, together with shapes of walls in the
plane.
"""

import numpy as np
import pytest

from sweep.result import Result, Status
from sweep.store.read import read_frames, read_runs
from sweep.store.write import Writer
from tests.support.results.specimens import Named, squeezed_cell, summary, tube

ROWS = summary({}, {"direction": "out_of_plane"}, {}, {"status": "stopped"}).to_dict("records")
SHAPES = [squeezed_cell(), tube(), squeezed_cell(), {}]


@pytest.mark.parametrize("folded", [False, True])
def test_shapes_of_both_kinds_are_read_as_they_were_written(tmp_path, folded):
    path, ids = tmp_path / "both.h5", [row["case_id"] for row in ROWS]
    results = [
        Result(Named(row["case_id"]), Status(row["status"]), "", {**row}, {}, shapes)
        for row, shapes in zip(ROWS, SHAPES, strict=True)
    ]
    with Writer(path) as writer:
        writer.append(results[:2])
        writer.append(results[2:])
        if folded:
            writer.fold()
    for case_id, shapes, case in zip(ids, SHAPES, read_runs(path, ids), strict=True):
        found = read_frames(path, case_id)
        assert found.keys() == shapes.keys() == case.frames.keys()
        for name, array in shapes.items():
            assert found[name].shape == array.shape
            np.testing.assert_allclose(found[name], array, rtol=1e-6)
