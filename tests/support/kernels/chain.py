"""A second problem for the solver: a chain of particles on a line, each in a double well.

    E = sum_i h ((x_i / a)^2 - 1)^2 + sum_i k / 2 (x_{i+1} - x_i - a0)^2 - f . u + E_i + D_f

One unknown a particle, no walls, no plane. Friction with the line is Coulomb's, smoothed as in
`kernels.terms.friction`; its normal force depends on the place, N = n (1 + (x / a)^2), and lags.
The Hessian is tridiagonal. The list of neighbours is imaginary: it holds for moves up to `MARGIN`.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import copy, zero
from kernels.compile.jit import jit_exact, jit_owning
from kernels.solve.problem import FREE, LED, NEGATIVE, POSITIVE, Coordinates

MARGIN = 0.4  # of a: a particle that has moved farther needs a new list
WELLS, SPRINGS = range(2)
ROW = np.dtype(
    (
        np.record,
        [
            *((name, np.float64) for name in ("time", "work", "kinetic", "wells", "springs")),
            *((name, np.float64) for name in ("material", "friction", "integrator", "residual")),
            ("reaction", np.float64),
        ],
    )
)


class Output(NamedTuple):
    """rows (steps,) of `ROW`; positions (steps, n)."""

    rows: np.ndarray
    positions: np.ndarray


class Neighbours(NamedTuple):
    """Positions at which the list was made (n,), and how often a list was made (1,)."""

    anchor: np.ndarray
    made: np.ndarray


class Buffers(NamedTuple):
    """Lagged normal forces (n,); pivots and off-diagonal (n,) of the factor, diagonal before it;
    place (1,) of the first negative pivot, -1 if there is none.
    """

    normal: np.ndarray
    pivot: np.ndarray
    beside: np.ndarray
    diagonal: np.ndarray
    place: np.ndarray


@jit_exact
def _well(scene, x):
    """Return the energy of a particle at ``x`` and its two derivatives."""
    s = x / scene.width
    hill = s * s - 1.0
    return (
        scene.height * hill * hill,
        4.0 * scene.height * s * hill / scene.width,
        4.0 * scene.height * (3.0 * s * s - 1.0) / scene.width**2,
    )


@jit_exact
def _smoothed(u, slip):
    """Return |u|, smoothed, and its two derivatives."""
    size = abs(u)
    if size >= slip:
        return size - slip / 3.0, 1.0 if u > 0.0 else -1.0, 0.0
    s = size / slip
    return slip * s * s * (1.0 - s / 3.0), u / slip * (2.0 - s), 2.0 / slip * (1.0 - s)


@jit_exact
def begin(problem, step, ahead, scratch):
    """Nothing is measured from the start of a step."""


@jit_exact
def store(problem, x, step, found):
    scene = problem.scene
    found.stored[WELLS], found.stored[SPRINGS] = 0.0, 0.0
    for i in range(x.size):
        value, slope, _ = _well(scene, x[i])
        found.stored[WELLS] += value
        found.elastic[i] += slope
        if i + 1 < x.size:
            stretched = x[i + 1] - x[i] - scene.apart
            found.stored[SPRINGS] += 0.5 * scene.spring * stretched * stretched
            found.elastic[i] -= scene.spring * stretched
            found.elastic[i + 1] += scene.spring * stretched


@jit_exact
def evaluate(problem, x, step, found):
    coordinates = problem.scene.coordinates
    for part in (found.elastic, found.friction, found.material):
        zero(part)
    for i in range(x.size):
        found.u[i] = x[i] - step.y[i]
    store(problem, x, step, found)
    total = found.stored[WELLS] + found.stored[SPRINGS]
    for i in range(x.size):
        force = step.factor * coordinates.load[i]
        total -= force * found.u[i]
        found.g[i] = found.elastic[i] - force
        if step.dynamic:
            inert = coordinates.mass[i] * (x[i] - step.x_pred[i]) / step.h**2
            total += 0.5 * inert * (x[i] - step.x_pred[i])
            found.g[i] += inert
    sums = found.sums[0]
    sums.potential, sums.friction, sums.dissipated = total, 0.0, 0.0
    return exchange(problem, step, found)


@jit_exact
def commit(problem, x, step, found):
    """Nothing is remembered."""


@jit_exact
def roll_back(problem, step):
    """Nothing is kept."""


@jit_exact
def _is_solved(coordinates, i):
    return coordinates.role[i] == FREE and i != coordinates.driven


@jit_exact
def factor(problem, x, step, found, shift, through):
    scene, buffers, coordinates = problem.scene, problem.buffers, problem.scene.coordinates
    met, first, before = POSITIVE, 0.0, 0.0
    buffers.place[0] = -1
    for i in range(x.size):
        stiffness = _well(scene, x[i])[2] + shift
        for end in (i > 0, i + 1 < x.size):
            stiffness += scene.spring * end
        if step.dynamic:
            stiffness += coordinates.mass[i] / step.h**2
        if scene.friction > 0.0:
            stiffness += scene.friction * buffers.normal[i] * _smoothed(found.u[i], scene.slip)[2]
        buffers.diagonal[i] = stiffness
    for i in range(x.size):
        if not _is_solved(coordinates, i):
            buffers.pivot[i], buffers.beside[i], before = 1.0, 0.0, 0.0
            continue
        buffers.beside[i] = -scene.spring / before if before != 0.0 else 0.0
        buffers.pivot[i] = buffers.diagonal[i] - buffers.beside[i] ** 2 * before
        before = buffers.pivot[i]
        if buffers.pivot[i] <= 0.0 and met == POSITIVE:
            met, first, buffers.place[0] = NEGATIVE, buffers.pivot[i], i
            if not through:
                break
    return met, first


@jit_exact
def solve(problem, b):
    buffers, coordinates = problem.buffers, problem.scene.coordinates
    for i in range(b.size):
        if not _is_solved(coordinates, i):
            b[i] = 0.0
        elif buffers.beside[i] != 0.0:
            b[i] -= buffers.beside[i] * b[i - 1]
    for i in range(b.size):
        b[i] /= buffers.pivot[i]
    for i in range(b.size - 1, 0, -1):
        if buffers.beside[i] != 0.0:
            b[i - 1] -= buffers.beside[i] * b[i]


@jit_exact
def descend(problem, direction):
    buffers = problem.buffers
    zero(direction)
    direction[buffers.place[0]] = 1.0
    for i in range(buffers.place[0], 0, -1):
        if buffers.beside[i] == 0.0:
            break
        direction[i - 1] = -buffers.beside[i] * direction[i]


@jit_exact
def unstable(problem):
    count = 0
    for pivot in problem.buffers.pivot:
        count += pivot < 0.0
    return count


@jit_exact
def stiffest(problem):
    most = 0.0
    for stiffness in problem.buffers.diagonal:
        most = max(most, abs(stiffness))
    return most


@jit_exact
def reduce(problem, g, residual):
    role = problem.scene.coordinates.role
    for i in range(g.size):
        residual[i] = g[i] if role[i] == FREE or role[i] == LED else 0.0


@jit_exact
def lead(problem, move, direction):
    driven = problem.scene.coordinates.driven
    if driven >= 0:
        direction[driven] = move


@jit_exact
def pull(problem, move, direction):
    scene = problem.scene
    driven = scene.coordinates.driven
    direction[driven] = problem.buffers.diagonal[driven] * move
    if driven > 0:
        direction[driven - 1] -= scene.spring * move
    if driven + 1 < direction.size:
        direction[driven + 1] -= scene.spring * move


@jit_exact
def tie(problem, vector):
    """Nothing follows another."""


@jit_exact
def travel(problem, dx):
    most = 0.0
    for move in dx:
        most = max(most, abs(move))
    return most


@jit_exact
def step_limit(problem, x, dx, far):
    """Return a share with which no particle goes farther than half the way to the other well."""
    return min(1.0, problem.scene.width / far) if far > 0.0 else 1.0


@jit_exact
def covers(problem, x, far):
    moved = 0.0
    for i in range(x.size):
        moved = max(moved, abs(x[i] - problem.neighbours.anchor[i]))
    return moved + far <= MARGIN * problem.scene.width or (far > 0.0 and moved == 0.0)


@jit_exact
def lag(problem, y):
    scene, normal = problem.scene, problem.buffers.normal
    for i in range(y.size):
        normal[i] = scene.weight * (1.0 + (y[i] / scene.width) ** 2)
    return scene.friction > 0.0


@jit_exact
def exchange(problem, step, found):
    scene, sums = problem.scene, found.sums[0]
    if scene.friction == 0.0:
        return sums.potential
    rubbed = 0.0
    for i in range(found.u.size):
        value, slope, _ = _smoothed(found.u[i], scene.slip)
        load = scene.friction * problem.buffers.normal[i]
        found.g[i] -= found.friction[i]
        found.friction[i] = load * slope
        found.g[i] += found.friction[i]
        rubbed += load * value
    sums.potential += rubbed - sums.friction
    sums.friction = rubbed
    return sums.potential


@jit_exact
def follow(problem, dx, share, step, found):
    return True


@jit_exact
def forget(problem):
    """Nothing is carried along."""


@jit_exact
def project(problem, x):
    return False


@jit_exact
def covers_projection(problem, x):
    return True


@jit_exact
def write_share(problem, out, k, state, found):
    """Nothing: a row has only the values at its end."""


@jit_exact
def write(problem, out, k, state, found):
    row, book, totals = out.rows[k], state.book[0], state.totals[0]
    row.time, row.work, row.kinetic = totals.time, book.work, book.kinetic
    row.wells, row.springs = state.stored[WELLS], state.stored[SPRINGS]
    row.material, row.friction = book.material, book.friction
    row.integrator, row.residual = book.integrator, book.residual
    row.reaction = totals.reaction
    copy(state.x, out.positions[k])


class Chain(NamedTuple):
    """The problem."""

    scene: object
    neighbours: Neighbours
    buffers: Buffers

    begin = begin
    evaluate = evaluate
    store = store
    commit = commit
    roll_back = roll_back
    factor = factor
    solve = solve
    descend = descend
    unstable = unstable
    stiffest = stiffest
    reduce = reduce
    lead = lead
    pull = pull
    tie = tie
    travel = travel
    step_limit = step_limit
    covers = covers
    lag = lag
    exchange = exchange
    follow = follow
    forget = forget
    project = project
    covers_projection = covers_projection
    write = write
    write_share = write_share


@jit_owning
def make_buffers(scene, memory):
    n = scene.coordinates.role.size
    a = np.zeros((4, n))
    return Buffers(a[0], a[1], a[2], a[3], np.full(1, -1))


@jit_owning
def find_neighbours(scene, x):
    return Neighbours(x.copy(), np.ones(1, np.int64))


@jit_owning
def renew_neighbours(scene, neighbours, x, far):
    neighbours.made[0] += 1
    return Neighbours(x.copy(), neighbours.made)


@jit_exact
def assemble(scene, neighbours, buffers):
    return Chain(scene, neighbours, buffers)


class Line(NamedTuple):
    """The data of a chain. height: of the hill between two wells, J; width: half their distance, m.

    spring, apart: stiffness, N/m, and rest length, m. friction, weight, slip: coefficient, n in
    N, smoothing in m.
    """

    coordinates: Coordinates
    height: float
    width: float
    spring: float
    apart: float
    friction: float
    weight: float
    slip: float

    make_buffers = make_buffers
    find_neighbours = find_neighbours
    renew_neighbours = renew_neighbours
    assemble = assemble
