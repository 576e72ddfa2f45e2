"""Where a lattice has packed: on curves known by hand, and continuous in every curve."""

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from sweep.config.case import Case
from sweep.simulation.densification import BAND, efficiency, near_maxima, packed_row, span, weights
from sweep.simulation.summary import crush_columns

HEIGHT, AREA = 10e-3, 1e-4
CRUSH = Case.of(
    lattice=dict(width=9e-3, wall_thickness=1e-3, height=HEIGHT, depth=10e-3),
    loading=dict(strain=0.6),
)
STRAIN = np.linspace(0.0, 0.6, 601)
NEW = ("absorbed_energy_until_packed_J", "peak_force_until_packed_N", "packing_strain")
OLD = (
    "absorbed_energy_at_densification_J",
    "peak_force_at_densification_N",
    "densification_strain",
)


def measured(force, names=NEW):
    """Columns of a crush with this force (N) at `STRAIN`."""
    loading = {
        "strain": STRAIN,
        "top_displacement_m": STRAIN * HEIGHT,
        "work_in_J": cumulative_trapezoid(force, HEIGHT * STRAIN, initial=0.0),
        "reaction_top_N": force,
        "reaction_bottom_N": force,
    }
    columns = crush_columns(CRUSH, loading)
    return np.array([columns[name] for name in names])


def gained(force):
    """Efficiency of a crush with this force (N) at `STRAIN`."""
    return efficiency(force / AREA, cumulative_trapezoid(force, STRAIN, initial=0.0) / AREA)


def two_rows(second):
    """The first row yields at 10 N up to 30 % strain, the second at ``second`` N up to 50 %.

    The efficiency has a maximum of 0.29 at 30 % and one of 0.2 + 2.95 / second, or so, at 50 %.
    """
    return np.interp(STRAIN, [0, 0.02, 0.3, 0.31, 0.5, 0.6], [0, 10, 10, second, second, 200])


def changes(seconds, names):
    """Greatest change of each column between neighbours / greatest value."""
    found = np.array([measured(two_rows(second), names) for second in seconds])
    return np.abs(np.diff(found, axis=0)).max(axis=0) / found.max(axis=0)


def test_two_maxima_that_exchange_their_ranks():
    """The place of the greatest one leaps, the mean passes from one to the other.

    The second maximum falls by 2 % while its force rises from 32 to 34 N; in a hundred steps,
    no change is more than a hundredth, in a thousand no more than a thousandth.
    """
    seconds = np.linspace(28.0, 36.0, 401)
    efficiencies = [gained(two_rows(second)) for second in seconds[[0, -1]]]
    assert [STRAIN[found.argmax()] for found in efficiencies] == pytest.approx([0.5, 0.3])
    assert changes(seconds, OLD).min() > 0.3
    coarse = changes(seconds, NEW)
    assert coarse.max() < 0.02
    assert changes(np.linspace(28.0, 36.0, 4001), NEW) == pytest.approx(0.1 * coarse, rel=0.1)


def bumpy(seed):
    """A force that rises, falls and packs somewhere, at random; positive."""
    rng = np.random.default_rng(seed)
    corners = np.sort(rng.uniform(0.02, 0.6, 8))
    heights = rng.uniform(2.0, 20.0, 8) * np.linspace(1.0, rng.uniform(1.0, 6.0), 8)
    return np.interp(STRAIN, [0.0, *corners], [0.0, *heights])


def slope(force):
    """Bound of the change of each column / greatest change of the force, for small changes.

    For a mean of x: the bound of x itself, and range of x times change of the weights / their
    integral.
    """
    eta, work = gained(force), cumulative_trapezoid(force, STRAIN, initial=0.0)
    near = eta > (1.0 - BAND) * eta.max()
    peak = np.maximum.accumulate(force)
    change = (2.0 - BAND) * (2.0 * STRAIN / peak.clip(1e-9))[near].max()  # of a weight
    room = 0.5 * (BAND * eta.max()) ** 2  # least integral of the weights
    own = np.array([0.6 * HEIGHT, 1.0, 0.0])
    ranges = [np.ptp(values[near]) for values in (work * HEIGHT, peak, STRAIN)]
    return own + np.array(ranges) * change * np.ptp(STRAIN[near]) / room


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("size", [1e-2, 1e-4])
def test_a_small_change_of_any_curve_is_a_small_change_of_the_columns(seed, size):
    """At any place of the curve: the changes are uniform, or of random sign in each row."""
    force, rng = bumpy(seed), np.random.default_rng(seed)
    before, bound = measured(force), slope(force)
    for change in (np.ones(601), -np.ones(601), rng.choice([-1.0, 1.0], 601)):
        change[0] = 0.0
        after = measured(force + size * change)
        assert np.all(np.abs(after - before) <= 1.05 * size * bound)


