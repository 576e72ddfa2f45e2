"""The common part of all tables of a case: types of values in SI, refusals, and canonical text."""

import json
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from functools import cache, lru_cache
from typing import Annotated, Any, ClassVar, TypedDict, TypeVar

from pydantic import BaseModel, ConfigDict, Field

from sweep.config.faults import MisfitError

T = TypeVar("T")
Inputs = Mapping[str, Any]
"""The values of one table that a config gives, in SI, by their keys."""


class Tables(TypedDict, total=False):
    """The values of the tables of a case; None for the defaults of a table."""

    lattice: "Inputs | Table | None"
    material: "Inputs | Table | None"
    loading: "Inputs | Table | None"
    contact: "Inputs | Table | None"
    damping: "Inputs | Table | None"
    solver: "Inputs | Table | None"


TABLES = tuple(Tables.__annotations__)
SIGNIFICANT = 12  # digits of a number that enter an id; unit conversions do not change them

Length = Annotated[float, Field(gt=0, json_schema_extra={"unit": "m"})]
Size = Annotated[float, Field(gt=0, le=1e3, json_schema_extra={"unit": "m"})]
Pause = Annotated[float, Field(ge=0, json_schema_extra={"unit": "s"})]
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
Angle = Annotated[float, Field(json_schema_extra={"unit": "rad"})]
Share = Annotated[float, Field(gt=0, lt=1, json_schema_extra={"unit": "1"})]
Count = Annotated[int, Field(ge=1)]
Few = Annotated[int, Field(ge=1, le=1000)]  # a typo must not fill the memory
Cycles = Annotated[int, Field(ge=1, le=100)]
# JSON returns lists, so that lists are accepted too.
Forces = Annotated[tuple[Force, ...], Field(strict=False)]
NonNegative = Annotated[float, Field(ge=0)]
STEADY = "the stress of the material does not depend on time: it has neither loss nor relaxation"
COMPUTED = "computed"  # marks a field that is no key of a config
Positive = Annotated[float, Field(gt=0)]


class Table(BaseModel):
    """One table of a case, complete and in SI; its attributes are keys of the config.

    table: its name, for `refusal`. labels: keys that never enter an id. neutral: keys that enter it
    only with other values. constants: values that enter it in addition to the attributes. derived:
    attributes that follow from others.

    sets: key -> the keys whose values follow from it, if it is given. replaces: key -> other keys
    whose values a new one drops. needs: key that may be left out -> the reason. fits: keys whose
    values are the nearest that fit. because: why other keys have no effect.
    """

    model_config = ConfigDict(frozen=True, strict=True, extra="forbid", allow_inf_nan=False)
    table: ClassVar[str]
    labels: ClassVar[tuple[str, ...]] = ()
    neutral: ClassVar[dict[str, Any]] = {}
    constants: ClassVar[dict[str, Any]] = {}
    derived: ClassVar[tuple[str, ...]] = ()
    sets: ClassVar[dict[str, tuple[str, ...]]] = {}
    replaces: ClassVar[dict[str, tuple[str, ...]]] = {}
    needs: ClassVar[dict[str, str]] = {}
    fits: ClassVar[tuple[str, ...]] = ()
    because: ClassVar[str] = ""

    @classmethod
    def overridden_by(cls, key: str) -> set[str]:
        """Keys that a new value of ``key`` overrides: keys that it sets, keys that set it, and keys
        that set the same key.
        """
        own = {key, *cls.sets.get(key, ())}
        causes = {cause for cause, keys in cls.sets.items() if own & {cause, *keys}}
        return {*own, *causes, *cls.replaces.get(key, ())} - {key}

    def inputs(self) -> dict[str, Any]:
        """The values from which this table follows, by key."""
        values = {name: value for name, value in self if name not in self.derived}
        return {name: value for name, value in values.items() if value is not None}

    def value(self, key: str) -> Any:
        """The value of a key; None if this kind does not have it."""
        return getattr(self, key) if key in keys_of(type(self)) else self.constants.get(key)

    def why_idle(self, key: str) -> str:
        """Why a key has no effect."""
        return self.needs.get(key, self.because)

    def refusal(self, key: str, allowed: str) -> "RefusedError":
        """The refusal of the value of a key."""
        return RefusedError(f"{self.table}.{key}", getattr(self, key), allowed)

    def implies(self, key: str, value: object) -> bool:
        """Whether a value of a key that this kind does not have states what is the case anyway."""
        implied = {**self.neutral, **self.constants}
        return bool(implied.get(key, getattr(self, key, None)) == value)


class RefusedError(MisfitError):
    """A value that contradicts the rest of its case.

    value: None if it is missing. since: the key that implies the value, if it is not given itself.
    also: further refusals of the same table.
    """

    def __init__(self, key: str, value: object, allowed: str, since: str | None = None) -> None:
        super().__init__(key, value, allowed, since)
        self.key, self.value, self.allowed, self.since = key, value, allowed, since
        self.also: list[RefusedError] = []

    def __str__(self) -> str:
        return f"{self.key} = {self.value}; allowed: {self.allowed}"

    @property
    def table(self) -> str:
        """The table of the key."""
        return self.key.split(".")[0]


def own_values(values: Inputs, model: type[Table]) -> dict[str, Any]:
    """The values of the keys that a model has."""
    own = keys_of(model)
    return {key: value for key, value in values.items() if key in own}


@cache
def keys_of(model: type[BaseModel]) -> set[str]:
    """The keys of a table or a case, one set for all of a kind: a set for each would take 1 kB."""
    return {*model.model_fields}


def similar(word: str, words: Iterable[object]) -> str:
    """A clause with the known word most similar to this one; empty if none is."""
    near = get_close_matches(
        word.lower(), [choice for choice in words if isinstance(choice, str)], n=1
    )
    return f'; the nearest is "{near[0]}"' if near else ""


def given_or(value: T | None, default: T) -> T:
    """A value, or its default if it is None."""
    return default if value is None else value


@lru_cache(maxsize=4096)
def canonical(table: Table) -> str:
    """A table as JSON, with sorted keys and rounded numbers, without unused keys."""
    used = {
        key: rounded(value)
        for key, value in table
        if value is not None and key not in table.labels and value != table.neutral.get(key)
    }
    return json.dumps(table.constants | used, sort_keys=True, separators=(",", ":"))


def rounded(value: object) -> object:
    """A value as it enters an id."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(f"{value:.{SIGNIFICANT}g}")
    if isinstance(value, BaseModel):
        return {key: rounded(item) for key, item in value}
    return [rounded(item) for item in value] if isinstance(value, tuple) else value
