"""Refuses lattices: flat boxes, closed cells, and drawings that are no period of an endless one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sweep.config.tables import refusal
from sweep.design.infill import trait

if TYPE_CHECKING:
    from sweep.config.lattice_table import Lattice

CUSTOM = "custom"
# The factor of a lattice of 70 000 nodes takes 8 GB, and a step several minutes.
MAX_NODES = 50_000
MAX_ASPECT = 1000.0  # of the box; above it the computed areas lose their accuracy


def check_proportion(lattice: Lattice) -> None:
    """Refuse a box whose aspect ratio is too large."""
    key, other = ("width", "height") if "width" in lattice.model_fields_set else ("height", "width")
    value, side = getattr(lattice, key), getattr(lattice, other)
    least, most = side / MAX_ASPECT, side * MAX_ASPECT
    if not least <= value <= most:
        allowed = f"from {least:g} m to {most:g} m, a thousandth to a thousand times the {other}"
        raise refusal(f"lattice.{key}", value, allowed)


def check_openings(lattice: Lattice) -> None:
    """Refuse walls as thick as the openings between them, and an outline that fills cells."""
    limit, thickness = lattice.thickest, lattice.wall_thickness
    if thickness >= limit * (1.0 - 1e-12):
        if lattice.infill is not None:
            allowed = "a share that leaves cells at least twice as wide as their walls"
            raise refusal("lattice.infill", lattice.infill, allowed)
        allowed = f"below half the width of the narrowest cell, {limit:.4g} m here"
        raise refusal("lattice.wall_thickness", thickness, allowed)
    if lattice.slicer is not None:
        return
    gap = lattice.opening - thickness
    for axis, key in enumerate(("perimeters", "solid_layers")):
        outline, count = lattice.outline[axis], getattr(lattice, key)
        if count and outline >= gap:
            most = int(gap / (outline / count))
            allowed = f"at most {most} here, thinner in all than cells are open, {gap:.4g} m"
            raise refusal(f"lattice.{key}", count, allowed)


def check_period(lattice: Lattice) -> None:
    """Refuse a lattice that cannot be the period of an endless one."""
    endless = 'if lattice.boundary is "periodic"'
    if lattice.kind == CUSTOM:
        raise refusal("lattice.boundary", "periodic", '"free" if lattice.kind is "custom"')
    if lattice.slicer is not None:
        raise refusal("lattice.boundary", "periodic", '"free" if lattice.slicer is given')
    for key, value in {**lattice.neutral, "infill": None}.items():
        if key not in ("boundary", "symmetry") and getattr(lattice, key) != value:
            wanted = "none" if value is None else f"{value:g}"
            raise refusal(f"lattice.{key}", getattr(lattice, key), f"{wanted} {endless}")
    key = "cells_x" if lattice.orientation == "flat" else "cells_y"
    if trait(lattice.kind, "STAGGERED") and getattr(lattice, key) % 2:
        allowed = f"an even number {endless}, as every other row of {lattice.kind} is shifted"
        raise refusal(f"lattice.{key}", getattr(lattice, key), allowed)
