"""A lattice pressed along its cells: completed values, excluded values, idle values."""

import json

import pytest

from sweep.config.case import Case
from sweep.config.grid import expand

ALONG = '[loading]\ndirection = "out_of_plane"\n'
ONLY = 'if loading.direction is "out_of_plane"'
CUSTOM = '[lattice]\nkind = "custom"\nfile = "angle.json"'
STRUCTURE = {"nodes_mm": [[0, 0], [5, 0], [5, 4]], "walls": [[0, 1], [1, 2]]}


def along(lattice=None, **loading):
    return Case.of(lattice=lattice or {}, loading=dict(direction="out_of_plane", **loading))


def test_a_crush_along_the_cells_presses_the_depth():
    case = along(dict(height=9e-3, depth=20e-3))
    assert (case.loading.mode, case.loading.platen) == ("displacement", "glued")
    assert (case.height, case.loading.stroke) == (20e-3, pytest.approx(0.6 * 20e-3))
    assert case.footprint == pytest.approx((13.3e-3, 9.8e-3))
    plane = case.changed(loading=dict(direction="in_plane"))
    assert (plane.height, plane.footprint) == (9e-3, pytest.approx((13.3e-3, 20e-3)))


PERIODIC, QUARTER = 'sides = "periodic"\n', 'symmetry = "quarter"'
METRE = 'width = "1 m"\nheight = "1 m"\ndepth = "1 m"\n'
SOFT = 'softening_m = "0.5 MPa"\nsoftening_r = 2.0'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('platen = "sliding"', [f'"glued", "clamped" or "contact" {ONLY}']),
        ('stroke = "20 mm"', ["below the depth", "12 mm"]),
        ('[lattice]\nboundary = "periodic"', [f'"free" {ONLY}']),
        (f"[lattice]\n{PERIODIC}cells = 4\n{QUARTER}", ['"none" if lattice.sides is "periodic"']),
        (f"[lattice]\ncells = 2\n{QUARTER}", ['"none"', "joints lie on its middle planes"]),
        (f'[lattice]\nkind = "hex"\n{QUARTER}', ['"none"', "not symmetric"]),
        ("[lattice]\nlayers = 16", ["at most 15 here"]),
        (f"[lattice]\n{METRE}cells = 40", ["at most 20,000", ONLY, "4,357,521 here"]),
        ("[lattice]\nimperfection = 10.0", ["at most 1, in wall", ONLY]),
        ('[material]\nbend = "fibres"', [f'"section" or "linear" {ONLY}']),
        ('[material]\nbend = "linear"', [f'"section" {ONLY}', 'material.stretch is "nonlinear"']),
        (f"[material]\n{SOFT}", [f"none {ONLY}"]),
        ('[contact]\nmodel = "position_based"', [f'"barrier" or "none" {ONLY}']),
        ('[damping]\nmodel = "rayleigh"', [f'"none" {ONLY}']),
        ('[solver]\nintegrator = "arc_length"', ['"static"', '"backward_euler", "bdf2" or']),
    ],
)
def test_what_does_not_go_along_the_cells_is_refused(last_refused, text, words):
    assert last_refused(ALONG + text, *words)


SLICED = '[lattice]\nslicer = "prusa"\npattern = "grid"\ninfill = "20 %"\nperimeters = 2'
BY_FORCE = 'loading.mode = "force", as loading.force is given'
OF_PLA = 'material.yield_stress = 4.5e+07 Pa in the file of "pla"'


@pytest.mark.parametrize(
    ("text", "key", "words"),
    [
        ('force = "3 N"', BY_FORCE, f'"impact" {ONLY}'),
        (f'[lattice]\n{PERIODIC}kind = "hex"', "lattice.cells_y = 3 by default", "an even number"),
        (SLICED, 'lattice.slicer = "prusa"', f"none {ONLY}"),
        ('[material]\nname = "pla"', OF_PLA, f"none {ONLY}"),
    ],
)
def test_what_follows_from_other_keys_is_refused_with_these(refused, text, key, words):
    assert refused(ALONG + text, key, words)


def test_a_height_below_the_wall_thickness_is_refused(tmp_path, last_refused):
    thick = '[lattice]\nwall_thickness = "0.4 mm"\ndepth = "0.3 mm"'
    assert last_refused(ALONG + thick, "at least the wall thickness, 0.4 mm here", ONLY)
    assert along(dict(depth=0.4e-3, wall_thickness=0.4e-3)).lattice.layers == 1
    written(tmp_path, depth_mm=0.3, wall_thickness_mm=0.4)
    assert last_refused(f"{ALONG}{CUSTOM}", "a depth_mm of at least", "0.4 mm here")


def test_clamped_platens_are_for_plates(last_refused):
    clamped = 'platen = "clamped"'
    assert last_refused(f"[loading]\n{clamped}", '"none", "contact", "glued" or "sliding"')
    allowed = '"contact", "glued" or "sliding" if loading.direction is "in_plane"'
    assert last_refused(f'[loading]\nmode = "displacement"\n{clamped}', allowed)


@pytest.mark.parametrize(
    "text",
    ['[material]\nplane = "strain"', '[solver]\njoints = "points"', '[damping]\nmass = "5 1/s"'],
)
def test_key_of_the_plane_has_no_effect_on_plates(last_refused, text):
    assert last_refused(ALONG + text, 'no effect, as loading.direction is "out_of_plane"')


@pytest.mark.parametrize("key", ["layers = 9", "imperfection_seed = 1", 'symmetry = "quarter"'])
def test_key_of_plates_has_no_effect_in_the_plane(last_refused, key):
    why = 'no effect, as loading.direction is "in_plane"; needed: "out_of_plane"'
    assert last_refused(f"[lattice]\n{key}", why)


def test_a_draw_of_no_imperfection_has_no_effect(last_refused):
    text = f"{ALONG}[lattice]\nimperfection = 0.0\nimperfection_seed = 1"
    assert last_refused(text, "no effect, as lattice.imperfection is 0")


def test_both_directions_in_one_sweep_share_keys_of_either(load):
    text = (
        '[lattice]\nlayers = 9\n[material]\nplane = "stress"\n[loading]\nmode = "displacement"\n'
        '[grid]\n"loading.direction" = ["in_plane", "out_of_plane"]\n'
    )
    across, up = expand(load(text))
    assert (across.lattice.layers, across.material.plane) == (None, "stress")
    assert (up.lattice.layers, up.material.plane) == (9, "strain")


def written(tmp_path, **parts):
    file = tmp_path / "angle.json"
    file.write_text(json.dumps(STRUCTURE | parts))
    return dict(kind="custom", file=str(file), imperfection=0.2)


def test_custom_structure_stands_on_its_walls(tmp_path):
    case = along(written(tmp_path, subdivide=[5, 4], wall_thickness_mm=0.5), strain=0.5)
    assert case.loading.stroke == pytest.approx(6e-3)
    assert (case.lattice.layers, case.lattice.imperfection) == (12, 0.2)


def test_custom_structure_in_the_plane_has_no_imperfection(tmp_path):
    fixed = written(tmp_path, supports=[{"node": 0, "fix": ["x", "y", "rotation"]}])
    assert Case.of(lattice=fixed).lattice.imperfection == 0.0


def test_parts_of_a_structure_that_plates_lack_are_refused(tmp_path, last_refused):
    written(tmp_path, supports=[{"node": 0, "fix": ["x"]}], probes=[1])
    assert last_refused(f"{ALONG}{CUSTOM}", "a file without supports, probes")
