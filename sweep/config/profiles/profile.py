"""Translates a slicer's profile into keys of [lattice], with their units.

Widths, as the slicers' sources compute them (libslic3r, Flow.cpp): 0 means the width for all lines,
and if that is 0 too, 1.125 nozzles; a percentage refers to the layer height in PrusaSlicer, to the
nozzle in SuperSlicer, OrcaSlicer and Bambu Studio. (If both are 0, the newest PrusaSlicer uses the
nozzle and the layer height together.)
"""

from collections.abc import Callable, Iterator, Mapping
from math import isfinite
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from sweep.config.faults import MisfitError
from sweep.config.kinds.specimen import LAYER_HEIGHT, NOZZLE
from sweep.config.profiles.settings import NEEDED, Settings, read_settings
from sweep.config.reading.other_names import present_choice
from sweep.design.slicer.patterns import ROUNDED, WIDTH_PER_NOZZLE, is_lateral
from sweep.numbers import in_unit, to_si

T = TypeVar("T")
TITLES = {"prusa": "PrusaSlicer", "superslicer": "SuperSlicer", "orca": "OrcaSlicer"}
SLICERS = {"prusa": "prusa", "superslicer": "prusa", "orca": "orca"}


class Names(NamedTuple):
    """The names of settings in a slicer. widths: of infill, then of all lines."""

    pattern: str
    infill: str
    widths: tuple[str, str]
    layer: str
    perimeters: str
    angle: str
    lines: str


PRUSA = Names(
    "fill_pattern",
    "fill_density",
    ("infill_extrusion_width", "extrusion_width"),
    "layer_height",
    "perimeters",
    "fill_angle",
    "fill_multiline",
)
ORCA = Names(
    "sparse_infill_pattern",
    "sparse_infill_density",
    ("sparse_infill_line_width", "line_width"),
    "layer_height",
    "wall_loops",
    "infill_direction",
    "fill_multiline",
)
NOZZLES = "nozzle_diameter"
LONGEST = 60  # most characters of a value in a sentence
SPACING = "infill_extrusion_spacing"  # SuperSlicer's key, in place of the width
LEFT_OUT: dict[str, dict[str, tuple[str, ...] | None]] = {
    "prusa": {
        "infill_every_layers": ("1",),
        "solid_infill_every_layers": ("0",),
        "top_solid_layers": ("0",),
        "bottom_solid_layers": ("0",),
        "spiral_vase": ("0",),
        "fuzzy_skin": ("none",),
        "extra_perimeters_odd_layers": ("0",),
        "fill_angle_increment": ("0",),
        "infill_dense": ("0",),
        "infill_overlap": ("25%",),
        "extrusion_multiplier": ("1", "100%"),
        "print_extrusion_multiplier": ("1", "100%"),
        "xy_size_compensation": ("0",),
        "perimeter_extrusion_width": None,
        "external_perimeter_extrusion_width": None,
    },
    "orca": {
        "infill_combination": ("0",),
        "top_shell_layers": ("0",),
        "bottom_shell_layers": ("0",),
        "spiral_mode": ("0",),
        "fuzzy_skin": ("none", "disabled_fuzzy"),
        "alternate_extra_wall": ("0",),
        "sparse_infill_rotate_template": ("",),
        "gyroid_optimized": ("0",),
        "lateral_lattice_angle_1": ("-45",),
        "lateral_lattice_angle_2": ("45",),
        "infill_overhang_angle": ("60",),
        "infill_wall_overlap": ("25%",),
        "filament_flow_ratio": ("1",),
        "print_flow_ratio": ("1",),
        "xy_contour_compensation": ("0",),
        "inner_wall_line_width": None,
        "outer_wall_line_width": None,
    },
}
"""Settings that change the walls and that no lattice here has, with the values without effect;
None: the widths of other lines.
"""


class Profile(NamedTuple):
    """A profile. values: keys of [lattice], as a config writes them. notes: sentences about
    settings that were adopted, missing or left out.
    """

    values: dict[str, Any]
    notes: tuple[str, ...]


def read_profile(path: Path, name: str) -> Profile:
    """The profile of a file; a # ends the path of a bundle and begins the name of a preset.

    name: of the file, in sentences. `MisfitError` says what is wrong.
    """
    file, preset = path, ""
    before, mark, after = path.name.partition("#")
    if mark and before and not path.is_file():
        file, preset = path.with_name(before), after
    settings = read_settings(file, preset)
    names = ORCA if settings.program == "orca" else PRUSA
    of_walls = (*names[:2], *names.widths, *names[3:], NOZZLES)
    if not settings.missing and not any(key in settings.values for key in of_walls):
        raise MisfitError(f"states nothing about walls; needed: {NEEDED}")
    translation = _Translation(settings, names)
    values = translation.values()
    return Profile(values, tuple(_notes(name, values, translation)))


