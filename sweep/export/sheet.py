"""A part of a sheet: its walls over a panel, or the block that a slicer fills.

Both faces of a wall lie half its thickness from a fine net of one period (`design.surfaces`), which
is repeated over the panel and beyond, and cut to size. The sheet meets the pressed faces steeply,
and is moved along them there.
"""

from collections.abc import Sequence

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.config.case import Case
from sweep.config.kinds.direction import ALONG
from sweep.config.kinds.sheet import Surface
from sweep.config.kinds.sliced_sheet import SlicedSheet
from sweep.constants import TO_MM, TO_MM3
from sweep.design.surfaces.nets import Net
from sweep.design.surfaces.panel import net_of, printed_thickness
from sweep.export.errors import ExportError
from sweep.export.outline import Layout, block
from sweep.export.solid import Body, within_box
from sweep.numbers import in_unit

QUADS = 16  # cells of the net in a period
MOST_PERIODS = 2_000  # a file of 150 MB
BEYOND = 1  # period of the net around the panel


def sheet_panel(case: Case, sides: Sequence[float] | None) -> tuple[Body, list[str]]:
    """The walls over a panel of two lengths (m), as they are printed, and a description."""
    lattice = _sheet_of(case)
    if not lattice.tied_sides:
        raise ExportError(
            f"case {case.case_id} is a block within perimeters, whose walls the slicer lays; "
            "allowed: a .3mf with --kind settings, .csv, .vtkhdf, .gif"
        )
    first, second = _two(case, sides)
    periods = first * second / (case.footprint[0] * case.footprint[1])
    if first < case.footprint[0] or second < case.footprint[1]:
        period = " x ".join(f"{TO_MM * side:.4g}" for side in case.footprint)
        raise ExportError(f"the panel is smaller than a period; allowed: at least {period} mm")
    if periods > MOST_PERIODS:
        raise ExportError(
            f"a panel of {periods:.0f} periods; allowed: at most {MOST_PERIODS:,}, or a .3mf of "
            "the kind settings"
        )
    net = net_of(lattice.sheet, lattice.turned, lattice.period, lattice.pressed_height, QUADS)
    walls = _walls(net, _half_thickness(lattice, net), (first, second))
    walls = walls._replace(points=TO_MM * walls.points)
    body = within_box(walls, [TO_MM * side for side in (first, second, lattice.pressed_height)])
    if lattice.pressed != ALONG:
        body = body.stood_up
    if not body.is_closed:
        raise ExportError(f"the mesh of case {case.case_id} is not closed; allowed: another panel")
    weighs = in_unit(case.material.density * body.volume / TO_MM3, "g")
    description = f"{_description(case, first, second)}; the body weighs {weighs:.4g} g"
    return body, [description]


def sheet_block(case: Case, sides: Sequence[float] | None) -> tuple[Layout, list[str]]:
    """The block over a panel of two lengths (m), or within perimeters, as it is printed, and a
    description.
    """
    import shapely

    lattice = _sheet_of(case)
    if not lattice.tied_sides:
        return _within_perimeters(case, sides)
    first, second = _two(case, sides)
    height = lattice.pressed_height
    plan, depth = (
        ((first, second), height) if lattice.pressed == ALONG else ((first, height), second)
    )
    shape = shapely.box(0.0, 0.0, *(TO_MM * side for side in plan))
    grams = _grams(case, first, second)
    layout = Layout(case.case_id, shape, TO_MM * depth, 1, 1, grams)
    return layout, [_description(case, first, second)]


def _within_perimeters(case: Case, sides: Sequence[float] | None) -> tuple[Layout, list[str]]:
    lattice = _sheet_of(case)
    if sides is not None:
        raise ExportError(f"case {case.case_id} is one block within perimeters; allowed: no panel")
    grams = in_unit(case.material.density * lattice.extruded, "g")
    size = " x ".join(f"{TO_MM * side:.4g}" for side in (*lattice.outer_size, lattice.depth))
    pressed = f"pressed {'along' if case.along else 'across'} the print axis, which is z"
    layout = Layout(case.case_id, block(lattice), TO_MM * lattice.depth, 1, 1, grams)
    return layout, [f"{size} mm, {pressed}: rank counts {grams:.4g} g"]


