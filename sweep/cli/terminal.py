"""Output on the terminal: lines, tables that fit its width, rankings with their warnings."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pandas import DataFrame
    from rich.table import Table

    from sweep.ranking.ranking import Ranking
    from sweep.report.sheets import Sheet

WIDTH = 120  # least width of a table; a narrower terminal wraps its lines, so no text is lost


def print_ranking(file: str, summary: DataFrame, question: Mapping[str, Any]) -> None:
    """Print the tables of a ranking, their legend, and the warnings."""
    from sweep.ranking.rank import ranked
    from sweep.report.sheets import legend, ranking_sheets

    ranking = ranked(summary, **question)
    if ranking.failed < ranking.cases:
        say(_heading(question, ranking))
        print_sheets(ranking_sheets(ranking, summary))
    if not ranking.table.empty:
        say(legend(ranking))
    say_all(warnings(file, ranking))


def version_counts(counts: Mapping[int, int]) -> str:
    """The number of rows of each version of the model, in words."""
    words = ", ".join(f"{version} ({count})" for version, count in counts.items())
    return f"rows of model version {words}"


def warnings(file: str, ranking: Ranking) -> Iterator[str]:
    """Sentences about cases that a reader of the ranking should know of."""
    from sweep.result import HOW_TO_RENEW
    from sweep.store.read import read_attributes

    if others := read_attributes(file).get("other_cases", 0):
        yield (
            f"{others} of {ranking.cases} cases belong to other configs than that of the last run; "
            "they are ranked too. To keep configs apart, give each its own --out or name."
        )
    if len(ranking.versions) > 1:
        yield f"Ranked together: {version_counts(ranking.versions)}; {HOW_TO_RENEW}."
    if ranking.without_bar:
        cases_have = _counted(ranking.without_bar, "ranked case")
        yield f"{cases_have} no error bar: placed by value alone."
    if ranking.unranked:
        yield f"{_counted(ranking.unranked, 'case')} no {ranking.by} and so no place."
    if ranking.pointed:
        some = f"In {ranking.pointed} of {ranking.cases} cases some walls end in points"
        yield f"{some}, not in solid joints: see solid_joint_share."
    if ranking.failed:
        yield f"{ranking.failed} of {ranking.cases} cases failed: crumple status {file} says why"


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun} has" if count == 1 else f"{count} {noun}s have"


def _heading(question: Mapping[str, Any], ranking: Ranking) -> str:
    """The question that the tables answer, in one or two lines."""
    from sweep.result import less_is_better

    by = ranking.by
    usual = {ranking.energy: "most energy", ranking.per_gram: "most energy per gram"}
    order = usual.get(by, f"least {by}" if less_is_better(by) else f"most {by}")
    lines = [f"Best first: {order}."]
    crushed = (ranking.table["loading_mode"] == "displacement").any()
    if (force := question.get("allowed_force")) and crushed:
        lines.append(f"Energy is counted until the force of a {ranking.per} exceeds {force}.")
    elif force:
        lines.append(f"The force of {force} has no effect: without a crush no energy is ranked.")
    if (budgets := question["budget"]) and len(budgets) == 1:
        lines.insert(0, f"At most {_written(budgets[0], 1e3, 'g')}.")
    if panel := question["panel"]:
        sides = " x ".join(_written(side, 1e3, "mm") for side in panel)
        lines.insert(0, f"Panel of {sides}, filled with specimens side by side.")
    return " ".join(lines)


def _written(value: float | str, scale: float, unit: str) -> str:
    """A quantity as the user writes it, or an SI number in the unit of a maker."""
    return value if isinstance(value, str) else f"{scale * value:.4g} {unit}"


def print_sheets(sheets: Iterable[Sheet]) -> None:
    """Print tables, each after a blank line."""
    from rich.console import Console

    console = Console()
    width, console.width = console.width, max(console.width, WIDTH)
    for sheet in sheets:
        say("")
        with console.capture() as shown:
            if sheet.title or sheet.heads:
                console.print(sheet.title, style="bold", markup=False, highlight=False)
            if sheet.heads:
                console.print(_terminal_table(sheet, width))
        say(shown.get(), end="")
        say_all(sheet.notes)
    say("")


def _terminal_table(sheet: Sheet, width: int) -> Table:
    """A table of rich without title and notes, which fits into `width` columns if possible.

    The unit of a head is on a second line; in a table that is too wide, columns are closer.
    """
    from rich import box
    from rich.table import Table

    from sweep.numbers import NOTHING

    heads = ["\n".join(head.rsplit(" ", 1)) for head in sheet.heads]
    columns = [
        [*head.split("\n"), *texts] for head, texts in zip(heads, sheet.columns, strict=True)
    ]
    natural = sum(max(map(len, texts)) + 2 for texts in columns) - 2
    table = Table(
        box=box.SIMPLE_HEAD,
        show_edge=False,
        padding=(0, 1 if natural <= width else 0, 0, 0),
    )
    for head, texts in zip(heads, sheet.columns, strict=True):
        right = all(text[:1] in f"0123456789->?{NOTHING}" and " x " not in text for text in texts)
        table.add_column(head, justify="right" if right else "left", no_wrap=True)
    for i, row in enumerate(sheet.rows):
        if i in sheet.opens and i:
            table.add_section()
        table.add_row(*row)
    return table


def say(text: object, end: str = "\n") -> None:
    """Print a line."""
    sys.stdout.write(f"{text}{end}")


def say_all(lines: Iterable[object]) -> None:
    """Print lines."""
    for line in lines:
        say(line)
