"""DXF (R2000) in mm: a closed polyline for every ring, openings on a layer of their own."""

from pathlib import Path

from sweep.export.errors import ExportError
from sweep.export.outline import Layout, rings

OUTER, OPENING = "OUTLINE", "OPENINGS"


def write_dxf(path: Path, layout: Layout) -> None:
    """Write the outline of a layout."""
    import shapely

    try:
        import ezdxf.filemanagement
        import ezdxf.units
    except ModuleNotFoundError as missing:
        raise ExportError(
            'a .dxf file needs the package ezdxf: pip install ezdxf, or "crumple[export]"; .svg '
            "needs nothing"
        ) from missing
    document = ezdxf.filemanagement.new("R2000", units=ezdxf.units.MM)
    for layer in (OUTER, OPENING):
        document.layers.add(layer)
    for ring in rings(layout):
        layer = OUTER if shapely.is_ccw(shapely.linearrings(ring)) else OPENING
        document.modelspace().add_lwpolyline(ring[:-1], close=True, dxfattribs={"layer": layer})
    document.saveas(path)
