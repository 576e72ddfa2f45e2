"""The tables of a case: frozen models in SI whose attribute names are the TOML keys."""

import json
from functools import lru_cache
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

from sweep.config.materials.material_file import (
    REFERENCE_TIME,
    Record,
    check_curve,
    locate,
    not_rising,
    read_record,
)

BY_NUMBERS = "by numbers"
SOFTENING_BETA = 0.1
FIBRE_COUNT = 7
FIBRES = '"section" or "fibres"'
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
Curve = Annotated[tuple[float, ...], Field(strict=False)]
Range = Annotated[tuple[str, float, float], Field(strict=False)]
Forces = Annotated[tuple[Force, ...], Field(strict=False)]
Durations = Annotated[tuple[Duration, ...], Field(strict=False)]
Shares = Annotated[tuple[Strain, ...], Field(strict=False)]
Loss = Annotated[float, Field(gt=0, le=0.8, json_schema_extra={"unit": "1", "bare": True})]
# A million rows of history take 120 MB, and a million steps of one square cell half a minute.
MAX_STEPS = 1_000_000
# Without a unit at most 1: a greater number is likely a percentage.
Stretched = Annotated[
    float, Field(gt=0, json_schema_extra={"unit": "1", "bare": True, "bare_most": 1})
]
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


SECTIONS = ("section", "fibres")  # `Material.bend` that integrates a law over the thickness


def by_curve(stretch: str, bend: str) -> str | None:
    """The key of a material that goes by the curve of its record, if any.

    Sections follow the law of stretching, or the curve where that law is linear.
    """
    if stretch == "nonlinear":
        return "stretch"
    return "bend" if stretch == "linear" and bend in SECTIONS else None


