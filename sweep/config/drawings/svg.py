"""Reads the lines and curves of an SVG file, with their transforms, with the package
svgelements.
"""

import re
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as Xml

import numpy as np

from sweep.array_types import Floats
from sweep.config.drawings.curves import MOST_LINES, straightened, without_marks
from sweep.config.drawings.lines import METRES, Lines
from sweep.config.faults import MisfitError

PIXEL = METRES["in"] / 96.0  # m, in CSS
LENGTHS = METRES | {"": PIXEL, "px": PIXEL, "pt": METRES["in"] / 72.0, "pc": METRES["in"] / 6.0}
PAGE = ("width", "height", "viewBox", "preserveAspectRatio")
USE = re.compile(r"(?:\{.*\})?use$")
_ZERO = re.compile(r"0+(?:\.0*)?(?:%|[a-z]*)|\.0+(?:%|[a-z]*)")
_SIZE = re.compile(r"([\d.]+(?:e[+-]?\d+)?)([a-z]*)")


def read_svg(path: Path) -> Lines:
    """The centre lines of all visible shapes, y upwards; fill and width of a stroke are ignored. If
    some shapes have a visible stroke, the others are no lines, but areas and dots. Circles that
    mark joints are left out (`without_marks`).

    The unit is the unit of the view box, from the width and the height of the page; a pixel if
    there is no view box. Without a size of the page it is not known.
    """
    try:
        from svgelements import SVG, Shape
        from svgelements import Path as Outline
    except ModuleNotFoundError as missing:
        needed = 'a .svg file needs the package svgelements: pip install "crumple[drawings]"'
        raise MisfitError(needed) from missing
    try:
        root = Xml.fromstring(path.read_bytes())
        if _element_count(root) > MOST_LINES:
            raise MisfitError(f"more than {MOST_LINES:,} shapes, with those that are used again")
        unit = _unit(root)
        for key in PAGE:
            root.attrib.pop(key, None)
        _drop_templates(root)
        drawing = SVG.parse(BytesIO(Xml.tostring(root)))
        shapes = [
            each for each in drawing.elements() if isinstance(each, Shape) and _is_shown(each)
        ]
        drawn = [shape for shape in shapes if _is_stroked(shape)] or shapes
        shapes = [Outline(shape) for shape in drawn]
        ends = straightened(control for shape in shapes for control in _beziers(abs(shape)))
    except MisfitError:
        raise
    except Xml.ParseError as error:
        raise MisfitError(f"no SVG: not XML at line {error.position[0]}") from None
    except Exception as error:  # noqa: BLE001  a damaged file fails anywhere in its reader
        raise MisfitError(f"not SVG that svgelements can read ({type(error).__name__})") from None
    ends, marks = without_marks(ends * [1.0, -1.0])
    return Lines(ends, unit, notes=tuple(f"left out: {mark}" for mark in marks))


def _unit(root: Xml.Element) -> float | None:
    """Length of a unit of the view box, m; None if the page has no size."""
    box = [float(word) for word in re.split(r"[\s,]+", root.get("viewBox", "").strip()) if word]
    scales = []
    for size, units in zip(("width", "height"), box[2:] or (None, None), strict=False):
        match = _SIZE.fullmatch(root.get(size, "").strip().lower())
        if not match or match[2] not in LENGTHS:
            continue
        if units is None:
            return PIXEL
        if units > 0.0:
            scales.append(float(match[1]) * LENGTHS[match[2]] / units)
    return min(scales, default=None)


def _element_count(root: Xml.Element) -> int:
    """Number of elements when all that are reused are drawn; too many if one uses itself."""
    named = {element.get("id"): element for element in root.iter()}
    count: dict[int, int] = {}

    def drawn(element: Xml.Element) -> int:
        if id(element) not in count:
            count[id(element)] = MOST_LINES + 1  # while it is open, it cannot use itself
            parts = [*element]
            if USE.match(str(element.tag)):
                parts += [named[_link(element)]] if _link(element) in named else []
            count[id(element)] = min(1 + sum(map(drawn, parts)), MOST_LINES + 1)
        return count[id(element)]

    return drawn(root)


def _drop_templates(root: Xml.Element) -> None:
    """Remove markers, and symbols that nothing uses."""
    elements = [*root.iter()]
    used = {_link(element) for element in elements if USE.match(str(element.tag))}
    for parent in elements:
        for child in [*parent]:
            kind = str(child.tag).rpartition("}")[2]
            if kind == "marker" or (kind == "symbol" and child.get("id") not in used):
                parent.remove(child)


def _link(use: Xml.Element) -> str:
    """The id of the element that is used again; empty without one."""
    return next((value for key, value in use.items() if key.endswith("href")), "")[1:]


def _is_shown(shape: Any) -> bool:
    """Whether neither its visibility nor its opacity hides a shape."""
    hidden = shape.values.get("visibility") in ("hidden", "collapse")
    return not hidden and not _is_zero(shape, "opacity")


def _is_stroked(shape: Any) -> bool:
    """Whether a shape has a stroke that is visible."""
    stroke = shape.stroke
    clear = _is_zero(shape, "stroke-opacity") or _is_zero(shape, "stroke-width")
    return stroke is not None and stroke.value is not None and not clear


def _is_zero(shape: Any, key: str) -> bool:
    """Whether a number of a shape, with or without a unit, is zero."""
    return _ZERO.fullmatch(str(shape.values.get(key, "")).strip()) is not None


def _beziers(path: Any) -> Iterator[Floats]:
    """Control points (k, 2) of each part of a path."""
    from svgelements import Arc, CubicBezier, Move, QuadraticBezier

    for part in path:
        if isinstance(part, Move) or part.start is None or part.end is None:
            continue
        for curve in part.as_cubic_curves() if isinstance(part, Arc) else [part]:
            control = [curve.start, curve.end]
            if isinstance(curve, CubicBezier):
                control[1:1] = [curve.control1, curve.control2]
            elif isinstance(curve, QuadraticBezier):
                control[1:1] = [curve.control]
            yield np.array([(float(point.x), float(point.y)) for point in control])
