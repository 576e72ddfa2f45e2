"""No key that a user writes is without effect in silence: a sweep that needs it not says so."""

import json

import pytest

from sweep.config.faults import ConfigError
from sweep.config.grid import expand
from tests.support.designs.structures import BEAM, ROD

BOTH = '[grid]\nloading.mode = ["force", "displacement"]\n'
PRESSED = '[loading]\nmode = "displacement"\n'
IMPACT = '[loading]\nmode = "impact"\n'
STATIC = "as the crush is quasi-static; needed: a loading.speed"
DRIVEN = '; needed: loading.mode = "displacement"'
LOADED = f'as loading.mode is "force"{DRIVEN}'
STRUCK = f'as loading.mode is "impact"{DRIVEN}'
TOUCHES = 'as contact.model is "none"; needed: contact.model = "barrier"'
PLATEN = 'as loading.mode is "displacement"; needed: loading.mode = "force"'
APART = '[contact]\nmodel = "none"\n'
FAST = '[loading]\nspeed = "1 m/s"\n[solver]\n'
PAIR = '[[zip]]\nloading.mode = ["displacement", "displacement"]\nloading.force = '

SHEET = 'slicer = "orca"\npattern = "gyroid"\ninfill = "20 %"\n'
BLOCK = SHEET + 'perimeters = 2\nwidth = "14 mm"\n'

IDLE = [
    (PRESSED + 'force = "3 N"', PLATEN),
    ('[loading]\nforce = "3 N"\nload_steps = 9', LOADED),
    ('[loading]\nhold_time = "3 s"', "it has neither loss nor relaxation"),
    ('[loading]\nstriker = "edge"\nstriker_radius = "3 mm"', 'as loading.striker is not "round"'),
    (IMPACT + 'hold_time = "3 s"', STRUCK),
    (IMPACT + '[solver]\naccuracy = "1 %"', STRUCK),
    (FAST + 'integrator = "newmark"\naccuracy = 0.01', 'needed: solver.integrator = "static"'),
    (FAST + 'load_steps = 9\ntime_step = "1 ms"', "as solver.load_steps sets it"),
    (PRESSED + '[damping]\nmass = "5 1/s"', STATIC),
    (PRESSED + '[solver]\ntime_step = "1 ms"', STATIC),
    (PRESSED + '[solver]\nintegrator = "backward_euler"', STATIC),
    (PRESSED + '[contact]\nslip_speed = "1 mm/s"', STATIC),
    ('[contact]\nfriction = 0.0\nslip_speed = "1 mm/s"', "as contact.friction is 0"),
    (APART + "friction = 0.2", TOUCHES),
    ('[damping]\nrelaxation_time = "1 ms"', 'needed: damping.model = "kelvin_voigt"'),
    (PRESSED + '[grid]\nloading.force = ["1 N", "2 N"]', PLATEN),
    ("[[zip]]\nlattice.cells = [2, 3]\nloading.load_steps = [9, 8]", LOADED),
    (f'{PAIR}["", "5 N"]', PLATEN),
    ('[material]\nplane = "stress"\n[grid]\nmaterial.poisson = [0.3, 0.4]', "plane is"),
]

NEEDED = [
    BOTH + '[loading]\nforce = "3 N"\nstrain = 0.5\nload_steps = 9\n[damping]\nmass = "1 1/s"',
    '[loading]\nquasi_static = true\nspeed = "100 mm/min"',  # a label
    '[loading]\nspeed = "1 m/s"\n[solver]\ntime_step = "0.17 ms"',  # made to fit the stroke
    '[loading]\nspeed = "1 m/s"\n[damping]\nmass = "1 1/s"\n[contact]\nslip_speed = "1 m/s"',
    '[[zip]]\nloading.mode = ["force", "displacement"]\nloading.force = ["3 N", ""]',
    '[[zip]]\nloading.mode = ["displacement", "displacement"]\nloading.force = ["", ""]',
    '[material]\nplane = "stress"\npoisson = 0.4\n[loading]\nallowed_forces = ["1 N"]',
    '[contact]\nmodel = "none"\nfriction = 0.2\n[loading]\nplaten = "contact"',
    PRESSED + '[damping]\nmodel = "none"\n[solver]\nintegrator = "static"',
    "[lattice]\ncells = 3\n[grid]\nlattice.cells = [2, 3]",
    f"[lattice]\n{BLOCK}",  # the nearest width that fits
    f'[lattice]\n{BLOCK}sides = "free"',
    f'[lattice]\n{SHEET}sides = "periodic"',
    '[contact]\nmodel = "auto"',  # becomes the barrier
]


@pytest.mark.parametrize(("text", "why"), IDLE)
def test_a_key_that_no_case_needs_is_refused_with_the_reason(last_refused, text, why):
    assert last_refused(text, "has no effect, as", why)


