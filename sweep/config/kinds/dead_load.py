"""A dead load: applied at once, removed at `release_time`; the run ends at `duration`."""

from typing import ClassVar, Literal

from sweep.config.kinds.direction import ACROSS
from sweep.config.kinds.solver import IN_TIME
from sweep.config.kinds.striker import Struck
from sweep.config.kinds.table import Duration, Force, Forces, Given, RefusedError, chosen


class DeadLoad(Struck):
    """A dead load on the top nodes, in equal parts (platen "none"), or on a rigid plate."""

    because: ClassVar[str] = 'loading.mode is "force"'
    quasi_static: ClassVar[bool] = False
    cycles: ClassVar[int] = 1

    direction: Literal["in_plane"] = ACROSS
    mode: Literal["force"] = "force"
    force: Force = 10.0
    release_time: Duration
    duration: Duration = 0.2
    platen: Literal["none", "contact", "glued", "sliding"] = "none"
    allowed_forces: Forces = ()

    @property
    def columns(self) -> dict[str, float]:
        """Its columns of a results file."""
        return {"force_N": self.force}


def dead_load(given: Given, integrator: str | None) -> DeadLoad:
    """The dead load of these values."""
    if integrator == "static":
        raise RefusedError("solver.integrator", "static", f'{IN_TIME} if loading.mode is "force"')
    duration = given.get("duration", 0.2)
    release_time = given.get("release_time", min(0.138, duration))
    if release_time > duration:
        allowed = f"up to the duration, {duration:g} s"
        raise RefusedError("loading.release_time", release_time, allowed)
    return DeadLoad.model_validate(chosen(given, DeadLoad) | {"release_time": release_time})
