"""Output on the terminal: lines, tables that fit its width, rankings with their warnings."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from itertools import zip_longest
from shlex import quote
from subprocess import list2cmdline
from textwrap import wrap
from typing import TYPE_CHECKING, Literal, NamedTuple, TextIO

from sweep.numbers import NOTHING, budget_text, in_unit, text_in
from sweep.plain_text import plain

if TYPE_CHECKING:
    from pandas import DataFrame
    from rich.table import Table

    from sweep.ranking.question import Question
    from sweep.ranking.ranking import Ranking
    from sweep.report.tables.sheet import Sheet

USUAL = 80  # usual width in characters; in wider tables, columns are closer
LATE = ("densification_strain", "highest_densification_strain")  # unknown in a short crush
OF_THE_WHOLE = "The order is by the whole crush; requirements are not."
WIDE = 10_000  # width where no terminal limits it


def print_ranking(file: str, summary: DataFrame, question: Question, brief: bool) -> Ranking:
    """Print the tables of a ranking, and the warnings; return it.

    Legend and further commands are left out if ``brief``.
    """
    from sweep.ranking.rank import answer
    from sweep.report.tables.legend import legend
    from sweep.report.tables.sheets import ranking_sheets

    ranking = answer(summary, question)
    if ranking.failed < ranking.cases and (heading := _heading(question, ranking)):
        say(heading)
    print_sheets(ranking_sheets(ranking, summary))
    if not ranking.table.empty and not brief:
        say_all(_wrapped([legend(ranking)], _width()))
    say_all(warnings(file, ranking))
    say_all([] if brief else nearest_commands(file, ranking, summary))
    return ranking


def version_counts(counts: Mapping[int, int]) -> str:
    """The number of rows of each version of the model, in words."""
    words = ", ".join(f"{version} ({count})" for version, count in counts.items())
    return f"rows of model version {words}"


def warnings(file: str, ranking: Ranking) -> Iterator[str]:
    """Warnings about cases for a reader of the ranking."""
    from sweep.report.tables.missing_notes import incomplete
    from sweep.result import HOW_TO_RENEW
    from sweep.store.read import read_attributes

    about = read_attributes(file)
    yield from incomplete(ranking.cases, about)
    if others := about["other_cases"]:
        yield (
            f"{others} of {ranking.cases} cases belong to other configs than the last run; "
            "they are ranked too. To keep configs apart, give each its own --out or name."
        )
    if len(ranking.versions) > 1:
        yield f"Ranked together: {version_counts(ranking.versions)}; {HOW_TO_RENEW}."
    if ranking.without_bar:
        cases_have = _counted(ranking.without_bar, "ranked case")
        yield f"{cases_have} no error bar: placed by value alone."
    if ranking.unranked:
        late = " Those that did not densify in their crush may lead." if ranking.by in LATE else ""
        yield f"{_counted(ranking.unranked, 'case')} no {ranking.by} and cannot be ranked.{late}"
    if ranking.pointed:
        some = f"In {ranking.pointed} of {ranking.cases} cases some walls end in points"
        yield f"{some}, not in solid joints: see solid_joint_share."
    if ranking.unloaded:
        some = f"{ranking.unloaded} of {ranking.cases} cases stopped after the loading"
        yield f"{some}, which ranks them: crumple status {file} says why"
    if ranking.failed:
        some = f"{ranking.failed} of {ranking.cases} cases failed"
        yield f"{some}: crumple status {file} says why"


def next_commands(file: str, ranking: Ranking) -> Iterator[str]:
    """The place of the results, and the commands that a user may want next.

    If no design is ranked, `nearest_commands` says more.
    """
    yield f"results: {file}"
    name = quoted(file)
    if len(ranking.table):
        yield f"next: crumple show {name} 1: pictures of the first design"
        folder = quoted(file.removesuffix(".h5"))
        yield f"      crumple rank {name} --out {folder}: tables and pictures"
    elif ranking.failed == ranking.cases:
        yield f"next: crumple status {name}: what failed, and why"


def nearest_commands(file: str, ranking: Ranking, summary: DataFrame) -> Iterator[str]:
    """How to show and print the nearest design of the first scene in which none has a place."""
    from sweep.report.tables.design_text import short_id

    placed = {*ranking.table["scene"]}
    for label in ranking.scenes:
        if label not in placed and (instead := ranking.instead(label)):
            word, row = instead
            name, case_id = quoted(file), short_id(row["case_id"].item(), summary["case_id"])
            yield f"to see the {word}: crumple show {name} {case_id}"
            yield f"to print it: crumple export {name} {case_id} --to part.stl"
            return


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun} has" if count == 1 else f"{count} {noun}s have"


def _heading(question: Question, ranking: Ranking) -> str:
    """The question that the tables answer, in one or two lines."""
    from sweep.columns import in_words, less_is_better
    from sweep.loading_modes import MODES, has
    from sweep.ranking.merit import WHOLE_CRUSH, is_period
    from sweep.report.tables.requirement_notes import of_which

    by = ranking.by
    usual = {ranking.energy: "most energy", ranking.per_gram: "most energy per gram"}
    modes = {row["loading_mode"].item() for row in ranking.lightest.values()}
    if len(modes) == 1 and (least := MODES[modes.pop()].least):
        usual[least.column] = least.order
    order = usual.get(by, f"{'least' if less_is_better(by) else 'most'} {in_words(by)}")
    lines = [] if ranking.table.empty else [f"Best first: {order}."]
    crushed = ranking.table.empty or has(ranking.table, "driven").any()
    if (force := question.allowed_force) and crushed:
        lines.append(f"Energy is counted until the force of {of_which(ranking)} exceeds {force}.")
        if by in WHOLE_CRUSH:
            lines.append(OF_THE_WHOLE)
    elif force:
        lines.append(f"The force of {force} has no effect: without a crush no energy is ranked.")
    if len(ranking.budgets_g) == 1:
        budget = question.budgets[0]
        text = budget if isinstance(budget, str) else budget_text(in_unit(budget, "g"))
        lines.insert(0, f"At most {text}.")
    if panel := question.panel:
        sides = " x ".join(_quantity_text(side, "mm") for side in panel)
        periods = is_period(ranking.designs)
        how = "tiled with separate specimens"
        if periods.any():
            how = (
                "in one piece" if periods.all() else f"{how}, or in one piece where sides are tied"
            )
        lines.insert(0, f"Panel of {sides}, {how}.")
    return " ".join(lines)


def _quantity_text(value: float | str, unit: str) -> str:
    """A quantity as the user writes it, or an SI number in a unit."""
    return value if isinstance(value, str) else text_in(value, unit)


def print_sheets(sheets: Iterable[Sheet]) -> None:
    """Print tables that fit the terminal, with a blank line before each and after the last."""
    from rich.console import Console

    console, limit = Console(), _width()
    console.width = limit or WIDE
    for sheet in sheets:
        say("")
        shown = fitted(_plain(sheet), limit)
        flush()  # where the reader has closed the pipe, a capture would exit
        with console.capture() as title:
            if sheet.title:
                console.print(plain(sheet.title), style="bold", markup=False, highlight=False)
        lines = [title.get()]
        if sheet.heads:
            console.width = max(limit or 0, WIDE)  # rich would truncate numbers
            with console.capture() as heads:
                console.print(_headed(shown))
            console.width = limit or WIDE
            lines += [heads.get(), *_lines(shown)]
        write(sys.stdout, "".join(lines))
        say_all(_wrapped(sheet.notes, limit))
        say_all(_left_out(sheet, shown.sheet, limit or WIDE))
    say("")


def _width() -> int | None:
    """Characters in a line of the terminal; None where no terminal limits them."""
    from rich.console import Console

    console = Console()
    return console.width if console.is_terminal or "COLUMNS" in os.environ else None


def _wrapped(texts: Iterable[str], limit: int | None) -> Iterator[str]:
    """Lines of texts, those that are longer than the limit broken at blanks."""
    most = limit or WIDE
    for line in (line for text in texts for line in text.split("\n")):
        yield from [line] if len(line) <= most else wrap(line, most, break_on_hyphens=False)


def _plain(sheet: Sheet) -> Sheet:
    """A table without characters that control a terminal."""
    heads, *rows = [[plain(text) for text in texts] for texts in [sheet.heads, *sheet.rows]]
    return sheet._replace(heads=heads, rows=rows)


class Fitted(NamedTuple):
    """A table fitted to a terminal: its heads on several lines, the widths of its columns, and the
    blanks between them.
    """

    sheet: Sheet
    heads: list[str]
    widths: list[int]
    gap: int

    @property
    def width(self) -> int:
        """Width of the whole table."""
        return sum(self.widths) + self.gap * (len(self.widths) - 1)


def fitted(sheet: Sheet, limit: int | None) -> Fitted:
    """A table in at most ``limit`` characters, None for any number; numbers are never truncated.

    In a table wider than the limit, or `USUAL` without one, columns are closer. If it is still
    wider, heads have one word per line, then texts continue on a second line, then columns that are
    `spare` are left out. If that is not enough, the terminal wraps its lines.
    """
    usual, limit = limit or USUAL, limit or WIDE
    table = _laid_out(sheet, by_words=False, gap=2)
    if table.width > usual:
        table = table._replace(gap=1)
    if table.width > limit:
        table = _folded(_laid_out(sheet, by_words=True, gap=1), limit)
    spare = iter(sheet.spare)
    while table.width > limit and (head := next(spare, None)):
        table = _folded(_laid_out(table.sheet.without(head), by_words=True, gap=1), limit)
    return table


def _laid_out(sheet: Sheet, by_words: bool, gap: int) -> Fitted:
    """A table with each text on one line; heads have their unit on the second line."""
    heads = [_in_lines(head, by_words) for head in sheet.heads]
    columns = zip(heads, sheet.columns, strict=True)
    widths = [max(map(len, [*head.split("\n"), *texts])) for head, texts in columns]
    return Fitted(sheet, heads, widths, gap)


def _in_lines(head: str, by_words: bool) -> str:
    """A head with its unit, or every word, on a line of its own."""
    if by_words:
        return head.replace(" ", "\n").replace("_", "_\n")
    return "\n".join(head.rsplit(" ", 1))


def _folded(table: Fitted, limit: int) -> Fitted:
    """A table whose longest texts continue on further lines, so that it fits the limit if it
    can.
    """
    widths, columns = list(table.widths), table.sheet.columns
    least = [
        max(len(word) for text in [head.replace("\n", " "), *texts] for word in text.split(" "))
        if _is_text(texts)
        else width
        for head, texts, width in zip(table.heads, columns, widths, strict=True)
    ]
    excess = table.width - limit
    while excess > 0 and widths != least:
        k = max(range(len(widths)), key=lambda k: (widths[k] > least[k], widths[k]))
        widths[k] -= 1
        excess -= 1
    return table._replace(widths=widths)


def _is_number(texts: list[str]) -> bool:
    return all(text[:1] in f"0123456789->?{NOTHING}" and " x " not in text for text in texts)


def _is_text(texts: list[str]) -> bool:
    """Whether a column may continue on a second line."""
    return not _is_number(texts) and not any(" x " in text for text in texts)


def _left_out(sheet: Sheet, shown: Sheet, limit: int) -> Iterator[str]:
    """Lines about the columns that are not shown."""
    missing = [head for head in sheet.heads if head not in shown.heads]
    if missing:
        missed = f"Hidden in this narrow terminal: {', '.join(missing)}."
        yield from wrap(f"{missed} A wider one shows them, and so does {sheet.elsewhere}.", limit)


def _headed(table: Fitted) -> Table:
    """The heads of a table, with the line below them."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    grid = Table(box=box.SIMPLE_HEAD, show_edge=False, padding=(0, table.gap - 1, 0, 0))
    for head, texts, width in zip(table.heads, table.sheet.columns, table.widths, strict=True):
        grid.add_column(Text(head), justify=_side(texts), width=width, overflow="fold")
    return grid


