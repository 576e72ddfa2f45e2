"""What is private to the fast compiler is tested where that is the one in use."""

import pytest

from kernels.compile.choice import FAST, compiler


class Skipped(pytest.Module):
    """A file of tests that is not even imported."""

    def collect(self):
        """Skip it."""
        pytest.skip("of the fast compiler, which is not in use")


def pytest_pycollect_makemodule(module_path, parent):
    """Leave a file to pytest, or skip it."""
    return None if compiler() == FAST else Skipped.from_parent(parent, path=module_path)
