"""Results as a dataset: its coordinates, units, curves."""

import sys

import numpy as np
import pytest
import xarray

from sweep.results import Results
from sweep.store.read import StoreError, read_history
from tests.support.results.specimens import designs, summary, write

IDS = [f"{k:016x}" for k in range(3)]


@pytest.fixture
def results(tmp_path):
    """Three designs of a grid, the last of which has failed."""
    table = summary(*designs([1.0, 2.0, 3.0], [0.1, 0.3, 0.2]))
    keys = {"lattice.cells_x": [2, 3, 4], "lattice.cells_y": 3}
    table = table.assign(status=["converged", "converged", "stopped"], **keys)
    return Results(write(tmp_path / "trial.h5", table))


def test_the_table_is_along_the_cases_and_keys_of_the_grid_can_be_axes(results):
    data, keys = results.to_xarray(), ["lattice.cells_x", "lattice.cells_y"]
    assert data.sizes == {"case_id": 3}
    assert data["mass_g"].sel(case_id=IDS[1]) == 2.0
    assert data["mass_g"].attrs["units"] == "g"
    assert data["mass_g"].attrs["long_name"].startswith("density x exact area")
    assert {*data.data_vars} == {*results.table} - {"case_id", *keys}
    masses = data[["mass_g"]].set_index(case_id=keys).unstack()["mass_g"]
    assert masses.sel({"lattice.cells_x": 3, "lattice.cells_y": 3}) == 2.0


def test_curves_end_with_nan(results):
    data = results.to_xarray(curves=["strain", "newton_iterations"])
    assert data["strain"].dims == ("case_id", "row")
    curve = read_history(results.path, IDS[0])["strain"]
    np.testing.assert_array_equal(data["strain"].sel(case_id=IDS[0]), curve)
    assert np.isnan(data["strain"].sel(case_id=IDS[2])).all()
    assert data["newton_iterations"].dims == ("case_id",)
    assert data["history_newton_iterations"].dims == ("case_id", "row")
    assert {*results.to_xarray(curves="strain").variables} < {*data.variables}
    every = results.to_xarray(curves=True)
    assert {"reaction_top_N", "history_newton_iterations"} <= {*every.data_vars}


def test_an_unknown_curve_is_refused(results):
    with pytest.raises(StoreError, match="no curve heat; allowed: time_s, strain"):
        results.to_xarray(curves=["heat"])


def test_it_says_which_package_it_needs(results, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ModuleNotFoundError, match=r'needs xarray: pip install "crumple\[xarray\]"'):
        results.to_xarray()


def test_a_file_names_the_dimension_of_its_columns(results):
    """HDF5 dimension scales, as netCDF 4 has them."""
    how = {"engine": "h5netcdf", "phony_dims": "access"}
    with xarray.open_dataset(results.path, group="summary", **how) as data:
        assert data.sizes == {"case_id": 3}
        assert data["case_id"].values.astype(str).tolist() == IDS
        assert data["mass_g"].attrs["units"] == "g"
        with pytest.raises(StoreError, match="open in this process by another reader"):
            read_history(results.path, IDS[0])
    assert len(read_history(results.path, IDS[0])) > 0
