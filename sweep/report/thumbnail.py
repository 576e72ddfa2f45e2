"""A small drawing of a design, as SVG, from the first of its stored shapes."""

from collections.abc import Mapping
from typing import Any

import numpy as np

SIZE = 56  # pixels of the longer side
MOST = 2000  # most lines of a drawing; a denser one is left out
STRAIGHT = 0.02  # sine of the angle between two elements of one line


def thumbnail(frames: Mapping[str, Any]) -> str:
    """The walls at rest as one path of an SVG; for a print that stands upright, its plan. Empty
    without shapes, or if no element lies in the plan.
    """
    if "position_m" not in frames or not len(frames["position_m"]):
        return ""
    points = np.asarray(frames["position_m"][0], dtype=float)
    edges = np.asarray(frames["edges"]) if "edges" in frames else _plan(points, frames["quads"])
    lines = _lines(points[:, :2], edges)
    if not 0 < len(lines) <= MOST:
        return ""
    drawn = points[np.unique(lines), :2]
    low, size = drawn.min(axis=0), np.ptp(drawn, axis=0)
    scale = (SIZE - 2) / max(size.max(), np.finfo(float).tiny)
    x, y = (1 + scale * (points[:, :2] - low)).T
    height = int(scale * size[1]) + 2
    path = "".join(
        f"M{x[i]:.3g} {height - y[i]:.3g}L{x[j]:.3g} {height - y[j]:.3g}" for i, j in lines
    )
    style = 'fill="none" stroke="currentColor" stroke-width="1"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{int(scale * size[0]) + 2}" '
        f'height="{height}" role="img"><path d="{path}" {style}/></svg>'
    )


def _plan(points: np.ndarray, quads: Any) -> np.ndarray:
    """Edges (m, 2) of the quads (k, 4) that lie on the ground."""
    ground = np.isclose(points[:, 2], points[:, 2].min(), atol=STRAIGHT * points[:, 2].std())
    quads = np.asarray(quads)
    sides = np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)])
    return np.unique(np.sort(sides[ground[sides].all(axis=1)], axis=1), axis=0)


def _lines(points: np.ndarray, edges: np.ndarray) -> list[tuple[int, int]]:
    """Ends of the straight lines that elements (m, 2) form, one after another."""
    ends: dict[int, list[int]] = {}
    for k, edge in enumerate(edges.tolist()):
        for node in edge:
            ends.setdefault(node, []).append(k)
    inside = {node for node, [*own] in ends.items() if _is_inside(points, edges, node, own)}
    left, lines = set(range(len(edges))), []
    for k, (i, j) in enumerate(edges.tolist()):
        if k in left:
            left.discard(k)
            lines.append(
                (_follow(edges, ends, inside, left, i), _follow(edges, ends, inside, left, j))
            )
    return lines


def _is_inside(points: np.ndarray, edges: np.ndarray, node: int, own: list[int]) -> bool:
    """Whether a node lies between two elements of one straight line."""
    if len(own) != 2:
        return False
    (ax, ay), (bx, by) = (points[edges[k].sum() - node] - points[node] for k in own)
    return bool(abs(ax * by - ay * bx) <= STRAIGHT * np.hypot(ax, ay) * np.hypot(bx, by))


def _follow(
    edges: np.ndarray, ends: dict[int, list[int]], inside: set[int], left: set[int], node: int
) -> int:
    """The end of a line, starting from one of its nodes, over elements that are left."""
    while node in inside and (further := [k for k in ends[node] if k in left]):
        left.discard(further[0])
        node = int(edges[further[0]].sum()) - node
    return node
