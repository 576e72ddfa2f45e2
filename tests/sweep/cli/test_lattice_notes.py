"""The sentence on the result of a size of cells."""

from sweep.cli.lattice_notes import lattice_notes
from sweep.config.case import Case
from sweep.design.geometry import Drawing

PANEL = dict(width=0.1, height=15e-3, depth=0.05)


def test_each_lattice_is_told_once():
    sized = dict(PANEL, cell_size=4e-3)
    cases = [
        Case.of(lattice=PANEL),
        Case.of(lattice=sized),
        Case.of(lattice=sized, loading=dict(strain=0.3)),
        Case.of(lattice=dict(sized, kind="hex", orientation="flat")),
    ]
    assert lattice_notes(cases) == [
        "lattice.cell_size 4 mm: 25 x 4 cells of 4 x 3.75 mm (square)",
        "lattice.cell_size 4 mm: 25 x 3 cells of 3.95 x 4.29 mm (hex flat)",
    ]


def test_the_share_of_a_sheet_and_the_sides_of_a_block_are_told():
    sheet = dict(slicer="orca", pattern="gyroid", infill=0.15, height=12.5e-3)
    loading = dict(mode="displacement")
    assert lattice_notes([Case.of(lattice=sheet, loading=loading)], 0.15) == [
        "gyroid, 14.7 % for 15 %, pressed across the print axis: 1.75 periods of 7.143 mm in a "
        "height of 12.5 mm"
    ]
    block = dict(sheet, width=20e-3, depth=10e-3, perimeters=2)
    (line,) = lattice_notes([Case.of({"lattice.infill": 0.2}, lattice=block, loading=loading)], 0.3)
    assert line.startswith("gyroid, 16.8 % for 20 %, ")
    assert line.endswith("; a block of 18.75 x 12.5 x 9.375 mm within perimeters")


def test_a_drawing_is_told_with_its_loose_ends():
    joints = ((0.0, 0.0), (0.02, 0.0), (0.0, 0.01), (0.02, 0.01), (0.005, 0.0025))
    whole = Drawing(joints[:4], ((0, 1), (0, 2), (1, 3), (2, 3)))
    sentences = ["drawn: 20 x 10 mm, 4 joints, 4 walls"]
    assert lattice_notes([case_of(whole), case_of(whole)]) == sentences
    loose = Drawing(joints, (*whole.walls, (0, 4)))
    (sentence,) = lattice_notes([case_of(loose)])
    assert sentence == "drawn: 20 x 10 mm, 5 joints, 5 walls; 1 wall ends loose, at 5, 2.5 mm"


def case_of(drawing):
    return Case.of(lattice={"kind": "drawn", "drawing": drawing, "wall_thickness": 0.5e-3})
