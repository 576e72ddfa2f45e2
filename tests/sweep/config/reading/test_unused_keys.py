"""No key that a user writes is without effect in silence: a sweep that needs it not says so."""

import json

import pytest

from sweep.config.faults import ConfigError
from sweep.config.grid import expand
from sweep.config.load import load_config
from tests.support.designs.structures import BEAM, ROD

BOTH = '[grid]\nloading.mode = ["force", "displacement"]\n'
PRESSED = '[loading]\nmode = "displacement"\n'
STATIC = "as the crush is quasi-static; needed: a loading.speed"
DRIVEN = '; needed: loading.mode = "displacement"'
LOADED = f'as loading.mode is "force"{DRIVEN}'
TOUCHES = 'as contact.model is "none"; needed: contact.model = "barrier"'
PLATEN = 'as loading.mode is "displacement"; needed: loading.mode = "force"'

SHEET = 'slicer = "orca"\npattern = "gyroid"\ninfill = "20 %"\n'
BLOCK = SHEET + 'perimeters = 2\nwidth = "14 mm"\n'

IDLE = {
    PRESSED + 'force = "3 N"': f'loading.force = "3 N": {PLATEN}',
    '[loading]\nforce = "3 N"\nload_steps = 9': f"loading.load_steps = 9: {LOADED}",
    '[loading]\nhold_time = "3 s"': (
        'loading.hold_time = "3 s": as the stress of the material does not depend on time:'
        " it has neither loss nor relaxation"
    ),
    '[loading]\nstriker = "edge"\nstriker_radius = "3 mm"': (
        'loading.striker_radius = "3 mm": as loading.striker is not "round"'
    ),
    '[loading]\nmode = "impact"\nhold_time = "3 s"': (
        f'loading.hold_time = "3 s": as loading.mode is "impact"{DRIVEN}'
    ),
    '[loading]\nmode = "impact"\n[solver]\naccuracy = "1 %"': (
        f'solver.accuracy = "1 %": as loading.mode is "impact"{DRIVEN}'
    ),
    PRESSED + 'speed = "1 m/s"\n[solver]\nintegrator = "newmark"\naccuracy = 0.01': (
        'solver.accuracy = 0.01: as solver.integrator is "newmark"; '
        'needed: solver.integrator = "static"'
    ),
    PRESSED + '[damping]\nmass = "5 1/s"': f'damping.mass = "5 1/s": {STATIC}',
    PRESSED + '[solver]\ntime_step = "1 ms"': f'solver.time_step = "1 ms": {STATIC}',
    PRESSED + '[solver]\nintegrator = "backward_euler"': (
        f'solver.integrator = "backward_euler": {STATIC}'
    ),
    PRESSED + '[contact]\nslip_speed = "1 mm/s"': f'contact.slip_speed = "1 mm/s": {STATIC}',
    '[contact]\nslip_speed = "1 mm/s"\nfriction = 0.0': (
        'contact.slip_speed = "1 mm/s": as contact.friction is 0'
    ),
    '[contact]\nmodel = "none"\nfriction = 0.2': (f"contact.friction = 0.2: {TOUCHES}"),
    '[damping]\nrelaxation_time = "1 ms"': (
        'damping.relaxation_time = "1 ms": as damping.model is "rayleigh"; '
        'needed: damping.model = "kelvin_voigt"'
    ),
    '[loading]\nspeed = "1 m/s"\n[solver]\nload_steps = 9\ntime_step = "1 ms"': (
        'solver.time_step = "1 ms": as solver.load_steps sets it'
    ),
    PRESSED + '[grid]\nloading.force = ["1 N", "2 N"]': (
        f'[grid] loading.force = ["1 N", "2 N"]: {PLATEN}'
    ),
    "[[zip]]\nlattice.cells = [2, 3]\nloading.load_steps = [9, 8]": (
        f"[[zip]] loading.load_steps = [9, 8]: {LOADED}"
    ),
    '[material]\nplane = "stress"\n[grid]\nmaterial.poisson = [0.3, 0.4]': (
        '[grid] material.poisson = [0.3, 0.4]: as material.plane is "stress"'
    ),
    '[[zip]]\nloading.mode = ["displacement", "displacement"]\nloading.force = ["", "5 N"]': (
        f'[[zip]] loading.force = ["", "5 N"]: {PLATEN}'
    ),
    BOTH + f"contact.stiffness = {[0.1 + 0.01 * i for i in range(20)]}\n"
    '[contact]\nmodel = "none"': f"[grid] contact.stiffness = [...]: {TOUCHES}",
    BOTH + '[[exclude]]\nloading.mode = "force"\n[loading]\nforce = "3 N"': (
        f'loading.force = "3 N": {PLATEN}'
    ),
}

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
]


@pytest.mark.parametrize("text", IDLE)
def test_a_key_that_no_case_needs_is_refused_with_the_reason(load, text):
    with pytest.raises(ConfigError) as caught:
        load(text)
    key, why = IDLE[text].split(": as")
    assert str(caught.value) == f"{key}: has no effect, as{why}"


@pytest.mark.parametrize("text", NEEDED)
def test_a_key_that_some_case_needs_is_fine(load, text):
    assert len(expand(load(text))) > 0


