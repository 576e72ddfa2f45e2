"""Shapes of plates, whose nodes have three coordinates, together with shapes of walls in the
plane.
"""

import numpy as np
import pytest

from sweep.result import Result, Status
from sweep.store.read import read_frames, read_runs
from sweep.store.write import Writer
from tests.support.results.specimens import Named, squeezed_cell, summary, tube


def results():
    rows = summary({}, {"direction": "out_of_plane"}, {}, {"status": "stopped"}).to_dict("records")
    shapes = [squeezed_cell(), tube(), squeezed_cell(), {}]
    return [
        Result(Named(row["case_id"]), Status(row["status"]), "", {**row}, {}, frames)
        for row, frames in zip(rows, shapes, strict=True)
    ]


@pytest.fixture(params=[False, True], ids=["parts", "folded"])
def stored(request, tmp_path):
    path = tmp_path / "both.h5"
    with Writer(path) as writer:
        writer.append(results()[:2])
        writer.append(results()[2:])
        if request.param:
            writer.fold()
    return path


def test_shapes_of_both_kinds_are_read_as_they_were_written(stored):
    runs = read_runs(stored, [result.case_id for result in results()])
    for result, case in zip(results(), runs, strict=True):
        found = read_frames(stored, result.case_id)
        assert found.keys() == result.frames.keys() == case.frames.keys()
        for name, array in result.frames.items():
            assert found[name].shape == array.shape
            np.testing.assert_allclose(found[name], array, rtol=1e-6)
