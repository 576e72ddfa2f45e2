"""A refused number is the user's own, and the one that is suggested in its place is accepted."""

import re

import pytest

BOUND = re.compile(r"(at most|at least|below|above|between)[^\d]* ([\d.e+-]+) (%|mm|mg|g)")
INSIDE = {"below": 1.0 - 1e-6, "above": 1.0 + 1e-6}  # an open bound is not itself allowed
GYROID = 'kind = "gyroid"\n'
SLICED = 'slicer = "orca"\npattern = "gyroid"\n'
BLOCK = SLICED + 'perimeters = 2\nwidth = "14 mm"\nheight = "11 mm"\n'
GRID = 'slicer = "orca"\npattern = "grid"\nwidth = "37 mm"\nheight = "23 mm"\n'
FINE = 'line_width = "0.01 mm"\nlayer_height = "0.01 mm"\n'
ALONG = '[loading]\ndirection = "out_of_plane"\n'
REFUSED = [
    (SLICED, 'infill = "51.4 %"', ""),
    (SLICED, 'infill = "60 %"', ALONG),
    (SLICED + "fill_multiline = 2\n", 'infill = "70 %"', ""),
    (SLICED + 'fill_angle = "0 deg"\n', 'infill = "90 %"', ""),
    (SLICED, 'infill = "1 %"', ""),
    (SLICED + 'height = "3 mm"\n', 'infill = "2.5 %"', ""),
    (SLICED + 'infill = "20 %"\n', 'height = "0.4 mm"', ""),
    (BLOCK, 'infill = "2.2 %"', ALONG),
    (BLOCK, 'infill = "60 %"', ALONG),
    (GYROID, 'cell_size = "100 mm"', ""),
    (GYROID, 'cell_size = "2 mm"', ""),
    (GYROID, 'wall_thickness = "3 mm"', ""),
    (GYROID + 'cell_size = "5.3 mm"\n', 'mass = "3 g"', ""),
    (GRID.replace("grid", "tri-hexagon"), 'infill = "73 %"', ""),
    (GRID, 'line_distance = "0.3 mm"', ""),
    (GRID, 'mass = "300 g"', ""),
    ("cells = 7\n", 'wall_thickness = "1.3 mm"', ""),
    ('kind = "hex"\ncells = 7\n', 'mass = "3000 mg"', ""),
    ('width = "9.7 mm"\n', 'depth = "0.5 mm"', ALONG),
]


@pytest.mark.parametrize(("lattice", "line", "rest"), REFUSED)
def test_what_is_suggested_is_accepted(load, refused, lattice, line, rest):
    key, value = line.split(" = ")
    answer = refused(f"[lattice]\n{lattice}{line}\n{rest}", f"lattice.{line}", "allowed:")
    word, number, unit = BOUND.search(answer).groups()
    near = float(number) * INSIDE.get(word, 1.0)
    assert value.strip('"').split()[1] == unit
    assert load(f'[lattice]\n{lattice}{key} = "{near:.12g} {unit}"\n{rest}').cases


@pytest.mark.parametrize(
    ("text", "key"),
    [
        (GYROID, 'cell_size = "0.001 mm"'),
        (GYROID + 'nodes_per_wall = 11\nwall_thickness = "0.1 mm"\n', 'cell_size = "1 mm"'),
        (SLICED + 'height = "1000 mm"\n', 'infill = "50 %"'),
        ('kind = "hex"\n', 'cell_size = "0.05 mm"'),
        (GRID + FINE, 'line_distance = "0.05 mm"'),
    ],
)
def test_a_key_that_the_user_has_not_given_is_not_blamed(last_refused, text, key):
    assert "by default" not in last_refused(f"[lattice]\n{text}{key}")
