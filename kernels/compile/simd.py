"""Vectors of four float64, which LLVM does not form by itself from the entries of matrices.

A vector takes one register of AVX, or two of SSE2 or NEON. A `Four` exists inside a kernel only: it
is loaded from an array (n,), computed with (+, -, *, /, lane by lane), and stored. Where kernels
run as plain Python it is an array.
"""

import functools
import operator

import numpy as np
from llvmlite import ir
from numba import types
from numba.core.typing.templates import make_intrinsic_template
from numba.extending import lower_builtin, models, register_model, type_callable
from numba.np.arrayobj import make_array

LANES = 4
VECTOR = ir.VectorType(ir.DoubleType(), LANES)
INDEX, WORD = ir.IntType(32), ir.IntType(64)
INDICES, WORDS = ir.VectorType(INDEX, LANES), ir.VectorType(WORD, LANES)
ANYTHING = ir.Constant(VECTOR, ir.Undefined)
MANTISSA = ir.Constant(WORDS, [52] * LANES)  # its bits, below those of the exponent
ROOT = ir.Constant(WORDS, [int(np.sqrt(0.5).view(np.int64))] * LANES)  # bits of 2^(-1/2)


class Four(types.Type):
    """Numba's type of a vector of four float64."""

    def __init__(self):
        super().__init__("four")


four = Four()
ARITHMETIC = {
    operator.add: "fadd",
    operator.sub: "fsub",
    operator.mul: "fmul",
    operator.truediv: "fdiv",
}


@register_model(Four)
class _Model(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, VECTOR)


class _Instruction:
    """LLVM instructions that kernels call; Python calls the function ``plain`` instead."""

    def __init__(self, plain, emit):
        template = make_intrinsic_template(self, emit, emit.__name__)
        self._numba_type_ = types.Function(template)
        functools.update_wrapper(self, emit)
        self.plain = plain

    def __call__(self, *args):
        return self.plain(*args)


def _instruction(plain):
    """Return a decorator for a function that emits the instructions of the Python function
    ``plain``.
    """
    return functools.partial(_Instruction, plain)


def _write(array, index, value):
    array[index : index + LANES] = value


def _is_vector(array):
    """Return whether an array type is (n,) of float64 without gaps."""
    return array == types.float64[::1]


def _at(context, builder, kind, array, index):
    """Return a pointer to the four entries of ``array`` from ``index`` on."""
    data = make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [index]), VECTOR.as_pointer())


@_instruction(lambda array, index: array[index : index + LANES].copy())
def load(_, array, index):
    """Return entries ``index`` .. ``index`` + 3 of ``array``."""
    if not _is_vector(array):
        return None  # a TypingError

    def code(context, builder, signature, args):
        return builder.load(_at(context, builder, signature.args[0], *args), align=8)

    return four(array, types.intp), code


@_instruction(_write)
def store(_, array, index, value):
    """Write ``value`` to entries ``index`` .. ``index`` + 3 of ``array``."""
    if not _is_vector(array):
        return None

    def code(context, builder, signature, args):
        builder.store(args[2], _at(context, builder, signature.args[0], *args[:2]), align=8)
        return context.get_dummy_value()

    return types.none(array, types.intp, four), code


@_instruction(lambda number: np.full(LANES, number))
def spread(_, number):
    """Return a vector with ``number`` in all four lanes."""

    def code(context, builder, signature, args):
        first = builder.insert_element(ANYTHING, args[0], INDEX(0))
        return builder.shuffle_vector(first, ANYTHING, ir.Constant(INDICES, 0))

    return four(types.float64), code


@_instruction(lambda array, places, at: array[places[at : at + LANES]])
def collect(_, array, places, at):
    """Return the entries of ``array`` at the indices ``places``[at] .. ``places``[at + 3], none
    negative.
    """
    if not (_is_vector(array) and places == types.int64[::1]):
        return None

    def code(context, builder, signature, args):
        data = make_array(signature.args[0])(context, builder, args[0]).data
        index = make_array(signature.args[1])(context, builder, args[1]).data
        vector = ANYTHING
        for lane in range(LANES):
            place = builder.load(builder.gep(index, [builder.add(args[2], WORD(lane))]))
            entry = builder.load(builder.gep(data, [place]))
            vector = builder.insert_element(vector, entry, INDEX(lane))
        return vector

    return four(array, places, types.intp), code


@_instruction(lambda a, b: bool(np.all(a > b)))
def exceeds(_, a, b):
    """Return whether ``a`` > ``b`` in all lanes."""

    def code(context, builder, signature, args):
        lanes = builder.fcmp_ordered(">", *args)
        every = ir.Constant(ir.IntType(LANES), -1)
        return builder.icmp_unsigned("==", builder.bitcast(lanes, every.type), every)

    return types.boolean(four, four), code


@_instruction(lambda vector, index: vector[index])
def lane(_, vector, index):
    """Return number ``index`` of a vector."""

    def code(context, builder, signature, args):
        return builder.extract_element(*args)

    return types.float64(four, types.intp), code


@_instruction(np.rint)
def nearest(_, vector):
    """Return the whole number nearest to each lane."""

    def code(context, builder, signature, args):
        kind = ir.FunctionType(VECTOR, [VECTOR])
        rounded = builder.module.declare_intrinsic("llvm.rint.v4f64", fnty=kind)
        return builder.call(rounded, args)

    return four(four), code


@_instruction(lambda vector: np.floor(np.log2(vector) + 0.5))
def exponent(_, vector):
    """Return the k with 2^(k - 1/2) <= lane < 2^(k + 1/2) of each lane, a positive number."""

    def code(context, builder, signature, args):
        above = builder.sub(builder.bitcast(args[0], WORDS), ROOT)
        return builder.sitofp(builder.trunc(builder.ashr(above, MANTISSA), INDICES), VECTOR)

    return four(four), code


@_instruction(lambda vector, k: np.ldexp(vector, k.astype(int)))
def scaled(_, vector, k):
    """Return lane times 2^k of each lane, where ``k`` has whole numbers and nothing overflows."""

    def code(context, builder, signature, args):
        whole = builder.sext(builder.fptosi(args[1], INDICES), WORDS)
        bits = builder.add(builder.bitcast(args[0], WORDS), builder.shl(whole, MANTISSA))
        return builder.bitcast(bits, VECTOR)

    return four(four, four), code


def _declare(operation, instruction):
    """Let kernels compute with vectors."""

    @type_callable(operation)
    def kind(context):
        return lambda a, b: four if a == b == four else None

    @lower_builtin(operation, Four, Four)
    def code(context, builder, signature, args):
        return getattr(builder, instruction)(*args, flags=["contract"])


for name in ARITHMETIC.items():
    _declare(*name)
