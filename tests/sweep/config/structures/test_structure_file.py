"""Faults of the file of a structure are reported in one line each."""

import json

import pytest

from sweep.config.faults import ConfigError
from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.config.structures.structure import Structure

GOOD = {"nodes_mm": [[0, 0], [10, 0], [10, 5]], "walls": [[0, 1], [1, 2]]}
FIXED = [{"node": 0, "fix": ["x", "y", "rotation"]}]

APART = "has no length"
MOVED = {"node": 0, "direction": "x"}
LOAD = {"loads": [{"node": 1, "moment_Nmm": 2}]}
SQUARE = {"nodes_mm": [[0, 0], [10, 0], [10, 5], [0, 5]]}
WRONG = [
    ({"wals": []}, "wals", "the nearest is walls"),
    ({"nodes": []}, "nodes", "the nearest is nodes_mm"),
    ({"supports": [{"node": 0, "fixed": ["x"]}]}, "supports[0].fixed", "the nearest is fix"),
    ({"supports": [{"node": 0, "fix": ["z"]}]}, 'supports[0].fix[0] = "z"', "'x', 'y' or 'rotat"),
    ({"walls": [[0, 1], [1, 7]]}, "walls[1][1] = 7", "no such node; allowed: 0 to 2"),
    ({"walls": [[0, 1], [1, 2], [2, 2]]}, "walls[2] = [2, 2]", APART),
    ({"walls": [[0, 1], [1, 2], [1, 0]]}, "walls[2] = [1, 0]", "upon wall 0"),
    ({"springs": [{"nodes": [1, 1], "stiffness_N_mm": 1}]}, "springs[0].nodes = [1, 1]", APART),
    ({"wall_thickness_mm": [1.0, -1.0]}, "wall_thickness_mm[1] = -1.0", "greater than 0"),
    ({"subdivide": [4]}, "subdivide = [4]", "1 values; allowed: one value, or"),
    ({"nodes_mm": [[0, 0]]}, "nodes_mm = [[0, 0]]", "at least 2 values"),
    ({"initial_velocity_mm_s": []}, "initial_velocity_mm_s = []", "3 here"),
    ({"depth_mm": "10 mm"}, 'depth_mm = "10 mm"', "a valid number"),
    ({"rest_angles": "round"}, 'rest_angles = "round"', "'as_drawn'"),
    ({"floor_y_mm": 1}, "floor_y_mm = 1.0", "node 0 is -1 mm above it"),
    (
        {"floor_y_mm": -0.7, "wall_thickness_mm": [1.0, 2.0]},
        *("floor_y_mm = -0.7", "node 1 is 0.7 mm"),
    ),
    (SQUARE | {"walls": [[0, 2], [1, 2], [1, 3]]}, "walls[2] = [1, 3]", "meets wall 0"),
    (SQUARE | {"walls": [[0, 1], [2, 3]]}, "walls[1] = [2, 3]", "not connected with wall 0"),
    (SQUARE, "nodes_mm[3] = [0.0, 5.0]", "nodes of walls"),
    (
        {"supports": FIXED, "prescribed": [MOVED | {"displacement_mm": 1}]},
        *('prescribed[0].direction = "x"', "one support or one prescribed move"),
    ),
    ({"prescribed": [MOVED | {"angle_rad": 1}]}, 'prescribed[0].direction = "x"', "no angle_rad"),
    ({"pins": [1]} | LOAD, "pins[0] = 1", "no rotation"),
]


@pytest.fixture
def lines(tmp_path):
    """The messages on a config of a structure with these parts, a list of lines."""

    def said(parts, more=""):
        (tmp_path / "own.json").write_text(parts if isinstance(parts, str) else json.dumps(parts))
        path = tmp_path / "own.toml"
        path.write_text(f'[lattice]\nkind = "custom"\nfile = "own.json"\n{more}')
        try:
            assert len(expand(load_config(path))) == 1
        except ConfigError as error:
            return str(error).splitlines()
        return []

    return said


