"""What the solver asks of a problem, and all that it knows of one.

A *problem* is a named tuple of arrays whose class has the verbs of `Problem`:
``problem.evaluate(...)`` and so on. Compiled code finds a verb by the type of the tuple: each kind
of problem has a solver compiled for it, a call costs what a call of any kernel costs, and nothing
is compiled that no problem of the process needs. The solver itself knows coordinates by their role
only: no walls, no plates, no dimension of space.
"""

from typing import NamedTuple, Protocol

import numpy as np

HELD, LED, TIED, FREE = range(4)  # roles; what is TIED follows a FREE coordinate
POSITIVE, NEGATIVE, NO_ROOM = range(3)  # what a factor has met


class Coordinates(NamedTuple):
    """The n coordinates of a problem. A period's images are FREE in role, and follow by `Problem`.

    role (n,). scale (n,): length that turns a coordinate into m, 1 for one in m; lever (n,): its
    inverse. mass (n,): kg, 0 for what has no inertia; heavy (n,): 1 for what moves by its mass or
    by that of what it is tied to, else 0. load (n,): dead forces in N at a load factor of 1.
    driven: coordinate that is led to a target, -1 if none. cap: longest move in one iteration, m.
    leap: first move along a direction of negative curvature, m. close: a move so short that
    stability cannot have been lost on it, m.
    """

    role: np.ndarray
    scale: np.ndarray
    lever: np.ndarray
    mass: np.ndarray
    heavy: np.ndarray
    load: np.ndarray
    driven: int
    cap: float
    leap: float
    close: float


class Step(NamedTuple):
    """One step of a march, from the accepted position x0 (n,).

    y (n,): whence rates are measured; x_pred (n,): where inertia would lead (`integrators`).
    h: time that turns x - y into a rate, s. duration: of the step, s, with inertia or without.
    dynamic: whether there is inertia. factor: of the load at the end of the step. theta: share of
    the end in the energy book.
    """

    x0: np.ndarray
    y: np.ndarray
    x_pred: np.ndarray
    h: float
    duration: float
    dynamic: bool
    factor: float
    theta: float


SUMS = np.dtype(
    (
        np.record,  # for attributes in plain Python too
        [
            ("potential", np.float64),  # what the step minimises, J
            ("friction", np.float64),  # of which friction's share, J
            ("dissipated", np.float64),  # by the material in the step, when it is committed, J
        ],
    )
)


class Found(NamedTuple):
    """What `Problem.evaluate` has found at a point.

    g (n,): gradient by coordinate, which is also what supports must supply, N. elastic, friction,
    material (n,): its parts that belong to stored energy, to friction and to damping. u (n,):
    x - y, and after a step x - x0. stored (k,): stored energies, J, as many as the problem tells
    apart. sums (1,): see `SUMS`.
    """

    g: np.ndarray
    elastic: np.ndarray
    friction: np.ndarray
    material: np.ndarray
    u: np.ndarray
    stored: np.ndarray
    sums: np.ndarray


class Problem(Protocol):
    """The verbs of a problem: x, dx, g, direction ... are (n,) by coordinate.

    scene: the data of the problem, with the verbs of `Scene`. What a problem knows of a position it
    may keep, in arrays of its own, until the next `evaluate`.
    """

    scene: "Scene"

    # One step: from where it sets out until it is accepted.

    def begin(self, step, ahead, scratch):
        """Prepare what the step needs to know of its start. ahead: `integrators.Ahead`."""

    def evaluate(self, x, step, found, projected):
        """Return the potential of the step at ``x`` in J, and fill ``found``.

        ``projected``: of the Hessian that `factor` takes, keep what is positive semi-definite.
        """

    def store(self, x, step, found):
        """Fill ``found.elastic`` (added to) and ``found.stored`` alone."""

    def commit(self, x, step, found):
        """Accept ``x``: keep what the material remembers; fill what it has stored and dissipated.

        Coordinates may be re-based here: nobody subtracts two accepted positions.
        """

    def roll_back(self, step):
        """Forget what was found since the step set out."""

    # The linear system at the point of the last `evaluate`.

    def factor(self, x, step, found, projected, through):
        """Factor the Hessian; return what was met and the first negative pivot.

        POSITIVE: all pivots are. NEGATIVE: one is not; with ``through`` it is not stopped at.
        NO_ROOM: the pattern lacks an entry; `Scene.renew_neighbours` makes room.
        """

    def solve(self, b):
        """Solve in place for a right side; what is held, tied or led has its own rules."""

    def descend(self, direction):
        """Fill ``direction`` with d such that d . H d is the negative pivot of `factor`."""

    def unstable(self):
        """Return how many pivots of the last `factor` are negative."""

    def stiffest(self):
        """Return the largest stiffness of a coordinate in m in the last `factor`, N/m."""

    # Constraints.

    def reduce(self, g, residual):
        """Fill ``residual`` with the forces on what is FREE; zero elsewhere."""

    def lead(self, move, direction):
        """Write the moves of all that is LED when the driven coordinate goes by ``move``."""

    def pull(self, move, direction):
        """Fill ``direction`` with the change of the gradient when `lead` moves what it leads."""

    def tie(self, vector):
        """Let what follows another coordinate have its value times the ratio of their moves."""

    # How far a step may go, and what is near.

    def travel(self, dx):
        """Return how far a point of the problem goes at most in a move, m."""

    def step_limit(self, x, dx, far):
        """Return the share of ``dx`` (at most 1) that is admissible. far: its `travel`."""

    def covers(self, x, far):
        """Return whether all that matters within a move of ``far`` m from ``x`` is listed."""

    # Forces that lag, as friction does: they are taken anew between minima.

    def lags(self):
        """Return whether any force of the scene lags."""

    def lag(self, y):
        """Take lagged forces at ``y``; return whether there are any, or were before."""

    def exchange(self, step, found):
        """Exchange the lagged part of ``found`` for that of the forces of now; return potential."""

    def follow(self, dx, share, step, found):
        """Carry what lags along a share of a Newton step; return whether it fits where it leads."""

    def forget(self):
        """Forget what `follow` carries."""

    # After a step, and on record.

    def project(self, x):
        """Move ``x`` to where nothing is too near; return whether anything has moved."""

    def covers_projection(self, x):
        """Return whether all that `project` may have to move is listed."""

    def write(self, out, k, state, found):
        """Write row ``k`` of the history, and its frame."""


class Scene(Protocol):
    """The data of a problem, which nobody changes, and how a problem is made of it."""

    coordinates: Coordinates

    def make_buffers(self, memory):
        """Return the arrays of the problem that are made once. memory: `State.memory`."""

    def find_neighbours(self, x):
        """Return what is near at ``x``, and a matrix with room for it."""

    def renew_neighbours(self, neighbours, x, far):
        """Return ``neighbours`` with what was lacking at ``x``: entries of the matrix, or those
        whom a move by ``far`` m can bring near.

        A factor outlives this unless the matrix is another.
        """

    def assemble(self, neighbours, buffers):
        """Return the problem."""
