"""Designs as text: as columns of a table, or as words in a sentence."""

from collections.abc import Iterable

from pandas import DataFrame, Series
from pandas.api.types import is_numeric_dtype

from sweep.columns import ALONG, describe_column, is_grid_key
from sweep.design.slicer.patterns import is_lateral, is_sheet
from sweep.numbers import FACTORS, NOTHING, in_unit, scaled, short, shorts, text_in
from sweep.ranking.scenes import ASSUMPTIONS, scene_labels

ID = 4  # least letters of an id in a sentence
WAYS = {"in_plane": "across", ALONG: "along"}
"""How a lattice is pressed, by the column `direction`: across its cells or along them."""
LAYERED = "delamination of printed layers is not modelled"
MILLIMETRES = {
    "wall_thickness_m": "wall mm",
    "width_m": "width mm",
    "height_m": "height mm",
    "depth_m": "depth mm",
}
SHOWN_BY_NAME = {
    "lattice.kind",
    "lattice.pattern",
    "lattice.mass",
    "lattice.cells",
    "lattice.cell_size",
    "lattice.cells_x",
    "lattice.cells_y",
    "lattice.wall_thickness",
    "lattice.width",
    "lattice.height",
    "lattice.depth",
    "material.name",
}
"""Grid keys whose values are in a fixed column of the summary."""
NEUTRAL = {"grading": "1", "perimeters": "0"}
"""Values that change nothing, by their heads: texts leave them out, tables have them."""


def named_case(row: DataFrame, among: DataFrame) -> str:
    """The beginning of the id and the design of one row, in words."""
    short_of = short_id(row["case_id"].item(), among["case_id"].to_numpy(object))
    return f"case {short_of}, {design_labels(row, among)[0]}"


def short_id(case_id: str, among: Iterable[str]) -> str:
    """The shortest beginning of an id, of at least `ID` letters, that no other id has."""
    start = case_id[:ID]
    others = [other for other in among if other.startswith(start) and other != case_id]
    lengths = range(ID, len(case_id))
    alone = (n for n in lengths if not any(other.startswith(case_id[:n]) for other in others))
    return case_id[: next(alone, len(case_id))]


def design_text(frame: DataFrame, among: DataFrame) -> dict[str, Series]:
    """Columns that describe the designs of `frame`, as text in mm and the like.

    Only columns that vary `among` all cases are shown.
    """
    columns = {}
    if _varies(among, "lattice_kind"):
        columns["pattern"] = frame["lattice_kind"].astype(str)
    if "direction" in frame and _varies(among, "direction"):
        columns["pressed"] = frame["direction"].map(WAYS)
    laid = "infill_share" in frame and frame["infill_share"].notna().all()  # cells have no number
    if _varies(among, "cells_x", "cells_y") and not laid:
        columns["cells"] = frame["cells_x"].astype(str) + " x " + frame["cells_y"].astype(str)
    if "infill_share" in frame and _varies(among, "infill_share"):
        share = in_unit(frame["infill_share"], "%").map("{:.3g}".format)
        columns["infill %"] = share.where(frame["infill_share"].notna(), "")
    for name, head in MILLIMETRES.items():
        if _sizes_vary(among, name):
            columns[head] = in_unit(frame[name], "mm").map("{:.3g}".format)
    if _varies(among, "material"):
        columns["material"] = frame["material"].astype(str)
    if _varies(among, "material_memory"):
        columns["behaviour"] = frame["material_memory"].replace("none", "elastic").astype(str)
    by_name = SHOWN_BY_NAME | ({"lattice.infill"} if "infill %" in columns else set())
    if "infill %" in columns and len({*among.get("lattice.slicer", [])} - {""}) < 2:
        by_name = by_name | {"lattice.slicer"}  # designs with a share of infill are its own
    if "lattice.file" in among and set(among["lattice.file"]) <= {"", *among["lattice_kind"]}:
        by_name = by_name | {"lattice.file"}  # drawings are named by their files
    for key in frame:
        hidden = key in by_name or key.startswith(ASSUMPTIONS)
        if is_grid_key(key) and not hidden and _varies(among, key):
            columns |= _grid_text(frame[key], among[key])
    return columns


def _grid_text(values: Series, among: Series) -> dict[str, Series]:
    """The column of a grid key, with its unit; ``among``: its values in all cases."""
    unit = describe_column(str(values.name)).units
    noun = str(values.name).split(".")[-1].replace("_", " ")
    if not is_numeric_dtype(values):
        return {noun: values.map(short)}
    if not unit:
        return {noun: shorts(values)}
    factor, name = scaled(unit, float(among.abs().max()))
    return {f"{noun} {name}": shorts(factor * values.astype(float))}


def about_direction(row: Series) -> list[str]:
    """Sentences about how a design is pressed and what is left out; none for prisms of layers that
    are pressed in their planes.
    """
    sheet, how = is_sheet(row["lattice_kind"]), WAYS[row["direction"]]
    if is_lateral(row["lattice_kind"]):
        return [f"pressed along its print axis; {LAYERED}"]
    if row["direction"] != ALONG and not sheet:
        return []
    lines = [f"pressed {how} its {'print axis' if sheet else 'cells'}; {LAYERED}"]
    solid, strain = row["solid_strain"], row["peak_strain"]
    if strain > solid:
        share = text_in(solid, "%", 3)
        lines.append(
            f"beyond a strain of {share} its walls fill the pressed area, which shells do not model"
        )
    return lines


def describe_case(row: Series, among: DataFrame) -> str:
    """The scene and the design of one case of a summary, in words."""
    rows = among.loc[[row.name]]
    return f"{scene_labels(among)[row.name]}, {design_labels(rows, among)[0]}"


def design_labels(frame: DataFrame, among: DataFrame) -> list[str]:
    """The columns of `design_text` as one text per design: "cells 3 x 3, wall 0.8 mm, cheetah"."""
    columns = design_text(frame, among) or {"material": frame["material"].astype(str)}
    rows = (dict(zip(columns, texts, strict=True)) for texts in zip(*columns.values(), strict=True))
    return [_label(row) for row in rows]


def _label(texts: dict[str, str]) -> str:
    """A design in words, from its texts by their heads."""
    shown = {head: text for head, text in texts.items() if text}
    telling = {head: text for head, text in shown.items() if NEUTRAL.get(head) != text}
    return ", ".join(_with_noun(head, text) for head, text in (telling or shown).items())


def _with_noun(head: str, text: str) -> str:
    """A value with the head of its column: "wall mm", "0.8" -> "wall 0.8 mm"."""
    if head == "infill %":
        return f"{text} % infill"
    noun, _, unit = head.rpartition(" ")
    if noun and unit in FACTORS:
        return f"{noun} {text}" if text == NOTHING else f"{noun} {text} {unit}"
    return text if head in ("material", "pattern") else f"{head} {text}"


def _sizes_vary(among: DataFrame, name: str) -> bool:
    """Whether a length differs between designs by more than follows from other columns.

    Along the cells `depth_m` is the overall depth of the plan: its centre lines and a wall, or an
    outline.
    """
    if name != "depth_m" or "direction" not in among:
        return _varies(among, name)
    along = among["direction"] == ALONG
    plan = among[along].round(9)
    inner = (plan["depth_m"] - plan["wall_thickness_m"]).round(9)
    return _varies(among[~along], name) or (_varies(plan, name) and len(inner.unique()) > 1)


def _varies(frame: DataFrame, *names: str) -> bool:
    """True if one of the columns has more than one value."""
    return any(len(frame[name].unique()) > 1 for name in names)
