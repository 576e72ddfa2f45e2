"""Outlines of what is not flat, from a case and its shapes."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.store.outlines import outlines
from tests.support.designs.cases import pressed

FRAMES = {"position_m": np.array([[[0.0, 0.0], [12.5e-3, 12.5e-3]]])}


def drawn(case: Case):
    return outlines(case.to_json().encode(), FRAMES)


def test_flat_platens_have_none():
    assert drawn(pressed()) == outlines(b"", FRAMES) == {}


def test_a_striker_and_ribs():
    shapes = drawn(pressed(striker="round", striker_at=0.2, base="ribs", base_span=8e-3))
    assert shapes["striker_m"].shape[0] == 1
    assert shapes["striker_m"][0].mean(axis=0) == pytest.approx([2.5e-3, 5e-3], abs=1e-9)
    assert shapes["base_m"].shape[0] == 2
    assert shapes["base_m"][..., 1].max() == pytest.approx(0.0, abs=1e-12)
