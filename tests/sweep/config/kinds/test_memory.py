"""Keys of materials that soften, yield, or bend through fibres: their consequences and refusals.

Keys of materials that relax: `test_relaxation`.
"""

import pytest

from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError
from sweep.config.materials.material_file import REFERENCE_TIME
from tests.support.designs.tables import material_with

SOFT = {"softening_r": 2.0, "softening_m": 1e5}
NUMBERS = {"modulus": 2e9, "density": 1240.0, "poisson": 0.35}
PLASTIC = NUMBERS | {"yield_stress": 50e6}


def test_numbers_have_a_reference_time_too():
    material = material_with(**NUMBERS, loss=0.2)
    assert material.reference_time == REFERENCE_TIME
    assert material.bend == "linear"
    added = Case.of(material=NUMBERS).changed(material={"loss": 0.2}).material
    assert added.reference_time == REFERENCE_TIME


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ('softening_m = "1 MPa"', "has no effect, as material.softening_r is not given"),
        ("softening_r = 2.0", "a stress, as softening_r is given"),
        ('softening_r = 2.0\nsoftening_m = "1 MPa"\nbend = "linear"', '"section" or "fibres"'),
        ("fibres = 7", 'has no effect, as material.bend is "section"'),
        ("fracture_strain = 0.1", "has no effect, as material.yield_stress is not given"),
    ],
)
def test_what_contradicts_or_has_no_effect_is_refused(lines, text, line):
    (told,) = lines(f"[material]\n{text}")
    assert line in told


def test_a_measured_memory_that_the_config_replaces_is_refused(load, last_refused, tmp_path):
    curve = "strain,stress_Pa\n0.01,1e5\n0.05,4e5\n0.5,1.2e6\n1,2e6\n"
    head = "# density_kg_m3: 1100\n# poisson: 0.4\n"
    (tmp_path / "mine.csv").write_text(f"{head}# loss: 0.3\n{curve}")
    named, asked = '[material]\nname = "mine.csv"\n', 'memory = "measured"'
    for given in ("loss = 0.2", 'relaxation = [{time = "1 s", share = 0.1}]'):
        assert last_refused(f"{named}{given}\n{asked}", "no effect, as the config itself gives")
    (tmp_path / "softer.csv").write_text(f"{head}# softening_r: 2\n# softening_m_Pa: 1e6\n{curve}")
    softer = f'{asked}\nloss = 0.2\n[grid]\nmaterial.name = ["mine.csv", "softer.csv"]'
    assert len(load(named + softer).cases) == 2


def test_a_material_that_yields_bends_through_fibres():
    material = material_with(**PLASTIC)
    assert (material.stretch, material.bend, material.fibres) == ("linear", "fibres", 7)
    assert material.hardening == 0.0
    assert material.remembers
    assert not material.relaxes
    with pytest.raises(RefusedError, match="linear"):
        material_with(**PLASTIC, stretch="nonlinear")