@pytest.mark.parametrize("seed", range(40))
def test_the_weights_always_have_room(seed):
    """The efficiency rises with a slope of at most 1: the proof of continuity rests on it."""
    eta = gained(bumpy(seed))
    assert np.all(np.diff(eta) <= 1e-3 * (1.0 + 1e-9))
    above = np.clip(eta - (1.0 - BAND) * eta.max(), 0.0, None)
    assert np.trapezoid(above, STRAIN) >= 0.5 * (BAND * eta.max()) ** 2


def test_a_foam_packs_a_little_before_its_maximum():
    """10 N up to 50 %: eta = e - 0.05 up to 0.45 there, then falls below 0.36 within 0.7 %.

    The mean over the triangle from 41 to 50 % is 47 %; the strains beyond add 0.2 %.
    """
    foam = np.interp(STRAIN, [0.0, 0.1, 0.5, 0.6], [0.0, 10.0, 10.0, 50.0])
    energy, force, strain = measured(foam)
    assert strain == pytest.approx(0.472, abs=1e-3)
    assert energy == pytest.approx(42.3e-3, abs=0.2e-3)
    assert force == pytest.approx(10.06, abs=0.05)


def test_a_spring_that_never_packs_counts_the_end_of_the_stroke():
    """The efficiency is half the strain; the mean of the triangle from 48 to 60 % is 56 %."""
    energy, force, strain = measured(100.0 * STRAIN)
    assert strain == pytest.approx(0.56, abs=1e-4)
    assert force == pytest.approx(56.0, abs=1e-2)
    assert energy == pytest.approx(0.5 * 56.0 * 5.6e-3, rel=5e-3)


def test_without_energy_the_end_counts():
    assert list(weights(np.zeros(1), np.zeros(1))) == [1.0]
    assert measured(np.zeros(601)) == pytest.approx([0.0, 0.0, 0.6])
    rows = np.zeros(200_000)  # of an impact: their square in numbers would take 320 GB
    at = weights(rows, rows)
    assert (at.sum(), at[-1]) == (1.0, 1.0)


def test_maxima_of_nearly_the_greatest_efficiency():
    """The first and the last row are none."""
    assert near_maxima(np.array([0.0, 0.30, 0.2, 0.301, 0.1])) == [1, 3]
    assert near_maxima(np.array([0.0, 0.29, 0.2, 0.301, 0.1])) == [3]
    assert near_maxima(np.array([0.3, 0.2, 0.25, 0.3])) == []
    assert near_maxima(np.zeros(4)) == []
    for eta, row in (([0.0, 0.2, 0.3], None), ([0.0] * 3, None), ([0.0, 0.3, 0.2], 1)):
        assert packed_row(np.array(eta)) == row


def test_a_curve_with_two_maxima_says_both():
    """Their ranks are exchanged at about 33 N; far from there one of both is the greatest alone."""
    places = [f"{end}_densification_strain" for end in ("lowest", "highest")]
    energies = [f"{end}_absorbed_energy_at_densification_J" for end in ("lowest", "highest")]
    assert measured(two_rows(33.0), energies) == pytest.approx([29e-3, 93e-3], rel=0.02)
    for second, found in ((15.0, [0.5, 0.5]), (33.0, [0.3, 0.5]), (60.0, [0.3, 0.3])):
        assert measured(two_rows(second), places) == pytest.approx(found, abs=2e-3)
    spans = [span(STRAIN, gained(two_rows(second))) for second in (10.0, 31.5, 60.0)]
    assert spans[1] > 0.19
    assert max(spans[0], spans[2]) < 0.02
