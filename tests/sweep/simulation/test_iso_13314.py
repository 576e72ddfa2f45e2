"""The figures of ISO 13314 on curves whose values are known by hand."""

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from sweep.simulation.iso_13314 import figures

STRAIN = np.linspace(0.0, 0.7, 701)


def measured(strains, stresses, end=0.7):
    """Figures of a curve that is straight between its corners, pressed to a strain."""
    strain = STRAIN[: round(1e3 * end) + 1]
    stress = np.interp(strain, strains, stresses)
    return figures(strain, stress, cumulative_trapezoid(stress, strain, initial=0.0))


def foam(end=0.7):
    """100 Pa from 10 to 60 % strain, then 10 Pa for each percent."""
    return measured([0.0, 0.1, 0.6, 0.7], [0.0, 100.0, 100.0, 200.0], end)


def test_a_foam():
    """Energy up to 50 %: 5 + 40 J/m^3. The plateau ends at 63 %, after 5 + 50 + 3 x 1.15 J/m^3."""
    assert foam() == pytest.approx(
        {
            "plateau_stress_iso_Pa": 100.0,
            "plateau_stress_20_30_Pa": 100.0,
            "plateau_end_strain": 0.63,
            "quasi_elastic_gradient_Pa": 1000.0,
            "energy_to_50_J_per_m3": 45.0,
            "efficiency_to_50": 0.9,
            "energy_to_plateau_end_J_per_m3": 58.45,
            "efficiency_to_plateau_end": 58.45 / (130.0 * 0.63),
        }
    )


def test_the_plateau_may_end_between_two_rows():
    """The stress rises by 9 Pa per percent from 60 % on: 130 Pa at 63.3 %, after 55 + 115 / 30."""
    found = measured([0.0, 0.1, 0.6, 0.7], [0.0, 100.0, 100.0, 190.0])
    end = 0.6 + 0.1 / 3.0
    assert found["plateau_end_strain"] == pytest.approx(end)
    share = (55.0 + 115.0 / 30.0) / (130.0 * end)
    assert found["efficiency_to_plateau_end"] == pytest.approx(share, rel=1e-5)


PLATEAU = ["plateau_stress_20_30_Pa", "plateau_stress_iso_Pa", "quasi_elastic_gradient_Pa"]


@pytest.mark.parametrize(
    ("end", "known"),
    [
        (0.29, []),
        (0.3, PLATEAU[:1]),
        (0.4, PLATEAU),
        (0.5, [*PLATEAU, "energy_to_50_J_per_m3", "efficiency_to_50"]),
    ],
)
def test_what_a_short_crush_does_not_reach_is_unknown(end, known):
    values = foam(end)
    assert {name for name, value in values.items() if np.isfinite(value)} == set(known)
    assert [values[name] for name in known] == pytest.approx([foam()[name] for name in known])


def test_a_first_peak_is_no_end_of_the_plateau_but_lowers_the_efficiency():
    """A peak of 300 Pa at 10 %, 100 Pa from 20 to 60 %: up to 50 %, 15 + 20 + 30 J/m^3."""
    found = measured([0.0, 0.1, 0.2, 0.6, 0.7], [0.0, 300.0, 100.0, 100.0, 200.0])
    assert found["plateau_end_strain"] == pytest.approx(0.63)
    assert found["efficiency_to_50"] == pytest.approx(65.0 / (300.0 * 0.5))
    assert found["quasi_elastic_gradient_Pa"] == pytest.approx(3000.0)


def test_a_spring_leaves_its_plateau_within_it():
    """With 1000 Pa x strain, the mean is 300 Pa; 390 Pa are met at 39 %, with half of the
    square.
    """
    found = measured([0.0, 0.7], [0.0, 700.0])
    assert found["plateau_stress_20_30_Pa"] == pytest.approx(250.0)
    assert found["plateau_end_strain"] == pytest.approx(0.39)
    assert found["efficiency_to_plateau_end"] == pytest.approx(0.5)
    assert found["efficiency_to_50"] == pytest.approx(0.5)
    assert found["quasi_elastic_gradient_Pa"] == pytest.approx(1000.0)


def test_nothing_without_stress():
    found = measured([0.0, 0.7], [0.0, 0.0])
    assert found.pop("plateau_stress_iso_Pa") == found.pop("plateau_stress_20_30_Pa") == 0.0
    assert found.pop("energy_to_50_J_per_m3") == 0.0
    assert np.isnan(list(found.values())).all()