@pytest.mark.parametrize(
    ("text", "key", "why"),
    [
        ('orientation = "flat"', 'orientation = "flat"', 'lattice.kind is "square"'),
        ('line_width = "0.5 mm"', 'line_width = "0.5 mm"', "lattice.perimeters nor a"),
        (
            *('perimeters = 1\nlayer_height = "0.5 mm"', 'layer_height = "0.5 mm"'),
            "lattice.solid_layers is 0",
        ),
        (
            *('kind = "gyroid"\nwidth = "20 mm"', 'width = "20 mm"'),
            'one period of a panel is computed, of which loading.direction "in_plane" presses '
            "lattice.height",
        ),
        (
            *('kind = "gyroid"\ndepth = "20 mm"', 'depth = "20 mm"'),
            'loading.direction "in_plane" presses lattice.height',
        ),
        (
            *(f'{BLOCK}sides = "periodic"', 'sides = "periodic"'),
            "lattice.perimeters hold the sides of a block",
        ),
        (
            *(SHEET + 'sides = "free"', 'sides = "free"'),
            "lattice.perimeters is 0: one period of a panel is computed",
        ),
        (
            *('kind = "gyroid"\ncells = 3', "cells = 3"),
            'as lattice.kind is "gyroid"; needed: lattice.kind = "brick", "circle"',
        ),
        (
            'kind = "hex"\nfile_unit = "1 mm"',
            'file_unit = "1 mm"',
            'needed: lattice.kind = "drawn"',
        ),
        (
            *('fill_angle = "45 deg"', 'fill_angle = "45 deg"'),
            'as lattice.kind is "square"; needed: a lattice.slicer',
        ),
    ],
)
def test_what_the_infill_does_not_use_is_refused(refused, text, key, why):
    assert refused(f"[lattice]\n{text}", f"lattice.{key}", "has no effect", why)


def test_a_kind_whose_key_follows_from_others_is_not_needed(lines):
    """Cells of a slicer follow from its share."""
    (line,) = lines('[lattice]\nkind = "gyroid"\ncells_x = 3')
    assert line.endswith('"square" or "triangle"')


def test_all_idle_keys_are_told_at_once_and_after_a_misspelt_one_none(load):
    text = PRESSED + '[damping]\nmass = "5 1/s"\n[solver]\ntime_step = "1 ms"\n'
    with pytest.raises(ConfigError, match=r"(?s)damping\.mass.*\n.*time_step.*quasi-static"):
        load(text)
    with pytest.raises(ConfigError, match=r"^lattice\.cels [^\n]*$"):
        load(text + "[lattice]\ncels = 3")


def in_statics(folder, integrators, **parts):
    """Load the sweep of a structure over integrators."""
    (folder / "one.json").write_text(json.dumps(BEAM | parts))
    text = '[lattice]\nkind = "custom"\nfile = "one.json"\n[grid]\nsolver.integrator = '
    (folder / "sweep.toml").write_text(f"{text}{json.dumps(integrators)}")
    return load_config(folder / "sweep.toml")


@pytest.mark.parametrize(
    ("parts", "line"),
    [
        (
            {"initial_velocity_mm_s": [0, 3]},
            'its initial_velocity_mm_s has no effect, as solver.integrator is "static"',
        ),
        (
            {"masses": [{"node": 1, "mass_g": 2}]},
            'masses in it have no effect, as solver.integrator is "static" and there is no gravity',
        ),
    ],
)
def test_what_counts_in_motion_alone_is_refused_in_statics(tmp_path, parts, line):
    with pytest.raises(ConfigError) as caught:
        in_statics(tmp_path, ["static"], **parts)
    assert str(caught.value) == f'lattice.file = "one.json": {line}'
    assert in_statics(tmp_path, ["static", "bdf2"], **parts)
    assert in_statics(tmp_path, ["bdf2"], **parts)


def test_weights_count_in_statics(tmp_path):
    heavy = {"masses": [{"node": 1, "mass_g": 2}], "gravity_mm_s2": [0, -9810]}
    assert in_statics(tmp_path, ["static"], **heavy)


def test_statics_that_another_key_implies_is_refused_with_that_key(load, tmp_path):
    (tmp_path / "loose.json").write_text(json.dumps(ROD))
    with pytest.raises(ConfigError) as caught:
        load('[lattice]\nkind = "custom"\nfile = "loose.json"\n[loading]\nquasi_static = true')
    assert str(caught.value).startswith(
        'solver.integrator = "static", as loading.quasi_static is given: does not fit; allowed:'
    )


@pytest.mark.parametrize("loading", [PRESSED, '[loading]\nmode = "impact"\n', ""])
def test_contact_by_itself_counts_alone(tmp_path, loading):
    path = tmp_path / "auto.toml"
    path.write_text(loading + '[contact]\nmodel = "auto"\n', "utf-8")
    (case,) = expand(load_config(path))
    assert case.contact.model == "barrier"


def test_damping_that_a_material_that_relaxes_has_not_by_default(load, lines):
    asked = '[material]\nloss = 0.3\n[loading]\nmode = "impact"\n[damping]\nmass = "5 1/s"\n'
    (line,) = lines(asked)
    assert line.endswith(
        'has no effect, as damping.model is "none" by default if the material relaxes; needed: '
        'damping.model = "rayleigh"'
    )
    assert load(f'{asked}model = "rayleigh"').cases[0].damping.mass == 5.0
    (line,) = lines(f'{asked}model = "none"')
    assert 'has no effect, as damping.model is "none"; needed' in line