def test_long_lists_and_excluded_cases_do_not_hide_an_idle_key(refused):
    stiffness = f"contact.stiffness = {[0.1 + 0.01 * i for i in range(20)]}\n"
    assert refused(f"{BOTH}{stiffness}{APART}", "[grid] contact.stiffness = [...]", TOUCHES)
    excluded = f'{BOTH}[[exclude]]\nloading.mode = "force"\n[loading]\nforce = "3 N"'
    assert refused(excluded, 'loading.force = "3 N"', PLATEN)


@pytest.mark.parametrize("text", NEEDED)
def test_a_key_that_some_case_needs_is_fine(load, text):
    assert len(expand(load(text))) > 0


PANEL = 'one period of a panel is computed, of which loading.direction "in_plane" presses'
FAMILIES = 'as lattice.kind is "gyroid"; needed: lattice.kind = "brick", "circle"'


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ('orientation = "flat"', 'lattice.kind is "square"'),
        ('line_width = "0.5 mm"', "lattice.perimeters nor a"),
        ('perimeters = 1\nlayer_height = "0.5 mm"', "lattice.solid_layers is 0"),
        ('kind = "gyroid"\nwidth = "20 mm"', f"{PANEL} lattice.height"),
        ('kind = "gyroid"\ndepth = "20 mm"', 'loading.direction "in_plane" presses lattice.height'),
        ('kind = "gyroid"\ncells = 3', FAMILIES),
        ('kind = "gyroid"\ncells_x = 3', '"square" or "triangle"'),  # not of a slicer's share
        (f'{BLOCK}sides = "periodic"', "lattice.perimeters hold the sides of a block"),
        (SHEET + 'sides = "free"', "lattice.perimeters is 0: one period of a panel is computed"),
        ('kind = "hex"\nfile_unit = "1 mm"', 'needed: lattice.kind = "drawn"'),
        ('fill_angle = "45 deg"', 'as lattice.kind is "square"; needed: a lattice.slicer'),
    ],
)
def test_what_the_infill_does_not_use_is_refused(last_refused, text, why):
    assert last_refused(f"[lattice]\n{text}", "has no effect", why)


def test_all_idle_keys_are_told_at_once_and_after_a_misspelt_one_none(load):
    text = PRESSED + '[damping]\nmass = "5 1/s"\n[solver]\ntime_step = "1 ms"\n'
    with pytest.raises(ConfigError, match=r"(?s)damping\.mass.*\n.*time_step.*quasi-static"):
        load(text)
    with pytest.raises(ConfigError, match=r"^lattice\.cels [^\n]*$"):
        load(text + "[lattice]\ncels = 3")


MOVING = {"initial_velocity_mm_s": [0, 3]}
MASSES = {"masses": [{"node": 1, "mass_g": 2}]}


@pytest.mark.parametrize(
    ("parts", "line"),
    [
        (MOVING, "its initial_velocity_mm_s has no effect, as solver.integrator is"),
        (MASSES, "masses in it have no effect, as solver.integrator is"),
    ],
)
def test_what_counts_in_motion_alone_is_refused_in_statics(load, refused, tmp_path, parts, line):
    file = tmp_path / "one.json"
    file.write_text(json.dumps(BEAM | parts))
    text = '[lattice]\nkind = "custom"\nfile = "one.json"\n[grid]\nsolver.integrator = '
    assert refused(f'{text}["static"]', 'lattice.file = "one.json"', line)
    assert load(f'{text}["static", "bdf2"]')
    assert load(f'{text}["bdf2"]')
    file.write_text(json.dumps(BEAM | MASSES | {"gravity_mm_s2": [0, -9810]}))
    assert load(f'{text}["static"]')


def test_statics_that_another_key_implies_is_refused_with_that_key(refused, tmp_path):
    (tmp_path / "loose.json").write_text(json.dumps(ROD))
    text = '[lattice]\nkind = "custom"\nfile = "loose.json"\n[loading]\nquasi_static = true'
    assert refused(
        text, 'solver.integrator = "static", as loading.quasi_static is given', "allowed:"
    )


def test_damping_that_a_material_that_relaxes_has_not_by_default(load, lines):
    asked = '[material]\nloss = 0.3\n[loading]\nmode = "impact"\n[damping]\nmass = "5 1/s"\n'
    (line,) = lines(asked)
    assert 'damping.model is "none" by default if the material relaxes; needed: damping.m' in line
    assert load(f'{asked}model = "rayleigh"').cases[0].damping.mass == 5.0
    (line,) = lines(f'{asked}model = "none"')
    assert 'has no effect, as damping.model is "none"; needed' in line
