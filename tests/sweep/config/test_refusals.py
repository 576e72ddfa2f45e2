"""A config that cannot be run: one line for everything that is wrong, and no more."""

import pytest

from sweep.config import material_file
from sweep.config.material_file import available
from sweep.config.units import ConfigError, load_config
from sweep.design.infill import families

LENGTH = 'a length with a unit, such as "0.8 mm", above 0'
STRAIN = 'a number or a share in percent, such as "20 %", above 0, below 1'
SIZE = f"{LENGTH}, at most 1000 m"
PERIODIC = '[lattice]\nboundary = "periodic"\n'
LED = 'allowed: "displacement" if lattice.boundary is "periodic"'
CELLS = "a whole number, at least 1, at most 1000"
MATERIALS = ", ".join(available())
KINDS = ", ".join(f'"{kind}"' for kind in families())
THOUSAND = [round(0.01 + 1e-4 * i, 6) for i in range(1000)]

VALUES = {
    '[lattice]\nwall_thicknes = "0.8 mm"': (
        'lattice.wall_thicknes = "0.8 mm": unknown key; the nearest is lattice.wall_thickness'
    ),
    '[latice]\nwidth = "1 mm"': 'latice = {"width": "1 mm"}: unknown key; the nearest is lattice',
    "[lattice]\nwidth = 12.5": f"lattice.width = 12.5: a bare number; allowed: {SIZE}",
    '[lattice]\nwidth = "1 kg"': (
        f'lattice.width = "1 kg": "kg" is a unit of another kind; allowed: {SIZE}'
    ),
    '[lattice]\nwidth = "1 mmm"': f'lattice.width = "1 mmm": unknown unit "mmm"; allowed: {SIZE}',
    '[lattice]\ndepth = "-8 mm"': f'lattice.depth = "-8 mm": out of range; allowed: {SIZE}',
    '[lattice]\nwidth = "1e30 m"': f'lattice.width = "1e30 m": out of range; allowed: {SIZE}',
    '[lattice]\nwidth = "1e999 mm"': f'lattice.width = "1e999 mm": not finite; allowed: {SIZE}',
    "[lattice]\nwidth = true": f"lattice.width = true: no quantity; allowed: {SIZE}",
    "[lattice]\ncells_x = true": f"lattice.cells_x = true: wrong type; allowed: {CELLS}",
    "[lattice]\ncells_y = 3.0": f"lattice.cells_y = 3.0: wrong type; allowed: {CELLS}",
    "lattice = 3": "lattice = 3: not a table; allowed: a table [lattice]",
    '[loading]\nstrain = "160 %"': f'loading.strain = "160 %": out of range; allowed: {STRAIN}',
    '[loading]\nstrain = "0.6"': f'loading.strain = "0.6": a bare number; allowed: {STRAIN}',
    '[loading]\nstrain = "6 mm"': (
        f'loading.strain = "6 mm": "mm" is a unit of another kind; allowed: {STRAIN}'
    ),
    "[loading]\nstrain = 60": f"loading.strain = 60: out of range; allowed: {STRAIN}",
    "[loading]\nstrain = true": f"loading.strain = true: wrong type; allowed: {STRAIN}",
    "[contact]\nfriction = nan": (
        "contact.friction = NaN: not finite; allowed: a number, at least 0"
    ),
    '[material]\nname = "ninjaflx"': (
        f'material.name = "ninjaflx": unknown material; allowed: {MATERIALS}, or the path of a'
        " .csv file"
    ),
    '[rank]\npanel = ["1 mm"]': (
        f'rank.panel = ["1 mm"]: too few values; allowed: a list of 2 values, each {LENGTH}'
    ),
    'name = "a/b"': 'name = "a/b": not a name; allowed: letters, digits, dots, dashes, underscores',
}

CHOICES = {
    '[loading]\nmode = "shake"': (
        'loading.mode = "shake"; "force", "displacement", "impact" or "custom"'
    ),
    '[lattice]\nkind = "hexagon"': f'lattice.kind = "hexagon"; {KINDS} or "custom"',
    '[material]\nbend = "curve"': 'material.bend = "curve"; "linear", "section" or "none"',
    '[contact]\nmodel = "by_position"': (
        'contact.model = "by_position"; "auto", "none", "barrier" or "position_based"'
    ),
    '[solver]\nhessian = "tangent"': 'solver.hessian = "tangent"; "exact" or "tangent_modulus"',
    '[solver]\nintegrator = "bdf3"': (
        'solver.integrator = "bdf3"; "backward_euler", "bdf2", "newmark", "static" or "arc_length"'
    ),
}

