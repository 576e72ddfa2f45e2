"""Faults of the file of a structure are reported in one line each."""

import json

import pytest

from sweep.config.faults import ConfigError
from sweep.config.grid import expand
from sweep.config.load import load_config

GOOD = {"nodes_mm": [[0, 0], [10, 0], [10, 5]], "walls": [[0, 1], [1, 2]]}
FIXED = [{"node": 0, "fix": ["x", "y", "rotation"]}]

APART = ("has no length", "two nodes apart")
POSITIVE = "greater than 0"

WRONG = {
    "unknown key": ({"wals": []}, "wals", "the nearest is walls"),
    "unknown key of nodes": ({"nodes": []}, "nodes", "the nearest is nodes_mm"),
    "unknown key inside": (
        *({"supports": [{"node": 0, "fixed": ["x"]}]}, "supports[0].fixed", "the nearest is fix"),
    ),
    "no such node": ({"probes": [0, 3]}, "probes[1] = 3", "no such node", "0 to 2"),
    "no such end": ({"walls": [[0, 1], [1, 7]]}, "walls[1][1] = 7", "no such node", "0 to 2"),
    "wrong way": (
        *({"supports": [{"node": 0, "fix": ["z"]}]}, 'supports[0].fix[0] = "z"'),
        "'x', 'y' or 'rotation'",
    ),
    "thickness": ({"wall_thickness_mm": 0}, "wall_thickness_mm = 0", POSITIVE),
    "thickness in a list": (
        *({"wall_thickness_mm": [1.0, -1.0]}, "wall_thickness_mm[1] = -1.0", POSITIVE),
    ),
    "length of a list": ({"subdivide": [4]}, "subdivide = [4]", "1 values", "one value", "2 here"),
    "empty list": (
        *({"initial_velocity_mm_s": []}, "initial_velocity_mm_s = []", "0 values", "3 here"),
    ),
    "text for a number": ({"depth_mm": "10 mm"}, 'depth_mm = "10 mm"', "a valid number"),
    "rest angles": ({"rest_angles": "round"}, 'rest_angles = "round"', "'as_drawn'"),
    "wall without length": ({"walls": [[0, 1], [1, 2], [2, 2]]}, "walls[2] = [2, 2]", *APART),
    "spring without length": (
        *({"springs": [{"nodes": [1, 1], "stiffness_N_mm": 1}]}, "springs[0].nodes = [1, 1]"),
        *APART,
    ),
    "floor above a wall": (
        *({"floor_y_mm": 1}, "floor_y_mm = 1.0", "node 0 is -1 mm", "at most -0.4 here"),
    ),
    "floor within a wall": (
        {"floor_y_mm": -0.7, "wall_thickness_mm": [1.0, 2.0]},
        *("floor_y_mm = -0.7", "node 1 is 0.7 mm", "wall 1 mm", "at most -1 here"),
    ),
    "same wall twice": ({"walls": [[0, 1], [1, 2], [1, 0]]}, "walls[2] = [1, 0]", "upon wall 0"),
    "crossing": (
        {"nodes_mm": [[0, 0], [10, 0], [10, 5], [0, 5]], "walls": [[0, 2], [1, 2], [1, 3]]},
        *("walls[2] = [1, 3]", "meets wall 0"),
    ),
    "loose node": (
        {"nodes_mm": [[0, 0], [10, 0], [10, 5], [99, 9]]},
        *("nodes_mm[3] = [99.0, 9.0]", "nodes of walls"),
    ),
    "two pieces": (
        {"nodes_mm": [[0, 0], [10, 0], [10, 5], [0, 5]], "walls": [[0, 1], [2, 3]]},
        *("walls[1] = [2, 3]", "not connected with wall 0", "one piece"),
    ),
    "led and held": (
        {"supports": FIXED, "prescribed": [{"node": 0, "direction": "x", "displacement_mm": 1}]},
        *('prescribed[0].direction = "x"', "one support or one prescribed move"),
    ),
    "angle of a move": (
        {"prescribed": [{"node": 0, "direction": "x", "angle_rad": 1}]},
        *('prescribed[0].direction = "x"', "displacement_mm", "no angle_rad"),
    ),
    "moment at a pin": (
        *({"pins": [1], "loads": [{"node": 1, "moment_Nmm": 2}]}, "pins[0] = 1", "no rotation"),
    ),
}


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


