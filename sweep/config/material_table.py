"""The table `material`: a named record or numbers, and what follows from them."""

from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from sweep.config.materials.material_file import (
    REFERENCE_TIME,
    Record,
    check_curve,
    locate,
    not_rising,
    read_record,
)
from sweep.config.tables import Density, Duration, NonNegative, Strain, Stress, Table, refusal

BY_NUMBERS = "by numbers"
SOFTENING_BETA = 0.1
FIBRE_COUNT = 7
FIBRES = '"section" or "fibres"'
# JSON returns lists, so that lists are accepted too.
Curve = Annotated[tuple[float, ...], Field(strict=False)]
Range = Annotated[tuple[str, float, float], Field(strict=False)]
Durations = Annotated[tuple[Duration, ...], Field(strict=False)]
Shares = Annotated[tuple[Strain, ...], Field(strict=False)]
Loss = Annotated[float, Field(gt=0, le=0.8, json_schema_extra={"unit": "1", "bare": True})]
# Without a unit at most 1: a greater number is likely a percentage.
Stretched = Annotated[
    float, Field(gt=0, json_schema_extra={"unit": "1", "bare": True, "bare_most": 1})
]
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
    not_along: ClassVar[tuple[str, ...]] = ("softening_r", "yield_stress")  # refused along cells

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
