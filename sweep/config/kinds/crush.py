"""A crush: a platen moves down by `stroke`, rests for `hold_time`, and moves back up."""

from math import ceil, inf, isclose
from typing import Any, ClassVar, Literal

from sweep.config.kinds.body import Body
from sweep.config.kinds.directed import Ramp
from sweep.config.kinds.direction import is_along
from sweep.config.kinds.solver import IN_TIME, LOAD_STEPS, MAX_STEPS, InTime, Solver
from sweep.config.kinds.specimen import ENDLESS
from sweep.config.kinds.striker import WithStriker
from sweep.config.kinds.table import (
    STEADY,
    Cycles,
    Forces,
    Frequency,
    Inputs,
    Length,
    Pause,
    RefusedError,
    Speed,
    Strain,
    given_or,
    own_values,
)
from sweep.constants import FILTER_CLASS, SAMPLES

LONGEST = 1.0 / (SAMPLES * FILTER_CLASS)  # time step for this filter, s
ENOUGH = 1000  # steps that resolve the peak force of a slow stroke
NO_PAUSE = "hold_time", 0.0
STRAIN_RATE = 0.01  # 1/s, in a quasi-static crush of a material that relaxes
PLATENS = '"contact", "glued" or "sliding"'


class Crush(WithStriker):
    """A platen that moves down and back up if `unload`; the whole is done `cycles` times.

    strain: stroke / the height pressed. speed, strain_rate: None if the crush takes no time, as it
    is quasi-static and the stress of the material does not depend on time. hold_time: None without
    a pause. platen "none": an endless lattice under a mean strain; "clamped": the ends of walls
    stay upright, along the cells.
    """

    because: ClassVar[str] = 'loading.mode is "displacement"'
    neutral: ClassVar[dict[str, Any]] = WithStriker.neutral | {"cycles": 1, "hold_time": 0.0}
    needs: ClassVar[dict[str, str]] = WithStriker.needs | {
        "strain_rate": STEADY,
        "hold_time": STEADY,
    }
    words: ClassVar[tuple[str, ...]] = ("displacement",)
    driven: ClassVar[bool] = True
    sets: ClassVar[dict[str, tuple[str, ...]]] = {"strain": ("stroke",), "strain_rate": ("speed",)}

    mode: Literal["displacement"] = "displacement"
    stroke: Length
    strain: Strain = 0.6
    speed: Speed | None = None
    strain_rate: Frequency | None = None
    quasi_static: bool
    hold_time: Pause | None = None
    unload: bool = True
    cycles: Cycles = 1
    platen: Literal["none", "contact", "glued", "sliding", "clamped"] = "glued"
    allowed_forces: Forces = ()

    @classmethod
    def of(cls, inputs: Inputs, body: Body, integrator: str | None, relaxes: bool) -> "Crush":
        """The crush of these values; for an endless lattice, a mean strain."""
        inputs = {key: value for key, value in inputs.items() if (key, value) != NO_PAUSE}
        if body.endless:
            return _mean_crush(inputs, body, integrator, relaxes)
        if inputs.get("platen") == "none":
            allowed = f'{PLATENS} if loading.mode is "displacement"'
            raise RefusedError("loading.platen", "none", allowed)
        speed = _speed(inputs, body.height)
        quasi_static = _is_quasi_static(inputs, speed, integrator)
        stroke, strain = _stroke_and_strain(inputs, body.height)
        if inputs.get("cycles", 1) > 1 and not inputs.get("unload", True):
            raise RefusedError("loading.cycles", inputs["cycles"], "1 if loading.unload is false")
        motion = {"stroke": stroke, "strain": strain, "speed": speed, "quasi_static": quasi_static}
        if quasi_static:
            motion |= _pace(inputs, speed, body.height, relaxes)
        return cls.model_validate(own_values(inputs, cls) | motion)

    def ramps(self, solver: Solver) -> list[Ramp]:
        """Down, a pause, and back up; the pause takes as many steps as a motion of its time."""
        steps = solver.load_steps or 0
        ramps = [Ramp("loading", way=(0.0, 1.0), steps=steps)]
        if self.hold_time is not None:
            still = steps
            if isinstance(solver, InTime):
                still = steps_in(self.hold_time, solver.time_step)
            ramps.append(Ramp("holding", "hold", way=(1.0, 1.0), time=self.hold_time, steps=still))
        if self.unload:
            ramps.append(Ramp("unloading", "unloading", way=(1.0, 0.0), steps=steps))
        return ramps

    def loaded_for(self, height: float) -> float:
        """The time of a stroke down and back up, with the pause between, s."""
        return 2.0 * self.stroke / (self.speed or inf) + (self.hold_time or 0.0)

    def usual_motion(self, given: Inputs, body: Body, modulus: float) -> dict[str, Any]:
        """Steps of bdf2, which also impacts take."""
        return {"integrator": "bdf2"}

    def resolves_peaks(self, solver: Solver) -> bool:
        """Whether time steps are short enough for peak forces."""
        stroke = self.stroke / (self.speed or inf)
        longest = max(LONGEST, stroke / ENOUGH) * (1.0 + 1e-9)
        return not isinstance(solver, InTime) or solver.time_step <= longest

    @property
    def columns(self) -> dict[str, float]:
        """Its columns of a results file."""
        return {"stroke_m": self.stroke}


