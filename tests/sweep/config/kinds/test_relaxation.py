"""Keys of a material that relaxes: how branches are written, and keys that exclude a memory."""

import pytest

from sweep.config.case import Case
from sweep.config.grid import expand
from sweep.config.materials.material_file import locate, not_rising, read_record
from sweep.scene.material import stress_law
from tests.support.designs.structures import BEAM, structure
from tests.support.designs.tables import lattice_with, material_with
from tests.support.materials.records import HEADER, RUBBERS

SAGS = "0.01,1e5\n0.05,4e5\n0.1,3e5\n1,2e6\n"
LEVEL = "0.01,1e5\n0.05,2e5\n0.1,10e5\n0.2,10.1e5\n"
BRANCHES = 'relaxation = [{time = "1 ms", share = 0.1}, {time = "2 s", share = "20 %"}]'
BRANCH = '{time = "1 ms", share = 0.05}'
STEADY = "neither loss nor relaxation"
PRESSED = "[material]\nloss = 0.4\n[loading]\n"

SHARES = 'relaxation = [{time = "1 ms", share = 0.5}, {time = "1 s", share = "50 %"}]'
RATE = 'strain_rate = "1 1/s"'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (f"{BRANCHES}\nloss = 0.4", ["one of loss and relaxation"]),
        ("relaxation = []", [BRANCH]),
        ("relaxation = 0.3", [BRANCH]),
        ('relaxation_times = ["1 ms"]', ["for each share"]),
        ("loss = 0.9", ["out of range", "at least 0, at most 0.8"]),
        ('reference_time = "1 s"', ["no effect", STEADY]),
        (f'[loading]\nmode = "displacement"\n{RATE}', ["no effect", STEADY]),
        (f'{PRESSED}speed = "1 mm/s"\n{RATE}', ["one of speed and strain_rate"]),
        (f"{PRESSED}quasi_static = false\n{RATE}", ["a speed, if quasi_static is false"]),
    ],
)
def test_refused(text, words, last_refused):
    assert last_refused(text if "[loading]" in text else f"[material]\n{text}", *words)


def test_branches_are_refused_as_they_are_written(refused):
    shares = 'material.relaxation_shares = [0.5, "50 %"]'
    assert refused(f"[material]\n{SHARES}", shares, "below 1")
    branch = 'material.relaxation = [{"time": "1 ms"}]'
    assert refused('[material]\nrelaxation = [{time = "1 ms"}]', branch, BRANCH)


def test_branches_are_a_list_of_tables(load):
    (case,) = expand(load(f'[material]\n{BRANCHES}\nreference_time = "0.5 s"'))
    material = case.material
    assert material.relaxation_times == pytest.approx((1e-3, 2.0))
    assert material.relaxation_shares == pytest.approx((0.1, 0.2))
    assert (material.relaxes, material.reference_time) == (True, 0.5)
    (tables,) = expand(load(
        '[material]\nreference_time = "500 ms"\n[[material.relaxation]]\ntime = "0.001 s"\n'
        'share = 0.1\n[[material.relaxation]]\ntime = "2 s"\nshare = 0.2\n'
    ))  # fmt: skip
    assert tables.case_id == case.case_id


def test_a_loss_of_zero_is_none(load):
    elastic, relaxing = expand(load("[grid]\nmaterial.loss = [0, 0.3]"))
    assert elastic.case_id == expand(load("name = 'a'"))[0].case_id != relaxing.case_id
    assert not elastic.material.relaxes
    assert material_with(modulus=1e7, density=1e3, loss=0).loss is None
    assert not relaxing.changed(material={"loss": 0.0}).material.relaxes


def test_a_curve_that_falls_does_not_relax(own_record):
    path = own_record(HEADER + SAGS)
    assert not material_with(name=str(path)).relaxes
    falls = r"does not rise from a strain of 0\.05 on"
    with pytest.raises(ValueError, match=rf"material\.loss = 0\.3; .* {falls}"):
        material_with(name=str(path), loss=0.3)
    branch = {"relaxation_times": (1.0,), "relaxation_shares": (0.3,)}
    with pytest.raises(ValueError, match=rf"material\.relaxation_times = .* {falls}"):
        material_with(name=str(path), **branch)


def test_a_curve_that_ends_level_does_not_relax(own_record):
    """The record rises, but the law continues along its last tangent, which is flat."""
    path = own_record(HEADER + LEVEL)
    law = stress_law(material_with(name=str(path)))
    _, c1, c2, c3 = law.coefficients[-1]
    width = law.knots[-1] - law.knots[-2]
    modulus = law.coefficients[0, 1]
    assert c1 + 2.0 * c2 * width + 3.0 * c3 * width**2 == pytest.approx(0.0, abs=1e-9 * modulus)
    with pytest.raises(ValueError, match=r"does not rise from a strain of 0\.2 on"):
        material_with(name=str(path), loss=0.3)


@pytest.mark.parametrize("name", RUBBERS)
def test_shipped_curves_rise(name):
    record = read_record(locate(name))
    assert material_with(name=name, loss=0.3).reference_time == record.reference_time


@pytest.mark.parametrize(
    ("strain", "stress", "at"),
    [
        ((-0.5, -0.2, 0.1, 0.2), (-2.0, -2.0, 1.0, 2.0), -0.5),
        ((-0.5, -0.2, 0.1, 0.2), (-2.0, -1.0, 1.0, 1.0), 0.1),
        ((-0.5, -0.4, -0.2, 0.1, 0.2), (-10.1, -10.0, -1.0, 1.0, 2.0), -0.5),
        ((0.002, 0.02, 0.1), (-0.1, 1.0, 5.0), None),
    ],
)
def test_where_a_curve_does_not_rise(strain, stress, at):
    """A straight line replaces its toe, which therefore does not count."""
    assert not_rising(strain, stress) == at


def test_a_crush_with_memory_takes_its_time():
    lattice, loss = lattice_with(), material_with(loss=0.3)
    press = {"mode": "displacement", "strain": 0.3}

    def settled(material=loss, **loading):
        found = Case.of(lattice=lattice, material=material, loading=press | loading).loading
        return found.quasi_static, found.speed

    assert settled() == (True, pytest.approx(0.01 * lattice.height))
    assert settled(strain_rate=2.0) == (True, pytest.approx(2.0 * lattice.height))
    assert settled(speed=0.1) == (False, 0.1)
    assert settled(speed=0.1, quasi_static=True) == (True, 0.1)
    assert settled(material_with(), quasi_static=True, speed=0.1) == (True, None)


def test_a_material_with_memory_has_no_other_damping_unless_asked():
    loss, push = material_with(loss=0.3), dict(force=5.0)
    assert Case.of(loading=push).damping.model == "rayleigh"
    assert Case.of(loading=push, material=loss).damping.model == "none"
    asked = Case.of(loading=push, material=loss, damping=dict(model="rayleigh"))
    assert asked.damping.model == "rayleigh"


def test_arcs_have_no_time():
    arch = structure(**BEAM, loads=[{"node": 1, "force_N": [0.0, -1e-3]}])
    tables = dict(lattice=dict(kind="custom", structure=arch), solver=dict(integrator="arc_length"))
    assert Case.of(**tables).solver.integrator == "arc_length"
    with pytest.raises(ValueError, match=r"arc_length; allowed: .* if the material has a memory"):
        Case.of(**tables, material=dict(loss=0.3))
