"""Reads a measured curve of force over travel, and evaluates a measure of it."""

from pathlib import Path

import numpy as np
from pandas import Series

from sweep.array_types import Floats
from sweep.config.faults import MisfitError
from sweep.config.reading.text import rows_of, text_of
from sweep.constants import MM
from sweep.numbers import text_in
from sweep.published.table import PublishedError
from sweep.simulation.iso_13314 import figures

HEADS = ("displacement_mm", "force_N")
NEEDED = f"a csv file with the heads {','.join(HEADS)}, both positive in compression"
FEWEST = 10  # rows
SHORT_OF = 0.01  # share of the stroke: a curve that ends earlier is refused


def read_curve(path: Path) -> tuple[Floats, Floats]:
    """Travel (n,) in m from the first row, and force (n,) in N."""
    try:
        lines = text_of(path, NEEDED).splitlines()
        heads, *rows = rows_of(line for line in lines if line and line[0] != "#") or [[]]
        places = [heads.index(head) for head in HEADS]
        travel, force = (np.array([float(row[place]) for row in rows]) for place in places)
    except MisfitError as error:
        raise PublishedError(f"{path}: {error}") from None
    except (ValueError, IndexError):
        raise PublishedError(f"{path}: no numbers below its heads; needed: {NEEDED}") from None
    rises = len(travel) >= FEWEST and bool(np.all(np.diff(travel) >= 0.0))
    if not (rises and np.isfinite(travel).all() and np.isfinite(force).all()):
        needed = f"{FEWEST} rows or more, of travel that never falls: the first loading alone"
        raise PublishedError(f"{path}: {len(travel)} rows; needed: {needed}")
    return MM * (travel - travel[0]), force


def measure_of(path: Path, measure: str, row: Series) -> float:
    """A measure of a measured curve, in SI. row: of the simulated specimen in the summary.

    Energy and force are taken up to the simulated stroke, between two rows if need be; nominal
    stress and strain refer to the overall size of the specimen.
    """
    travel, force = read_curve(path)
    stroke = float(row["stroke_m"])
    reached = travel[-1]
    if not reached >= (1.0 - SHORT_OF) * stroke:
        raise PublishedError(
            f"{path}: ends at {text_in(reached, 'mm')}; needed: the whole simulated stroke, "
            f"{text_in(stroke, 'mm')}"
        )
    last = np.interp(stroke, travel, force)
    end = int(np.searchsorted(travel, stroke, side="right"))
    travel, force = travel[:end], force[:end]
    if travel[-1] < stroke <= reached:
        travel, force = np.append(travel, stroke), np.append(force, last)
    work = np.append(0.0, np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(travel)))
    area, height = float(row["outer_width_m"] * row["depth_m"]), float(row["height_m"])
    values = figures(travel / height, force / area, work / (area * height)) | {
        "absorbed_energy_J": float(work[-1]),
        "peak_force_N": float(force.max()),
    }
    if measure not in values:
        raise PublishedError(f"--measure {measure}; allowed of a curve: {', '.join(values)}")
    if not np.isfinite(values[measure]):
        raise PublishedError(f"{path}: the curve is too short for {measure}")
    return values[measure]
