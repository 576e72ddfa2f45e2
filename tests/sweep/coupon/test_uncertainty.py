"""Standard errors agree with repeated measurements, with white and with slow noise."""

import numpy as np
import pytest

from sweep.coupon.uncertainty import covariance, standard_errors

X = np.linspace(0.0, 1.0, 400)
JACOBIAN = np.column_stack([np.ones_like(X), X])


@pytest.mark.parametrize(("slow", "within"), [(0.0, 0.1), (0.8, 0.2)])
def test_errors_are_the_scatter_of_repeated_fits(slow, within):
    random = np.random.default_rng(3)
    fits, errors = [], []
    for _ in range(400):
        noise = random.standard_normal(X.size)
        for k in range(1, X.size):
            noise[k] = slow * noise[k - 1] + np.sqrt(1.0 - slow**2) * noise[k]
        fitted = np.linalg.pinv(JACOBIAN) @ noise
        fits.append(fitted)
        errors.append(standard_errors(JACOBIAN, noise - JACOBIAN @ fitted))
    assert np.mean(errors, axis=0) == pytest.approx(np.std(fits, axis=0), rel=within)


def test_without_a_misfit_there_is_no_error():
    assert covariance(JACOBIAN, np.zeros(X.size)) == pytest.approx(np.zeros((2, 2)))
