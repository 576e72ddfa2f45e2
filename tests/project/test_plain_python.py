"""The same results from kernels as plain Python, and with nonsense in memory that is freed."""

import os
import subprocess
import sys

import pytest

PROGRAM = """
from sweep import simulate
from sweep.config.structures.structure import Load, Structure, Support
from sweep.config.case import Case

crush = Case.of(
    lattice=dict(cells_x=1, cells_y=1, nodes_per_wall=1),
    loading=dict(mode="displacement", strain=0.005),
    solver=dict(load_steps=2),
)
clamp = Support(node=0, fix=("x", "y", "rotation"))
tip = Load(node=1, force_N=(0.0, -1e-3))
wall = Structure(nodes_mm=((0, 0), (10, 0)), walls=((0, 1),), supports=(clamp,), loads=(tip,))
path = Case.of(
    lattice=dict(kind="custom", structure=wall),
    solver=dict(integrator="arc_length", load_steps=3),
)
for case in (crush, path):
    result = simulate(case)
    summary = result.summary
    counts = summary["steps"], summary["newton_iterations"], len(result.history["time_s"])
    print(result.status, *counts)
    print(summary["absorbed_energy_J"])
"""
NONSENSE = {"MALLOC_PERTURB_": "165", "GLIBC_TUNABLES": "glibc.malloc.tcache_count=0"}


def output(**environment):
    run = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env=os.environ | environment,
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stderr
    return run.stdout.splitlines()


@pytest.fixture(scope="module")
def compiled():
    return output()


@pytest.mark.parametrize(
    "environment", [{"NUMBA_DISABLE_JIT": "1"}, NONSENSE], ids=["plain", "freed"]
)
def test_simulations_find_the_same(compiled, environment):
    crush, crushed, path, bent = output(**environment)
    assert [crush, path] == compiled[::2]
    assert crush.startswith("converged")
    assert path.startswith("converged")
    energies = [float(energy) for energy in (crushed, bent)]
    assert energies == pytest.approx([float(energy) for energy in compiled[1::2]], rel=1e-9)
