"""What is private to the fast compiler is tested where that is the one in use."""

import pytest

from kernels.compile.choice import FAST, compiler

PRIVATE = ("test_linking.py", "test_sealed.py")


class Skipped(pytest.Module):
    """A file of tests that is not even imported."""

    def collect(self):
        """Skip it."""
        pytest.skip("of the fast compiler, which is not in use")


def pytest_pycollect_makemodule(module_path, parent):
    """Leave a file to pytest, or skip it."""
    if compiler() == FAST or module_path.name not in PRIVATE:
        return None
    return Skipped.from_parent(parent, path=module_path)
