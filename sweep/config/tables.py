"""The tables of a case: frozen models in SI whose attribute names are the TOML keys."""

import json
from functools import lru_cache
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

SIGNIFICANT = 12  # digits of a number that enter an id; unit conversions do not change them

Length = Annotated[float, Field(gt=0, json_schema_extra={"unit": "m"})]
Size = Annotated[float, Field(gt=0, le=1e3, json_schema_extra={"unit": "m"})]
Duration = Annotated[float, Field(gt=0, json_schema_extra={"unit": "s"})]
Lag = Annotated[float, Field(ge=0, json_schema_extra={"unit": "s"})]
Frequency = Annotated[float, Field(gt=0, json_schema_extra={"unit": "1/s"})]
Rate = Annotated[float, Field(ge=0, json_schema_extra={"unit": "1/s"})]
# The unit may be left out: 0.6 is 60 %.
Strain = Annotated[float, Field(gt=0, lt=1, json_schema_extra={"unit": "1", "bare": True})]
Speed = Annotated[float, Field(gt=0, json_schema_extra={"unit": "m/s"})]
Force = Annotated[float, Field(gt=0, json_schema_extra={"unit": "N"})]
Energy = Annotated[float, Field(gt=0, json_schema_extra={"unit": "J"})]
Stress = Annotated[float, Field(gt=0, json_schema_extra={"unit": "Pa"})]
Acceleration = Annotated[float, Field(gt=0, json_schema_extra={"unit": "m/s^2"})]
Mass = Annotated[float, Field(gt=0, json_schema_extra={"unit": "kg"})]
Density = Annotated[float, Field(gt=0, json_schema_extra={"unit": "kg/m^3"})]
Count = Annotated[int, Field(ge=1)]
Few = Annotated[int, Field(ge=1, le=1000)]  # a typo must not fill the memory
Cycles = Annotated[int, Field(ge=1, le=100)]
# JSON returns lists, so that lists are accepted too.
Forces = Annotated[tuple[Force, ...], Field(strict=False)]
# A million rows of history take 120 MB, and a million steps of one square cell half a minute.
MAX_STEPS = 1_000_000
NonNegative = Annotated[float, Field(ge=0)]


class Table(BaseModel):
    """One table of a config."""

    model_config = ConfigDict(frozen=True, strict=True, extra="forbid", allow_inf_nan=False)
    neutral: ClassVar[dict[str, Any]] = {}  # keys that enter an id only with other values
    labels: ClassVar[tuple[str, ...]] = ()  # keys that never enter an id


def refusal(key: str, value: object, allowed: str, since: str | None = None) -> PydanticCustomError:
    """The error of one key whose value contradicts the rest of its case.

    since: the key that implies the value, if the value itself is not given.
    """
    context = {"key": key, "value": value, "allowed": allowed, "since": since}
    return PydanticCustomError("refused", "{key} = {value}; allowed: {allowed}", context)


@lru_cache(maxsize=4096)
def canonical(table: Table) -> str:
    """A table as JSON, with sorted keys and rounded numbers, without unused keys."""
    used = {
        key: rounded(value)
        for key, value in table
        if value is not None and key not in table.labels and value != table.neutral.get(key)
    }
    return json.dumps(used, sort_keys=True, separators=(",", ":"))


