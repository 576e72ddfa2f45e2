"""The striker or platen that presses a lattice, and the base that carries it: flat platens, or
rigid profiles in their place.

A striker that is not flat moves in y and acts on the whole depth of the lattice, as a line: in the
plane a tooth is as long as the panel is deep. The lattice then stands on its base, to which
`loading.platen` refers.
"""

from collections.abc import Iterator
from math import degrees, pi
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import Field

from sweep.config.kinds.directed import Directed
from sweep.config.kinds.direction import WHERE, is_along
from sweep.config.kinds.table import Angle, Inputs, Length, RefusedError, given_or
from sweep.numbers import text_in

if TYPE_CHECKING:
    from sweep.design.profile import Profile

Tip = Annotated[float, Field(ge=0, json_schema_extra={"unit": "m"})]
Place = Annotated[float, Field(ge=0, le=1, json_schema_extra={"unit": "1", "bare": True})]
Radius = Annotated[float, Field(gt=0, le=10, json_schema_extra={"unit": "m"})]
LEAST_ANGLE, MOST_ANGLE = pi / 18, 17 * pi / 18
REACH = 4.0  # length of flanks / (width + height of the lattice)


USUAL: dict[str, dict[str, float | None]] = {
    "flat": {},
    "round": {"striker_radius": 5e-3, "striker_at": 0.5},
    "edge": {"striker_angle": pi / 2, "striker_tip": 0.5e-3, "striker_at": 0.5},
    "punch": {"striker_width": 10e-3, "striker_tip": 0.5e-3, "striker_at": 0.5},
    "ribs": {"base_span": None, "base_radius": 1e-3},
}
"""The kinds of strikers and bases, with their keys and usual numbers; None: no default."""
UNSAID = {"striker_tip": "tip ", "base_span": "span ", "base_radius": "radius "}
SHAPED = ("striker", "base")
_OF_KINDS = {key for keys in USUAL.values() for key in keys}


class WithStriker(Directed):
    """A loading by a striker or a platen on a base, each of some shape: both have the keys of their
    kinds, and None for others.
    """

    neutral: ClassVar[dict[str, Any]] = Directed.neutral | {"striker": "flat", "base": "flat"}

    needs: ClassVar[dict[str, str]] = {
        "striker_at": 'loading.striker is "flat"',
        "striker_radius": 'loading.striker is not "round"',
        "striker_angle": 'loading.striker is not "edge"',
        "striker_tip": 'loading.striker is neither "edge" nor "punch"',
        "striker_width": 'loading.striker is not "punch"',
        "base_span": 'loading.base is not "ribs"',
        "base_radius": 'loading.base is not "ribs"',
    }

    striker: Literal["flat", "round", "edge", "punch"] = "flat"
    striker_at: Place | None = None
    striker_radius: Radius | None = None
    striker_angle: Angle | None = None
    striker_tip: Tip | None = None
    striker_width: Length | None = None
    base: Literal["flat", "ribs"] = "flat"
    base_span: Length | None = None
    base_radius: Length | None = None

    @property
    def is_shaped(self) -> bool:
        """Whether the striker or the base is not flat."""
        return (self.striker, self.base) != ("flat", "flat")

    @property
    def shape_columns(self) -> dict[str, str]:
        """Striker and base in words, such as "round, 5 mm, at 50 %", for a results file."""
        return {key: ", ".join(self._words(key)) for key in SHAPED}

    def _words(self, key: str) -> Iterator[str]:
        """The kind of the striker or the base, and its numbers."""
        yield str(getattr(self, key))
        for name, value in _numbers(key, self.inputs()).items():
            if name == "striker_angle":
                yield f"{degrees(value):.4g} deg"
            elif name == "striker_at":
                yield f"at {text_in(value, '%')}"
            else:
                yield UNSAID.get(name, "") + text_in(value, "mm")

    def profiles(self, key: str, left: float, width: float, height: float) -> "tuple[Profile, ...]":
        """The profiles of the "striker" or the "base" (``key``) of a lattice, empty if it is flat.

        left: x of its left side; all in m.
        """
        from sweep.design.profile import circle, punch, rib, wedge

        number, reach = _numbers(key, self.inputs()), REACH * (width + height)
        x = left + number.get("striker_at", 0.5) * width
        match getattr(self, key):
            case "round":
                return (circle(x, number["striker_radius"]),)
            case "edge":
                return (wedge(x, number["striker_angle"], number["striker_tip"], reach),)
            case "punch":
                return (punch(x, number["striker_width"], number["striker_tip"], reach),)
            case "ribs":
                half = 0.5 * number["base_span"]
                return tuple(rib(x + side, number["base_radius"], reach) for side in (-half, half))
        return ()


def _numbers(key: str, inputs: Inputs) -> dict[str, float]:
    """The numbers of the striker or the base of these values."""
    usual = USUAL[inputs.get(key, "flat")]
    if "base_span" in usual and "base_span" not in inputs:
        raise RefusedError("loading.base_span", None, "the distance of the ribs, axis to axis")
    return {name: inputs.get(name, number) for name, number in usual.items()}


def with_striker(inputs: Inputs, width: float, unending: str) -> dict[str, Any]:
    """These values of a loading, with striker and base completed.

    Keys of other kinds of strikers are left out. width (m): of the lattice over centre lines.
    unending: the key that ties its sides, in words; empty if none does.
    """
    shaped = {key for key in SHAPED if inputs.get(key, "flat") != "flat"}
    if shaped and (is_along(inputs) or unending):
        key, where = min(shaped), WHERE if is_along(inputs) else unending
        raise RefusedError(f"loading.{key}", inputs[key], f'"flat" {where}')
    own = {name: value for name, value in inputs.items() if name not in _OF_KINDS}
    for key in SHAPED:
        own |= _numbers(key, inputs)
    if shaped:
        own["platen"] = _standing(inputs)
    _check(own, width)
    return own


def _standing(inputs: Inputs) -> str:
    """How the lattice stands on its base: glued, or loose, as always on ribs."""
    ribs = inputs.get("base") == "ribs"
    platen: str = inputs.get("platen", "contact" if ribs else "glued")
    if ribs and platen != "contact":
        raise RefusedError("loading.platen", platen, '"contact" if loading.base is "ribs"')
    if platen not in ("contact", "glued"):
        allowed = '"contact" or "glued", which is about the base, unless loading.striker is "flat"'
        raise RefusedError("loading.platen", platen, allowed)
    return platen


def _check(own: Inputs, width: float) -> None:
    """Refuse an edge that is no wedge, a tip wider than its punch, and ribs beside the lattice."""
    angle, tip, face = (own.get(f"striker_{key}") for key in ("angle", "tip", "width"))
    if angle is not None and not LEAST_ANGLE <= angle <= MOST_ANGLE:
        allowed = f"from {degrees(LEAST_ANGLE):g} deg to {degrees(MOST_ANGLE):g} deg"
        raise RefusedError("loading.striker_angle", angle, allowed)
    if face is not None and given_or(tip, 0.0) > 0.5 * face:
        allowed = f"at most half of loading.striker_width, {0.5 * face:g} m here"
        raise RefusedError("loading.striker_tip", tip, allowed)
    span, radius = own.get("base_span"), own.get("base_radius", 0.0)
    if span is not None and not 2.0 * radius < span <= width:
        allowed = f"more than twice loading.base_radius, {2.0 * radius:g} m here, and at most the "
        allowed += f"width of the lattice, {width:g} m here"
        raise RefusedError("loading.base_span", span, allowed)
