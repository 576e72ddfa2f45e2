"""Tables of text as HTML, for the page of a sweep and for notebooks; every text is escaped."""

from collections.abc import Iterable, Mapping
from html import escape

from sweep.report.tables.sheet import Sheet


def html_table(sheet: Sheet, pictures: Mapping[str, str] | None = None) -> str:
    """A table with its title and notes.

    pictures: SVG by the id of a case, from `Sheet.cases`; if given, the first column shows them.
    """
    title = f"<h3>{escape(sheet.title)}</h3>" if sheet.title else ""
    drawn = [(pictures or {}).get(case_id, "") for case_id in sheet.cases]
    first = [f"<td>{picture}</td>" for picture in drawn] if any(drawn) else [""] * len(sheet.rows)
    cells = ["".join(f"<td>{escape(text)}</td>" for text in row) for row in sheet.rows]
    rows = "".join(
        f"<tr>{picture}{texts}</tr>" for picture, texts in zip(first, cells, strict=True)
    )
    heads = "<th></th>" if any(drawn) else ""
    heads += "".join(f'<th scope="col">{escape(head)}</th>' for head in sheet.heads)
    grid = f"<table><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table>"
    scrolled = f'<div class="scroll">{grid}</div>' if sheet.heads else ""
    return f"{title}{scrolled}{paragraphs(sheet.notes)}"


def paragraphs(lines: Iterable[str]) -> str:
    """Lines of subdued text, a paragraph each."""
    return "".join(f'<p class="quiet">{escape(line)}</p>' for line in lines)
