"""The material: a named record or numbers, and values that follow from them."""

from typing import Annotated, Any, ClassVar, Literal

from pydantic import AfterValidator, Field

from sweep.config.kinds.table import (
    COMPUTED,
    STEADY,
    Density,
    Duration,
    Inputs,
    NonNegative,
    RefusedError,
    Strain,
    Stress,
    Table,
)
from sweep.config.materials.material_file import (
    REFERENCE_TIME,
    Record,
    check_curve,
    locate,
    not_rising,
    read_record,
)

BY_NUMBERS = "by numbers"
NUMBERS = ("modulus", "density", "poisson", "reference_time")  # that every record has
SOFTENING_BETA = 0.1
FIBRE_COUNT = 7
FIBRES = '"section" or "fibres"'
RULES = {"compression": (0.0, 1.0), "tension": (1.0, 0.0)}  # see `Material.uncertain`
# JSON returns lists, so that lists are accepted too.
Curve = Annotated[tuple[float, ...], Field(strict=False)]
Range = Annotated[tuple[str, float, float], Field(strict=False)]
Durations = Annotated[tuple[Duration, ...], Field(strict=False)]
Shares = Annotated[tuple[Strain, ...], Field(strict=False)]
Loss = Annotated[float, Field(ge=0, le=0.8, json_schema_extra={"unit": "1", "bare": True})]
# Without a unit at most 1: a greater number is likely a percentage.
Stretched = Annotated[
    float, Field(gt=0, json_schema_extra={"unit": "1", "bare": True, "bare_most": 1})
]
IDLE_ALONG = ("plane", "poisson")  # keys that have their defaults in plates
SECTIONS = ("section", "fibres")  # `Material.bend` that integrates a law over the thickness


def by_curve(stretch: str, bend: str) -> str | None:
    """The key of a material that uses the curve of its record, if any.

    Sections follow the law of stretching, or the curve if that law is linear.
    """
    if stretch == "nonlinear":
        return "stretch"
    return "bend" if stretch == "linear" and bend in SECTIONS else None


class Material(Table):
    """A material: a named record, whose numbers may be overridden, or numbers without a record.

    It relaxes if it has a `loss`, the share of the work that is lost in a cycle of loading and
    unloading, or branches: shares of the instantaneous stress, each with the time in which it
    relaxes. The curve, or the modulus, is then valid at `reference_time` after loading. It softens
    on reloading if it has the numbers r, m (J/m^3) and beta of Ogden and Roxburgh. It yields,
    instead of following a curve, if it has a `yield_stress`; `hardening` is its slope beyond the
    yield stress over plastic strain. A fibre that is stretched beyond `fracture_strain` counts as
    broken.

    memory "measured": loss and softening are taken from the record, unless they are given.

    `bend` "fibres" is "section" with `fibres` points through the thickness instead of five.

    `curve_strain`, `curve_stress` (k,) in Pa hold the record itself, so that a case needs no file.
    They are empty if neither stretching nor bending uses the curve. `uncertain`: key, low and high
    end of each number that is the record's and has a range there; and "compression" or "tension",
    if the record does not measure it, with the shares of the rule of Cauchy stress
    (`sweep.scene.material`) that make it soft and stiff.
    """

    table: ClassVar[str] = "material"
    labels: ClassVar[tuple[str, ...]] = ("memory", "uncertain")
    neutral: ClassVar[dict[str, Any]] = {"relaxation_times": (), "relaxation_shares": ()}
    needs: ClassVar[dict[str, str]] = {
        "reference_time": STEADY,
        "hardening": "material.yield_stress is not given",
        "fracture_strain": "material.yield_stress is not given",
        "softening_m": "material.softening_r is not given",
        "softening_beta": "material.softening_r is not given",
    }
    not_along: ClassVar[tuple[str, ...]] = ("softening_r", "yield_stress")  # refused along cells

    name: str = "ninjaflex"
    stretch: Literal["nonlinear", "linear"] = "nonlinear"
    bend: Literal["linear", "section", "fibres", "none"] = "section"
    fibres: Annotated[int, Field(ge=3, le=15)] | None = None
    plane: Literal["strain", "stress", "strain_bending"] = "strain"
    modulus: Stress
    density: Density
    poisson: Annotated[float, Field(ge=0, lt=0.5)] = 0.48
    loss: Annotated[Loss | None, AfterValidator(lambda loss: loss or None)] = None  # 0: none
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
    curve_strain: Annotated[Curve, COMPUTED] = ()
    curve_stress: Annotated[Curve, COMPUTED] = ()
    uncertain: Annotated[tuple[Range, ...], Field(strict=False), COMPUTED] = ()

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
        """Inelastic behaviour of the walls in words: "relaxes, softens" and the like, or "none"."""
        softens = self.softening_r is not None
        words = {"relaxes": self.relaxes, "softens": softens, "yields": self.yields}
        return ", ".join(word for word, true in words.items() if true) or "none"

    @property
    def yields(self) -> bool:
        """Whether it deforms plastically."""
        return self.yield_stress is not None

    @property
    def through_fibres(self) -> bool:
        """Whether bending is integrated over fibres through the thickness."""
        return self.bend in SECTIONS


