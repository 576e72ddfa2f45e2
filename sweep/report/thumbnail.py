"""A small drawing of a design, as SVG, from the first of its stored shapes."""

from collections.abc import Mapping
from typing import Any

from sweep.report.page.trails import at_rest, drawing

SIZE = 56  # pixels of the longer side
MOST = 20_000  # most letters of the walls; a denser drawing is left out


def thumbnail(frames: Mapping[str, Any]) -> str:
    """The walls at rest as one path of an SVG, a pixel wide; for a print that stands upright, its
    plan. Empty without shapes.
    """
    if not len(frames.get("position_m", ())):
        return ""
    drawn = drawing(*at_rest(frames))
    left, low, width, height = drawn["box"]
    path = "".join(walls for _, walls in drawn["walls"])
    if len(path) > MOST:
        return ""
    scale = SIZE / max(width, height)
    sides = f'width="{scale * width:.3g}" height="{scale * height:.3g}"'
    place = f"matrix(.01 0 0 -.01 {-left} {low + height})"  # y points down, and units are mm
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" {sides} viewBox="0 0 {width} {height}" '
        f'overflow="visible" role="img"><path d="{path}" transform="{place}" fill="none" '
        'stroke="currentColor" vector-effect="non-scaling-stroke"/></svg>'
    )