def _sheet_of(case: Case) -> Surface:
    assert isinstance(case.lattice, Surface)
    return case.lattice


def _two(case: Case, sides: Sequence[float] | None) -> tuple[float, float]:
    """The lengths of the panel, which a sheet needs."""
    if sides is None:
        raise ExportError(
            f"case {case.case_id} is one period of a sheet; allowed with a panel, such as "
            '--panel "100 mm" "50 mm"'
        )
    return sides[0], sides[1]


def _half_thickness(lattice: Surface, net: Net) -> Floats:
    """Half the thickness at each node, (n,) in m."""
    line, along = lattice.wall_thickness, lattice.pressed == ALONG
    if isinstance(lattice, SlicedSheet):
        return 0.5 * printed_thickness(line, lattice.layer_height, net.normals, along)
    return np.full(len(net.points), 0.5 * line)


def _walls(net: Net, half: Floats, sides: tuple[float, float]) -> Body:
    """Walls over more than the panel, in m: both faces, and the edges between them."""
    node, tile, quads = _laid(net, sides)
    middle = net.points[node]
    middle[:, :2] += tile * net.box.size[:2]
    move = half[:, None] * net.normals
    outer = np.concatenate([net.bottom, net.top])
    move[outer, 2] = 0.0
    move[outer] *= (half[outer] / np.linalg.norm(move[outer], axis=1))[:, None] ** 2
    faces = np.concatenate([middle + move[node], middle - move[node]])
    n, edges = len(node), _rim(quads)
    rim = np.column_stack([edges[:, 1], edges[:, 0], edges[:, 0] + n, edges[:, 1] + n])
    every = np.concatenate([quads, quads[:, ::-1] + n, rim])
    return Body(faces, np.concatenate([every[:, [0, 1, 2]], every[:, [0, 2, 3]]]))


def _laid(net: Net, sides: tuple[float, float]) -> tuple[Ints, Ints, Ints]:
    """Periods side by side, from `BEYOND` periods before the panel to as many behind it.

    For each of n points the node (n,) of the net and the period (n, 2) in which it is; quads (m,
    4).
    """
    first, low = -BEYOND, -BEYOND - 1  # a corner may be in the previous period
    counts = [
        int(np.ceil(side / one)) + BEYOND for side, one in zip(sides, net.box.size[:2], strict=True)
    ]
    tiles = np.stack(np.meshgrid(*(np.arange(first, count) for count in counts)), -1).reshape(-1, 2)
    place = tiles[:, None, None] + net.shift - low
    shape = (len(net.points), *(count + 1 - low for count in counts))
    node = np.broadcast_to(net.quads, (len(tiles), *net.quads.shape))
    number = np.ravel_multi_index((node, place[..., 0], place[..., 1]), shape)
    points, corner = np.unique(number, return_inverse=True)
    node, *tile = np.unravel_index(points, shape)
    return node, np.column_stack(tile) + low, corner.reshape(-1, 4)


def _rim(quads: Ints) -> Ints:
    """Sides that belong to one quad, (k, 2), in the direction in which it passes them."""
    sides = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    _, first, count = np.unique(np.sort(sides), axis=0, return_index=True, return_counts=True)
    return np.asarray(sides[first[count == 1]])


def _grams(case: Case, first: float, second: float) -> float:
    """Mass of a panel as it is ranked, g."""
    share = first * second / (case.footprint[0] * case.footprint[1])
    return in_unit(case.material.density * _sheet_of(case).extruded * share, "g")


def _description(case: Case, first: float, second: float) -> str:
    """A description of the part, in a sentence."""
    size = " x ".join(f"{TO_MM * side:.4g}" for side in (first, second))
    thick = f"{TO_MM * _sheet_of(case).pressed_height:.4g} mm thick"
    how = "along" if case.along else "across"
    return (
        f"{size} mm, {thick}, pressed {how} the print axis, which is z: rank counts "
        f"{_grams(case, first, second):.4g} g; its edges count as its middle"
    )
