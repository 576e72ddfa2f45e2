"""Makes a case with more or fewer elements and steps, and no other change."""

from typing import Any

from sweep.config.case import Case
from sweep.config.kinds.lattice import Lattice
from sweep.config.kinds.solver import Solver
from sweep.design.upright_plan import most_layers

ROUND_OFF = 1e-9


def refined(case: Case, elements: float = 1.0, steps: float = 1.0) -> Case:
    """The case with ``elements`` times the elements of every wall, and ``steps`` times the steps.

    Numbers are rounded down, to at least one.
    """
    other_mesh = {} if elements == 1.0 else mesh(case.lattice, elements)
    other_steps = {} if steps == 1.0 else _steps(case.solver, steps)
    tables = {
        "lattice": case.lattice.model_copy(update=other_mesh),
        "solver": case.solver.model_copy(update=other_steps),
    }
    return case.model_copy(update=tables)


def mesh(lattice: Lattice, times: float) -> dict[str, Any]:
    """The changes of a lattice with `times` the elements: of its walls, and of its layers of
    quads.
    """
    before = lattice.pieces
    after = tuple(_times(count, times) for count in before)
    change = lattice.remeshed(after)
    if lattice.layers is None:
        return change
    ratio = min(one / other for one, other in zip(before, after, strict=True))
    return change | layers(lattice, round(lattice.layers / ratio))


def layers(lattice: Lattice, count: int, thicker: float = 1.0) -> dict[str, int]:
    """Layers of quads of plates with walls ``thicker`` times as thick, at most so many that quads
    are as high as walls are thick.
    """
    most = most_layers(thicker * lattice.network.wall_thickness, lattice.depth)
    return {"layers": max(min(count, most), 1)}


def _steps(solver: Solver, times: float) -> dict[str, Any]:
    """The changes of a solver with `times` the steps.

    The error of one step grows with its length to the power order + 1 of the integrator.
    """
    count = solver.load_steps
    after = None if count is None else _times(count, times)
    ratio = 1.0 / times if count is None or after is None else count / after
    order = 1 if solver.integrator == "backward_euler" else 2
    scales = {"time_step": ratio, "arc_length": ratio, "accuracy": ratio}
    scales["step_error"] = ratio ** (order + 1)
    values = {key: getattr(solver, key, None) for key in scales}
    longer = {key: scales[key] * value for key, value in values.items() if value is not None}
    return longer | {"load_steps": after}


def _times(count: int, times: float) -> int:
    return max(int(times * count + ROUND_OFF), 1)
