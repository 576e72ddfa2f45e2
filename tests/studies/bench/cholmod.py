"""A symmetric matrix in CHOLMOD, of SuiteSparse: factor and solution. The library is optional.

Y. Chen, T. A. Davis, W. W. Hager, S. Rajamanickam: ACM Transactions on Mathematical Software 35
(2008) 22. It chooses its order itself; the method is the supernodal one, L L^T.
"""

import ctypes
from ctypes import POINTER, byref, c_int, c_size_t, c_void_p
from ctypes.util import find_library
from functools import cache

import numpy as np
from scipy.sparse import csc_array

COMMON = 1 << 14  # bytes of `cholmod_common`, which has some 3000
LONG, REAL, LOWER, SOLUTION, SUPERNODAL = 2, 1, -1, 0, 2


class Sparse(ctypes.Structure):
    """`cholmod_sparse`."""

    _fields_ = [
        *((name, c_size_t) for name in ("nrow", "ncol", "nzmax")),
        *((name, c_void_p) for name in ("p", "i", "nz", "x", "z")),
        *((name, c_int) for name in ("stype", "itype", "xtype", "dtype", "sorted", "packed")),
    ]


class Dense(ctypes.Structure):
    """`cholmod_dense`."""

    _fields_ = [
        *((name, c_size_t) for name in ("nrow", "ncol", "nzmax", "d")),
        *((name, c_void_p) for name in ("x", "z")),
        *((name, c_int) for name in ("xtype", "dtype")),
    ]


class Settings(ctypes.Structure):
    """The beginning of `cholmod_common`."""

    _fields_ = [
        *((name, ctypes.c_double) for name in ("dbound", "grow0", "grow1")),
        *((name, c_size_t) for name in ("grow2", "maxrank")),
        ("supernodal_switch", ctypes.c_double),
        ("supernodal", c_int),
    ]


class Factor(ctypes.Structure):
    """The beginning of `cholmod_factor`: ``minor`` is n if the factor went through."""

    _fields_ = [("n", c_size_t), ("minor", c_size_t)]


@cache
def library():
    """The library; ImportError where it is not installed."""
    if (name := find_library("cholmod")) is None:
        raise ImportError("CHOLMOD is not installed")
    loaded = ctypes.CDLL(name)
    loaded.cholmod_l_analyze.restype = POINTER(Factor)
    loaded.cholmod_l_solve.restype = POINTER(Dense)
    return loaded


def pointer(array):
    """Address of the values of an array."""
    return array.ctypes.data_as(c_void_p)


class Peer:
    """A positive definite matrix, given by its lower half, whose pattern has been analysed.

    Its memory is kept until the process ends.
    """

    def __init__(self, lower: csc_array):
        lower = lower.sorted_indices()
        indices = (each.astype(np.int64) for each in (lower.indptr, lower.indices))
        self._kept = (*indices, lower.data)
        p, i, x = map(pointer, self._kept)
        n = lower.shape[0]
        self._a = Sparse(n, n, lower.nnz, p, i, None, x, None, LOWER, LONG, REAL, 0, 1, 1)
        self._common = ctypes.create_string_buffer(COMMON)
        self._library = library()
        self._library.cholmod_l_start(self._common)
        Settings.from_buffer(self._common).supernodal = SUPERNODAL
        self._factor = self._library.cholmod_l_analyze(byref(self._a), self._common)

    def factor(self):
        """Factor the matrix."""
        self._library.cholmod_l_factorize(byref(self._a), self._factor, self._common)
        if self._factor.contents.minor < self._a.nrow:
            raise ArithmeticError("the matrix is not positive definite")

    def solve(self, b):
        """Solution (n,) for a right side ``b`` (n,) after `factor`."""
        n, right = b.size, np.array(b, dtype=np.float64)
        given = Dense(n, 1, n, n, pointer(right), None, REAL, 0)
        solution = self._library.cholmod_l_solve(
            c_int(SOLUTION), self._factor, byref(given), self._common
        )
        address = ctypes.cast(solution.contents.x, POINTER(ctypes.c_double))
        x = np.ctypeslib.as_array(address, (n,)).copy()
        self._library.cholmod_l_free_dense(byref(solution), self._common)
        return x
