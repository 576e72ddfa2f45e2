"""Columns, a cross, cells, grids and a patch of hexagons, with some nodes moved far."""

import numpy as np

from sweep.design.lattice import build_network
from tests.studies.validation.joints import ARM, CROSS
from tests.support.designs.structures import CLAMPED, LENGTH, MM
from tests.support.designs.tables import lattice_with

HINGED = ["x", "y"]
FLAT = 12.5  # mm, height and width of the grid
SIDE = 4.0  # mm, of a hexagon
REGULAR = {"width": 2.5 * 3.0**0.5 * SIDE, "height": 3.5 * SIDE}  # of two rows of two hexagons


def column(clamped, slenderness, share):
    """A column of this thickness / length whose end moves along it by a share of its length."""
    fix = CLAMPED if clamped else HINGED
    return {
        "nodes_mm": [[0, 0], [LENGTH, 0]],
        "walls": [[0, 1]],
        "wall_thickness_mm": slenderness * LENGTH,
        "supports": _held((0, 1), fix, (1,), "x"),
    } | _moved([1], "x", displacement_mm=-share * LENGTH)


def cross(slenderness, angle):
    """Four clamped arms of this thickness / length; the joint turns by an angle, rad."""
    turned = _moved([0], "rotation", angle_rad=angle)
    return CROSS | turned | {"wall_thickness_mm": slenderness * ARM}


def cell(slenderness, share):
    """A square cell whose walls bend as two plates come nearer; its corners are hinged to them."""
    corners = LENGTH * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    return {
        "nodes_mm": corners.tolist(),
        "walls": [[0, 1], [1, 2], [2, 3], [3, 0]],
        "wall_thickness_mm": slenderness * LENGTH,
        "supports": _held(range(4), HINGED, (2, 3), "y"),
    } | _moved([2, 3], "y", displacement_mm=-share * LENGTH)


def on_corner(slenderness, share):
    """A square cell that stands on a corner, with a share of its height pressed upon the other."""
    half = LENGTH / np.sqrt(2.0)
    return {
        "nodes_mm": [[0, 0], [half, half], [0, 2 * half], [-half, half]],
        "walls": [[0, 1], [1, 2], [2, 3], [3, 0]],
        "wall_thickness_mm": slenderness * LENGTH,
        "supports": _held((0, 2), CLAMPED, (2,), "y"),
    } | _moved([2], "y", displacement_mm=-share * 2 * half)


def grid(thickness, share):
    """The grid of 3 x 3 cells, glued, perfect; thickness in mm, and a share of the height."""
    box = {"cells_x": 3, "cells_y": 3, "width": FLAT * MM, "height": FLAT * MM}
    return _glued(lattice_with(kind="square", **box), thickness, share)


def hexagons(slenderness, share):
    """Two rows of two regular hexagons, glued; thickness / side, and a share of the height."""
    box = {"cells_x": 2, "cells_y": 2, **{key: size * MM for key, size in REGULAR.items()}}
    return _glued(lattice_with(kind="hex", **box), slenderness * SIDE, share)


def _glued(lattice, thickness, share):
    """A lattice as a structure; its outer rows are clamped, and their own walls left out."""
    network = build_network(lattice.geometry)
    points, rows = network.points / MM, [network.bottom.tolist(), network.top.tolist()]
    held = {*rows[0], *rows[1]}
    return {
        "nodes_mm": points.tolist(),
        "walls": [wall for wall in network.walls.tolist() if not set(wall) <= held],
        "wall_thickness_mm": thickness,
        "supports": _held(sorted(held), CLAMPED, rows[1], "y"),
    } | _moved(rows[1], "y", displacement_mm=-share * np.ptp(points[:, 1]))


def _held(nodes, fix, moved, direction):
    """Supports of nodes, except in the ``direction`` in which some are moved."""
    return [
        {"node": node, "fix": [way for way in fix if node not in moved or way != direction]}
        for node in nodes
    ]


def _moved(nodes, direction, **move):
    """Prescribed moves of nodes, which are the probes too."""
    led = [{"node": node, "direction": direction, **move} for node in nodes]
    return {"prescribed": led, "probes": nodes}