def rounded(value: object) -> object:
    """A value as it enters an id."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(f"{value:.{SIGNIFICANT}g}")
    if isinstance(value, BaseModel):
        return {key: rounded(item) for key, item in value}
    return [rounded(item) for item in value] if isinstance(value, tuple) else value


# Keys that imply the mode.
MODES = {
    "force": ("force", "release_time"),
    "displacement": (
        *("stroke", "strain", "speed", "strain_rate"),
        *("quasi_static", "hold_time", "unload", "cycles"),
    ),
    "impact": (
        *("striker_mass", "striker_speed", "energy"),
        *("drop_height", "preset", "specimens", "filter_class"),
    ),
}


class Loading(Table):
    """The loading of the specimen. None: not given, or not used by the mode.

    If the mode is not given, keys that only one mode has imply it. The mode of a custom structure
    is "custom": the file of the structure has its loading. `cycles`: how often a platen moves down
    and back up. `hold_time`: of the pause of a platen at its full stroke, in each of them.

    direction: "in_plane" presses the height of the drawing, "out_of_plane" the `lattice.depth`,
    along the cells. platen "clamped", only with the latter, holds the ends of walls upright too.

    `drop_height` and `preset` (`drop_tests`) are other words for the speed and the mass of a
    striker, and `specimens` for the share of the mass of the preset that one of them bears.
    `filter_class`: of the filter behind which the deceleration of a striker is measured.
    """

    labels: ClassVar[tuple[str, ...]] = ("drop_height", "preset", "specimens")
    neutral: ClassVar[dict[str, Any]] = {
        "cycles": 1,
        "filter_class": 1000,
        "direction": "in_plane",
    }

    direction: Literal["in_plane", "out_of_plane"] = "in_plane"
    mode: Literal["force", "displacement", "impact", "custom"] = "force"
    force: Force | None = None
    release_time: Duration | None = None
    duration: Duration | None = None
    stroke: Length | None = None
    strain: Strain | None = None
    speed: Speed | None = None
    strain_rate: Frequency | None = None
    quasi_static: bool | None = None
    hold_time: Duration | None = None
    unload: bool | None = None
    cycles: Cycles | None = None
    striker_mass: Mass | None = None
    striker_speed: Speed | None = None
    energy: Energy | None = None
    drop_height: Length | None = None
    preset: str | None = None
    specimens: Count | None = None
    filter_class: Literal[60, 180, 600, 1000] | None = None
    platen: Literal["none", "contact", "glued", "sliding", "clamped"] | None = None
    allowed_forces: Forces = ()

    @model_validator(mode="before")
    @classmethod
    def _infer_mode(cls, given: Any) -> Any:
        if not isinstance(given, dict) or "mode" in given:
            return given
        implied = {
            mode: next(key for key in keys if given.get(key) is not None)
            for mode, keys in MODES.items()
            if any(given.get(key) is not None for key in keys)
        }
        if given.get("duration") is not None and "impact" not in implied:
            implied.setdefault("force", "duration")
        if len(implied) > 1:
            (one, key), (other, also) = list(implied.items())[:2]
            keys = f"as loading.{key} needs the one and loading.{also} the other"
            raise refusal("loading.mode", None, f'"{one}" or "{other}", {keys}')
        usual = "displacement" if given.get("direction") == "out_of_plane" else "force"
        return {"mode": next(iter(implied), usual), **given}

    @property
    def says_mode(self) -> str | None:
        """The first given key that implies the mode."""
        keys = (*MODES.get(self.mode, ()), "duration")
        return next((f"loading.{key}" for key in keys if getattr(self, key) is not None), None)


class Contact(Table):
    """Contact between walls and with platens; `stiffness` is the factor c of the barrier.

    auto: the barrier, which acts if walls come within one thickness of each other and costs little
    otherwise; the column `touched` says whether it acted. position_based: walls that are too close
    are moved apart after each step.
    """

    model: Literal["auto", "none", "barrier", "position_based"] = "auto"
    friction: NonNegative | None = 0.3
    stiffness: Annotated[float, Field(gt=0)] | None = 1.0
    slip_speed: Speed | None = None


class Damping(Table):
    """Rayleigh: `mass` alpha, `stiffness` beta. Kelvin-Voigt: viscosity = modulus x time. None:
    Rayleigh, or no damping if the material relaxes.
    """

    model: Literal["none", "rayleigh", "kelvin_voigt"] | None = None
    mass: Rate | None = 5.0
    stiffness: Lag | None = 1e-4
    relaxation_time: Lag | None = 1e-4


class Solver(Table):
    """How the equations are solved. None: chosen by the loading, or not used by it.

    newmark: the trapezoidal rule. `step_error`: error of a position allowed in a single step, which
    is a fraction of the time step where needed. None: steps are not divided for accuracy.
    """

    labels: ClassVar[tuple[str, ...]] = ("time_limit",)  # a new limit does not change results
    neutral: ClassVar[dict[str, Any]] = {"hessian": "exact"}

    integrator: Literal["backward_euler", "bdf2", "newmark", "static", "arc_length"] | None = None
    time_step: Duration | None = None
    step_error: Length | None = None
    load_steps: Count | None = None
    arc_length: Length | None = None
    tolerance: Annotated[float, Field(gt=0, lt=1)] = 1e-8
    max_iterations: Count = 100
    time_limit: Duration = 300.0
    element: Literal["cubic", "classical"] = "cubic"
    joints: Literal["solid", "points"] | None = None
    bend_measure: Literal["angle", "tangent"] = "angle"
    hessian: Literal["exact", "tangent_modulus"] = "exact"


class Rank(Table):
    """Defaults of a ranking: budgets of mass (kg), and the panel that specimens fill (m).

    per: what allowed forces and requirements are of. drop_heights: of cushion curves (m).
    """

    budgets: tuple[Mass, ...] = ()
    panel: tuple[Length, Length] | None = None
    drop_heights: tuple[Length, ...] = ()
    per: Literal["specimen", "panel"] = "specimen"


class Require(Table):
    """What a design must fulfil to have a place in a ranking; it enters no id."""

    max_force: Force | None = None
    max_deceleration: Acceleration | None = None
    max_mass: Mass | None = None
    min_absorbed: Energy | None = None
    max_stroke: Length | None = None


QUESTION: dict[str, type[Table]] = {"rank": Rank, "require": Require}
"""Tables of a config that ask something of the results."""
