"""Lattices as slicers print them: checks of pattern and lines; the infill for a share or a mass."""

from __future__ import annotations

from math import isnan
from typing import TYPE_CHECKING, Any

from sweep.config.lattice_limits import MAX_NODES, check_openings
from sweep.config.tables import refusal
from sweep.design.slicer.patterns import (
    NO_PRISMS,
    SLICERS,
    distance_of,
    lines_at_most,
)

if TYPE_CHECKING:
    from sweep.config.lattice_table import Lattice


def check_pattern(lattice: Lattice, patterns: dict[str, str]) -> None:
    """Refuse a pattern that is no prism of the slicer, and keys that a slicer has no use for."""
    key, pattern, names = (
        "lattice.pattern",
        lattice.pattern,
        ", ".join(map('"{}"'.format, patterns)),
    )
    if pattern is None:
        raise refusal(key, None, f"{names}, as lattice.slicer is given")
    if pattern not in patterns:
        named = pattern.lower().replace(" ", "")
        why, nearest = NO_PRISMS.get(named, ("", "grid"))
        nearest = next((own for own, known in patterns.items() if known == nearest), "grid")
        reason = f"; {pattern} is no prism, as {why}: the nearest is {nearest}" if why else ""
        raise refusal(key, pattern, f"{names}{reason}")
    if lattice.mass is None and lattice.infill is None:
        raise refusal("lattice.infill", None, 'a share such as "20 %", or a lattice.mass')
    count = lattice.fill_multiline
    if count > lines_at_most(lattice.slicer or "", patterns[pattern]):
        allowed = '1; more with lattice.slicer "orca" and a pattern other than honeycomb'
        raise refusal("lattice.fill_multiline", count, allowed)
    fixed = {"kind": "square", "orientation": None, "grading": 1.0, "solid_layers": 0}
    for name, value in fixed.items():
        if getattr(lattice, name) != value:
            allowed = f"none, as lattice.slicer is given and lattice.pattern is {pattern}"
            raise refusal(f"lattice.{name}", getattr(lattice, name), allowed)


def check_lines(lattice: Lattice) -> None:
    """Refuse lines that are higher than wide, and perimeters that are absent or leave no room."""
    width, height = lattice.line_width or 0.0, lattice.layer_height or 0.0
    if height > width:
        raise refusal("lattice.layer_height", height, f"at most the line width, {width:g} m")
    most = int(0.5 * min(lattice.width, lattice.height) / lattice.line)
    if not 1 <= lattice.perimeters < most:
        allowed = f"1 to {most - 1}, as lattice.slicer is given: perimeters hold the infill"
        raise refusal("lattice.perimeters", lattice.perimeters, allowed)


def spacing_of(lattice: Lattice, share: float) -> dict[str, Any]:
    """What follows from a share of infill: the distance of lines, and about how many cells fit."""
    pattern = SLICERS[lattice.slicer or ""][lattice.pattern or ""]
    distance = distance_of(pattern, share, lattice.lines)
    cells = {
        f"cells_{axis}": max(1, round(size / distance))
        for axis, size in (("x", lattice.width), ("y", lattice.height))
    }
    if cells["cells_x"] * cells["cells_y"] > MAX_NODES:
        allowed = f"a share whose lines make at most {MAX_NODES:,} cells in this box"
        raise refusal("lattice.infill", share, allowed)
    for key, value in cells.items():
        if key in lattice.model_fields_set and getattr(lattice, key) != value:
            allowed = f"{value}, as lattice.slicer is given"
            raise refusal(f"lattice.{key}", getattr(lattice, key), allowed)
    return {"infill": share, "fill_distance": distance, **cells}


def with_mass(lattice: Lattice, density: float) -> Lattice:
    """The lattice with the share of infill with which its `mass` is extruded."""
    from sweep.design.slicer.network import LEAST_SHARE, share_for

    wanted = lattice.mass or 0.0
    pattern = lattice.printed_as
    most = 0.5 * pattern.opening * pattern.directions / pattern.wall
    first = lattice.model_copy(update=spacing_of(lattice, LEAST_SHARE))
    per_area = density * lattice.depth
    share, *bounds = share_for(first.geometry, wanted / per_area, (1.0 - 1e-9) * most)
    if isnan(share):
        light, heavy = (per_area * area for area in bounds)
        allowed = f"between {light:.4g} kg and {heavy:.4g} kg as extruded with this pattern"
        if light < wanted < heavy:
            allowed = "another mass: there a line along a side appears; or another fill_angle"
        raise refusal("lattice.mass", lattice.mass, allowed)
    made = lattice.model_copy(update=spacing_of(lattice, share))
    made.check_size()
    check_openings(made)
    return made
