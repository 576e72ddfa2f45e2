"""The tables of a case: frozen models whose attribute names are the TOML keys, SI inside."""

import json
from functools import lru_cache
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

from sweep.config.material_file import check_curve, locate, read_record

BY_NUMBERS = "by numbers"
SIGNIFICANT = 12  # digits of a number that count in an id: a unit conversion leaves them alone

Length = Annotated[float, Field(gt=0, json_schema_extra={"unit": "m"})]
Size = Annotated[float, Field(gt=0, le=1e3, json_schema_extra={"unit": "m"})]
Duration = Annotated[float, Field(gt=0, json_schema_extra={"unit": "s"})]
Lag = Annotated[float, Field(ge=0, json_schema_extra={"unit": "s"})]
Rate = Annotated[float, Field(ge=0, json_schema_extra={"unit": "1/s"})]
# Also without its unit: 0.6 is 60 %.
Strain = Annotated[float, Field(gt=0, lt=1, json_schema_extra={"unit": "1", "bare": True})]
Speed = Annotated[float, Field(gt=0, json_schema_extra={"unit": "m/s"})]
Force = Annotated[float, Field(gt=0, json_schema_extra={"unit": "N"})]
Energy = Annotated[float, Field(gt=0, json_schema_extra={"unit": "J"})]
Stress = Annotated[float, Field(gt=0, json_schema_extra={"unit": "Pa"})]
Mass = Annotated[float, Field(gt=0, json_schema_extra={"unit": "kg"})]
Density = Annotated[float, Field(gt=0, json_schema_extra={"unit": "kg/m^3"})]
Count = Annotated[int, Field(ge=1)]
Few = Annotated[int, Field(ge=1, le=1000)]  # a slip of the keyboard must not fill the memory
# Lists too, as JSON gives them back.
Curve = Annotated[tuple[float, ...], Field(strict=False)]
Forces = Annotated[tuple[Force, ...], Field(strict=False)]
# A million rows take 120 MB while a case runs, and one square cell half a minute.
MAX_STEPS = 1_000_000
NonNegative = Annotated[float, Field(ge=0)]


class Table(BaseModel):
    """One table of a config."""

    model_config = ConfigDict(frozen=True, strict=True, extra="forbid", allow_inf_nan=False)
    neutral: ClassVar[dict[str, Any]] = {}  # keys that count in an id only if they differ
    labels: ClassVar[tuple[str, ...]] = ()  # keys that never do


def refusal(key: str, value: object, allowed: str, since: str | None = None) -> PydanticCustomError:
    """The error of one key whose value does not go with the rest of its case.

    since : the key that implies the value, where it need not be given itself.
    """
    context = {"key": key, "value": value, "allowed": allowed, "since": since}
    return PydanticCustomError("refused", "{key} = {value}; allowed: {allowed}", context)


@lru_cache(maxsize=4096)
def canonical(table: Table) -> str:
    """A table as JSON: sorted keys, rounded numbers, only the keys in use."""
    used = {
        key: rounded(value)
        for key, value in table
        if value is not None and key not in table.labels and value != table.neutral.get(key)
    }
    return json.dumps(used, sort_keys=True, separators=(",", ":"))


def rounded(value: object) -> object:
    """A value as it counts in an id."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(f"{value:.{SIGNIFICANT}g}")
    if isinstance(value, BaseModel):
        return {key: rounded(item) for key, item in value}
    return [rounded(item) for item in value] if isinstance(value, tuple) else value


BY_CURVE = {"stretch": ("nonlinear",), "bend": ("section",)}
"""Laws that go by the record's curve, by their keys."""


class Material(Table):
    """A material: a record by its name, whose numbers may be overridden, or numbers alone.

    `curve_strain`, `curve_stress` (k,) in Pa hold the record itself, so that a case needs no file;
    empty if neither stretching nor bending goes by it.
    """

    name: str = "ninjaflex"
    stretch: Literal["nonlinear", "linear"] = "nonlinear"
    bend: Literal["linear", "section", "none"] = "linear"
    plane: Literal["strain", "stress", "strain_bending"] = "strain"
    # Filled in before validation, from the record; the zeros are refused if they are not.
    modulus: Stress = Field(default=0.0, validate_default=True)
    density: Density = Field(default=0.0, validate_default=True)
    poisson: Annotated[float, Field(ge=0, lt=0.5)] = 0.48
    curve_strain: Curve = ()
    curve_stress: Curve = ()

    @model_validator(mode="before")
    @classmethod
    def _fill_in(cls, given: Any) -> Any:
        if not isinstance(given, dict) or "curve_strain" in given:
            return given
        if "modulus" in given and "name" not in given:
            if "density" not in given:
                raise refusal("material.density", None, "a density, as no name is given")
            return {"name": BY_NUMBERS, "stretch": "linear", **given}
        record = read_record(locate(given.get("name", "ninjaflex")))
        known = {key: getattr(record, key) for key in ("modulus", "density", "poisson")}
        if any(given.get(key, cls.model_fields[key].default) in BY_CURVE[key] for key in BY_CURVE):
            known |= {"curve_strain": record.strain, "curve_stress": record.stress}
        return {**known, **given, "name": record.name}

    @model_validator(mode="after")
    def _has_its_curve(self) -> Self:
        chosen = [(key, getattr(self, key)) for key in BY_CURVE]
        used = [(key, word) for key, word in chosen if word in BY_CURVE[key]]
        if used:
            if not self.curve_strain:
                key, word = used[0]
                raise refusal(f"material.{key}", word, '"linear", as no curve is given')
            check_curve(self.curve_strain, self.curve_stress)
        elif self.curve_strain:
            raise refusal("material.curve_strain", self.curve_strain, "no curve if linear")
        return self