def steps_in(time: float, time_step: float | None) -> int:
    """Number of steps of at most ``time_step`` (s) in ``time`` (s); if no step is given 200, or up
    to `ENOUGH` if they are longer than `LONGEST`.
    """
    if time_step is None:
        return min(max(LOAD_STEPS, steps_in(time, LONGEST)), ENOUGH)
    return ceil(min(time / time_step * (1 - 1e-9), MAX_STEPS + 1.0))


def _mean_crush(inputs: Inputs, body: Body, integrator: str | None, relaxes: bool) -> Crush:
    """The crush of an endless lattice: a prescribed mean strain, quasi-static, without platens.

    The inertia of a mean motion depends on the point of reference, so that motion is refused.
    """
    if inputs.get("platen", "none") != "none":
        raise RefusedError("loading.platen", inputs["platen"], f'"none" {ENDLESS}')
    others = {key: value for key, value in inputs.items() if key != "platen"}
    crush = Crush.of(others, body._replace(endless=False), integrator, relaxes)
    if not crush.quasi_static:
        raise RefusedError("loading.quasi_static", False, f"true {ENDLESS}", "loading.speed")
    return crush.model_copy(update={"platen": "none"})


def _speed(inputs: Inputs, height: float) -> float | None:
    """The speed of a platen, from the strain rate if that is given."""
    if "strain_rate" not in inputs:
        return inputs.get("speed")
    speed: float = inputs["strain_rate"] * height
    if not isclose(inputs.get("speed", speed), speed, rel_tol=1e-9):
        raise RefusedError(
            "loading.strain_rate", inputs["strain_rate"], "one of speed and strain_rate"
        )
    return speed


def _is_quasi_static(inputs: Inputs, speed: float | None, integrator: str | None) -> bool:
    """Whether inertia is neglected: as given, else if there is no speed, or a strain rate."""
    rate = inputs.get("strain_rate")
    timed = speed is not None and rate is None
    quasi_static: bool = inputs.get("quasi_static", not timed or integrator == "static")
    if rate is not None and not quasi_static:
        raise RefusedError("loading.strain_rate", rate, "a speed, if quasi_static is false")
    if not quasi_static and integrator == "static":
        raise RefusedError("solver.integrator", "static", f"{IN_TIME} if not quasi_static")
    if not quasi_static and speed is None:
        raise RefusedError("loading.speed", None, "a speed if quasi_static is false")
    return quasi_static


def _pace(
    inputs: Inputs, speed: float | None, height: float, relaxes: bool
) -> dict[str, float | None]:
    """The pace of a quasi-static crush, which takes time only if the stress depends on it."""
    if not relaxes:
        return dict.fromkeys(("speed", "strain_rate", "hold_time"))
    pace = given_or(speed, STRAIN_RATE * height)
    return {"speed": pace, "strain_rate": inputs.get("strain_rate", pace / height)}


def _stroke_and_strain(inputs: Inputs, height: float) -> tuple[float, float]:
    """Stroke and strain, one from the other; 60 % strain if neither is given."""
    if "stroke" not in inputs:
        strain = inputs.get("strain", 0.6)
        return strain * height, strain
    stroke = inputs["stroke"]
    strain = inputs.get("strain", stroke / height)
    if stroke >= height:
        pressed = "depth" if is_along(inputs) else "height"
        allowed = f"below the {pressed} of the lattice, {height:g} m"
        raise RefusedError("loading.stroke", stroke, allowed)
    if not isclose(stroke, strain * height, rel_tol=1e-9):
        allowed = f"{strain * height:g} m at the strain given; give one of them"
        raise RefusedError("loading.stroke", stroke, allowed)
    return stroke, strain
