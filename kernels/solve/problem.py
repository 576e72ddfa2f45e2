"""The interface between the solver and a problem.

A *problem* is a named tuple of arrays whose class has the verbs of `Problem`:
``problem.evaluate(...)`` and so on. Compiled code finds a verb by the type of the tuple, so that
the solver is compiled once for each kind of problem in the process, and calling a verb costs no
more than calling any other kernel (`compile.verbs`). The solver knows mechanics (mass, stored
energy, dissipation, lagged forces) and the role of each coordinate, but no structure: no walls, no
plates and no dimension of space.
"""

from typing import NamedTuple, Protocol

import numpy as np

HELD, LED, TIED, FREE = range(4)  # roles; a TIED coordinate follows a FREE one. The order counts:
# from TIED on a coordinate is not prescribed (`newton._longest`, `arc_length`).
POSITIVE, NEGATIVE, NO_ROOM = range(3)  # results of a factorisation


class Coordinates(NamedTuple):
    """The n coordinates of a problem.

    role (n,): HELD at a fixed value, LED by the driven coordinate, TIED or FREE. Periodic images
    have the role FREE; the verbs of `Problem` let them follow. scale (n,): length that converts a
    coordinate to m, 1 for one in m; lever (n,): 1 / scale. mass (n,): kg, 0 without inertia. heavy
    (n,): 1 where the coordinate, or the one that it is tied to, has mass, else 0. load (n,): dead
    forces in N at a load factor of 1. driven: coordinate with a prescribed value, -1 if none. cap:
    longest move in one iteration, m. leap: length of a move along a direction of negative
    curvature, m. close: a move too short for stability to be lost in it, m.
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
    """One step of a march, from the accepted positions x0 (n,).

    y (n,): (x - y) / h is the velocity, h in s. x_pred (n,): x~, positions that inertia alone would
    lead to (`integrators`). duration: of the step, s, static steps included. dynamic: whether the
    step has inertia. factor: load factor at the end of the step. theta: weight of the forces at the
    end of the step in the energy book. rows: number of rows of the history that the step spans, 1
    for a part of a row. speed: the root mean square, over all mass, of the velocity at x0, m/s.
    """

    x0: np.ndarray
    y: np.ndarray
    x_pred: np.ndarray
    h: float
    duration: float
    dynamic: bool
    factor: float
    theta: float
    rows: float
    speed: float


SUMS = np.dtype(
    (
        np.record,  # fields are attributes in plain Python too
        [
            ("potential", np.float64),  # of the step, which is minimised, J
            ("friction", np.float64),  # its friction part, J
            ("dissipated", np.float64),  # by the laws in the step, J; filled at commit
        ],
    )
)


class Evaluation(NamedTuple):
    """Result of `Problem.evaluate` at a point.

    g (n,): gradient of the potential, N; at supports it is the reaction. elastic, friction,
    material (n,): its parts due to stored energy, friction and damping. u (n,): x - y, after a step
    x - x0. stored (k,): stored energies in J, one for each kind that the problem distinguishes.
    sums (1,): see `SUMS`.
    """

    g: np.ndarray
    elastic: np.ndarray
    friction: np.ndarray
    material: np.ndarray
    u: np.ndarray
    stored: np.ndarray
    sums: np.ndarray


class Problem(Protocol):
    """The verbs of a problem; the vectors x, dx, g, direction ... are (n,), by coordinate.

    scene: the data of the problem, with the verbs of `Scene`. Until the next `evaluate`, a problem
    may keep what it computes at a point in arrays of its own.
    """

    scene: "Scene"

    # One step, from its start until it is accepted or rejected.

    def begin(self, step, ahead, scratch):
        """Prepare the data at the start of the step. ahead: `integrators.Ahead`. scratch (n,)."""

    def evaluate(self, x, step, evaluation):
        """Return the potential of the step at ``x`` in J, and fill ``evaluation``."""

    def store(self, x, step, evaluation):
        """Renew the part of ``evaluation.stored`` that `project` may have changed, in a step of no
        duration.

        The gradient is added to ``evaluation.elastic``, which the next `evaluate` sets.
        """

    def commit(self, x, step, evaluation):
        """Accept ``x``, the point of the last `evaluate`: commit the state of the material laws.

        Correct ``evaluation.stored`` to the stored energy and fill ``sums.dissipated``. Coordinates
        may be re-based here: the solver never subtracts two accepted positions.
        """

    def roll_back(self, step):
        """Discard data of points after the start of the step, which is rejected."""

    # The linear system at the point of the last `evaluate`.

    def factor(self, x, step, evaluation, shift, through):
        """Factor the Hessian; return the result and the first negative pivot.

        shift: sigma of `newton` in N/m, 0 for the exact Hessian; before a shifted one the exact one
        has been factored at the same point. POSITIVE: all pivots are positive. NEGATIVE: a pivot is
        negative; the factorisation stops there, unless ``through``. NO_ROOM: the pattern lacks an
        entry, which `Scene.renew_neighbours` adds.
        """

    def solve(self, b):
        """Solve in place for the right side ``b``, with the constraints of the coordinates."""

    def descend(self, direction):
        """Fill ``direction`` with d such that d . H d is the negative pivot of `factor`."""

    def unstable(self):
        """Return the number of negative pivots in the last `factor`."""

    def stiffest(self):
        """Return the largest stiffness in the last `factor` among coordinates in m, N/m."""

    # Constraints.

    def reduce(self, g, residual):
        """Fill ``residual`` with ``g`` of the FREE coordinates and with the reaction of the driven
        one, each including its followers; other entries are 0.
        """

    def lead(self, move, direction):
        """Write the moves of LED coordinates when the driven coordinate moves by ``move``."""

    def pull(self, move, direction):
        """Fill ``direction`` with the linearised change of the gradient in the moves of `lead`."""

    def tie(self, vector):
        """Set each TIED coordinate of ``vector`` to its leader times the ratio of their moves."""

    # Step limits and neighbour lists.

    def travel(self, dx):
        """Return the longest distance that a point of the problem moves in ``dx``, m."""

    def step_limit(self, x, dx, far):
        """Return the share of ``dx`` (at most 1) that is admissible. far: its `travel`."""

    def covers(self, x, far):
        """Return whether the neighbour lists hold for any move of at most ``far`` m from ``x``."""

    # Lagged forces, such as friction: fixed in a minimisation, renewed between two of them.

    def lag(self, y):
        """Lag the forces at ``y``; return whether there are any now, or were before."""

    def exchange(self, step, evaluation):
        """Replace the lagged part of ``evaluation`` by its value for the present forces; return
        E.
        """

    def follow(self, dx, share, step, evaluation):
        """Update dual variables of lagged forces in a share of a Newton step ``dx``.

        Return whether they agree with the primal variables at the end, so that the factor may be
        kept.
        """

    def forget(self):
        """Reset the dual variables of `follow`."""

    # After a step: projection and output.

    def project(self, x):
        """Correct the accepted positions ``x`` or the data of the problem before the next step;
        return whether the stored energy may have changed.
        """

    def covers_projection(self, x):
        """Return whether the neighbour lists hold for `project` at ``x``."""

    def write(self, out, k, state, evaluation):
        """Write row ``k`` of the history, and its frame if ``out`` has a slot for it."""

    def write_share(self, out, k, state, evaluation):
        """Write the data of row ``k`` at the end of a share that is not the last of the row."""


class Scene(Protocol):
    """The constant data of a problem, with the verbs that assemble the problem."""

    coordinates: Coordinates

    def make_buffers(self, memory):
        """Return the arrays that are allocated once per march. memory: `history.State.memory`."""

    def find_neighbours(self, x):
        """Return the neighbour lists at ``x`` and a matrix with room for their couplings."""

    def renew_neighbours(self, neighbours, x, far):
        """Return neighbour lists that hold for any move of at most ``far`` m from ``x``, and the
        matrix with its missing entries.

        If no entry is missing, the matrix is the same, and its factor remains valid.
        """

    def assemble(self, neighbours, buffers):
        """Return the `Problem`."""
