"""The kernels of cases: which they are, and that uncached ones are announced."""

import pytest

from sweep.config.case import Case
from sweep.running.warming import Kernels, inspect_kernels, real_simulate, simulate_unloaded
from sweep.simulation.retries import simulate_again
from sweep.simulation.warm_up import kernels_of

ALONG = {"direction": "out_of_plane"}


@pytest.fixture
def cold(monkeypatch):
    """Kernels none of which is cached, and the names of the loaded ones."""
    loaded = []
    monkeypatch.setattr("kernels.compile.cache.is_cold", lambda name: name not in loaded)
    monkeypatch.setattr("kernels.compile.cache.warmed_up", lambda name: None)
    monkeypatch.setattr("sweep.simulation.warm_up.warm_up", loaded.extend)
    return loaded


def test_cold_kernels_are_announced_and_loaded(cold, capsys, monkeypatch):
    monkeypatch.setattr("kernels.compile.cache.is_lasting", lambda: False)
    assert real_simulate([Case.of()]) is simulate_again
    assert cold == ["marches"]
    first, second = capsys.readouterr().err.splitlines()
    assert first.startswith("compiling the kernels of walls in the plane, once: this takes ")
    assert second.startswith("for this run alone: ")
    sheet, plate = ({"lattice": {"kind": kind}, "loading": ALONG} for kind in ("gyroid", "hex"))
    assert kernels_of(Case.of(**sheet)) == kernels_of(Case.of(**plate)) == "plates"
    real_simulate([Case.of()])
    assert capsys.readouterr().err == ""


def test_for_a_cluster_nothing_is_loaded_here(cold, capsys):
    assert simulate_unloaded([Case.of(), Case.of()]) == (simulate_again, ["marches"])
    assert cold == []
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("lasting", [True, False])
def test_cold_kernels_are_found(monkeypatch, lasting):
    monkeypatch.setattr("kernels.compile.cache.is_lasting", lambda: lasting)
    monkeypatch.setattr("kernels.compile.cache.is_cold", lambda name: name == "plates")
    assert inspect_kernels(["marches", "plates"]) == Kernels(["plates"], lasting)
