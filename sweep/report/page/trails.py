"""Stores walls of a shape as few long polylines, or as faces, and shapes as short text; plates at
rest as their plan.
"""

from base64 import b64encode
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.numbers import in_unit
from sweep.ranking.budget import ROUND_OFF
from sweep.report.figures.shaded import AMBIENT, CAMERA, COLOURS, LIGHT, ring
from sweep.report.outlines import outlines
from sweep.report.page.thinning import numbers, thinned

STRAIGHT = 0.03  # share of the wall thickness: nodes nearer to a straight wall are not drawn
UNIT = 1e-5  # m: coordinates of drawings are multiples of it
GRID = 65535  # steps of a coordinate of a frame
FRAMES = 24
PLATEN = 0.05  # share of the width of plates by which their platens are wider
LEVEL = 1e-6  # share of the height within which nodes have one height


class Trail(NamedTuple):
    """Elements of equal thickness (m) in a row: their nodes, the first again if it is closed."""

    thickness: float
    nodes: list[int]


def trails(position: Floats, edges: Ints, thickness: Floats) -> list[Trail]:
    """All elements, each in one trail; a trail goes straight on at a joint where it can.

    position (n, 2) m; edges (m, 2); thickness (m,).
    """
    follows = _pairs(position, edges, thickness)
    free = dict.fromkeys(range(len(edges)))
    ends = [(e, side) for e in free for side in (0, 1) if (e, side) not in follows]
    closed = [(e, 0) for e in range(len(edges))]
    walks = []
    for e, side in [*ends, *closed]:
        if e in free:
            walks.append(Trail(float(thickness[e]), _walk(e, side, edges, follows, free)))
    return walks


def _pairs(
    position: Floats, edges: Ints, thickness: Floats
) -> dict[tuple[int, int], tuple[int, int]]:
    """The end of an element (element, side) that continues another one, the straightest first."""
    chord = position[edges[:, 1]] - position[edges[:, 0]]
    away = chord / np.linalg.norm(chord, axis=1, keepdims=True)
    at_node: dict[tuple[int, float], list[tuple[int, int]]] = {}
    for e, nodes in enumerate(edges.tolist()):
        for side in (0, 1):
            at_node.setdefault((nodes[side], float(thickness[e])), []).append((e, side))
    pairs = {}
    for arms in at_node.values():
        for i, k in [(0, 1)] if len(arms) == 2 else _straightest(arms, away):
            pairs[arms[i]], pairs[arms[k]] = arms[k], arms[i]
    return pairs


def _straightest(arms: Sequence[tuple[int, int]], away: Floats) -> Iterator[tuple[int, int]]:
    """Disjoint pairs of the arms of a node, the straightest pair first.

    arms: (element, side); away (m, 2): directions of the elements.
    """
    ways = np.array([away[e] if side == 0 else -away[e] for e, side in arms])
    cosines = ways @ ways.T
    rows, columns = np.triu_indices(len(cosines), 1)
    left = set(range(len(cosines)))
    for k in np.argsort(cosines[rows, columns], kind="stable"):
        pair = int(rows[k]), int(columns[k])
        if left.issuperset(pair):
            left -= set(pair)
            yield pair


def _walk(
    e: int,
    side: int,
    edges: Ints,
    follows: Mapping[tuple[int, int], tuple[int, int]],
    free: dict[int, None],
) -> list[int]:
    """Nodes from one end of an element on, along elements that are still free."""
    nodes = [int(edges[e, side])]
    while e in free:
        del free[e]
        nodes.append(int(edges[e, 1 - side]))
        e, side = follows.get((e, 1 - side), (-1, 0))
    return nodes


def at_rest(frames: Mapping[str, Any]) -> tuple[Floats, Ints, Floats]:
    """Nodes (n, 2) m, elements (m, 2) and their thickness (m,) at rest; of plates, their plan."""
    position = frames["position_m"][0].astype(float)
    if "quads" not in frames:
        return position, frames["edges"], frames["edge_thickness_m"].astype(float)
    sides = np.concatenate([frames["quads"][:, [k, (k + 1) % 4]] for k in range(4)])
    edges, first = np.unique(np.sort(sides, axis=1), axis=0, return_index=True)
    thickness = np.tile(frames["quad_thickness_m"], 4)[first].astype(float)
    height = position[:, 2]
    bottom = np.all(height[edges] <= height.min() + LEVEL * np.ptp(height), axis=1)
    return position[:, :2], edges[bottom], thickness[bottom]