def material(inputs: Inputs, where: str = "") -> Material:
    """The material of these values; where: why its walls are plates, in words, if they are.

    Raises `RecordError` if the file of a named material cannot be read.
    """
    complete = "curve_strain" in inputs
    material = Material.model_validate(_with_constants(inputs) if complete else _completed(inputs))
    _check_relaxation(material)
    _check_softening(material)
    _check_law(material)
    return _of_plates(material, where) if where else material


def relaxes(inputs: Inputs) -> bool:
    """Whether these values of a material make its stress depend on time."""
    return bool(inputs.get("loss") or inputs.get("relaxation_times"))


def _with_constants(inputs: Inputs) -> dict[str, Any]:
    """The values of a complete material, to which a change may have added a memory."""
    usual: dict[str, Any] = {"softening_beta": SOFTENING_BETA} if "softening_r" in inputs else {}
    if relaxes(inputs) and "reference_time" not in inputs:
        by_numbers = inputs["name"] == BY_NUMBERS
        record = None if by_numbers else read_record(locate(inputs["name"]))
        usual["reference_time"] = record.reference_time if record else REFERENCE_TIME
    return {**usual, **inputs}


def _completed(own: Inputs) -> dict[str, Any]:
    """The values, completed by the record if there is one, which else are linear, and by the
    defaults that follow from both; without keys that have no effect.
    """
    by_numbers = "modulus" in own and "name" not in own
    record = None if by_numbers else read_record(locate(own.get("name", "ninjaflex")))
    inputs = _with_memory(dict(own), record)
    usual: dict[str, Any] = {"softening_beta": SOFTENING_BETA, "hardening": 0.0}
    usual["fibres"] = FIBRE_COUNT
    if record is not None:
        inputs = dict(record.plasticity) | inputs
        usual |= {key: getattr(record, key) for key in NUMBERS}
    elif "density" in inputs:
        usual |= {"name": BY_NUMBERS, "stretch": "linear", "reference_time": REFERENCE_TIME}
    else:
        raise RefusedError("material.density", None, "a density, as no name is given")
    softens, yields = "softening_r" in inputs, "yield_stress" in inputs
    if yields:
        usual |= {"stretch": "linear", "bend": "fibres"}
    elif (usual | inputs).get("stretch") == "linear":
        usual |= {"bend": "linear"}
    values = usual | inputs
    used = {"reference_time": relaxes(values), "fibres": values.get("bend") == "fibres"}
    used |= dict.fromkeys(("softening_m", "softening_beta"), softens)
    used |= dict.fromkeys(("hardening", "fracture_strain"), yields)
    values = {key: value for key, value in values.items() if used.get(key, True)}
    if record is None:
        return values
    laws = [values.get(key, Material.model_fields[key].default) for key in ("stretch", "bend")]
    if by_curve(*laws) and not yields:
        values |= {"curve_strain": record.strain, "curve_stress": record.stress}
    return values | {"name": record.name, "uncertain": _uncertain(record, own, values)}


