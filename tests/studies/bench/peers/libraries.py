"""Our factor and solution of the matrix of a step beside those of libraries, on the same numbers.

Ours starts from the elements' stiffness, a library from its assembled matrix; what depends on the
pattern alone is done before the clock starts, as far as a library lets one.
"""

from functools import partial

import numpy as np
from scipy import linalg
from scipy.sparse import csgraph, triu
from scipy.sparse.linalg import splu

from tests.studies.bench.measuring import loops
from tests.studies.bench.measuring.clock import medians, seconds
from tests.studies.bench.measuring.crushes import Crush
from tests.studies.bench.measuring.spot import Spot
from tests.studies.bench.peers.matrix import assembled
from tests.studies.bench.table import Table

OURS = "ours, from the elements"
SYMMETRIC = {"diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
SAMPLE = 5e-3  # s of calls in a sample


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
    band = np.zeros((offset.max() + 1, matrix.shape[0]), order="F")
    band[offset, lower.col[below]] = lower.data[below]
    factor, solve = linalg.get_lapack_funcs(("pbtrf", "pbtrs"), (band,))
    return lambda b: solve(factor(band, lower=1)[0], b[order], lower=1)[0][back]


def _qdldl(matrix):
    """QDLDL with the order and the tree of its first factor."""
    from qdldl import Solver

    upper = triu(matrix, format="csc")
    solver = Solver(upper, upper=True)

    def again(b):
        solver.update(upper, upper=True)
        return solver.solve(b)

    return again


def _cholmod(matrix):
    """CHOLMOD with the analysis of its first factor."""
    from sksparse.cholmod import analyze

    factor = analyze(matrix)

    def again(b):
        factor.cholesky_inplace(matrix)
        return factor(b)

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
    "LAPACK band (scipy)": _band,
    "SuperLU (scipy), with its analysis": _superlu,
    "QDLDL (qdldl)": _qdldl,
    "CHOLMOD (scikit-sparse)": _cholmod,
    "PARDISO (pypardiso)": _pardiso,
}


def solvers(matrix):
    """Function of a right side for every library; None where it is not installed."""
    found = {}
    for name, prepare in LIBRARIES.items():
        try:
            found[name] = prepare(matrix)
        except ImportError:
            found[name] = None
    return found


def repeated(solve, b):
    """CPU seconds of one call; ``SAMPLE`` is filled."""
    calls = max(round(SAMPLE / max(seconds(partial(solve, b)), 1e-6)), 1)
    return seconds(lambda: [solve(b) for _ in range(calls)]) / calls


def table(sizes, count):
    """µs to factor and solve."""
    found = Table("factor and solve the same matrix, µs", sizes)
    for cells in sizes:
        crush = Crush(cells)
        spot = Spot(crush.scene, crush.state.x, crush.move)
        matrix = assembled(crush.scene.terms, spot.whole.problem.buffers.stiffness)
        b, libraries = np.ones(matrix.shape[0]), solvers(matrix)
        sides = {OURS: lambda spot=spot: spot.each(loops.FACTOR) + spot.each(loops.SOLVE)}
        for name, solve in libraries.items():
            if solve:
                sides[name] = partial(repeated, solve, b)
        at = medians(sides, count)
        for name in (OURS, *libraries):
            if name in at:
                found.put(name, cells, 1e6 * at[name], f"{at[name] / at[OURS]:.2g} x")
            else:
                found.lack(name, "not installed")
    return found