UNFIT = {
    '[lattice]\nwall_thickness = "2.5 mm"': (
        'lattice.wall_thickness = "2.5 mm": does not fit; allowed: below half the width of'
        " the narrowest cell, 2.083 mm here"
    ),
    "[lattice]\ncells = 20": (
        "lattice.wall_thickness = 0.0008 m by default: does not fit; allowed: below half the"
        " width of the narrowest cell, 0.0003125 m here"
    ),
    '[loading]\nmode = "displacement"\nstrain = 0.5\nstroke = "5 mm"': (
        'loading.stroke = "5 mm": does not fit; allowed: 6.25 mm at the strain given; give one'
        " of them"
    ),
    '[loading]\nstroke = "0.5in"': (
        'loading.stroke = "0.5in": does not fit; allowed: below the height of the lattice,'
        " 0.4921 in"
    ),
    '[lattice]\ncells = 300\nwidth = "3 m"\nheight = "3 m"': (
        "lattice.cells = 300: does not fit; allowed: at most 50,000 nodes in all, 451,801 here"
    ),
    "[lattice]\ncells_y = 4\nnodes_per_wall = 999\ncells_x = 6": (
        "lattice.nodes_per_wall = 999: does not fit; allowed: at most 50,000 nodes in all,"
        " 57,977 here"
    ),
    '[solver]\ntime_step = "1e-12 s"': (
        'solver.time_step = "1e-12 s": does not fit; allowed: at most 1,000,000 steps in all'
    ),
    '[loading]\nspeed = "1 mm/s"\n[solver]\ntime_step = "1e-320 s"': (
        'solver.time_step = "1e-320 s": does not fit; allowed: at most 1,000,000 steps in all'
    ),
    '[loading]\nduration = "1000 s"': (
        "solver.time_step = 0.0001 s by default: does not fit; allowed: at most 1,000,000 steps in"
        " all"
    ),
    "[loading]\nstrain = 0.5\nload_steps = 500_001": (
        "loading.load_steps = 500001: does not fit; allowed: at most 1,000,000 steps in all,"
        " 1,000,002 here"
    ),
    "[loading]\nload_steps = 3\n[solver]\nload_steps = 4": (
        "solver.load_steps = 4: set twice; allowed: the same as loading.load_steps = 3"
    ),
    '[solver]\nintegrator = "static"': (
        'solver.integrator = "static": does not fit; allowed: "backward_euler", "bdf2" or "newmark"'
        ' if loading.mode is "force"'
    ),
    '[loading]\nstrain = 0.5\n[solver]\nstep_error = "1 um"': (
        'solver.step_error = "1 um": does not fit; allowed: none unless solver.integrator is'
        ' "backward_euler", "bdf2" or "newmark"'
    ),
    '[lattice]\nnodes_per_wall = 0\n[material]\nbend = "section"': (
        'material.bend = "section": does not fit; allowed: "linear" if lattice.nodes_per_wall is 0'
        ' and solver.hinges "exact_beam"'
    ),
    '[material]\nbend = "none"\n[loading]\nstrain = 0.5': (
        'material.bend = "none": does not fit; allowed: "linear" or "section" if solver.integrator'
        ' is "static"'
    ),
    '[solver]\nintegrator = "arc_length"': (
        'solver.integrator = "arc_length": does not fit; allowed: "static" where quasi-static, else'
        ' "backward_euler", "bdf2" or "newmark", unless lattice.kind is "custom"'
    ),
    '[contact]\nmodel = "position_based"\n[solver]\nintegrator = "newmark"': (
        'solver.integrator = "newmark": does not fit; allowed: "backward_euler" if contact.model is'
        ' "position_based"'
    ),
    f'{PERIODIC}[loading]\nforce = "3 N"': (
        f'loading.mode = "force", as loading.force is given: does not fit; {LED}'
    ),
    f'{PERIODIC}[loading]\nduration = "1 s"': (
        f'loading.mode = "force", as loading.duration is given: does not fit; {LED}'
    ),
    PERIODIC: f'loading.mode = "force" by default: does not fit; {LED}',
    f'{PERIODIC}[loading]\nspeed = "1 m/s"': (
        "loading.quasi_static = false, as loading.speed is given: does not fit; allowed: true if"
        ' lattice.boundary is "periodic"'
    ),
    '[lattice]\nwidth = "40 mm"\nheight = "0.01 mm"': (
        'lattice.width = "40 mm": does not fit; allowed: from 1e-05 mm to 10 mm, a thousandth to'
        " a thousand times the height"
    ),
    '[lattice]\nheight = "30 m"': (
        'lattice.height = "30 m": does not fit; allowed: from 1.25e-05 m to 12.5 m, a thousandth'
        " to a thousand times the width"
    ),
    '[material]\nmodulus = "12 MPa"': (
        "material.density is missing; needed: a density, as no name is given"
    ),
}

