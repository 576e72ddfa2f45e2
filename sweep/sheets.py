"""Rankings and lists of cases as text: for a terminal of 80 columns, and in Markdown."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from sweep.rank import ASSUMPTIONS

if TYPE_CHECKING:
    from pandas import DataFrame, Series
    from rich.table import Table

NOTHING = "–"
LEGEND = (
    "* Pareto: nothing lighter in its table absorbs as much.  packs at: strain of densification."
)

MILLIMETRES = {
    "wall_thickness_m": "wall mm",
    "width_m": "width mm",
    "height_m": "height mm",
    "depth_m": "depth mm",
}
SHOWN_BY_NAME = {
    "lattice.kind",
    "lattice.cells",
    "lattice.cells_x",
    "lattice.cells_y",
    "lattice.wall_thickness",
    "lattice.width",
    "lattice.height",
    "lattice.depth",
    "material.name",
}
"""Grid keys whose values have a column of the summary to themselves."""


class Sheet(NamedTuple):
    """A table of text. `opens` are the rows that begin a section, `notes` the lines below."""

    title: str
    heads: list[str]
    rows: list[list[str]]
    opens: frozenset[int] = frozenset()
    notes: tuple[str, ...] = ()


def ranking_sheets(ranking: DataFrame, summary: DataFrame) -> Iterator[Sheet]:
    """One sheet a loading scene, budgets one below the other; designs as they vary in `summary`."""
    names = ranking.attrs
    for scene, lightest in names["lightest_g"].items():
        rows = ranking[ranking["scene"] == scene]
        first = ~rows["budget_g"].duplicated()
        columns = {"#": rows["place"].astype(str) + rows["pareto"].map({True: "*", False: " "})}
        if len(names["budgets_g"]) > 1:
            columns = {"up to g": rows["budget_g"].map("{:g}".format).where(first, "")} | columns
        columns |= design_text(rows, summary) | _measures(rows, names)
        yield Sheet(
            title=scene,
            heads=list(columns),
            rows=[list(row) for row in zip(*columns.values(), strict=True)],
            opens=frozenset(i for i, opens in enumerate(first) if opens),
            notes=tuple(
                f"Nothing weighs {budget:g} g or less: the lightest weighs {lightest:.3g} g."
                for budget in names["budgets_g"]
                if budget < lightest
            ),
        )


def design_text(frame: DataFrame, among: DataFrame) -> dict[str, Series]:
    """What tells designs apart: columns of `frame` that vary `among` all, in a maker's units."""
    columns = {}
    if _varies(among, "lattice_kind"):
        columns["pattern"] = frame["lattice_kind"].astype(str)
    if _varies(among, "cells_x", "cells_y"):
        columns["cells"] = frame["cells_x"].astype(str) + " x " + frame["cells_y"].astype(str)
    for name, head in MILLIMETRES.items():
        if _varies(among, name):
            columns[head] = (frame[name] * 1e3).map("{:.3g}".format)
    if _varies(among, "material"):
        columns["material"] = frame["material"].astype(str)
    for key in frame:
        if "." in key and key not in SHOWN_BY_NAME and not key.startswith(ASSUMPTIONS):
            columns[key.split(".")[-1].replace("_", " ")] = frame[key].map(short)
    return columns


def _measures(rows: DataFrame, names: dict[Any, Any]) -> dict[str, Series]:
    """Columns of what was found; the column sorted by is always among them."""
    energy, by = rows[names["energy"]], names["by"]
    whole, columns = "absorbs", {"mass g": numerals(rows["mass_g"])}
    if "panel_mass_g" in rows:
        whole, columns["panel g"] = "panel", numerals(rows["panel_mass_g"])
    unit, scale = ("mJ", 1e3) if energy.max() < 1.0 else ("J", 1.0)
    columns[f"{whole} {unit}"] = numerals(energy * scale)
    columns["J/g"] = numerals(rows[names["per_gram"]])
    columns["peak N"] = numerals(rows["peak_force_N"])
    if rows["densification_strain"].notna().any():
        columns["packs at"] = rows["densification_strain"].map(percent)
    shown = {"mass_g", "panel_mass_g", "peak_force_N", "densification_strain"}
    if by not in shown | {names["energy"], names["per_gram"]}:
        columns[by] = numerals(rows[by])
    return columns


def terminal_table(sheet: Sheet) -> Table:
    """A rich table; the unit of a head goes on a second line, so that 80 columns are enough."""
    from rich import box
    from rich.table import Table

    table = Table(
        title=sheet.title,
        caption="\n".join(sheet.notes) or None,
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
        pad_edge=False,
        show_edge=False,
        collapse_padding=True,
    )
    for head, texts in zip(sheet.heads, _columns(sheet), strict=True):
        right = all(text[:1] in f"0123456789-{NOTHING}" and " x " not in text for text in texts)
        lines = "\n".join(head.rsplit(" ", 1))
        table.add_column(lines, justify="right" if right else "left", no_wrap=True)
    for i, row in enumerate(sheet.rows):
        if i in sheet.opens and i:
            table.add_section()
        table.add_row(*row)
    return table


def markdown(sheets: Iterable[Sheet]) -> str:
    """Sheets in Markdown, a heading each."""
    return "\n".join(_markdown(sheet) for sheet in sheets)


def _markdown(sheet: Sheet) -> str:
    """One sheet: heading, table with columns of equal width, notes."""
    texts = [[head, *texts] for head, texts in zip(sheet.heads, _columns(sheet), strict=True)]
    widths = [max(len(text) for text in column) for column in texts]
    lines = [
        "| " + " | ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)) + " |"
        for row in zip(*texts, strict=True)
    ]
    rule = "| " + " | ".join("-" * width for width in widths) + " |"
    heading = [f"### {sheet.title}", ""] if sheet.title else []
    notes = [line for note in sheet.notes for line in ("", note)]
    return "\n".join([*heading, lines[0], rule, *lines[1:], *notes, ""])


def numerals(values: Series) -> Series:
    """Numbers with as many decimals as give the greatest three significant digits."""
    greatest = values.abs().replace(math.inf, math.nan).max()
    decimals = 2 - math.floor(math.log10(greatest)) if greatest > 0.0 else 0
    decimals = min(max(decimals, 0), 9)
    return values.map(lambda value: f"{value:.{decimals}f}" if math.isfinite(value) else NOTHING)


def percent(value: float) -> str:
    """A strain as whole percent."""
    return f"{value:.0%}" if math.isfinite(value) else NOTHING


def short(value: object) -> str:
    """A number with few digits, anything else as it is."""
    if isinstance(value, float):
        return f"{value:.4g}" if math.isfinite(value) else NOTHING
    return str(value)


def _varies(frame: DataFrame, *names: str) -> bool:
    """True if one of the columns has more than one value."""
    return any(len(frame[name].unique()) > 1 for name in names)


def _columns(sheet: Sheet) -> list[list[str]]:
    """The texts of each column."""
    return [[row[i] for row in sheet.rows] for i in range(len(sheet.heads))]
