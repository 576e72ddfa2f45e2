"""Keys of materials with a memory: what they imply, and what is refused."""

import pytest
from pydantic import ValidationError

from sweep.config.case import Case, Damping, Lattice, Loading, Material, Solver
from sweep.config.grid import ConfigError, expand
from sweep.config.material_file import REFERENCE_TIME
from sweep.config.structure import Load, Structure, Support
from sweep.config.units import load_config

CRUSH = Loading(mode="displacement", strain=0.5)
SOFT = {"softening_r": 2.0, "softening_m": 1e5}
NUMBERS = {"modulus": 2e9, "density": 1240.0, "poisson": 0.35}
PLASTIC = NUMBERS | {"yield_stress": 50e6}
BRANCHES = 'relaxation = [{time = "1 ms", share = 0.05}, {time = "2 s", share = "30 %"}]'


def read(tmp_path, text):
    path = tmp_path / "memory.toml"
    path.write_text(text, "utf-8")
    return expand(load_config(path))


def faults(tmp_path, text):
    with pytest.raises(ConfigError) as caught:
        read(tmp_path, text)
    return str(caught.value)


def test_a_loss_implies_a_pace_and_no_other_damping():
    case = Case(material=Material(loss=0.4), loading=CRUSH)
    assert case.loading.speed == pytest.approx(0.01 * case.lattice.height)
    assert case.loading.quasi_static
    assert case.damping.model == "none"
    assert case.material.reference_time is not None
    fast = Case(material=Material(loss=0.4), loading=Loading(mode="impact"))
    assert fast.damping.model == "none"
    damped, struck = Damping(model="rayleigh"), Loading(mode="impact")
    asked = Case(material=Material(loss=0.4), loading=struck, damping=damped)
    assert asked.damping.model == "rayleigh"


def test_without_memory_nothing_changes():
    case = Case(loading=CRUSH)
    assert case.loading.speed is None
    assert case.material.reference_time is None
    assert Case(loading=Loading(mode="impact")).damping.model == "rayleigh"
    timed = Case(loading=Loading(mode="displacement", strain=0.5, strain_rate=3.0))
    assert timed.case_id == case.case_id
    assert Case(material=Material(reference_time=3.0), loading=CRUSH).case_id == case.case_id


def test_pace_and_branches_are_part_of_the_id():
    cases = [
        Case(material=Material(loss=0.4), loading=CRUSH),
        Case(material=Material(loss=0.3), loading=CRUSH),
        Case(material=Material(loss=0.4, reference_time=2.0), loading=CRUSH),
        Case(
            material=Material(loss=0.4),
            loading=Loading(mode="displacement", strain=0.5, strain_rate=1.0),
        ),
        Case(material=Material(relaxation_times=(1.0,), relaxation_shares=(0.5,)), loading=CRUSH),
        Case(material=Material(**SOFT), loading=CRUSH),
    ]
    assert len({case.case_id for case in cases}) == len(cases)


def test_branches_are_a_list_of_tables(tmp_path):
    (case,) = read(tmp_path, f'[material]\n{BRANCHES}\n[loading]\nstrain_rate = "2 1/s"')
    assert case.material.relaxation_times == (1e-3, 2.0)
    assert case.material.relaxation_shares == (0.05, 0.3)
    assert case.material.reference_time is not None
    assert case.loading.mode == "displacement"
    assert case.loading.speed == pytest.approx(2.0 * case.lattice.height)


def test_numbers_have_a_reference_time_too():
    material = Material(**NUMBERS, loss=0.2)
    assert material.reference_time == REFERENCE_TIME
    assert material.bend == "linear"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (f"[material]\nloss = 0.2\n{BRANCHES}", "one of loss and relaxation"),
        ('[material]\nrelaxation = [{time = "1 s", share = 1.2}]', "share"),
        ('[material]\nrelaxation = ["1 s"]', "a list of tables"),
        (
            '[material]\nrelaxation = [{time = "1 s", share = 0.6}, {time = "2 s", share = 0.6}]',
            "shares whose sum is below 1",
        ),
        ("[material]\nloss = 0.9", "material.loss"),
        (
            '[material]\nloss = 0.2\n[loading]\nspeed = "1 m/s"\nstrain_rate = "1 1/s"',
            "one of speed and strain_rate",
        ),
        ('[material]\nreference_time = "2 s"', "does not depend on time"),
        ('[loading]\nstrain = 0.5\nstrain_rate = "2 1/s"', "does not depend on time"),
        ('[material]\nsoftening_m = "1 MPa"', "softening_r is not given"),
        ("[material]\nsoftening_r = 2.0", "a stress, as softening_r is given"),
        ('[material]\nsoftening_r = 2.0\nsoftening_m = "1 MPa"\nbend = "linear"', "section"),
        ("[material]\nfibres = 7", 'material.bend is "section"'),
        ("[material]\nfracture_strain = 0.1", "yield_stress is not given"),
        (
            '[material]\nmodulus = "2 GPa"\ndensity = "1240 kg/m^3"\nyield_stress = "50 MPa"\n'
            "loss = 0.2",
            "none if loss is given",
        ),
    ],
)
def test_what_contradicts_or_has_no_effect_is_refused(tmp_path, text, words):
    assert words in faults(tmp_path, text)


def test_a_path_of_equilibria_has_no_time():
    wall = Structure(
        nodes_mm=((0, 0), (10, 0)),
        walls=((0, 1),),
        supports=(Support(node=0, fix=("x", "y", "rotation")),),
        loads=(Load(node=1, force_N=(0.0, -1e-3)),),
    )
    lattice, path = Lattice(kind="custom", structure=wall), Solver(integrator="arc_length")
    assert Case(lattice=lattice, solver=path).solver.integrator == "arc_length"
    with pytest.raises(ValidationError, match="memory"):
        Case(lattice=lattice, material=Material(loss=0.2), solver=path)


@pytest.mark.parametrize("key", [{"loss": 0.2}, SOFT], ids=["loss", "softening"])
def test_a_curve_that_falls_has_no_memory(key):
    falling = {"curve_strain": (0.1, 0.2, 0.4), "curve_stress": (1e6, 1.5e6, 1.4e6)}
    given = NUMBERS | falling | {"name": "falls", "reference_time": 1.0, "softening_beta": 0.1}
    with pytest.raises(ValidationError, match=r"beyond a strain of 0\.2"):
        Material(**given | key)


def test_a_material_that_yields_bends_through_fibres():
    material = Material(**PLASTIC)
    assert (material.stretch, material.bend, material.fibres) == ("linear", "fibres", 7)
    assert material.hardening == 0.0
    assert material.remembers
    assert not material.relaxes
    with pytest.raises(ValidationError, match="linear"):
        Material(**PLASTIC, stretch="nonlinear")
