"""The study of the mesh of a crushed gyroid: its measures, and a piece of it."""

import numpy as np
import pandas as pd
import pytest

from tests.studies.surfaces import mesh

AREA = {"outer_width_m": 2.0, "depth_m": 3.0}


def test_modulus_and_first_peak_are_read_from_the_curve():
    force = np.array([0.0, 6.0, 12.0, 9.0, 30.0, 20.0])
    history = pd.DataFrame({"strain": 0.1 * np.arange(6), "reaction_top_N": force})
    assert mesh.stresses(history, AREA) == pytest.approx((10.0, 2.0))
    assert np.isnan(mesh.stresses(history.iloc[:3], AREA)[1])


def test_a_piece_of_the_study(tmp_path, capsys):
    """Six quads a period, pressed by 2 %: too little for an energy to 50 %, and for a peak."""
    assert not mesh.main(tmp_path, [mesh.crush(2, strain=0.02)])
    (line,) = [text for text in capsys.readouterr().out.splitlines() if text.startswith("| 6 |")]
    _, modulus, peak, energy, *_, crossings, _ = line.strip("| ").split(" | ")
    assert (peak, energy, crossings) == ("nan", "nan", "0")
    assert float(modulus) == pytest.approx(3.1, rel=0.02)
    assert [case.lattice.quads_per_period for case in map(mesh.crush, mesh.NODES)] == [8, 10, 12, 16]
