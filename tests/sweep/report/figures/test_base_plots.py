"""The pressure on the base: over time, with the place of its peak."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from sweep.report.figures.base_plots import base_pressure
from tests.support.results.specimens import IMPACTS, there_and_back


def test_the_peak_has_its_place():
    history = there_and_back()
    pressure = np.linspace(0.0, 2e5, len(history)) * (np.arange(len(history)) < 30)
    history["base_pressure_Pa"], history["base_pressure_x_m"] = pressure, 4e-3
    ax = Figure().subplots()
    base_pressure(ax, history, IMPACTS.iloc[0])
    curve, peak = (line for line in ax.lines if line.get_linestyle() != ":")
    np.testing.assert_allclose(curve.get_ydata(), 1e-3 * pressure)
    (x,), (y,) = peak.get_data()
    assert (x, y) == (pytest.approx(29.0), pytest.approx(1e-3 * pressure[29]))
    assert peak.get_label() == f"{y:.3g} kPa, x = 4 mm"
    assert ax.get_xlabel() == "time, ms"
