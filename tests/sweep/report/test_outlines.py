"""Outlines of strikers and ribs: from a run, through a file, to pictures."""

import numpy as np
import pytest

from sweep.report.outlines import outlines
from sweep.simulation.simulate import simulate
from sweep.store.read import read_frames
from sweep.store.write import Writer
from tests.support.designs.cases import pressed

SMALL = dict(strain=0.05, unload=False)


def test_flat_platens_have_none():
    assert outlines({}) == ([], [])


def test_a_striker_and_ribs_come_back_from_a_file(tmp_path):
    """The file also has a case without them; outlines are in mm."""
    shapes = dict(striker="round", striker_at=0.2, base="ribs", base_span=8e-3)
    results = [simulate(pressed(**SMALL)), simulate(pressed(**SMALL, **shapes))]
    with Writer(tmp_path / "hit.h5") as writer:
        writer.append(results)
    flat, hit = (read_frames(tmp_path / "hit.h5", result.case_id) for result in results)
    assert outlines(flat) == ([], [])
    (one, other), (striker,) = outlines(hit)
    assert striker.mean(axis=0) == pytest.approx([2.5, 5.0], abs=1e-3)
    assert np.ptp(striker, axis=0) == pytest.approx([10.0, 10.0], abs=1e-3)
    assert other.mean(axis=0) - one.mean(axis=0) == pytest.approx([8.0, 0.0], abs=1e-3)
    assert max(one[:, 1].max(), other[:, 1].max()) == pytest.approx(0.0, abs=1e-6)
