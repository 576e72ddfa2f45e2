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


def test_the_finest_mesh_has_twice_the_quads_of_the_default_one():
    crushes = [mesh.crush(nodes) for nodes in mesh.NODES]
    assert [case.lattice.quads_per_period for case in crushes] == [8, 10, 12, 16]


def test_a_piece_of_the_study(tmp_path, capsys, monkeypatch):
    """Six quads a period, pressed by 2 %: too little for an energy to 50 %, and for a peak."""
    brief = mesh.crush(2, strain=0.02)
    monkeypatch.setattr(mesh, "crush", lambda _: brief)
    assert not mesh.main(tmp_path, [2])
    last = capsys.readouterr().out.splitlines()[-1]
    quads, modulus, peak, energy, *_, crossings, _ = [
        cell.strip() for cell in last.split("|")[1:-1]
    ]
    assert (quads, peak, energy, crossings) == ("6", "nan", "nan", "0")
    assert float(modulus) == pytest.approx(3.1, rel=0.02)
