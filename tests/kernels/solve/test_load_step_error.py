"""Errors of load steps: of walls that relax, whose amplitudes do not grow evenly."""

from itertools import pairwise

import numpy as np
import pytest

from kernels.solve.history import at_rest
from kernels.solve.load_step_error import measure_amplitude_rates, of_relaxation
from kernels.solve.workspace import make_workspace


def errors(amplitude, places):
    """Error of each step but the first, J, for amplitudes at ``places`` (m) of one energy."""
    state, workspace, steps = at_rest(np.zeros(1), 1), make_workspace(1, 1), []
    evaluation, rate = workspace.evaluation, workspace.amplitude_rate
    state.stored[0] = amplitude(places[0]) ** 2
    for start, end in pairwise(places):
        evaluation.stored[0] = amplitude(end) ** 2
        steps.append(of_relaxation(state, evaluation, end - start, rate))
        measure_amplitude_rates(state, evaluation, end - start, rate)
        state.stored[0] = evaluation.stored[0]
    return np.array(steps[1:])


def test_amplitudes_that_grow_evenly_have_no_error():
    """In steps of any length."""
    assert errors(lambda x: 3.0 * x, [0.0, 0.1, 0.3, 0.4, 0.8]) == pytest.approx(0.0, abs=1e-15)


def test_errors_per_length_fall_with_the_square_of_the_step_and_at_a_kink_with_the_step():
    """At a kink from 0 to 3 J^0.5 / m it is 9 d^2."""
    smooth = []
    for d in (0.1, 0.05, 0.025):
        smooth.append(errors(np.exp, 1.0 + d * np.arange(-2.0, 1.0))[-1] / d)
        kink = errors(lambda x: max(3.0 * (x - 1.0), 0.0), 1.0 + d * np.arange(-2.0, 3.0))
        assert kink == pytest.approx([0.0, 9.0 * d**2, 0.0], abs=1e-12)
    assert np.diff(np.log2(smooth)) == pytest.approx(-2.0, abs=0.2)
