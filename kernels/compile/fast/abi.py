"""How kernels pass arrays to one another: by address and shape.

Numba passes seven words for a vector and nine for a matrix. Among them are the owner, which is not
needed where references are not counted, and the strides, which follow from the shape of a
contiguous array. A step, with its named tuples of arrays, has a thousand arguments; a third of them
are left.
"""

import functools

from llvmlite import ir
from numba.core import types
from numba.core.base import BaseContext
from numba.core.callconv import CPUCallConv
from numba.core.datamodel.packer import ArgPacker
from numba.core.imputils import user_function
from numba.core.lowering import Lower
from numba.np.numpy_support import as_dtype

MEMINFO, PARENT, NITEMS, ITEMSIZE, DATA, SHAPE, STRIDES = range(7)


class _Array:
    """A contiguous array that nobody owns, as an argument (data, *shape)."""

    def __init__(self, manager, kind):
        self._type = manager[kind].get_value_type()
        words = self._type.elements
        self._data, self._word, self._ndim = words[DATA], words[NITEMS], kind.ndim
        self._size = self._word(as_dtype(kind.dtype).itemsize)
        known = [ir.Constant(word, ir.Undefined) for word in words]
        known[MEMINFO], known[PARENT] = (ir.Constant(words[k], None) for k in (MEMINFO, PARENT))
        known[ITEMSIZE] = self._size
        self._empty = ir.Constant(self._type, known)

    def get_argument_type(self):
        return (self._data, *[self._word] * self._ndim)

    def as_argument(self, builder, value):
        shape = [builder.extract_value(value, (SHAPE, k)) for k in range(self._ndim)]
        return (builder.extract_value(value, DATA), *shape)

    def from_argument(self, builder, given):
        data, *shape = given
        value, stride = builder.insert_value(self._empty, data, DATA), self._size
        for k in reversed(range(self._ndim)):
            value = builder.insert_value(value, shape[k], (SHAPE, k))
            value = builder.insert_value(value, stride, (STRIDES, k))
            stride = builder.mul(stride, shape[k]) if k > 0 else stride
        items = functools.reduce(builder.mul, shape)
        return builder.insert_value(value, items, NITEMS)


class _Tuple:
    """A tuple, as its parts."""

    def __init__(self, manager, kind):
        self._empty = ir.Constant(manager[kind].get_value_type(), ir.Undefined)
        self._parts = [_model(manager, part) for part in kind]

    def get_argument_type(self):
        return tuple(part.get_argument_type() for part in self._parts)

    def as_argument(self, builder, value):
        return tuple(
            part.as_argument(builder, builder.extract_value(value, k))
            for k, part in enumerate(self._parts)
        )

    def from_argument(self, builder, given):
        value = self._empty
        for k, part in enumerate(self._parts):
            value = builder.insert_value(value, part.from_argument(builder, given[k]), k)
        return value


@functools.cache
def _model(manager, kind):
    """Return how a value of this type is taken apart for a call, and put together behind it."""
    if type(kind) is types.Array and kind.layout == "C" and kind.ndim > 0:
        return _Array(manager, kind)
    return _Tuple(manager, kind) if isinstance(kind, types.BaseTuple) else manager[kind]


class _Models:
    def __init__(self, manager):
        self._manager = manager

    def lookup(self, kind):
        return _model(self._manager, kind)


@functools.cache
def _packer(manager, kinds):
    return ArgPacker(_Models(manager), kinds)


class _Convention(CPUCallConv):
    """Numba's calls but for the arguments, on both sides."""

    def _get_arg_packer(self, argtypes):
        return _packer(self.context.data_model_manager, tuple(argtypes))


class _Context:
    """Numba's target but for its calls: what declares and calls a function asks it how."""

    declare_function = BaseContext.declare_function

    def __init__(self, context):
        self._context, self.call_conv = context, _Convention(context)

    def __getattr__(self, name):
        return getattr(self._context, name)


class ShortLower(Lower):
    """Numba's way of writing a function down but for its arguments."""

    @property
    def call_conv(self):
        """How it is called."""
        return _Convention(self.context)

    def setup_function(self, fndesc):
        """Declare the function."""
        whole, self.context = self.context, _Context(self.context)
        super().setup_function(fndesc)
        self.context = whole


def is_short(flags):
    """Whether code is called so: by kernels only, and where it counts no references."""
    return flags.no_cpython_wrapper and not flags.nrt


def register(context, key, description, libraries, short):
    """Make a function known to its callers, by a key."""
    if not short:
        context.insert_user_function(key, description, libraries)
        return
    usual = user_function(description, libraries)

    def call(context, builder, sig, args):
        return usual(_Context(context), builder, sig, args)

    call.signature, call.libs = usual.signature, usual.libs
    context._defns[key].append(call, call.signature)
