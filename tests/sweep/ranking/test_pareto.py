"""The Pareto front of mass and energy."""

import itertools

import numpy as np
import pandas as pd

from sweep.ranking.pareto import pareto


def test_pareto_agrees_with_its_definition():
    rng = np.random.default_rng(7)
    mass = pd.Series(rng.integers(1, 12, 60).astype(float))
    energy = pd.Series(rng.integers(1, 12, 60).astype(float))
    expected = [True] * 60
    for i, j in itertools.permutations(range(60), 2):
        no_worse = mass[j] <= mass[i] and energy[j] >= energy[i]
        if no_worse and (mass[j] < mass[i] or energy[j] > energy[i]):
            expected[i] = False
    assert list(pareto(mass, energy)) == expected


def test_round_off_of_equal_masses_is_no_merit():
    mass, energy = pd.Series([1.4, 1.4 + 3e-13, 1.4 - 3e-13]), pd.Series([1.0, 2.0, 0.5])
    assert list(pareto(mass, energy)) == [False, True, False]


def test_a_design_without_the_energy_hides_no_heavier_one_from_the_front():
    mass, energy = pd.Series([1.0, 2.0, 3.0]), pd.Series([0.1, np.nan, 0.3])
    assert list(pareto(mass, energy)) == [True, False, True]
