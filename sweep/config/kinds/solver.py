"""The solution method: in time, quasi-statically, or along arcs of an equilibrium path."""

from typing import Annotated, Any, ClassVar, Literal, TypeAlias

from pydantic import Field

from sweep.config.kinds.table import Count, Duration, Length, Strain, Table

ARCS = "arc_length"
# A million rows of history take 120 MB, and a million steps of one square cell half a minute.
MAX_STEPS = 1_000_000
LOAD_STEPS = 200
TIME_STEP = 1e-4  # s
IN_TIME = '"backward_euler", "bdf2" or "newmark"'  # the integrators
Integrator = Literal["backward_euler", "bdf2", "newmark", "static", "arc_length"]


class _Solver(Table):
    """The keys of all solvers. joints: None along the cells. retry: `simulation.retries`."""

    table: ClassVar[str] = "solver"
    # Neither changes the results of a case that converges as it is.
    labels: ClassVar[tuple[str, ...]] = ("time_limit", "retry")
    neutral: ClassVar[dict[str, Any]] = {"hessian": "exact"}

    tolerance: Annotated[float, Field(gt=0, lt=1)] = 1e-8
    max_iterations: Count = 100
    time_limit: Duration = 300.0
    retry: bool = True
    element: Literal["cubic", "classical"] = "cubic"
    joints: Literal["solid", "points"] | None = None
    bend_measure: Literal["angle", "tangent"] = "angle"
    hessian: Literal["exact", "tangent_modulus"] = "exact"


class InTime(_Solver):
    """Steps of a motion. newmark: the trapezoidal rule.

    `step_error`: allowed error of a position in a single step, which is a fraction of the time step
    where needed. `load_steps`: of a driven platen, which set the time step.
    """

    because: ClassVar[str] = "solver.load_steps sets it"

    integrator: Literal["backward_euler", "bdf2", "newmark"] = "backward_euler"
    time_step: Duration
    step_error: Length | None = None
    load_steps: Count | None = None


class Static(_Solver):
    """Equilibria after steps of a load or a platen.

    `accuracy`: allowed error of the work in a step, as a share of it; a step then spans up to four
    of `load_steps` equal ones, and is as short as a 32nd of one where walls that relax buckle.
    Without it, steps are equal.
    """

    because: ClassVar[str] = "the crush is quasi-static"

    integrator: Literal["static"] = "static"
    load_steps: Count = 200
    accuracy: Strain | None = None


class Arcs(_Solver):
    """Equilibria one `arc_length` apart along a path."""

    because: ClassVar[str] = f'solver.integrator is "{ARCS}"'

    integrator: Literal["arc_length"] = "arc_length"
    load_steps: Count = 200
    arc_length: Length


Solver: TypeAlias = Annotated[InTime | Static | Arcs, Field(discriminator="integrator")]
