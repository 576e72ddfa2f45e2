"""Reads drawings as numbers: the JSON of a structure, CSV of nodes and walls, and LAMMPS data."""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from math import isfinite
from pathlib import Path
from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats
from sweep.config.drawings.lines import METRES, Lines
from sweep.config.faults import MisfitError
from sweep.config.reading.text import foreign_text, rows_of
from sweep.config.structures.structure_file import faults_of_lists, read_structure
from sweep.constants import MM
from sweep.numbers import counted
from sweep.plain_text import plain

MOST_ROWS = 200_000
ROUND_OFF = 1e-6  # share of the size of a box
LINE, NODE, WALL = ("x1", "y1", "x2", "y2"), ("x", "y"), ("from", "to")
IDS = ("node", *WALL)
OTHER_HEADS = {
    **dict.fromkeys(("id", "node_id"), "node"),
    **dict.fromkeys(("source", "start", "node1", "node_1"), "from"),
    **dict.fromkeys(("target", "end", "node2", "node_2"), "to"),
}
"""Other heads, as in files of graphs."""
_HEAD = re.compile(
    rf"({'|'.join((*LINE, *NODE, *IDS, 'thickness'))})(?:[ _]*[(\[]?({'|'.join(METRES)})[)\]]?)?"
)
CSV = 'the heads "x1_mm, y1_mm, x2_mm, y2_mm", or "x_mm, y_mm" of nodes and below "from, to"'
ATOM_STYLES = {
    **dict.fromkeys(("atomic", "hybrid"), 2),
    **dict.fromkeys(("bond", "angle", "molecular", "charge"), 3),
    **dict.fromkeys(("full", "sphere"), 4),
}
"""Place of x in an atom line of LAMMPS, by its style."""
BY_LENGTH = {5: 2, 6: 3, 7: 4, 8: 2, 9: 3, 10: 4}
"""Place of x by the length of a line, if no style is named; from eight on, three image flags
follow.
"""


def read_json(path: Path) -> Lines:
    """Nodes and walls of a structure, which has nothing else but thickness, depth and elements."""
    structure = read_structure(path, faults_of_lists)
    if unfit := structure.beside_walls:
        raise MisfitError(f'has {", ".join(unfit)}; needed: walls alone, or lattice.kind "custom"')
    if isinstance(structure.subdivide, tuple):
        raise MisfitError("subdivide is a list; needed: one number for all walls")
    ends = np.array(structure.nodes_mm)[np.array(structure.walls)]
    stated = structure.model_fields_set
    thickness = np.array(structure.thickness_mm) if "wall_thickness_mm" in stated else None
    depth = MM * structure.depth_mm if "depth_mm" in stated else None
    elements = structure.subdivide if "subdivide" in stated else None
    return Lines(ends, MM, thickness, depth, elements, named=True)


def read_csv(path: Path) -> Lines:
    """Walls by the coordinates of their ends, or by nodes in a table above them."""
    text = foreign_text(path, CSV)
    lines = (line for line in text.splitlines() if line.strip() and not line.startswith("#"))
    first = next(lines, "")
    separator = max(";\t,", key=first.count)
    rows = rows_of(text.splitlines()[: MOST_ROWS + 1], separator)
    if len(rows) > MOST_ROWS:
        raise MisfitError(f"more than {MOST_ROWS:,} rows")
    tables = [*_tables(rows, decimal="," if separator == ";" else ".")]
    nodes = next((table for table in tables if table.has(NODE)), None)
    walls = [table for table in tables if table.has(LINE) or (nodes and table.has(WALL))]
    if not walls:
        lacks = "nodes with positions" if any(table.has(WALL) for table in tables) else "walls"
        raise MisfitError(f"has no {lacks}; needed: {CSV}")
    used = walls if nodes is None else [nodes, *walls]
    named = {size is not None for table in used for size in table.units.values()}
    if len(named) > 1:
        raise MisfitError("some heads name a unit and others do not; needed: all of them, or none")
    ends = [_ends(table, nodes) for table in walls]
    thick = [table.column("thickness") for table in walls]
    if any(t is None for t in thick) and any(t is not None for t in thick):
        raise MisfitError("some walls have a thickness and others do not")
    thickness = None if thick[0] is None else np.concatenate([t for t in thick if t is not None])
    unit = 1.0 if named == {True} else None
    return Lines(np.concatenate(ends), unit, thickness, named=unit is not None)


class _Table(NamedTuple):
    """Rows below a row of heads: heads -> place and size of the unit; None if the head names
    none.
    """

    heads: dict[str, int]
    units: dict[str, float | None]
    rows: list[tuple[int, Sequence[str]]]
    decimal: str

    def has(self, heads: Sequence[str]) -> bool:
        return all(head in self.heads for head in heads)

    def column(self, head: str) -> Floats | None:
        """The numbers below a head, in m if it names its unit."""
        if head not in self.heads:
            return None
        size = self.units.get(head) or 1.0
        place = self.heads[head]
        return size * np.array([_number(row, place, n, self.decimal) for n, row in self.rows])

    def words(self, head: str) -> list[str]:
        place = self.heads[head]
        return [row[place].strip() if place < len(row) else "" for _, row in self.rows]


