"""The loading in the file of a custom structure: for a duration, or quasi-static in equal steps."""

from typing import Any, ClassVar, Literal, Self

from sweep.config.kinds.body import Body
from sweep.config.kinds.dead_load import DURATION
from sweep.config.kinds.directed import Directed, Ramp
from sweep.config.kinds.direction import ACROSS
from sweep.config.kinds.solver import ARCS, IN_TIME, Solver
from sweep.config.kinds.table import Duration, Inputs, RefusedError
from sweep.config.structures.structure import Structure


class CustomLoading(Directed):
    """Loads and prescribed moves of the file. `quasi_static`: they grow together in equal steps."""

    because: ClassVar[str] = 'lattice.kind is "custom"'
    constants: ClassVar[dict[str, Any]] = {"platen": "none", "allowed_forces": []}
    words: ClassVar[tuple[str, ...]] = ("custom",)
    solid: ClassVar[bool] = False
    cycles: ClassVar[int] = 1
    platen: ClassVar[str] = "none"
    columns: ClassVar[dict[str, float]] = {}
    is_shaped: ClassVar[bool] = False
    shape_columns: ClassVar[dict[str, str]] = {"striker": "none", "base": "none"}
    allowed_forces: ClassVar[tuple[float, ...]] = ()

    direction: Literal["in_plane"] = ACROSS
    mode: Literal["custom"] = "custom"
    duration: Duration
    quasi_static: bool

    @classmethod
    def of(cls, inputs: Inputs, body: Body, integrator: str | None, relaxes: bool) -> Self:
        """The loading of a structure; a structure that is at rest only with inertia is refused in
        statics.
        """
        structure, still = body.structure, integrator in ("static", ARCS)
        assert structure is not None
        quasi_static = still or bool(inputs.get("quasi_static"))
        if quasi_static and not still and integrator is not None:
            raise RefusedError("solver.integrator", integrator, '"static" if quasi_static')
        if quasi_static and structure.floor_y_mm is None:
            _check_mechanism(structure, integrator)
        if integrator == ARCS and structure.prescribed:
            allowed = '"static", or loads instead of prescribed moves'
            raise RefusedError("solver.integrator", ARCS, allowed)
        if integrator == ARCS and not (structure.loads or any(structure.gravity_mm_s2)):
            raise RefusedError("solver.integrator", ARCS, '"static" where there are no loads')
        duration = inputs.get("duration", 1.0 if quasi_static else DURATION)
        return cls(duration=duration, quasi_static=quasi_static)

    def ramps(self, solver: Solver) -> list[Ramp]:
        """Loads and moves that act from the start, or that grow together in statics."""
        start = 0.0 if self.quasi_static else 1.0
        time, steps = (self.duration, None) if start else (None, solver.load_steps)
        return [Ramp("loading", load=(start, 1.0), way=(0.0, 1.0), time=time, steps=steps)]


def _check_mechanism(structure: Structure, integrator: str | None) -> None:
    """Refuse a structure that can move without resistance."""
    from sweep.config.structures.mechanism import find_mechanism

    if motion := find_mechanism(structure):
        allowed = f"{IN_TIME}, or more supports: {motion}"
        since = "loading.quasi_static"
        raise RefusedError("solver.integrator", integrator or "static", allowed, since)
