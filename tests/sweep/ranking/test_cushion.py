"""Energy-absorption diagrams and cushion curves of crushes with closed forms."""

import numpy as np
import pandas as pd
import pytest

from sweep.constants import STANDARD_GRAVITY
from sweep.ranking.cushion import (
    absorbed_below,
    crush_of,
    cushion_curve,
    dropped_from,
    drops,
    shoulder,
)
from tests.support.results.specimens import summary, there_and_back

ROW = {"outer_width_m": 10e-3, "depth_m": 20e-3, "height_m": 30e-3}
ROW |= {"absorbed_energy_within_model_J": np.inf}
AREA, THICKNESS = 2e-4, 30e-3
STRAIN = np.linspace(0.0, 0.8, 801)


def crushed(stress, work):
    """The crush with this stress (Pa) and energy per volume (J/m^3) at `STRAIN`, let up again."""
    down = {
        "strain": STRAIN,
        "reaction_top_N": stress * AREA,
        "work_in_J": work * AREA * THICKNESS,
    }
    return crush_of(pd.concat([pd.DataFrame(down), pd.DataFrame(down)[::-1]]), ROW)


FOAM = crushed(np.full(801, 50e3), 50e3 * STRAIN)
SPRING = crushed(200e3 * STRAIN, 100e3 * STRAIN**2)


@pytest.mark.parametrize("height", [0.01, 0.5])
def test_a_foam_of_constant_stress_slows_every_weight_by_stress_over_static_stress(height):
    static, peak = cushion_curve(FOAM, height)
    np.testing.assert_allclose(peak, 50e3 / static)
    # at 80 % strain, 24 mm: 30 mm x 40 kJ/m^3 = p (H + 24 mm)
    assert static[-1] == pytest.approx(1200.0 / (height + 0.024))


@pytest.mark.parametrize("height", [1e-6, 0.01, 0.5])
def test_a_spring_slows_a_weight_as_the_textbook_says(height):
    """With the stiffness K, and m g at its end: G = 1 + sqrt(1 + 2 K H / (m g)); K / (m g) = k / (p
    T).
    """
    static, peak = cushion_curve(SPRING, height)
    known = 1.0 + np.sqrt(1.0 + 2.0 * 200e3 * height / (static * THICKNESS))
    np.testing.assert_allclose(peak, known)
    assert len(peak) == 800


def test_a_weight_stops_where_it_first_may():
    """Under no stress beyond 40 % the weight moves on, and stresses below that do not count for
    it.
    """
    work = 50e3 * STRAIN.clip(max=0.4)
    static, peak = cushion_curve(crushed(np.full(801, 50e3), work), 0.01)
    assert np.all(np.diff(static) > 0.0)
    assert static[-1] == pytest.approx(0.03 * 20e3 / (0.01 + 0.4 * 0.03))
    assert peak[-1] == pytest.approx(50e3 / static[-1])


def test_only_the_first_loading_counts_as_far_as_the_model_holds():
    history = there_and_back()
    crush = crush_of(history, ROW)
    assert len(crush.strain) == 20
    assert crush.strain[-1] == pytest.approx(0.4)
    half = float(history["work_in_J"].max() / 2.0)
    crush = crush_of(history, ROW | {"absorbed_energy_within_model_J": half})
    assert len(crush.strain) == 10
    assert crush.work[-1] * AREA * THICKNESS <= half


def test_a_shoulder_is_within_the_curve():
    """5 kJ/m^3 at 10 %, 100 kPa to 50 %: there 45 kJ/m^3 / 100 kPa; then packed."""
    stress = np.interp(STRAIN, [0.0, 0.1, 0.5, 0.8], [0.0, 100e3, 100e3, 1000e3])
    work = np.append(0.0, np.cumsum(0.5 * (stress[1:] + stress[:-1]) * np.diff(STRAIN)))
    crush = crushed(stress, work)
    row = shoulder(crush)
    assert (crush.strain[row], crush.work[row]) == pytest.approx((0.5, 45e3))
    assert shoulder(SPRING) is None
    assert shoulder(crush_of(there_and_back()[:1], ROW)) is None


def test_energy_below_a_stress():
    """A spring absorbs stress^2 / (2 k) up to 160 kPa; a foam absorbs all at its own stress."""
    stresses = np.array([0.1, 80.1e3, 160e3, 500e3])  # the second one is between two rows
    found = absorbed_below(SPRING, stresses)
    np.testing.assert_allclose(found, [np.nan, 80.1e3**2 / 400e3, 64e3, 64e3], rtol=1e-5)
    np.testing.assert_allclose(absorbed_below(FOAM, np.array([49e3, 50e3])), [np.nan, 40e3])
    assert np.isnan(absorbed_below(crush_of(there_and_back()[:1], ROW), stresses)).all()


def test_static_stress_and_deceleration_of_a_striker():
    """50 g at 2 m/s: from 204 mm; 0.49 N on 2 cm^2."""
    hit = {"striker_mass_g": 50.0, "striker_speed_m_per_s": 2.0, "gravity": 1.0}
    hit |= {"peak_deceleration_filtered_m_per_s2": 40.0 * STANDARD_GRAVITY} | ROW
    falls = drops(summary(hit, hit | {"striker_speed_m_per_s": 3.0}, hit | {"gravity": 0.0}))
    expected = [4.0 / (2.0 * STANDARD_GRAVITY), 50e-3 * STANDARD_GRAVITY / AREA, 40.0]
    columns = ["drop_height_m", "static_stress_Pa", "peak_G"]
    assert list(falls.loc[0, columns]) == pytest.approx(expected)
    assert list(dropped_from(falls, 0.205)) == [True, False]
