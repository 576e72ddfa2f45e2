"""Reads the file of a custom structure and lists its faults, one line each."""

import json
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from sweep.config.faults import MisfitError, in_words
from sweep.config.reading.text import text_of
from sweep.config.structures.structure import (
    Load,
    PointMass,
    Prescribed,
    SpringPart,
    Structure,
    Support,
    pieces_of,
)

MAX_ELEMENTS = 50_000
TOUCHING = 1e-9  # share of half a thickness: round-off
_PARTS = (Structure, Support, Load, Prescribed, PointMass, SpringPart)
_EITHER = {"wall_thickness_mm", "subdivide", "initial_velocity_mm_s"}
_KEYS = list(dict.fromkeys(key for part in _PARTS for key in part.model_fields))


class StructureError(MisfitError):
    """A structure that cannot be used; `lines`: its faults, one line each."""

    def __init__(self, lines: Sequence[str]) -> None:
        super().__init__(lines)
        self.lines = list(lines)

    def __str__(self) -> str:
        return "\n".join(self.lines)


def read_structure(path: Path, check: Callable[..., Iterator[str]] | None = None) -> Structure:
    """Read and check a file; `StructureError` holds all faults. check: `faults`, or another
    check.
    """
    try:
        text = text_of(path, "a JSON file")
        _check_object(text)
        structure = Structure.model_validate_json(text)
    except ValidationError as error:
        raise StructureError(list(_misfits(error))) from None
    except MisfitError as error:
        raise StructureError([str(error)]) from None
    lines = list((check or faults)(structure))
    if lines:
        raise StructureError(lines)
    return structure


def _check_object(text: str) -> None:
    """Refuse a text that is no JSON object."""
    try:
        document = json.loads(text, object_pairs_hook=_without_repeats)
    except MisfitError:
        raise
    except json.JSONDecodeError as error:
        raise MisfitError(f"not JSON at line {error.lineno}, column {error.colno}") from None
    except (ValueError, RecursionError):
        raise MisfitError("not JSON (a number too long, or nested too deeply)") from None
    if not isinstance(document, dict):
        raise MisfitError("not a JSON object; allowed: { ... } with nodes_mm and walls")
    if Structure.model_fields.keys().isdisjoint(document):
        raise MisfitError(
            "of another program; needed: nodes_mm, pairs of mm, and walls, pairs of nodes"
        )


