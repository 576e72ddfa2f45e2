"""Our factor and solution of the matrix of a step beside those of libraries, on the same numbers.

Ours starts from the elements' stiffness, a library from its assembled matrix; what depends on the
pattern alone is done before the clock starts, as far as a library lets one.
"""

from functools import partial

import numpy as np
from scipy import linalg
from scipy.sparse import csgraph, triu
from scipy.sparse.linalg import splu

from tests.bench import loops
from tests.bench.clock import medians, seconds
from tests.bench.crushes import Crush
from tests.bench.matrix import assembled
from tests.bench.spot import Spot
from tests.bench.table import Row

GROUP = "factor and solve one matrix, µs (ratio to ours)"
SYMMETRIC = {"diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}


def _superlu(matrix):
    """SuperLU in an order of least degree that it found before."""
    order = np.argsort(splu(matrix, "MMD_AT_PLUS_A", **SYMMETRIC).perm_c)
    permuted, back = matrix[order][:, order].tocsc(), np.argsort(order)
    return lambda b: splu(permuted, "NATURAL", **SYMMETRIC).solve(b[order])[back]


def _band(matrix):
    """Cholesky of a band in reverse Cuthill-McKee order."""
    order = csgraph.reverse_cuthill_mckee(matrix.tocsr(), symmetric_mode=True)
    lower, back = matrix[order][:, order].tocoo(), np.argsort(order)
    below = lower.row >= lower.col
    offset = (lower.row - lower.col)[below]
    band = np.zeros((offset.max() + 1, matrix.shape[0]))
    band[offset, lower.col[below]] = lower.data[below]
    return lambda b: linalg.solveh_banded(band, b[order], lower=True, check_finite=False)[back]


def _qdldl(matrix):
    """QDLDL with the order and the tree of its first factor."""
    from qdldl import Solver

    upper = triu(matrix, format="csc")
    solver = Solver(upper, upper=True)

    def again(b):
        solver.update(upper, upper=True)
        return solver.solve(b)

    return again


def _pardiso(matrix):
    """PARDISO of MKL with the analysis of its first factor."""
    from pypardiso import PyPardisoSolver

    upper = triu(matrix, format="csr")
    solver = PyPardisoSolver(mtype=2)
    solver.factorize(upper)
    solver.set_phase(23)  # numbers, then the solution
    return lambda b: solver._call_pardiso(upper, b)


LIBRARIES = {
    "SuperLU (scipy), analysis included": _superlu,
    "LAPACK band (scipy)": _band,
    "QDLDL (qdldl)": _qdldl,
    "PARDISO (pypardiso)": _pardiso,
}


def solvers(matrix):
    """Function of a right side for every library that is installed."""
    found = {}
    for name, prepare in LIBRARIES.items():
        try:
            found[name] = prepare(matrix)
        except ImportError:
            continue
    return found


def _both(spot):
    return spot.each(loops.FACTOR) + spot.each(loops.SOLVE)


def rows(sizes, count):
    """Rows of the table."""
    table = {name: Row(GROUP, name) for name in ("ours, from the elements", *LIBRARIES)}
    for cells in sizes:
        crush = Crush(cells)
        spot = Spot(crush.scene, crush.state.x)
        matrix = assembled(crush.scene.terms, spot.at.stiffness)
        b = np.ones(matrix.shape[0])
        sides = {"ours, from the elements": partial(_both, spot)}
        for name, solve in solvers(matrix).items():
            sides[name] = partial(seconds, partial(solve, b))
        found = medians(sides, count)
        ours = found["ours, from the elements"]
        for name, row in table.items():
            if name in found:
                row.put(cells, 1e6 * found[name], f"{found[name] / ours:.2g}")
            else:
                row.lack(cells, "not installed")
    return list(table.values())
