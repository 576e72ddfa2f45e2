"""Tests of the groups of tests that one process runs together (tests/conftest.py)."""

import os

import pytest

from tests.conftest import runs_of


@pytest.mark.skipif("PYTEST_XDIST_WORKER" not in os.environ, reason="one process runs all tests")
def test_pytest_xdist_knows_the_groups(request):
    assert request.node.nodeid.endswith("@project/test_groups.py")


def test_tests_of_kernels_are_grouped_by_the_runs_whose_kernels_they_compile():
    assert runs_of("kernels/plates/test_assembly.py") == "plates"
    assert runs_of("kernels/solve/test_march.py") == "marches"
    assert runs_of("kernels/compile/test_simd.py") is None
    assert runs_of("sweep/test_numbers.py") is None
