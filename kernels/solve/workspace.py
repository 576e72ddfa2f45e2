"""Scratch arrays of a march, allocated once."""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit_owning
from kernels.solve.problem import SUMS, Evaluation


class Work(NamedTuple):
    """Scratch (n,) of a minimisation.

    dx: next move. trial: trial point. residual: of `Problem.reduce`. direction: Newton direction.
    escape: direction of negative curvature.
    """

    dx: np.ndarray
    trial: np.ndarray
    residual: np.ndarray
    direction: np.ndarray
    escape: np.ndarray


class Workspace(NamedTuple):
    """evaluation, work: of the minimisation. x0, y, x_pred (n,): of the step (`problem.Step`).
    amplitude_rate (k,): of the stored energies in the last step (`load_step_error`).
    """

    evaluation: Evaluation
    work: Work
    x0: np.ndarray
    y: np.ndarray
    x_pred: np.ndarray
    amplitude_rate: np.ndarray


@jit_owning
def make_workspace(n, stored):
    """Return the arrays for ``n`` coordinates and ``stored`` kinds of stored energy."""
    a, b, c = np.zeros((5, n)), np.zeros((5, n)), np.zeros((3, n))
    sums = np.zeros(1, SUMS)
    evaluation = Evaluation(a[0], a[1], a[2], a[3], a[4], np.zeros(stored), sums)
    work = Work(b[0], b[1], b[2], b[3], b[4])
    return Workspace(evaluation, work, c[0], c[1], c[2], np.zeros(stored))
