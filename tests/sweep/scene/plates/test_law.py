"""The law of a sheet: under uniaxial stress the curve of the material, where that is stable."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.scene.material import stress_law, with_compression
from sweep.scene.plates.law import (
    UNSTABLE,
    UnstableMaterialError,
    law_of_sheet,
    shear_moduli,
)
from sweep.scene.relaxation import relaxation_of
from sweep.simulation.simulate import simulate
from tests.support.designs.tables import material_with


def uniaxial(law, stretch):
    """Nominal stress of a sheet under uniaxial stress, from its energy per volume."""

    def energy(length):
        return law.elastic.respond(length**2 - 1.0, 1.0 / length - 1.0, 0.0)[0]

    step = 1e-6
    return (energy(stretch + step) - energy(stretch - step)) / (2.0 * step)


@pytest.mark.parametrize("name", ["ninjaflex", "ultimaker_tpu95a", "cheetah"])
@pytest.mark.parametrize("strain", [-0.1, -0.01, 0.01, 0.1, 0.5])
def test_stress_of_a_strip_is_that_of_the_curve(name, strain):
    material = material_with(name=name)
    found = uniaxial(law_of_sheet(material), 1.0 + strain)
    assert found == pytest.approx(float(stress_law(material).at(np.array([strain]))[0]), rel=0.02)


def test_linear_material_is_neo_hookean():
    material = material_with(modulus=12e6, density=1200.0)
    mu, stretch = 4e6, 0.8
    assert uniaxial(law_of_sheet(material), stretch) == pytest.approx(
        mu * (stretch - 1.0 / stretch**2), rel=1e-6
    )
    assert shear_moduli(material) == pytest.approx((5.0 / 6.0 * mu,) * 2)


def test_shear_modulus_is_that_of_the_curve_at_rest():
    material = material_with(name="ninjaflex")
    slope = float(stress_law(material).at(np.array([1e-6]))[0]) / 1e-6
    assert shear_moduli(material) == pytest.approx((5.0 / 18.0 * slope,) * 2, rel=1e-6)


@pytest.mark.parametrize("table", [{"name": "ninjaflex"}, {"modulus": 12e6, "density": 1200.0}])
def test_a_material_that_relaxes_has_its_curve_at_the_reference_time(table):
    """At once it is stiffer, by the same factor at all strains."""
    elastic, material = material_with(**table), material_with(**table, loss=0.4)
    law, instant = law_of_sheet(material), relaxation_of(material).instant
    left = law.shares @ np.exp(-material.reference_time / law.times) + 1.0 - law.shares.sum()
    assert instant * left == pytest.approx(1.0, rel=1e-12)
    assert instant > 1.5
    for stretch in (0.8, 1.1, 1.6):
        expected = instant * uniaxial(law_of_sheet(elastic), stretch)
        assert uniaxial(law, stretch) == pytest.approx(expected, rel=1e-6)
    at_once, lasting = shear_moduli(material)
    assert (lasting, at_once) == pytest.approx(
        (shear_moduli(elastic)[0], instant * shear_moduli(elastic)[0])
    )


def test_a_material_that_is_no_stable_rubber_fails_with_a_sentence():
    """The softer of the two rules for the compression of cheetah, which `--spread` runs."""
    case = Case.of(material={"name": "cheetah"}, loading={"direction": "out_of_plane"})
    strain, stress = with_compression(case.material.curve_strain, case.material.curve_stress, 0.0)
    curve = {"curve_strain": tuple(strain.tolist()), "curve_stress": tuple(stress.tolist())}
    material = case.material.model_copy(update=curve)
    with pytest.raises(UnstableMaterialError, match="need a stable rubber"):
        law_of_sheet(material)
    result = simulate(case.model_copy(update={"material": material}))
    assert (result.status, result.message) == ("stopped", UNSTABLE)
