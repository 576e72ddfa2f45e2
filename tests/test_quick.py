"""What numba's compiler is spared: to look for what it knows, passes for what kernels lack."""

import operator

import numba
import numpy as np
import pytest
from numba.core import types
from numba.core.errors import TypingError, UnsupportedError
from numba.core.registry import cpu_target
from numba.core.targetconfig import ConfigStack

from kernels import quick
from kernels.jit import jit, jit_owning


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    """Folder that kernels decorated from here on are kept in."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))


def resolve(function, *args):
    """The signature of a function for some types."""
    context = cpu_target.typing_context
    context.refresh()
    return context.resolve_value_type(function).get_call_type(context, args, {})


def test_a_signature_is_looked_for_once_for_the_same_types():
    searches = []

    def find(function, context, args, kws):
        searches.append((function, args, kws))
        return len(searches)

    found = quick._remembered(find)
    assert [found("f", None, (types.int64,), {}) for _ in range(3)] == [1, 1, 1]
    assert found("f", None, [types.int64], {}) == 1
    assert found("f", None, (types.float64,), {}) == 2
    assert found("g", None, (types.int64,), {}) == 3
    assert [found("f", None, (types.int64,), {"k": 1}) for _ in range(2)] == [4, 5]


def test_a_signature_found_under_other_flags_does_not_count():
    flags = quick.QuickFlags()
    found = quick._remembered(lambda *_: [])
    plain = found("f", None, (), {})
    with ConfigStack().enter(flags):
        owning = found("f", None, (), {})
        assert found("f", None, (), {}) is owning is not plain
    with ConfigStack().enter(flags.copy()):
        assert found("f", None, (), {}) is owning


def test_a_search_in_vain_is_made_again():
    answers = [TypingError("not yet"), "found"]

    def find(function, context, args, kws):
        answer = answers.pop(0)
        if isinstance(answer, Exception):
            raise answer
        return answer

    found = quick._remembered(find)
    with pytest.raises(TypingError):
        found("f", None, (), {})
    assert found("f", None, (), {}) == "found"


def test_what_is_remembered_goes_by_the_types():
    assert resolve(operator.mul, types.int64, types.int64).return_type == types.int64
    assert resolve(operator.mul, types.int64, types.float64).return_type == types.float64
    assert resolve(operator.mul, types.float32, types.float32).return_type == types.float32
    assert resolve(operator.truediv, types.int64, types.int64).return_type == types.float64


def test_formulas_of_whole_arrays_mean_the_same():
    @jit_owning
    def formula(a, b):
        return 2.0 * a + b[::2] ** 2 - np.minimum(a, 1.0)

    a, b = np.linspace(0.0, 3.0, 5), np.arange(10.0)
    np.testing.assert_allclose(formula(a, b), 2.0 * a + b[::2] ** 2 - np.minimum(a, 1.0))


def test_closures_are_refused():
    @jit
    def total(x):
        def twice(value):
            return 2.0 * value

        return twice(x[0])

    with pytest.raises((TypingError, UnsupportedError)):
        total(np.ones(2))


def test_flags_are_equal_when_the_same_are_set():
    one, same, other = quick.QuickFlags(), quick.QuickFlags(), quick.QuickFlags()
    one.nrt, same.nrt, other.nrt = True, True, False
    assert one == same == one.copy()
    assert hash(one) == hash(same)
    assert one != other
