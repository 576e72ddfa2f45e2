"""The common part of all loadings: a direction, the base, and ramps of a load or a driven
motion.
"""

from abc import abstractmethod
from typing import Any, ClassVar, Literal, NamedTuple

from sweep.config.kinds.body import Body
from sweep.config.kinds.direction import ACROSS, ALONG, Direction
from sweep.config.kinds.solver import TIME_STEP, InTime, Solver
from sweep.config.kinds.table import Inputs, Length, Table

BASE_PATCH = 5e-3  # m
Role = Literal["loading", "hold", "unloading"]  # in the order of a cycle


class Ramp(NamedTuple):
    """A part of a loading, in which the load and the driven motion change evenly.

    name: in messages. role: in the measurements. load: factor of the load at both ends. way: share
    of the driven travel, at both ends. It takes a `time` (s), or `steps`, or both. watched: whether
    the run may end within it.
    """

    name: str
    role: Role = "loading"
    load: tuple[float, float] = (0.0, 0.0)
    way: tuple[float, float] = (0.0, 0.0)
    time: float | None = None
    steps: int | None = None
    watched: bool = False

    def steps_with(self, solver: Solver) -> float:
        """Number of steps."""
        if self.steps is None and self.time is not None and isinstance(solver, InTime):
            return self.time / solver.time_step
        return self.steps or 0


class Directed(Table):
    """A loading across the cells or along them.

    base_patch: width of the patch of the base over which its greatest pressure is taken.

    words: allowed values of `loading.mode`, the mode itself first. driven: whether a platen moves
    by a stroke. solid: whether joints of a lattice are solid by default.
    """

    words: ClassVar[tuple[str, ...]]
    driven: ClassVar[bool] = False
    solid: ClassVar[bool] = True
    neutral: ClassVar[dict[str, Any]] = {"direction": ACROSS, "base_patch": BASE_PATCH}

    direction: Direction = ACROSS
    base_patch: Length = BASE_PATCH

    @classmethod
    @abstractmethod
    def of(cls, inputs: Inputs, body: Body, integrator: str | None, relaxes: bool) -> "Directed":
        """The loading of these values; relaxes: whether stress depends on time."""

    @abstractmethod
    def ramps(self, solver: Solver) -> list[Ramp]:
        """The parts of one cycle."""

    def loaded_for(self, height: float) -> float:
        """About how long walls of a height (m) are loaded, s."""
        return float(self.value("duration"))

    def usual_motion(self, given: Inputs, body: Body, modulus: float) -> dict[str, Any]:
        """The integrator of a motion and its steps, where they are not ``given``; modulus: of the
        material, Pa.
        """
        return {"integrator": "backward_euler", "time_step": TIME_STEP}

    @property
    def approach(self) -> float | None:
        """Speed (m/s) with which walls are pressed together; None if it is not known."""
        speed: float | None = self.value("speed") or self.value("striker_speed")
        return speed

    @property
    def base_moves(self) -> bool:
        """Whether the base is a body that moves freely."""
        return self.value("target_mass") is not None

    @property
    def along(self) -> bool:
        """Whether the lattice is pressed along its cells."""
        return self.direction == ALONG