AXES = {
    "[grid]\nlattice.cells = []": (
        f"[grid] lattice.cells = []: no values; allowed: a list, each {CELLS}"
    ),
    "[grid]\nlattice.cells = 3": (
        f"[grid] lattice.cells = 3: not a list; allowed: a list, each {CELLS}"
    ),
    "[grid]\nlattice.cels = [1]": (
        "[grid] lattice.cels = [1]: unknown key; the nearest is lattice.cells"
    ),
    '[grid]\nloading.allowed_forces = [["1 N"]]': (
        '[grid] loading.allowed_forces = [["1 N"]]: a list itself, no axis; allowed: keys with one'
        " value"
    ),
    f"[grid]\nlattice.imperfection = {THOUSAND}\ncontact.friction = {THOUSAND}\n"
    f"contact.stiffness = {THOUSAND}": (
        "[grid] makes 1,000,000,000 cases; allowed: at most 1,000,000 in one sweep"
    ),
    "[grid]\nlattice.cells = [2, 3]\n[[zip]]\nlattice.cells_x = [2, 3]": (
        "[[zip]] lattice.cells_x = [2, 3]: varied in [grid] too; allowed: one of them"
    ),
    '[[zip]]\nlattice.cells = [1, 2]\nloading.force = ["1 N"]': (
        "[[zip]] lattice.cells = [1, 2]: lengths differ (lattice.cells has 2, loading.force has"
        " 1); allowed: lists of equal length"
    ),
    "zip = 3": "zip = 3: not a list of tables; allowed: tables [[zip]]",
    "[grid]\nlattice.cells = [2, 3]\n[[exclude]]\nlattice.cell = 2": (
        "[[exclude]] lattice.cell = 2: unknown key; the nearest is lattice.cells"
    ),
    "[[exclude]]\nlatice.cells = 2": (
        "[[exclude]] latice.cells = 2: unknown key; the nearest is lattice.cells"
    ),
    "[[exclude]]": "[[exclude]] = {}: is empty; allowed: at least one key",
    "[[exclude]]\nlattice.cells = []": (
        "[[exclude]] lattice.cells = []: is empty; allowed: at least one value"
    ),
    '[[exclude]]\nrank.budgets = ["2 g"]': (
        '[[exclude]] rank.budgets = "2 g": unknown key; the nearest is solver.hinges'
    ),
    "[grid]\nlattice.cells = [2, 3]\n[[exclude]]\nlattice.cells = 2\n"
    "[[exclude]]\nlattice.cells = 4\ncontact.friction = 0.3": (
        "[[exclude]] of lattice.cells, contact.friction, number 2: drops no case; allowed: tables"
        " that drop at least one"
    ),
    "[grid]\nlattice.cells = [2, 3]\n[[exclude]]\nlattice.cells = [2, 3]": (
        "[[exclude]] drops all 2 cases; allowed: tables that leave at least one"
    ),
}


@pytest.fixture
def load(tmp_path):
    def loaded(text):
        path = tmp_path / "sweep.toml"
        path.write_text(text)
        return load_config(path)

    return loaded


@pytest.fixture
def lines(load):
    """The lines of the error that a config answers with."""

    def refused(text):
        with pytest.raises(ConfigError) as caught:
            load(text)
        return str(caught.value).splitlines()

    return refused


@pytest.mark.parametrize("text", [*VALUES, *UNFIT, *AXES])
def test_one_fault_is_one_line(lines, text):
    assert lines(text) == [(VALUES | UNFIT | AXES)[text]]


@pytest.mark.parametrize("text", CHOICES)
def test_unknown_choices_name_the_known_ones(lines, text):
    value, allowed = CHOICES[text].split("; ")
    assert lines(text) == [f"{value}: unknown choice; allowed: {allowed}"]


