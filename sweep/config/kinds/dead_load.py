"""A dead load: applied at once, removed at `release_time`; the run ends at `duration`."""

from typing import Any, ClassVar, Literal, Self

from sweep.config.kinds.body import Body
from sweep.config.kinds.directed import Ramp
from sweep.config.kinds.direction import ACROSS
from sweep.config.kinds.solver import IN_TIME, Solver
from sweep.config.kinds.striker import WithStriker
from sweep.config.kinds.table import Duration, Force, Forces, Inputs, RefusedError, own_values

DURATION, RELEASE = 0.2, 0.138  # s, as in the course report
STEP_ERROR = 1e-4  # of the height: a step lets the strain err by 0.01 %


class DeadLoad(WithStriker):
    """A dead load on the top nodes, in equal parts (platen "none"), or on a rigid plate."""

    because: ClassVar[str] = 'loading.mode is "force"'
    words: ClassVar[tuple[str, ...]] = ("force",)
    quasi_static: ClassVar[bool] = False
    cycles: ClassVar[int] = 1

    direction: Literal["in_plane"] = ACROSS
    mode: Literal["force"] = "force"
    force: Force = 10.0
    release_time: Duration
    duration: Duration = DURATION
    platen: Literal["none", "contact", "glued", "sliding"] = "none"
    allowed_forces: Forces = ()

    @classmethod
    def of(cls, inputs: Inputs, body: Body, integrator: str | None, relaxes: bool) -> Self:
        """The dead load of these values."""
        if integrator == "static":
            allowed = f'{IN_TIME} if loading.mode is "force"'
            raise RefusedError("solver.integrator", "static", allowed)
        duration = inputs.get("duration", DURATION)
        release_time = inputs.get("release_time", min(RELEASE, duration))
        if release_time > duration:
            allowed = f"up to the duration, {duration:g} s"
            raise RefusedError("loading.release_time", release_time, allowed)
        return cls.model_validate(own_values(inputs, cls) | {"release_time": release_time})

    def usual_motion(self, given: Inputs, body: Body, modulus: float) -> dict[str, Any]:
        """Steps of bdf2 by their error, unless the integrator or the time step is ``given``."""
        usual = super().usual_motion(given, body, modulus)
        if not {"integrator", "time_step"}.isdisjoint(given):
            return usual
        return usual | {"integrator": "bdf2", "step_error": STEP_ERROR * body.height}

    def ramps(self, solver: Solver) -> list[Ramp]:
        """The load until its release, and the time after it."""
        loaded = Ramp("loading", load=(1.0, 1.0), time=self.release_time)
        after = self.duration - self.release_time
        return [loaded, Ramp("released", "unloading", time=after)] if after > 0.0 else [loaded]

    @property
    def columns(self) -> dict[str, float]:
        """Its columns of a results file."""
        return {"force_N": self.force}
