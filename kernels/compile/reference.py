"""Large named tuples by reference: one address in place of a hundred arrays.

Numba passes a named tuple by value, every array of it with its shape and strides. A kernel that
only passes a tuple on then consists mostly of arguments, which cost time to compile and none to
run. A tuple that is `by_reference` is an address: a field is loaded, by value, where it is read.
Only public names of Numba are used here (README.md).

The tuple must outlive its reference, which the caller has to ensure.
"""

import functools

from numba import types
from numba.core import cgutils
from numba.core.imputils import impl_ret_borrowed
from numba.core.typing.templates import AttributeTemplate, make_intrinsic_template
from numba.extending import (
    NativeValue,
    infer_getattr,
    lower_getattr_generic,
    models,
    register_model,
    typeof_impl,
    unbox,
)


class Reference(types.Type):
    """Type of the address of a named tuple of type ``kind``."""

    def __init__(self, kind):
        self.kind = kind
        super().__init__(f"reference({kind})")

    @property
    def key(self):
        """References are equal where their tuples are."""
        return self.kind

    @property
    def instance_class(self):
        """The class of the tuple, which has its verbs."""
        return self.kind.instance_class


@register_model(Reference)
class _Model(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, manager[kind.kind].get_value_type().as_pointer())


@infer_getattr
class _Fields(AttributeTemplate):
    key = Reference

    def generic_resolve(self, reference, name):
        fields = reference.kind.fields
        return reference.kind[fields.index(name)] if name in fields else None


@lower_getattr_generic(Reference)
def _load(context, builder, reference, address, name):
    index = reference.kind.fields.index(name)
    value = builder.load(cgutils.gep_inbounds(builder, address, 0, index))
    return impl_ret_borrowed(context, builder, reference.kind[index], value)


def _address(_, value):
    """Keep a tuple in the frame of the kernel that calls this, and return its address."""

    def code(context, builder, signature, args):
        place = cgutils.alloca_once(builder, args[0].type)
        builder.store(args[0], place)
        return place

    return Reference(value)(value), code


class Referenced:
    """The tuple as `by_reference` returns it to Python, with a type of its own."""

    __slots__ = ("_kind", "_tuple")

    def __init__(self, value):
        self._tuple, self._kind = value, None

    def __getattr__(self, name):
        if name in self._tuple._fields:
            return getattr(self._tuple, name)
        return functools.partial(getattr(type(self._tuple), name), self)  # a verb


@typeof_impl.register(Referenced)
def _typeof(value, context):
    if value._kind is None:  # which takes a millisecond for a hundred arrays
        value._kind = Reference(typeof_impl(value._tuple, context))
    return value._kind


@unbox(Reference)
def _unboxed(kind, value, tools):
    """Keep the tuple of a `Referenced` in the frame of the function that Python calls."""
    fields = tools.pyapi.object_getattr_string(value, "_tuple")
    native = tools.unbox(kind.kind, fields)
    tools.pyapi.decref(fields)  # `value` holds it
    place = cgutils.alloca_once_value(tools.builder, native.value)
    return NativeValue(place, is_error=native.is_error, cleanup=native.cleanup)


class _ByReference:
    """The function `by_reference`, for kernels and for Python."""

    def __init__(self):
        self._numba_type_ = types.Function(make_intrinsic_template(self, _address, "by_reference"))

    def __call__(self, value):
        return Referenced(value)


by_reference = _ByReference()


def referred(value):
    """Return the tuple that Python holds by reference."""
    return value._tuple
