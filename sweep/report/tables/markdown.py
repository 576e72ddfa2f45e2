"""Sheets as text in Markdown."""

import re
from collections.abc import Iterable

from sweep.report.tables.sheet import Sheet

TAG = re.compile(r"<(?=[A-Za-z/!])")


def markdown(sheets: Iterable[Sheet]) -> str:
    """Sheets in Markdown, each with a heading."""
    return "\n".join(_markdown(sheet) for sheet in sheets)


def _markdown(sheet: Sheet) -> str:
    """One sheet: heading, table with columns of equal width, notes."""
    heading = [f"### {sheet.title}", ""] if sheet.title else []
    if not sheet.heads:
        return "\n".join([*heading, *sheet.notes, ""])
    columns = zip(sheet.heads, sheet.columns, strict=True)
    texts = [[_cell(text) for text in (head, *texts)] for head, texts in columns]
    widths = [max(len(text) for text in column) for column in texts]
    lines = [
        "| " + " | ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)) + " |"
        for row in zip(*texts, strict=True)
    ]
    rule = "| " + " | ".join("-" * width for width in widths) + " |"
    notes = [line for note in sheet.notes for line in ("", note)]
    return "\n".join([*heading, lines[0], rule, *lines[1:], *notes, ""])


def _cell(text: str) -> str:
    """A text made safe: it ends no cell and begins no tag."""
    return TAG.sub("&lt;", text.replace("\n", " ").replace("|", "\\|"))