def _lines(table: Fitted) -> Iterator[str]:
    """The rows of a table as rich would print them, in 0.25 ms each."""
    texts = zip(*map(_aligned, table.sheet.columns, table.widths), strict=True)
    for i, row in enumerate(texts):
        if i in table.sheet.opens and i:
            yield f"{' ' * (table.width + table.gap - 1)}\n"
        for line in zip_longest(*row):
            cells = (text or " " * width for text, width in zip(line, table.widths, strict=True))
            yield (" " * table.gap).join(cells) + " " * (table.gap - 1) + "\n"


def _aligned(texts: list[str], width: int) -> Iterator[list[str]]:
    """The lines of each text of a column, as wide as the column."""
    from rich.cells import cell_len
    from rich.console import Console
    from rich.text import Text

    console, side = Console(), _side(texts)
    for text in texts:
        if len(text) <= width and text.isascii() and text.isprintable():
            yield [text.rjust(width) if side == "right" else text.ljust(width)]
            continue
        lines = [line.plain for line in Text(text, overflow="fold").wrap(console, width)]
        blanks = [" " * (width - cell_len(line)) for line in lines]
        yield [b + t if side == "right" else t + b for t, b in zip(lines, blanks, strict=True)]


def _side(texts: list[str]) -> Literal["left", "right"]:
    return "right" if _is_number(texts) else "left"


def quoted(name: str) -> str:
    """The name of a file, quoted for the shells of this system."""
    return list2cmdline([name]) if sys.platform == "win32" else quote(name)


def flush() -> None:
    """Write what stdout has buffered, to the same end as `write`."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        silence(sys.stdout)


def silence(stream: TextIO) -> None:
    """Discard buffered and later output, so that Python reports no second error at the exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def write(stream: TextIO, text: str) -> None:
    """Write to stdout or stderr. A reader that has closed the pipe changes neither work nor exit
    status.
    """
    try:
        stream.write(text)
    except BrokenPipeError:
        silence(stream)


def say(text: object, end: str = "\n") -> None:
    """Print a line."""
    write(sys.stdout, f"{plain(text)}{end}")


def say_all(lines: Iterable[object]) -> None:
    """Print lines."""
    for line in lines:
        say(line)


def hint(lines: Iterable[str]) -> None:
    """Print lines on stderr, after the output on stdout."""
    flush()
    for line in lines:
        write(sys.stderr, f"{plain(line)}\n")