# Keys that say the mode.
MODES = {
    "force": ("force", "release_time"),
    "displacement": ("stroke", "strain", "speed", "quasi_static", "unload"),
    "impact": ("striker_mass", "striker_speed", "energy"),
}


class Loading(Table):
    """What is done to the specimen. None: not given, or not used by the mode.

    Without a mode, the keys of one mode say which it is. A custom structure has its own, "custom":
    its file says what is done to it.
    """

    mode: Literal["force", "displacement", "impact", "custom"] = "force"
    force: Force | None = None
    release_time: Duration | None = None
    duration: Duration | None = None
    stroke: Length | None = None
    strain: Strain | None = None
    speed: Speed | None = None
    quasi_static: bool | None = None
    unload: bool | None = None
    striker_mass: Mass | None = None
    striker_speed: Speed | None = None
    energy: Energy | None = None
    platen: Literal["none", "contact", "glued", "sliding"] | None = None
    allowed_forces: Forces = ()

    @model_validator(mode="before")
    @classmethod
    def _infer_mode(cls, given: Any) -> Any:
        if not isinstance(given, dict) or "mode" in given:
            return given
        said = {
            mode: next(key for key in keys if given.get(key) is not None)
            for mode, keys in MODES.items()
            if any(given.get(key) is not None for key in keys)
        }
        if given.get("duration") is not None and "impact" not in said:
            said.setdefault("force", "duration")
        if len(said) > 1:
            (one, key), (other, also) = list(said.items())[:2]
            keys = f"as loading.{key} needs the one and loading.{also} the other"
            raise refusal("loading.mode", None, f'"{one}" or "{other}", {keys}')
        return {"mode": next(iter(said), "force"), **given}

    @property
    def says_mode(self) -> str | None:
        """The first key that is given and implies the mode."""
        keys = (*MODES.get(self.mode, ()), "duration")
        return next((f"loading.{key}" for key in keys if getattr(self, key) is not None), None)


class Contact(Table):
    """Wall against wall and wall against platen; `stiffness` is the factor c of the barrier.

    auto: the barrier, which acts where walls come within a thickness of one another and costs next
    to nothing elsewhere; `touched` tells whether it did. position_based: what is too near is moved
    apart after each step.
    """

    model: Literal["auto", "none", "barrier", "position_based"] = "auto"
    friction: NonNegative | None = 0.3
    stiffness: Annotated[float, Field(gt=0)] | None = 1.0
    slip_speed: Speed | None = None


class Damping(Table):
    """Rayleigh: `mass` alpha, `stiffness` beta. Kelvin-Voigt: viscosity = modulus x time."""

    model: Literal["none", "rayleigh", "kelvin_voigt"] = "rayleigh"
    mass: Rate | None = 5.0
    stiffness: Lag | None = 1e-4
    relaxation_time: Lag | None = 1e-4


class Solver(Table):
    """How the equations are solved. None: chosen by the loading, or not used by it.

    newmark: the trapezoidal rule. `step_error`: of a position, that a step may make by itself; the
    steps then are shares of the time step. None: all are whole.
    """

    labels: ClassVar[tuple[str, ...]] = ("time_limit",)  # raising it makes nothing run again
    neutral: ClassVar[dict[str, Any]] = {"hessian": "exact"}

    integrator: Literal["backward_euler", "bdf2", "newmark", "static", "arc_length"] | None = None
    time_step: Duration | None = None
    step_error: Length | None = None
    load_steps: Count | None = None
    arc_length: Length | None = None
    tolerance: Annotated[float, Field(gt=0, lt=1)] = 1e-8
    max_iterations: Count = 100
    time_limit: Duration = 300.0
    hinges: Literal["exact_beam", "classical"] = "exact_beam"
    bend_measure: Literal["angle", "tangent"] = "angle"
    hessian: Literal["exact", "tangent_modulus"] = "exact"


class Rank(Table):
    """What a ranking is asked for: greatest masses (kg), and the panel that the specimens fill."""

    budgets: tuple[Mass, ...] = ()
    panel: tuple[Length, Length] | None = None