def _check_relaxation(material: Material) -> None:
    times, shares = material.relaxation_times, material.relaxation_shares
    if len(times) != len(shares):
        raise material.refusal("relaxation_times", "a time for each share")
    if times and material.loss is not None:
        raise material.refusal("loss", "one of loss and relaxation")
    if sum(shares) >= 1.0:
        raise material.refusal("relaxation_shares", "shares whose sum is below 1")


def _check_softening(material: Material) -> None:
    if material.softening_r is None:
        return
    if material.softening_m is None:
        raise RefusedError("material.softening_m", None, "a stress, as softening_r is given")
    if not material.through_fibres:
        raise material.refusal("bend", f"{FIBRES} if softening_r is given")


def _check_law(material: Material) -> None:
    """Refuse a law of stretching or bending without its curve, or together with another law."""
    used = by_curve(material.stretch, material.bend)
    if material.yields:
        _check_plasticity(material)
    elif used and not material.curve_strain:
        raise material.refusal(used, '"linear", as no curve is given')
    elif used:
        check_curve(material.curve_strain, material.curve_stress)
        _check_that_it_rises(material)


def _check_that_it_rises(material: Material) -> None:
    """Refuse a material that relaxes if its stress does not rise with strain."""
    at = not_rising(material.curve_strain, material.curve_stress) if material.relaxes else None
    if at is not None:
        key = "relaxation_times" if material.loss is None else "loss"
        falls = f"the stress of {material.name} does not rise from a strain of {at:g} on"
        raise material.refusal(key, f"none, as {falls}")


def _check_plasticity(material: Material) -> None:
    """Refuse a plastic material with other laws."""
    if material.stretch != "linear":
        raise material.refusal("stretch", '"linear" if yield_stress is given')
    if not material.through_fibres:
        raise material.refusal("bend", f"{FIBRES} if yield_stress is given")
    if material.relaxes or material.softening_r is not None:
        other = "relaxation" if material.relaxes else "softening_r"
        other = "loss" if material.loss is not None else other
        raise material.refusal("yield_stress", f"none if {other} is given")


def _of_plates(material: Material, where: str) -> Material:
    """The material of walls that are plates: incompressible sheets in plane stress, whose layers
    all follow one law, elastic or relaxing.
    """
    for key in material.not_along:
        if getattr(material, key):
            raise material.refusal(key, f"none {where}: its walls are elastic or relax")
    if material.bend == "fibres":
        raise material.refusal("bend", f'"section" or "linear" {where}')
    fit = "linear" if material.stretch == "linear" else "section"
    if material.bend != fit:
        why = f'{where} and material.stretch is "{material.stretch}"'
        raise material.refusal("bend", f'"{fit}" {why}')
    usual = {key: Material.model_fields[key].default for key in IDLE_ALONG}
    return material.model_copy(update=usual)


def _with_memory(inputs: dict[str, Any], record: Record | None) -> dict[str, Any]:
    """The given keys with the loss and softening of the record, if they are requested."""
    if inputs.get("memory") != "measured":
        return inputs
    if record is None:
        raise RefusedError("material.memory", "measured", '"none", as no name is given')
    if not record.memory:
        allowed = f'"none", as {record.name} states neither loss nor softening'
        raise RefusedError("material.memory", "measured", allowed)
    stated = dict(record.memory)
    if inputs.get("relaxation_times"):
        stated.pop("loss", None)
    return {**stated, **inputs}


def _uncertain(
    record: Record, own: Inputs, values: dict[str, Any]
) -> tuple[tuple[str, float, float], ...]:
    """The ranges of the record's numbers that a material uses, except numbers that are given, and
    of the branch of its curve that is not measured.
    """
    used = [key for key in record.ranges if key not in own]
    used = [key for key in used if values.get(key) is not None or key == "friction"]
    ranges = dict(record.ranges)
    if record.derived and "curve_strain" in values:
        used, ranges[record.derived] = [*used, record.derived], RULES[record.derived]
    return tuple((key, *ranges[key]) for key in used)