def _without_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object of JSON; refused if it has a key twice, of which readers take the last."""
    counts = Counter(key for key, _ in pairs)
    if repeated := [key for key, count in counts.items() if count > 1]:
        raise MisfitError(f"{repeated[0]} stands twice in one object; allowed: once")
    return dict(pairs)


def _misfits(error: ValidationError) -> Iterator[str]:
    """One line for each fault of form; a value with two allowed forms gets the fault of the closer
    one.
    """
    closest: dict[object, tuple[int, str]] = {}
    errors = error.errors()
    inside = {wrong["loc"][:depth] for wrong in errors for depth in range(len(wrong["loc"]))}
    unknown = {wrong["loc"][:-1] for wrong in errors if wrong["type"] == "extra_forbidden"}
    for wrong in errors:
        follows = wrong["type"] == "missing" and wrong["loc"][:-1] in unknown
        if wrong["loc"] in inside or follows:
            continue
        loc = [part for part in wrong["loc"] if isinstance(part, int) or part in _KEYS]
        place = loc[0] if loc and loc[0] in _EITHER else tuple(wrong["loc"])
        depth, line = len(loc), _misfit(loc, dict(wrong))
        if depth > closest.get(place, (-1, ""))[0]:
            closest[place] = depth, line
    yield from (line for _, line in closest.values())


def _misfit(loc: Sequence[str | int], wrong: dict[str, Any]) -> str:
    if wrong["type"] == "extra_forbidden":
        *loc, key = wrong["loc"]
        keys = _KEYS if loc else [*Structure.model_fields]
        near = get_close_matches(str(key), keys, n=1, cutoff=0.0)[0]
        return f"{_where((*loc, key))}: unknown key; the nearest is {near}"
    if wrong["type"] == "missing":
        return f"{_where(wrong['loc'])} is missing"
    allowed = wrong["msg"].removeprefix("Input should be ").removeprefix("Input should ")
    if wrong["type"] == "too_short":
        allowed = f"at least {wrong['ctx']['min_length']} values"
    return _fault(loc, wrong["input"], f"does not fit; allowed: {allowed}")


def _where(loc: Sequence[str | int]) -> str:
    """The place of a value, such as supports[0].node."""
    dotted = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in loc)
    return dotted.removeprefix(".")


def _fault(loc: Sequence[str | int], value: object, wrong: str) -> str:
    return f"{_where(loc)} = {in_words(value)}: {wrong}"


def faults(structure: Structure) -> Iterator[str]:
    """The faults of a structure of valid form."""
    unknown = list(_unknown_nodes(structure))
    if unknown:
        yield from unknown
        return
    yield from _lists(structure)
    yield from _drives(structure)
    geometry = list(_geometry(structure))
    yield from geometry or _loose(structure)


def faults_of_lists(structure: Structure) -> Iterator[str]:
    """The faults of the lists of a structure alone, as its walls may cross."""
    unknown = list(_unknown_nodes(structure))
    yield from unknown or _lists(structure)


def _node_references(structure: Structure) -> Iterator[tuple[tuple[str | int, ...], int]]:
    """Every reference to a node: its place in the file, and the number of the node."""
    for k, ends in enumerate(structure.walls):
        yield from ((("walls", k, side), node) for side, node in enumerate(ends))
    for k, spring in enumerate(structure.springs):
        yield from ((("springs", k, "nodes", side), node) for side, node in enumerate(spring.nodes))
    for key in ("supports", "loads", "prescribed", "masses"):
        yield from (((key, k, "node"), part.node) for k, part in enumerate(getattr(structure, key)))
    for key in ("pins", "probes"):
        yield from (((key, k), node) for k, node in enumerate(getattr(structure, key)))


def _unknown_nodes(structure: Structure) -> Iterator[str]:
    last = len(structure.nodes_mm) - 1
    for loc, node in _node_references(structure):
        if node > last:
            yield _fault(loc, node, f"no such node; allowed: 0 to {last}")


def _lists(structure: Structure) -> Iterator[str]:
    """Faults of lists with too many or too few entries."""
    walls, nodes = len(structure.walls), len(structure.nodes_mm)
    for key, entries, count, what in (
        ("wall_thickness_mm", structure.thickness_mm, walls, "wall"),
        ("subdivide", structure.pieces, walls, "wall"),
        ("initial_velocity_mm_s", structure.velocity_mm_s, nodes, "node"),
    ):
        if len(entries) != count:
            allowed = f"one value, or one for each {what}, {count} here"
            yield _fault(
                (key,), getattr(structure, key), f"{len(entries)} values; allowed: {allowed}"
            )
    if sum(structure.pieces) > MAX_ELEMENTS:
        allowed = f"at most {MAX_ELEMENTS:,} elements in all, {sum(structure.pieces):,} here"
        yield _fault(("subdivide",), structure.subdivide, f"does not fit; allowed: {allowed}")


def _drives(structure: Structure) -> Iterator[str]:
    """Faults of prescribed moves, loads and pins that contradict one another."""
    driven: set[tuple[int, str]] = set()
    for k, part in enumerate(structure.prescribed):
        turned = part.direction == "rotation"
        quantity, other = ("angle_rad", "displacement_mm")[:: 1 if turned else -1]
        if getattr(part, quantity) is None or getattr(part, other) is not None:
            wrong = f"does not fit; allowed: {quantity}, and no {other}, with this direction"
            yield _fault(("prescribed", k, "direction"), part.direction, wrong)
        coordinate = part.node, part.direction
        if coordinate in structure.restraints or coordinate in driven:
            wrong = "held or moved already; allowed: one support or one prescribed move of each"
            yield _fault(("prescribed", k, "direction"), part.direction, wrong)
        driven.add(coordinate)
    turning = {(load.node, "rotation") for load in structure.loads if load.moment_Nmm}
    for k, node in enumerate(structure.pins):
        if (node, "rotation") in structure.restraints | driven | turning:
            wrong = "has no rotation to fix, move or load; allowed: nodes without these"
            yield _fault(("pins", k), node, wrong)


def _geometry(structure: Structure) -> Iterator[str]:
    """Faults of geometry: walls and springs without length, walls that cross or overlap."""
    import numpy as np
    from shapely import STRtree, intersects, linestrings

    points = np.array(structure.nodes_mm)
    ends = np.array(structure.walls)
    for k, (a, b) in enumerate(structure.walls):
        if structure.nodes_mm[a] == structure.nodes_mm[b]:
            yield _fault(("walls", k), (a, b), "has no length; allowed: two nodes apart")
            return
    for k, (a, b) in enumerate(spring.nodes for spring in structure.springs):
        if structure.nodes_mm[a] == structure.nodes_mm[b]:
            yield _fault(("springs", k, "nodes"), (a, b), "has no length; allowed: two nodes apart")
    if structure.floor_y_mm is not None:
        yield from _sunk(structure, structure.floor_y_mm)
    lines = linestrings(points[ends])
    one, two = STRtree(lines).query(lines)
    one, two = one[one < two], two[one < two]
    shared = ends[one][:, :, None] == ends[two][:, None, :]
    apart = ~shared.any(axis=(1, 2))
    for i, j in zip(one[apart], two[apart], strict=True):
        if intersects(lines[i], lines[j]):
            wrong = f"meets wall {i} without a common node; allowed: walls that meet at nodes"
            yield _fault(("walls", int(j)), structure.walls[j], wrong)
    for i, j in zip(one[~apart], two[~apart], strict=True):
        if _overlap(points, structure.walls[i], structure.walls[j]):
            wrong = f"lies upon wall {i}; allowed: walls in different directions at a node"
            yield _fault(("walls", int(j)), structure.walls[j], wrong)


def _sunk(structure: Structure, floor: float) -> Iterator[str]:
    """The fault of a floor above the lowest surface of the walls."""
    reaches = [
        (structure.nodes_mm[node][1] - 0.5 * thickness, node, 0.5 * thickness)
        for wall, thickness in zip(structure.walls, structure.thickness_mm, strict=True)
        for node in wall
    ]
    lowest, node, half = min(reaches)
    if floor > lowest + TOUCHING * half:
        wrong = f"node {node} is {lowest + half - floor:g} mm above it, half its wall {half:g} mm"
        yield _fault(("floor_y_mm",), floor, f"{wrong}; allowed: at most {lowest:g} here")


def _overlap(points: Any, one: tuple[int, int], two: tuple[int, int]) -> bool:
    """True for walls that leave a common node in the same direction."""
    for node in set(one) & set(two):
        u, v = (
            points[wall[1] if wall[0] == node else wall[0]] - points[node] for wall in (one, two)
        )
        cross, dot = u[0] * v[1] - u[1] * v[0], float(u @ v)
        if dot > 0.0 and abs(cross) <= 1e-9 * dot:
            return True
    return False


def _loose(structure: Structure) -> Iterator[str]:
    """Faults of nodes without walls, and of walls that are not connected to the first one."""
    used = {node for wall in structure.walls for node in wall}
    for k, at in enumerate(structure.nodes_mm):
        if k not in used:
            yield _fault(("nodes_mm", k), at, "no wall ends here; allowed: nodes of walls")
    pairs = [*structure.walls, *(spring.nodes for spring in structure.springs)]
    piece = pieces_of(len(structure.nodes_mm), pairs)
    for k, wall in enumerate(structure.walls):
        if piece[wall[0]] != piece[structure.walls[0][0]]:
            wrong = "not connected with wall 0; allowed: a structure in one piece"
            yield _fault(("walls", k), wall, wrong)
            return
