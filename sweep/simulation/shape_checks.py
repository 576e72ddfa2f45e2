"""Measures of the stored shapes of a case: strains of elements, covered area, crossings.

The model holds as long as no element is shorter than 0.7 of its rest length, `SQUEEZED`. Its walls
keep their thickness, whereas a wall of incompressible TPU is 1.4 times as thick at that strain;
neither bending nor contact takes this into account. The law in compression is derived from tension,
with an error of 30 % or more. Solid finite elements confirm the model within 7 % up to the strain
they reached, with the shortest element at 0.85 of its rest length.
"""

from collections.abc import Mapping

import numpy as np
from shapely import intersects, linestrings

from kernels.geometry import crossing
from kernels.planar.problem import PlanarScene
from kernels.terms.bend import Bend
from kernels.terms.elements import Walls
from kernels.terms.section import LEAST
from kernels.terms.stretch import Stretch
from sweep.array_types import Floats, Ints
from sweep.design.area import covered_area

Deformations = tuple[Floats, Floats, Floats]
Frames = Mapping[str, np.ndarray]
Strains = tuple[Floats, Floats, Floats]
"""In every stored shape, (f, m) each: least and greatest strain of every element or quad, and the
greatest of its surfaces.
"""

SURFACE = np.sqrt(5.0 / 3.0)  # place of the surface over the fibre of `terms.bend`
SQUEEZED = -0.3  # element strain below which the model does not hold
CHUNK = 1 << 16  # pairs in one call of shapely


def strains_of(x: Floats, terms: PlanarScene) -> Strains:
    """`element_strains`, twice, and `surface_strains` of the stored shapes x (f, n)."""
    deformation = deformations(x, terms.walls)
    strains = element_strains(deformation, terms.stretch)
    return strains, strains, surface_strains(deformation, strains, terms.bend)


def element_strains(deformation: Deformations, stretch: Stretch) -> Floats:
    """Nominal strain of every element, along its arc, in every stored shape, (f, m)."""
    length, one, two = deformation
    same, mixed = stretch.arc
    return np.asarray(length / stretch.l0 - 1.0 + same * (one**2 + two**2) + mixed * one * two)


def surface_strains(deformation: Deformations, strains: Floats, bend: Bend) -> Floats:
    """Nominal strain of the most stretched surface of every element, (f, m).

    strains: `element_strains`. Elements that do not bend through their section, such as solid
    joints, count with their strain alone.
    """
    if bend.volume.size == 0:
        return strains
    _, one, two = deformation
    across, along = bend.spread[0] * (two - one), bend.spread[1] * (one + two)
    bent = SURFACE * np.maximum(np.abs(across + along), np.abs(across - along))
    m, stretched = bend.section.m, np.maximum(1.0 + strains, LEAST)
    surface = (stretched**m + m * bent) ** (1.0 / m) - 1.0  # closed form of `terms.section`
    return np.asarray(np.where(bend.volume > 0.0, surface, strains))


def moment_of(values: Floats, limit: float, stored: Floats) -> float:
    """Time (s) at which ``values`` (f,) first exceed a limit, interpolated; NaN if they never do.

    stored (f,): times of the shapes to which the values belong.
    """
    beyond = np.flatnonzero(values > limit)
    if len(beyond) == 0:
        return float("nan")
    at = slice(max(beyond[0] - 1, 0), beyond[0] + 1)
    return float(np.interp(limit, values[at], stored[at]))


def deformations(x: Floats, walls: Walls) -> Deformations:
    """Length (m) and turns of both ends (rad) of every element in every stored shape, (f, m).

    Whole turns are counted as in `terms.elements.measure`.
    """
    ends = x[:, walls.dofs]
    along = ends[..., 3:5] - ends[..., :2]
    one, two = ends[..., 2], ends[..., 5]
    turned = np.arctan2(along[..., 1], along[..., 0])
    turned -= np.arctan2(walls.rest[:, 1], walls.rest[:, 0])
    turned += 2.0 * np.pi * np.rint((0.5 * (one + two) - turned) / (2.0 * np.pi))
    return np.hypot(*np.moveaxis(along, -1, 0)), turned - one, turned - two


def work_within_model(
    strains: Floats, broken: float, stored: Floats, time: Floats, work: Floats
) -> float:
    """Work (J) done until an element strain is first below `SQUEEZED`, or until a wall is broken;
    all of it if neither happens.

    strains (f, m): of the elements in the stored shapes. broken: time of the break, s; NaN: none.
    stored (f,): times of these shapes, s. time (rows,) s, work (rows,) J: of the loading.
    """
    squeezed = moment_of(-strains.min(axis=1), -SQUEEZED, stored)
    moment = np.fmin(squeezed, broken)
    return float(work[-1] if np.isnan(moment) else np.interp(moment, time, work))


def kept_area(frames: Frames) -> float:
    """Area that the walls cover at the greatest strain / at rest.

    NaN for a structure without a strain.
    """
    if np.isnan(frames["strain"]).any():
        return float("nan")
    rest, deepest = frames["position_m"][[0, int(np.argmax(frames["strain"]))]]
    walls = frames["edges"], frames["edge_thickness_m"]
    return covered_area(deepest, *walls) / covered_area(rest, *walls)


def shortening(frames: Frames, bottom: Ints, top: Ints) -> float:
    """1 - distance between the centres of two rows of nodes in the last shape / at rest.

    Rigid motions do not change it. NaN without rows.
    """
    if len(bottom) == 0:
        return float("nan")
    rest, last = frames["position_m"][[0, -1]]
    height, left = (
        np.linalg.norm(shape[top].mean(axis=0) - shape[bottom].mean(axis=0))
        for shape in (rest, last)
    )
    return float(1.0 - left / height)


def crossings(frames: Frames) -> int:
    """Greatest number of pairs of elements that cross one another in a stored shape.

    The check is independent of the solver. Where round-off may decide, shapely's exact predicates
    are used.
    """
    position, edges = frames["position_m"], frames["edges"]
    low, high = position.min(axis=0)[edges].min(axis=1), position.max(axis=0)[edges].max(axis=1)
    arrays = np.ascontiguousarray(position.T), low, high, np.argsort(low[:, 0]), edges
    crossed, unsure = np.empty(len(position), np.int64), np.empty((0, 3), np.int64)
    while (count := crossing.count(*arrays, crossed, unsure)) > len(unsure):
        unsure = np.empty((count, 3), np.int64)
    for begin in range(0, len(unsure), CHUNK):
        *pair, shape = unsure[begin : begin + CHUNK].T
        lines = (linestrings(position[shape[:, None], edges[which]]) for which in pair)
        crossed += np.bincount(shape[intersects(*lines)], minlength=len(crossed))
    return int(crossed.max())