def test_not_toml(lines, tmp_path):
    (line,) = lines("hello world")
    assert line.startswith(f"{tmp_path / 'sweep.toml'}: not TOML (Expected '='")


def test_missing_file(tmp_path):
    with pytest.raises(ConfigError, match=r"no\.toml: cannot be read \(No such file"):
        load_config(tmp_path / "no.toml")


def test_default_material_that_is_not_there(lines, tmp_path, monkeypatch):
    monkeypatch.setattr(material_file, "FOLDER", tmp_path)
    (line,) = lines("")
    assert line.startswith('material.name: "ninjaflex" is no material; allowed: ')


def test_not_text(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ConfigError, match="not TOML"):
        load_config(path)


def test_all_faults_are_told_at_once(lines):
    told = lines(
        '[lattice]\nwall_thickness = "3 mm"\n'
        '[material]\nname = "x"\n'
        '[contact]\nfriction = -1\nmodel = "foo"\n'
        '[grid]\nsolver.tol = [1]\nloading.force = ["1 N", 2]'
    )
    keys = [line.split(" = ")[0] for line in told]
    assert keys == [
        "material.name",
        "contact.friction",
        "contact.model",
        "[grid] solver.tol",
        "[grid] loading.force",
        "lattice.wall_thickness",
    ]


MANY = {
    f"[grid]\nlattice.wall_thickness = {[*range(2000)]}": "[grid] lattice.wall_thickness",
    f"[[zip]]\nlattice.cells = {[-1] * 2000}\nlattice.depth = {['1 mm'] * 2000}": (
        "[[zip]] lattice.cells"
    ),
    "[contact]\n" + "".join(f"key{n} = 1\n" for n in range(2000)): "contact.key",
    f"[[exclude]]\nlattice.depth = {[*range(2000)]}": "[[exclude]] lattice.depth",
}


@pytest.mark.parametrize("text", MANY)
def test_of_many_faults_ten_are_told_and_the_rest_counted(load, text):
    with pytest.raises(ConfigError) as caught:
        load(text)
    *told, last = str(caught.value).splitlines()
    assert len(told) == 10
    assert all(line.startswith(MANY[text]) for line in told)
    assert last == "and 1,990 more mistakes"
    assert len(caught.value.faults) == 2000


def test_faults_of_one_key_do_not_hide_those_of_others(lines):
    bad = ", ".join(["0"] * 10)
    told = lines(f"[grid]\nlattice.depth = [{bad}]\nsolver.tol = [1]")
    assert ["lattice.depth" in line for line in told] == [True] * 9 + [False] * 2
    assert "solver.tol = [1]: unknown key" in told[9]
    assert told[10] == "and 1 more mistake"


def test_what_may_only_follow_from_a_fault_is_not_told(lines):
    (line,) = lines('[lattice]\ncels = 1\nwall_thickness = "3 mm"')
    assert "lattice.cels" in line


def test_one_bad_value_is_one_line_in_many_cases(lines):
    (line,) = lines(
        '[lattice]\nwall_thickness = "2 mm"\n'
        "[grid]\nlattice.cells = [2, 3, 4, 5]\ncontact.friction = [0.1, 0.2]"
    )
    assert line.endswith("(4 of 8 combinations)")


def test_of_a_lattice_that_is_refused_no_mass_is_told(lines):
    (line,) = lines('[lattice]\ncells = 6\nnodes_per_wall = 999\nmass = "9 g"')
    assert line.startswith("lattice.nodes_per_wall = 999: does not fit; allowed: at most 50,000")


@pytest.mark.parametrize("walls", ['"", "0.8 mm"', '"0.8 mm", ""'])
def test_a_wall_beside_a_mass_is_refused_though_an_equal_lattice_by_default_is_not(lines, walls):
    (line,) = lines(
        '[lattice]\nmass = "1 g"\n'
        f"[[zip]]\nlattice.wall_thickness = [{walls}]\nloading.strain = [0.5, 0.6]"
    )
    assert line.startswith('lattice.wall_thickness = "0.8 mm": does not fit; allowed: 0.7')
    assert line.endswith("mm at the mass given; give one of them (1 of 2 combinations)")


def test_a_text_with_line_breaks_stays_in_one_line(lines):
    assert len(lines('[material]\nname = "a\\nb"\n"c\\nd" = 1')) == 2
