"""One drawing in every format: the grid of 3 x 3 squares in 12.5 mm, as lines that cross."""

import json

import ezdxf

SIDE, PARTS = 12.5, 3  # mm
AT = [SIDE * k / PARTS for k in range(PARTS + 1)]
GRID = [((0.0, y), (SIDE, y)) for y in AT] + [((x, 0.0), (x, SIDE)) for x in AT]
"""Lines from side to side, which cross without a vertex."""


def as_json(path, lines=GRID, **keys):
    """Two nodes for each line."""
    nodes = [end for line in lines for end in line]
    walls = [[2 * k, 2 * k + 1] for k in range(len(lines))]
    path.write_text(json.dumps({"nodes_mm": nodes, "walls": walls, **keys}))
    return path


def as_csv(path, lines=GRID):
    """A row for each line, in inches."""
    rows = [[repr(value / 25.4) for end in line for value in end] for line in lines]
    path.write_text("\n".join(["x1_in,y1_in,x2_in,y2_in", *(",".join(row) for row in rows)]))
    return path


def as_nodes(path, lines=GRID):
    """Named nodes and walls, as a spreadsheet of a country with decimal commas writes them."""
    nodes = [f"n{k};{x};{y}".replace(".", ",") for k, (x, y) in enumerate(sum(lines, ()))]
    walls = [f"n{2 * k};n{2 * k + 1}" for k in range(len(lines))]
    path.write_text("\n".join(["node;x (mm);y (mm)", *nodes, "", "from;to", *walls]))
    return path


def as_svg(path, lines=GRID):
    """A path of all lines with y downwards, in a moved group, of a page in mm."""
    d = " ".join(f"M {x1} {SIDE - y1} L {x2} {SIDE - y2}" for (x1, y1), (x2, y2) in lines)
    page = f'width="{2 * SIDE}mm" height="{2 * SIDE}mm" viewBox="0 0 {2 * SIDE} {2 * SIDE}"'
    style = 'fill="none" stroke="black"'
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" {page}>'
        f'<g transform="translate(3 4)"><path d="{d}" {style}/></g></svg>'
    )
    return path


def as_dxf(path, lines=GRID, units=4):
    """Lines in a block that is inserted elsewhere; units: $INSUNITS, 4 of mm, 0 of none."""
    document = ezdxf.new(units=units)
    block = document.blocks.new("cell")
    for start, end in lines:
        block.add_line(start, end)
    document.modelspace().add_blockref("cell", (3.0, 4.0))
    document.saveas(path)
    return path


def as_lammps(path, lines=GRID):
    """Atoms in two images of a periodic box, and bonds."""
    ends = sum(lines, ())
    atoms = [
        f"{k} 1 1 {x if k % 2 else x - 40.0} {y} 0.0 {0 if k % 2 else 1} 0 0"
        for k, (x, y) in enumerate(ends, 1)
    ]
    bonds = [f"{k + 1} 1 {2 * k + 1} {2 * k + 2}" for k in range(len(lines))]
    head = ["LAMMPS data", "", f"{len(ends)} atoms", f"{len(bonds)} bonds", "-20 20 xlo xhi"]
    text = [*head, "", "Atoms # bond", "", *atoms, "", "Bonds", "", *bonds]
    path.write_text("\n".join(text))
    return path
