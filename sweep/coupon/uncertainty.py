"""Standard errors of numbers that are fitted by least squares, from the Jacobian."""

import numpy as np

from sweep.array_types import Floats

MOST_CORRELATED = 0.99


def standard_errors(jacobian: Floats, residuals: Floats) -> Floats:
    """Standard errors (p,) of p numbers, the roots of the diagonal of their covariance

        s^2 (J^T J)^-1 (1 + c) / (1 - c).

    jacobian (n, p), residuals (n,). s^2: sum of squares of the residuals over n - p. c: correlation
    of neighbouring residuals, if it is positive: n rows in which the misfit changes slowly contain
    as much information as n (1 - c) / (1 + c) independent ones.
    """
    rows, numbers = jacobian.shape
    squares = float(residuals @ residuals)
    if squares == 0.0:
        return np.zeros(numbers)
    correlated = float(residuals[1:] @ residuals[:-1]) / squares
    c = min(max(correlated, 0.0), MOST_CORRELATED)
    variance = squares / max(rows - numbers, 1) * (1.0 + c) / (1.0 - c)
    return np.sqrt(variance * np.diag(np.linalg.pinv(jacobian.T @ jacobian)))
