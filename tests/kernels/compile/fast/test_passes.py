"""What numba's compiler is spared: to look for what it knows, passes for what kernels lack."""

import operator

import numba
import numpy as np
import pytest
from numba.core import types
from numba.core.compiler import Flags
from numba.core.errors import TypingError, UnsupportedError
from numba.core.registry import cpu_target
from numba.core.targetconfig import ConfigStack
from numba.extending import overload

from kernels.compile.fast import passes
from kernels.compile.jit import jit, jit_exact, jit_owning


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    """Folder that kernels decorated from here on are kept in."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))


def resolve(function, *args):
    """The signature of a function for some types."""
    context = cpu_target.typing_context
    context.refresh()
    return context.resolve_value_type(function).get_call_type(context, args, {})


class Searched:
    """A function whose signatures are numbered as they are found."""

    def __init__(self):
        self.searches, self._impl_keys = 0, {}

    def find(self, context, args, kws):
        """Search, and note which code belongs to what is found."""
        self.searches += 1
        if args == (types.none,):
            raise TypingError("none")
        signature = numba.core.typing.signature(types.int64, *args)
        self._impl_keys[signature.args] = f"code {self.searches}"
        return signature

    def get_impl_key(self, signature):
        """The code that was noted last."""
        return self._impl_keys[signature.args]

    def code(self, found, *args, **kws):
        """The code for some types, by a search of `passes`."""
        return self.get_impl_key(found(self, None, args, kws))


FOUND = passes._remembered(Searched.find)


def test_a_kernel_has_a_signature_looked_for_once_for_the_same_types():
    function, other = Searched(), Searched()
    with ConfigStack().enter(passes.QuickFlags()):
        assert [function.code(FOUND, types.int64) for _ in range(3)] == ["code 1"] * 3
        assert function.code(FOUND, types.float64) == "code 2"
        assert other.code(FOUND, types.int64) == "code 1"
        assert [function.code(FOUND, types.int64, k=1) for _ in range(2)] == ["code 3", "code 4"]


def test_what_is_found_under_other_flags_is_other_code():
    function, exact, fast = Searched(), passes.QuickFlags(), passes.QuickFlags()
    fast.fastmath = True
    for _ in range(2):
        for flags, code in ((exact, "code 1"), (fast, "code 2"), (exact.copy(), "code 1")):
            with ConfigStack().enter(flags):
                assert function.code(FOUND, types.int64) == code


def test_what_is_no_kernel_is_compiled_as_ever():
    function = Searched()
    codes = [function.code(FOUND, types.int64)]
    with ConfigStack().enter(Flags()):
        codes.append(function.code(FOUND, types.int64))
    assert codes == ["code 1", "code 2"]


def test_a_search_in_vain_is_made_again():
    function = Searched()
    with ConfigStack().enter(passes.QuickFlags()):
        for _ in range(2):
            with pytest.raises(TypingError):
                function.code(FOUND, types.none)
    assert function.searches == 2


def total(values):
    """Has one code for arithmetic as written and another for quick arithmetic."""
    return sum(values)


@overload(total)
def _total(values):
    def add(values):
        value = 0.0
        for k in range(values.size):
            value += values[k]
        return value

    return add


def test_exact_kernels_stay_exact_beside_quick_ones():
    random = np.random.default_rng(0)
    values = np.concatenate([1e3 * random.random(1000), random.random(1000)])
    as_written = float(sum(values.tolist()))

    @jit_exact
    def exact(values):
        return total(values)

    @jit
    def quickly(values):
        return total(values)

    @jit_exact
    def again(values):
        return total(values) * 1.0

    assert exact(values) == as_written
    assert quickly(values) != as_written
    assert quickly(values) == pytest.approx(as_written, rel=1e-12)
    assert again(values) == as_written


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
    one, same, other = passes.QuickFlags(), passes.QuickFlags(), passes.QuickFlags()
    one.nrt, same.nrt, other.nrt = True, True, False
    assert one == same == one.copy()
    assert hash(one) == hash(same)
    assert one != other