class _Translation:
    """The keys that settings mean. unread: settings with a value that is not understood."""

    def __init__(self, settings: Settings, names: Names) -> None:
        self.settings, self.names = settings, names
        self.unread: dict[str, str] = {}
        self.differing: dict[str, str] = {}

    def values(self) -> dict[str, Any]:
        """Keys of [lattice] with their values."""
        names, program = self.names, self.settings.program
        nozzle, layer = self._read(NOZZLES, _length), self._read(names.layer, _length)
        width = self._width(*names.widths, nozzle or NOZZLE, layer or LAYER_HEIGHT)
        spacing = self._spacing(nozzle or NOZZLE) if program == "superslicer" else None
        if spacing is not None:
            width = spacing + ROUNDED * (layer or LAYER_HEIGHT)
        values = {
            "slicer": SLICERS[program],
            "pattern": self._text(names.pattern).lower() or None,
            "infill": _quantity(self._read(names.infill, _percentage), "%"),
            "line_width": _quantity(width, "mm"),
            "layer_height": _quantity(layer, "mm"),
            "nozzle": _quantity(nozzle, "mm"),
            "perimeters": self._read(names.perimeters, _count),
            "fill_angle": None if self.lateral else _quantity(self._angle, "deg"),
            "fill_multiline": self._read(names.lines, _count),
        }
        return {key: value for key, value in values.items() if value is not None}

    @property
    def lateral(self) -> bool:
        """Whether the lines of the pattern run along the depth, whatever their angle on the bed."""
        return is_lateral(present_choice("lattice.pattern", self._text(self.names.pattern)))

    @property
    def _angle(self) -> float | None:
        return self._read(self.names.angle, _number)

    @property
    def automatic(self) -> bool:
        """Whether the profile leaves the width of lines to the slicer."""
        texts = [self._text(name) for name in self.names.widths]
        return any(texts) and all(text in ("", "0") for text in texts)

    def left_out(self) -> Iterator[str]:
        """Settings that change walls, and that no lattice here has, with their values."""
        own = self.settings.values
        widths = {own.get(name, "0") for name in self.names.widths} | {"0", ""}
        for name, neutral in LEFT_OUT[SLICERS[self.settings.program]].items():
            value = self._text(name)
            if value and value.removesuffix(".0") not in (widths if neutral is None else neutral):
                yield f"{name} = {value}"
        if self.lateral and self._angle:
            yield f"{self.names.angle} = {self._text(self.names.angle)}"

    def _text(self, name: str) -> str:
        """The text of a setting, of the first extruder; "" if it is not there."""
        text = self.settings.values.get(name, "").partition(" #")[0]  # a note of a bundle
        first, *others = text.split(",")
        if any(other.strip() != first.strip() for other in others):
            self.differing[name] = text[:LONGEST]
        return first.strip()[:LONGEST]

    def _read(self, name: str, meaning: Callable[[str], T]) -> T | None:
        """The meaning of a setting; None if it is not there, or, noted, without a meaning."""
        text = self._text(name)
        try:
            return meaning(text) if text else None
        except ValueError:
            self.unread[name] = text
            return None

    def _width(self, own: str, usual: str, nozzle: float, layer: float) -> float | None:
        """The width of a line, m; None if it is not stated."""
        of = layer if self.settings.program == "prusa" else nozzle
        for name in (own, usual):
            if (width := self._read(name, lambda text: _width_of(text, of))) and width > 0.0:
                return width
        return WIDTH_PER_NOZZLE * nozzle if self.automatic else None

    def _spacing(self, nozzle: float) -> float | None:
        """The distance of lines at full infill, one of SuperSlicer's two ways to give the width."""
        if self._text(self.names.widths[0]) not in ("", "0"):
            return None
        spacing = self._read(SPACING, lambda text: _width_of(text, nozzle))
        return spacing if spacing and spacing > 0.0 else None


def _number(text: str) -> float:
    """A finite number."""
    number = float(text)
    if not isfinite(number):
        raise ValueError(text)
    return number


def _length(text: str) -> float:
    """A length above 0 in m, from millimetres."""
    number = _number(text)
    if number <= 0.0:
        raise ValueError(text)
    return to_si(number, "mm")


def _count(text: str) -> int:
    """A whole number."""
    number = _number(text)
    if not number.is_integer():
        raise ValueError(text)
    return int(number)


def _percentage(text: str) -> float:
    """A number in per cent: from "15%", and from "15", as JSON may have it; from "0.15" of an old
    Slic3r too.
    """
    number = _number(text.removesuffix("%"))
    return in_unit(number, "%") if "%" not in text and 0.0 < number < 1.0 else number


def _width_of(text: str, of: float) -> float:
    """A width in m, from millimetres, or from per cent of another width (m)."""
    number = _number(text.removesuffix("%"))
    return to_si(number, "%") * of if text.endswith("%") else to_si(number, "mm")


def _quantity(value: float | None, unit: str) -> str | None:
    """A number as a config writes it; lengths are converted from m, others unchanged."""
    if value is None:
        return None
    return f"{in_unit(value, unit) if unit == 'mm' else value:.10g} {unit}"


def _notes(name: str, values: Mapping[str, Any], translation: _Translation) -> Iterator[str]:
    """Sentences about a profile."""
    program, missing = translation.settings.program, translation.settings.missing
    taken = ", ".join(f"{key.replace('_', ' ')} {value}" for key, value in values.items())
    yield f"{name}, of {TITLES[program]}: {taken}"
    if translation.settings.project:
        yield f"{name}: settings of single objects are not read, only settings of the project"
    if missing:
        yield f'{name} inherits from "{missing}", which is not beside it: what that says is unknown'
    keys = ("pattern", "infill", "perimeters", "line_width", "layer_height", "nozzle")
    usual = [key for key in keys if key not in values]
    if usual:
        yield f"{name} does not say: {', '.join(usual)}"
    if translation.automatic:
        wide = f"{WIDTH_PER_NOZZLE:g} nozzles, {values['line_width']}"
        yield f"{name} leaves the width of lines to the slicer: taken as {wide}"
    several = " has several extruders: the first of", translation.differing
    for words, read in (several, (": not understood:", translation.unread)):
        if read:
            yield f"{name}{words} {', '.join(f'{key} = {value}' for key, value in read.items())}"
    if left := list(translation.left_out()):
        yield f"{name}: left out, as no wall here has it: {', '.join(left)}"