class Material(Table):
    """A material: a named record, whose numbers may be overridden, or numbers without a record.

    It relaxes if it has a `loss`, the share of the work that is lost in a cycle of loading and
    unloading, or branches: shares of the instantaneous stress, each with the time in which it
    relaxes. The curve, or the modulus, then holds at `reference_time` after loading. It softens on
    reuse if it has the numbers r, m (J/m^3) and beta of Ogden and Roxburgh. It yields, instead of
    following a curve, if it has a `yield_stress`; `hardening` is its slope beyond that over plastic
    strain. A fibre that is stretched beyond `fracture_strain` counts as broken.

    memory "measured": loss and softening are those that the record states, unless they are given.

    `bend` "fibres" is "section" with `fibres` points through the thickness in place of three.

    `curve_strain`, `curve_stress` (k,) in Pa hold the record itself, so that a case needs no file.
    They are empty if neither stretching nor bending uses the curve. `uncertain`: key, low and high
    end of each number that is the record's and has a range there.
    """

    labels: ClassVar[tuple[str, ...]] = ("memory", "uncertain")
    neutral: ClassVar[dict[str, Any]] = {"relaxation_times": (), "relaxation_shares": ()}
    not_along: ClassVar[tuple[str, ...]] = (
        "softening_r",
        "yield_stress",
    )  # refused along the cells

    name: str = "ninjaflex"
    stretch: Literal["nonlinear", "linear"] = "nonlinear"
    bend: Literal["linear", "section", "fibres", "none"] = "section"
    fibres: Annotated[int, Field(ge=4, le=15)] | None = None
    plane: Literal["strain", "stress", "strain_bending"] = "strain"
    # Filled in from the record before validation, which refuses the zeros if they remain.
    modulus: Stress = Field(default=0.0, validate_default=True)
    density: Density = Field(default=0.0, validate_default=True)
    poisson: Annotated[float, Field(ge=0, lt=0.5)] = 0.48
    loss: Loss | None = None
    relaxation_times: Durations = ()
    relaxation_shares: Shares = ()
    reference_time: Duration | None = None
    memory: Literal["none", "measured"] = "none"
    softening_r: Annotated[float, Field(gt=1)] | None = None
    softening_m: Stress | None = None
    softening_beta: NonNegative | None = None
    yield_stress: Stress | None = None
    hardening: Annotated[float, Field(ge=0, json_schema_extra={"unit": "Pa"})] | None = None
    fracture_strain: Stretched | None = None
    curve_strain: Curve = ()
    curve_stress: Curve = ()
    uncertain: Annotated[tuple[Range, ...], Field(strict=False)] = ()

    @property
    def relaxes(self) -> bool:
        """Whether the stress depends on time."""
        return self.loss is not None or bool(self.relaxation_times)

    @property
    def remembers(self) -> bool:
        """Whether the stress depends on the past."""
        return self.relaxes or self.softening_r is not None or self.yields

    @property
    def inelasticity(self) -> str:
        """What the walls do that springs do not: "relaxes, softens" and the like, or "none"."""
        softens = self.softening_r is not None
        words = {"relaxes": self.relaxes, "softens": softens, "yields": self.yields}
        return ", ".join(word for word, true in words.items() if true) or "none"

    @property
    def yields(self) -> bool:
        """Whether it deforms plastically."""
        return self.yield_stress is not None

    @property
    def through_fibres(self) -> bool:
        """Whether bending goes by fibres through the thickness."""
        return self.bend in SECTIONS

    @model_validator(mode="before")
    @classmethod
    def _fill_in(cls, given: Any) -> Any:
        if not isinstance(given, dict) or "curve_strain" in given:
            return given
        by_numbers = "modulus" in given and "name" not in given
        record = None if by_numbers else read_record(locate(given.get("name", "ninjaflex")))
        asked, given = given, _with_memory(given, record)
        if record is not None:
            plastic = record.plasticity.items()
            given = given | {key: value for key, value in plastic if given.get(key) is None}
        relaxes = given.get("loss") is not None or given.get("relaxation_times")
        if not relaxes:
            given = {**given, "reference_time": None}
        if given.get("softening_r") is None:
            given = {**given, "softening_m": None, "softening_beta": None}
        else:
            given = {"softening_beta": SOFTENING_BETA, **given}
        given = _with_plasticity(given)
        if record is None:
            if "density" not in given:
                raise refusal("material.density", None, "a density, as no name is given")
            usual = {"reference_time": REFERENCE_TIME} if relaxes else {}
            given = {"name": BY_NUMBERS, "stretch": "linear", **usual, **given}
        if given.get("stretch", "nonlinear") == "linear":
            given = {"bend": "linear", **given}
        if record is None:
            return given
        numbers = ("modulus", "density", "poisson", *(["reference_time"] if relaxes else []))
        known = {key: getattr(record, key) for key in numbers}
        laws = [given.get(key, cls.model_fields[key].default) for key in ("stretch", "bend")]
        if given["hardening"] is None and by_curve(*laws):
            known |= {"curve_strain": record.strain, "curve_stress": record.stress}
        uncertain = _uncertain(record, asked, {**known, **given})
        return {**known, **given, "name": record.name, "uncertain": uncertain}

    @model_validator(mode="after")
    def _relaxes_in_part(self) -> Self:
        times, shares = self.relaxation_times, self.relaxation_shares
        if len(times) != len(shares):
            raise refusal("material.relaxation_times", list(times), "a time for each share")
        if times and self.loss is not None:
            raise refusal("material.loss", self.loss, "one of loss and relaxation")
        if sum(shares) >= 1.0:
            raise refusal("material.relaxation_shares", list(shares), "shares whose sum is below 1")
        return self

    @model_validator(mode="after")
    def _softens_through_its_sections(self) -> Self:
        if self.softening_r is None:
            return self
        if self.softening_m is None:
            raise refusal("material.softening_m", None, "a stress, as softening_r is given")
        if not self.through_fibres:
            raise refusal("material.bend", self.bend, f"{FIBRES} if softening_r is given")
        return self

    @model_validator(mode="after")
    def _has_its_curve(self) -> Self:
        used = by_curve(self.stretch, self.bend)
        if self.yields:
            self._check_plasticity()
        elif used:
            if not self.curve_strain:
                allowed = '"linear", as no curve is given'
                raise refusal(f"material.{used}", getattr(self, used), allowed)
            check_curve(self.curve_strain, self.curve_stress)
            self._check_that_it_rises()
        elif self.curve_strain:
            raise refusal("material.curve_strain", self.curve_strain, "no curve if linear")
        return self

    def _check_that_it_rises(self) -> None:
        """Refuse a material that relaxes if its stress does not rise with strain."""
        at = not_rising(self.curve_strain, self.curve_stress) if self.relaxes else None
        if at is not None:
            key = "relaxation_times" if self.loss is None else "loss"
            value = list(self.relaxation_times) if self.loss is None else self.loss
            falls = f"the stress of {self.name} does not rise from a strain of {at:g} on"
            raise refusal(f"material.{key}", value, f"none, as {falls}")

    def _check_plasticity(self) -> None:
        """Refuse a plastic material with other laws beside."""
        if self.stretch != "linear":
            raise refusal("material.stretch", self.stretch, '"linear" if yield_stress is given')
        if not self.through_fibres:
            raise refusal("material.bend", self.bend, f"{FIBRES} if yield_stress is given")
        if self.relaxes or self.softening_r is not None:
            other = (
                "loss" if self.loss is not None else "relaxation" if self.relaxes else "softening_r"
            )
            raise refusal("material.yield_stress", self.yield_stress, f"none if {other} is given")


def _with_memory(given: dict[str, Any], record: Record | None) -> dict[str, Any]:
    """The given keys with the loss and softening of the record, where they are asked for."""
    if given.get("memory") != "measured":
        return given
    if record is None:
        raise refusal("material.memory", "measured", '"none", as no name is given')
    if not record.memory:
        allowed = f'"none", as {record.name} states neither loss nor softening'
        raise refusal("material.memory", "measured", allowed)
    stated = dict(record.memory)
    if given.get("relaxation_times"):
        stated.pop("loss", None)
    return {**stated, **given}


def _uncertain(
    record: Record, asked: dict[str, Any], known: dict[str, Any]
) -> tuple[tuple[str, float, float], ...]:
    """The ranges of the record's numbers that a material uses, without those that it is given."""
    used = [key for key in record.ranges if asked.get(key) is None]
    used = [key for key in used if known.get(key) is not None or key == "friction"]
    return tuple((key, *record.ranges[key]) for key in used)


def _with_plasticity(given: dict[str, Any]) -> dict[str, Any]:
    """The given keys with the defaults of fibres and of a material that yields."""
    if given.get("yield_stress") is not None:
        given = {"stretch": "linear", "bend": "fibres", "hardening": 0.0, **given}
    else:
        given = {**given, "hardening": None, "fracture_strain": None}
    if given.get("bend") == "fibres":
        return {"fibres": FIBRE_COUNT, **given}
    return {**given, "fibres": None}


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
