"""Writes the page of a sweep: template, style and program filled with the data."""

import json
from base64 import b64encode
from collections.abc import Mapping, Sequence
from hashlib import sha256
from html import escape
from pathlib import Path
from string import Template
from typing import Any

from pandas import DataFrame

from sweep.numbers import budget_text, counted
from sweep.ranking.merit import doubtful
from sweep.ranking.question import Question
from sweep.ranking.ranking import Ranking
from sweep.report.figures.storyboard import PARTS
from sweep.report.page.gather import FilesOf, first_ranking, page_data
from sweep.report.tables.design_text import design_labels
from sweep.report.tables.html import html_table, paragraphs
from sweep.report.tables.legend import legend
from sweep.report.tables.sheet import Sheet
from sweep.report.tables.sheets import ranking_sheets
from sweep.whole_file import write_whole

HERE = Path(__file__).parent
PROGRAM = ("rank.js", "link.js", "print.js", "plots.js", "page.js")
IN_HTML = ("failures", "failed", "unloaded", "missing", "about", "config", "total", "designs")
LEFT_OUT = (
    "The page holds {} of {} designs: those that are first for some budget, per gram or per area, "
    "up to the forces of the columns or below some limit, and a sample of the others. Where a "
    "design that is left out may be better, the page says so."
)


def write_page(
    file: str,
    summary: DataFrame,
    question: Question,
    out: Path,
    files_of: FilesOf | None = None,
) -> Path:
    """Write the page of a results file; `question` and `files_of`: of `page_data`."""
    ranking = first_ranking(summary, question)
    data = page_data(file, summary, question, ranking, files_of)
    text = page(data, tables(summary, ranking))
    return write_whole(out, text)


def page(data: Mapping[str, Any], static: str) -> str:
    """The whole page; `static`: HTML that is shown where scripts do not run."""
    script = "\n".join(['"use strict";', *map(_read, PROGRAM)])
    digest = b64encode(sha256(script.encode()).digest()).decode()
    done = counted(data["total"], "case")
    if failed := data["failed"]:
        done += f", {failed} of them failed"
    if late := data["unloaded"]:
        done += f", {late} stopped after their loading, which ranks them"
    return Template(_read("page.html")).substitute(
        title=escape(f"{data['name']}: which lattice is best?"),
        subtitle=escape(f"{data['file']}, {done}"),
        missing=paragraphs(data["missing"]),
        style=_read("page.css"),
        script=script,
        script_hash=f"sha256-{digest}",
        data=_as_script(_of_the_program(data)),
        tables=static,
        failures=_failures(data["failures"], failed, late, data["file"]),
        origin=_origin(data),
    )


def tables(summary: DataFrame, ranking: Ranking) -> str:
    """The best designs of a ranking in words, then tables with their legend."""
    if ranking.failed == ranking.cases:
        return "<p>No case has converged, so there is no ranking.</p>"
    sheets = "".join(html_table(sheet) for sheet in ranking_sheets(ranking, summary))
    notes = paragraphs(legend(ranking).splitlines()) if len(ranking.table) else ""
    return f"{_winners(ranking.table, summary)}{sheets}{notes}"


def _winners(table: DataFrame, summary: DataFrame) -> str:
    """A sentence for each budget and scene."""
    first = table.drop_duplicates(["budget_g", "scene"])
    labels, doubts = design_labels(first, summary), doubtful(first)
    lines = [
        f"The best design{f' up to {budget_text(row.budget_g)}' if row.budget_g > 0.0 else ''}, "
        f"{row.scene}: {label}{', whose result is unreliable' if doubt else ''}."
        for row, label, doubt in zip(first.itertuples(), labels, doubts, strict=True)
    ]
    return "".join(f"<p>{escape(line)}</p>" for line in lines)


def _read(name: str) -> str:
    return (HERE / name).read_text("utf-8")


def _of_the_program(data: Mapping[str, Any]) -> dict[str, Any]:
    """The data for the program: all that the page does not state in HTML."""
    needed = {name: value for name, value in data.items() if name not in IN_HTML}
    return needed | {"parts": list(PARTS.values())}


def _as_script(data: Mapping[str, Any]) -> str:
    """JSON that cannot end the script that contains it."""
    text = json.dumps(data, separators=(",", ":"), allow_nan=False, ensure_ascii=True)
    for letter in "<>&":
        text = text.replace(letter, f"\\u{ord(letter):04x}")
    return text


def _failures(failures: Sequence[Mapping[str, str]], failed: int, late: int, file: str) -> str:
    """The cases that did not converge, with their messages; "" if there is none. failed, late:
    numbers of those that stopped before and after the end of their loading, of which the page may
    have only the first.
    """
    if not failures:
        return ""
    words = [f"{counted(failed, 'case')} failed"] * bool(failed)
    words += [f"{counted(late, 'case')} stopped after the loading"] * bool(late)
    left = failed + late - len(failures)
    notes = (f"{left} more are left out: crumple status {file} says why.",) * (left > 0)
    rows = [list(each.values()) for each in failures]
    table = html_table(Sheet("", list(failures[0]), rows, notes=notes))
    return f'<details class="block"><summary>{", ".join(words)}</summary>{table}</details>'


def _origin(data: Mapping[str, Any]) -> str:
    """File, versions and config."""
    pairs = [("file", data["file"]), *data["about"]]
    listed = "".join(f"<dt>{escape(name)}</dt><dd>{escape(text)}</dd>" for name, text in pairs)
    config = escape(json.dumps(data["config"], indent=1))
    folded = f"<details><summary>Config, in SI</summary><pre>{config}</pre></details>"
    thin = f"Curves have at most {data['points']} points, energies over the path two thirds of them"
    shown, designs = len(data["cases"]), data["designs"]
    kept = f"{len(data['shapes'])} of {shown} designs have their motion in this page"
    lines = [f"{thin}; {kept}."]
    if shown < designs:
        lines += [LEFT_OUT.format(shown, designs)]
    return f"<dl>{listed}</dl>{folded}{paragraphs(lines)}"