def test_a_sound_file_is_read(lines):
    assert lines(GOOD) == []


@pytest.mark.parametrize("what", WRONG)
def test_a_mistake_is_a_line(refused, what):
    parts, key, *words = WRONG[what]
    assert refused(GOOD | parts, f'lattice.file = "own.json": {key}', *words)


def test_all_mistakes_are_told(lines):
    found = lines(GOOD | {"depth_mm": -1, "floor_y_mm": "low", "probes": [-1]})
    assert len(found) == 3


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("{", "not JSON at line 1, column 2"),
        ("[]", "not a JSON object"),
        ('{"nodes": [[0, 0]], "edges": []}', "of another program; needed: nodes_mm"),
        ('{"walls": [[0, 1]]}', "nodes_mm is miss"),
    ],
)
def test_what_is_no_structure(lines, text, wanted):
    (line,) = lines(text)
    assert line.startswith(f'lattice.file = "own.json": {wanted}')


STATIC = '[solver]\nintegrator = "static"'


@pytest.mark.parametrize(
    ("parts", "loose"),
    [
        ({}, "node 1 can move in y"),
        ({"supports": [{"node": 0, "fix": ["x", "y"]}]}, "node 1 can move in y"),
        ({"supports": FIXED, "pins": [1]}, "node 2 can move in x"),
        ({"supports": FIXED}, ""),
        ({"supports": [{"node": 0, "fix": ["x", "y"]}, {"node": 2, "fix": ["y"]}]}, ""),
    ],
)
def test_a_mechanism_has_no_equilibrium(lines, parts, loose):
    found = lines(GOOD | parts, STATIC)
    wanted = (
        'solver.integrator = "static": does not fit; allowed: "backward_euler", "bdf2" or'
        ' "newmark", or more'
    )
    assert found == ([f"{wanted} supports: {loose} without resistance"] if loose else [])
    assert lines(GOOD | parts) == []


def test_file_and_kind_go_together(lines, tmp_path):
    (tmp_path / "square.toml").write_text('[lattice]\nfile = "own.json"')
    lines(GOOD)
    with pytest.raises(ConfigError, match=r'has no effect, as lattice\.kind is "square"'):
        load_config(tmp_path / "square.toml")
    (tmp_path / "bare.toml").write_text('[lattice]\nkind = "custom"')
    with pytest.raises(ConfigError, match=r"lattice.file is missing; needed: the path of a .json"):
        load_config(tmp_path / "bare.toml")


def test_grid_scales_the_thickness_of_all_walls(tmp_path):
    for given, found in {
        0.5: [(0.4, 0.4), (1.2, 1.2)],
        (0.4, 1.2): [(0.2, 0.6), (0.6, 1.8)],
    }.items():
        (tmp_path / "own.json").write_text(json.dumps(GOOD | {"wall_thickness_mm": given}))
        path = tmp_path / "own.toml"
        sizes = '[grid]\nlattice.wall_thickness = ["0.4 mm", "1.2 mm"]'
        path.write_text(f'[lattice]\nkind = "custom"\nfile = "own.json"\n{sizes}')
        cases = expand(load_config(path))
        thick = [case.lattice.structure.thickness_mm for case in cases]
        assert thick == [pytest.approx(walls) for walls in found]
        assert [case.axes["lattice.wall_thickness"] for case in cases] == pytest.approx(
            [0.4e-3, 1.2e-3]
        )


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