def _tables(rows: Sequence[Sequence[str]], decimal: str) -> Iterator[_Table]:
    """The tables of a file; each begins with a row of heads."""
    table = None
    for number, row in enumerate(rows, 1):
        cells = [cell.strip() for cell in row]
        if not any(cells) or cells[0].startswith("#"):
            continue
        headed = _headed(cells, decimal)
        if any(headed.has(heads) for heads in (LINE, NODE, WALL)):
            if table:
                yield table
            table = headed
        elif table is None:
            raise MisfitError(f"line {number} has no heads; needed: {CSV}")
        else:
            table.rows.append((number, cells))
    if table:
        yield table


def _headed(cells: Sequence[str], decimal: str) -> _Table:
    """A table without rows, of the cells that are heads."""
    words = [OTHER_HEADS.get(cell.lower(), cell.lower()) for cell in cells]
    matches = {place: _HEAD.fullmatch(word) for place, word in enumerate(words)}
    heads = {match[1]: (place, match[2]) for place, match in matches.items() if match}
    return _Table(
        {name: place for name, (place, _) in heads.items()},
        {name: METRES.get(unit) for name, (_, unit) in heads.items() if name not in IDS},
        [],
        decimal,
    )


def _ends(table: _Table, nodes: _Table | None) -> Floats:
    """Ends (w, 2, 2) of the walls of a table."""
    if table.has(LINE):
        columns = [table.column(head) for head in LINE]
        return np.stack([c for c in columns if c is not None], axis=1).reshape(-1, 2, 2)
    assert nodes is not None
    xy = [nodes.column(head) for head in NODE]
    points = np.stack([c for c in xy if c is not None], axis=1)
    names = nodes.words("node") if "node" in nodes.heads else [str(n) for n in range(len(points))]
    place = {name: n for n, name in enumerate(names)}
    ends = [[_node(place, name) for name in table.words(head)] for head in WALL]
    return points[np.array(ends).T]


def _node(place: Mapping[str, int], name: str) -> int:
    if name not in place:
        raise MisfitError(f'a wall ends at node "{plain(name[:40])}", which no row has')
    return place[name]


def _number(row: Sequence[str], place: int, line: int, decimal: str = ".") -> float:
    """The finite number in a cell."""
    cell = row[place] if place < len(row) else ""
    with suppress(ValueError):
        if isfinite(value := float(cell.replace(decimal, "."))):
            return value
    raise MisfitError(f'line {line}: "{plain(cell[:40])}" is no number')


def read_lammps(path: Path) -> Lines:
    """Atoms and bonds of a file for `read_data`, in the plane of x and y; images are unwrapped."""
    text = foreign_text(path, "a LAMMPS data file")
    sections, style, box = _sections(text)
    if not {"Atoms", "Bonds"} <= sections.keys():
        raise MisfitError("no LAMMPS data file with the sections Atoms and Bonds")
    place: dict[str, int] = {}
    points: list[list[float]] = []
    for line, words in sections["Atoms"]:
        at = ATOM_STYLES.get(style) if style else BY_LENGTH.get(len(words))
        if at is None:
            raise MisfitError(f"line {line}: an atom of unknown style; needed: Atoms # molecular")
        x = [_number(words, at + k, line) for k in range(3)]
        if len(words) == at + 6 and style != "hybrid":
            x = [a + _number(words, at + 3 + k, line) * box[k] for k, a in enumerate(x)]
        place[words[0]] = len(points)
        points.append(x)
    at_rest = np.array(points)
    if np.ptp(at_rest[:, 2]) > 1e-6 * np.ptp(at_rest[:, :2]):
        raise MisfitError("its atoms are not in a plane of equal z")
    if short := next((line for line, words in sections["Bonds"] if len(words) < 4), None):
        raise MisfitError(f"line {short}: no bond; needed: number, type and two atoms")
    pairs = [[_node(place, name) for name in words[2:4]] for _, words in sections["Bonds"]]
    ends = at_rest[pairs][..., :2]
    return _inside(ends, np.array(box[:2]))


def _inside(ends: Floats, box: Floats) -> Lines:
    """The bonds except those around a periodic box, which are shorter the other way."""
    reach = np.abs(ends[:, 1] - ends[:, 0])
    around = ((reach > 0.5 * box) & (reach < (1.0 - ROUND_OFF) * box)).any(axis=1)
    count = int(around.sum())
    note = f"left out: {counted(count, 'bond')} around the box, longer than half of it"
    return Lines(ends[~around], notes=(note,) if count else ())


def _sections(text: str) -> tuple[dict[str, list[tuple[int, list[str]]]], str, list[float]]:
    """Lines of numbers by section, each with its number; the style of atoms; sizes of the box."""
    sections: dict[str, list[tuple[int, list[str]]]] = {}
    style, box, inside = "", [0.0, 0.0, 0.0], None
    for number, line in enumerate(text.splitlines(), 1):
        content, _, comment = line.partition("#")
        words = content.split()
        if not words or number == 1:
            continue
        if words[0][0].isalpha():
            inside = sections.setdefault(" ".join(words), [])
            style = comment.strip() if words == ["Atoms"] and comment.strip().isalpha() else style
        elif inside is not None:
            inside.append((number, words))
        elif words[2:] in AXES:
            low, high = _number(words, 0, number), _number(words, 1, number)
            box[AXES.index(words[2:])] = high - low
    return {name: lines for name, lines in sections.items() if lines}, style, box


AXES = [[f"{axis}lo", f"{axis}hi"] for axis in "xyz"]
READERS: dict[str, Callable[[Path], Lines]] = {
    ".json": read_json,
    ".csv": read_csv,
    **dict.fromkeys((".data", ".lmp", ".lammps"), read_lammps),
}
