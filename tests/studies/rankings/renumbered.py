"""Crush the same lattice with its joints and walls in another order: how far do forces differ?

python -m tests.studies.rankings.renumbered: without friction, the results agree within round-off.
With it, they depend on which end of a wall is drawn first: a vertex between two elements counts
once, with the slip of the element that is not its owner (`contact_near_joints.owners`).
"""

import sys
from dataclasses import replace
from unittest.mock import patch

import numpy as np

from sweep.config.case import Case
from sweep.design.lattice import build_network
from sweep.scene.mesh import build_mesh
from tests.support.converged import converged

ORDERS = 8
COLUMNS = ("absorbed_energy_J", "absorbed_energy_until_packed_J", "peak_force_N")


def renumbered(network, seed):
    """The network with its joints and walls in a random order, and walls from either end."""
    rng = np.random.default_rng(seed)
    order = rng.permutation(len(network.points))
    number = np.argsort(order)
    walls = number[network.walls]
    turned = rng.random(len(walls)) < 0.5
    walls[turned] = walls[turned, ::-1]
    shuffled = rng.permutation(len(walls))
    return replace(
        network,
        points=network.points[order],
        walls=walls[shuffled],
        wall_thickness=network.wall_thickness[shuffled],
        bottom=number[network.bottom],
        top=number[network.top],
    )


def crushed(case, seed):
    """Result of a case; seed: of the order, None for the order of the product."""
    if seed is None:
        return converged(case)

    def build(geometry):
        return renumbered(build_network(geometry), seed)

    build_mesh.cache_clear()
    with (
        patch("sweep.scene.mesh.build_network", build),
        patch("sweep.scene.lattice.build_network", build),
    ):
        result = converged(case)
    build_mesh.cache_clear()
    return result


def scene(friction, imperfection=0.01):
    """The 3 x 3 grid pressed by half between loose platens."""
    return Case.of(
        lattice=dict(imperfection=imperfection),
        material=dict(name="ultimaker_tpu95a"),
        loading=dict(mode="displacement", strain=0.5, platen="contact"),
        contact=dict(friction=friction),
        solver=dict(tolerance=1e-10),
    )


def spreads(case):
    """Range over all orders of some columns and of the force along the way, as shares."""
    results = [crushed(case, seed) for seed in (None, *range(ORDERS))]
    found = {}
    for name in COLUMNS:
        values = np.array([result.summary[name] for result in results])
        found[name] = np.ptp(values) / max(np.abs(values).max(), 1e-300)
    curves = np.array([result.history["reaction_top_N"] for result in results])
    found["force along the way"] = np.ptp(curves, axis=0).max() / np.abs(curves).max()
    return found


def main():
    """Print the spreads."""
    for imperfection in (0.0, 0.01, 0.1):
        for friction in (0.0, 0.3, 1.0):
            found = spreads(scene(friction, imperfection))
            shares = ", ".join(f"{name} {100.0 * share:.2g} %" for name, share in found.items())
            sys.stdout.write(f"imperfection {imperfection}, friction {friction}: {shares}\n")


if __name__ == "__main__":
    main()