@pytest.mark.parametrize(
    ("key", "read", "one", "each"),
    [
        ("wall_thickness_mm", "thickness_mm", 0.5, (0.5, 0.7)),
        ("subdivide", "pieces", 3, (3, 1)),
        ("initial_velocity_mm_s", "velocity_mm_s", (1.0, 2.0), ((1.0, 2.0),) * 2 + ((0.0, 0.0),)),
    ],
)
def test_one_value_stands_for_each(key, read, one, each):
    walls = {"nodes_mm": ((0.0, -2.0), (3.0, 1.0), (-4.0, 0.0)), "walls": ((0, 1), (1, 2))}
    made = Structure.model_validate(walls | {key: one})
    assert (getattr(made, read), made.size_mm) == ((one,) * len(each), (7.0, 3.0))
    assert getattr(Structure.model_validate(walls | {key: each}), read) == each


@pytest.mark.parametrize(("parts", "key", "words"), WRONG)
def test_a_mistake_is_a_line(lines, parts, key, words):
    (line,) = lines(GOOD | parts)
    assert line.startswith(f'lattice.file = "own.json": {key}: ')
    assert words in line


def test_all_mistakes_are_told(lines):
    found = lines(GOOD | {"depth_mm": -1, "floor_y_mm": "low", "probes": [-1]})
    assert len(found) == 3


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("{", "not JSON at line 1, column 2"),
        ("[]", "not a JSON object"),
        ('{"walls": [[0, 1]], "walls": [[1, 2]]}', "walls stands twice in one object"),
        ('{"nodes": [[0, 0]], "edges": []}', "of another program; needed: nodes_mm"),
        ('{"walls": [[0, 1]]}', "nodes_mm is miss"),
    ],
)
def test_what_is_no_structure(lines, text, wanted):
    (line,) = lines(text)
    assert line.startswith(f'lattice.file = "own.json": {wanted}')


@pytest.mark.parametrize(
    ("supports", "loose"),
    [
        (FIXED, ""),
        ([{"node": 0, "fix": ["x", "y"]}], "supports: node 1 can move in y without resistance"),
    ],
)
def test_a_mechanism_has_no_equilibrium(lines, supports, loose):
    parts = GOOD | {"supports": supports}
    found = lines(parts, '[solver]\nintegrator = "static"')
    assert [line.split("or more ")[1] for line in found] == ([loose] if loose else [])
    assert lines(parts) == []


def test_file_and_kind_go_together(lines, tmp_path):
    (tmp_path / "square.toml").write_text('[lattice]\nfile = "own.json"')
    lines(GOOD)
    with pytest.raises(ConfigError, match=r'has no effect, as lattice\.kind is "square"'):
        load_config(tmp_path / "square.toml")
    (tmp_path / "bare.toml").write_text('[lattice]\nkind = "custom"')
    with pytest.raises(ConfigError, match=r"lattice.file is missing; needed: the path of a .json"):
        load_config(tmp_path / "bare.toml")


@pytest.mark.parametrize(
    ("given", "found"),
    [(0.5, [(0.4, 0.4), (1.2, 1.2)]), ((0.4, 1.2), [(0.2, 0.6), (0.6, 1.8)])],
)
def test_grid_scales_the_thickness_of_all_walls(load, tmp_path, given, found):
    (tmp_path / "own.json").write_text(json.dumps(GOOD | {"wall_thickness_mm": given}))
    sizes = '[grid]\nlattice.wall_thickness = ["0.4 mm", "1.2 mm"]'
    cases = expand(load(f'[lattice]\nkind = "custom"\nfile = "own.json"\n{sizes}'))
    thick = [case.lattice.structure.thickness_mm for case in cases]
    assert thick == [pytest.approx(walls) for walls in found]
    labels = [case.axes["lattice.wall_thickness"] for case in cases]
    assert labels == pytest.approx([0.4e-3, 1.2e-3])


def test_thickness_that_does_not_fit_a_structure_is_refused(lines):
    low = GOOD | {"floor_y_mm": -5.0}
    assert lines(low, 'wall_thickness = "1 mm"') == []
    (line,) = lines(low, 'wall_thickness = "20 mm"')
    assert line.startswith('lattice.wall_thickness = "20 mm": does not fit; allowed: one that fits')
    assert "(floor_y_mm = -5.0: node " in line


@pytest.mark.parametrize(
    "more", ['width = "9 mm"', '[loading]\nforce = "3 N"', '[loading]\nplaten = "glued"']
)
def test_keys_of_other_lattices_have_no_effect(lines, more):
    (line,) = lines(GOOD, more)
    assert line.endswith('has no effect, as lattice.kind is "custom"')
    assert len(lines(GOOD, '[loading]\nmode = "custom"\nduration = "5 ms"')) == 0