def drawing(position: Floats, edges: Ints, thickness: Floats) -> dict[str, Any]:
    """A shape at rest: its box (x, y, width, height; mm) and the paths of its walls, by thickness.

    The paths are in units of 0.01 mm, y upwards. Nodes in straight walls are left out.
    """
    paths: dict[float, str] = {}
    for trail in trails(position, edges, thickness):
        points = position[trail.nodes]
        kept = thinned(points, len(points), STRAIGHT * trail.thickness)
        wide = round(in_unit(trail.thickness, "mm"), 4)
        paths[wide] = paths.get(wide, "") + _path(np.rint(points[kept] / UNIT).astype(int).tolist())
    half = 0.5 * thickness.max()
    used = position[np.unique(edges)]
    low, size = used.min(0) - half, np.ptp(used, axis=0) + 2.0 * half
    box = [round(in_unit(float(v), "mm"), 3) for v in (*low, *size)]
    return {"box": box, "walls": [[wide, path] for wide, path in paths.items()]}


def _path(points: Sequence[Sequence[int]]) -> str:
    """An SVG path with steps relative to the previous point."""
    x, y = points[0]
    steps = (f"{c - a} {d - b}" for (a, b), (c, d) in pairwise(points))
    return f"M{x} {y}l{' '.join(steps)}"


def moving_shape(frames: Mapping[str, Any], forces: Sequence[Any]) -> dict[str, Any]:
    """Some frames of a case: trails of nodes, and the data of `_moving`.

    frames: from `read_frames`. forces: of every frame (N), None if unknown.
    """
    used, edges = np.unique(frames["edges"], return_inverse=True)
    position = np.asarray(frames["position_m"], float)[:, used]
    lines = trails(position[0], edges.reshape(-1, 2), frames["edge_thickness_m"].astype(float))
    return {
        **_moving(frames, position, forces),
        "profiles": [[*map(_points, shapes)] for shapes in outlines(frames)],
        "trails": [[float(f"{in_unit(t.thickness, 'mm'):.4g}"), t.nodes] for t in lines],
    }


def moving_faces(frames: Mapping[str, Any], forces: Sequence[Any], laid: Floats) -> dict[str, Any]:
    """Some frames of plates: nodes of their quads, as `shaded.faces` draws them. laid (k, 2): how
    far the pieces that are drawn side by side are moved along x and y, m.
    """
    used, quads = np.unique(frames["quads"], return_inverse=True)
    position = np.asarray(frames["position_m"], float)[:, used]
    plan, laid = in_unit(position[0, :, :2], "mm"), in_unit(laid, "mm")
    box = np.stack([plan.min(0), plan.max(0) + laid.max(0)])
    return {
        **_moving(frames, position, forces),
        "quads": quads.reshape(-1, 4).tolist(),
        "laid": _points(laid),
        "ring": _points(ring(box, PLATEN * float(np.ptp(box, axis=0).max()))),
        "camera": CAMERA.tolist(),
        "light": LIGHT.tolist(),
        "ambient": AMBIENT,
        "colours": [[*bytes.fromhex(colour[1:])] for colour in COLOURS],
    }


def _moving(frames: Mapping[str, Any], position: Floats, forces: Sequence[Any]) -> dict[str, Any]:
    """Strain, time, force and platens of some frames, and positions (f, n, c) in m as 16-bit
    numbers in base 64: x = low x + step x number, in mm; frame after frame, node after node.
    """
    chosen = _frame_numbers(np.asarray(frames["strain"]))
    position = in_unit(position[chosen], "mm")
    low = position.min((0, 1))
    step = float((position.max((0, 1)) - low).max()) / GRID or 1.0
    counts = np.rint((position - low) / step).astype("<u2")
    plates = in_unit(frames["plate_y_m"][chosen], "mm")
    return {
        "strain": numbers(in_unit(frames["strain"][chosen], "%")),
        "time": numbers(in_unit(frames["time_s"][chosen], "ms")),
        "force": [forces[i] for i in chosen],
        "plates": [numbers(ends) for ends in plates],
        "low": [float(f"{v:.7g}") for v in low],
        "step": float(f"{step:.9g}"),
        "nodes": position.shape[1],
        "position": b64encode(counts.tobytes()).decode(),
    }


def _points(outline: Floats) -> list[list[float | int | None]]:
    return [numbers(point) for point in outline]


def _frame_numbers(strain: Floats) -> list[int]:
    """At most `FRAMES` numbers of frames: the first, the last and the turning point at the greatest
    strain; the others evenly spaced between them.
    """
    last = len(strain) - 1
    if last < FRAMES:
        return list(range(last + 1))
    reached = strain >= (1.0 - ROUND_OFF) * np.fmax.reduce(strain)
    first_of_each = np.flatnonzero(reached[1:last] & ~reached[: last - 1]) + 1
    turns = first_of_each[: FRAMES - 2].tolist()
    return sorted({*np.linspace(0, last, FRAMES - len(turns)).round().astype(int).tolist(), *turns})
