"""The verb `published`: predictions of published crushes beside the measured values, and a user's
own.
"""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from sweep.cli.refusals import ArgumentError, writing
from sweep.cli.terminal import hint, print_sheets, say, say_all
from sweep.published.table import Row
from sweep.whole_file import write_whole

if TYPE_CHECKING:
    from pandas import DataFrame

OF_ADD = ("measure", "measured", "source")
RESULTS = "results/published"
USUAL = "absorbed_energy_J"
AFTERWARDS = "its config has changed since a measured value was entered: no prediction any more"
COLUMN_LIST = "docs/results.md lists them"


def published(arguments: Namespace) -> int:
    """Print the table; with --run repeat its predictions, with --add enter a row of the user.

    Return how many rows have cases that failed, or predictions that could not be reproduced.
    """
    from sweep.published.table import OURS, read_table

    mine = Path(arguments.table)
    if arguments.add:
        _add(arguments, mine)
    elif options := [name for name in OF_ADD if getattr(arguments, name)]:
        raise ArgumentError(f"--{options[0]} belongs to --add")
    others = [mine] if mine.exists() and mine.resolve() != OURS else []
    tables = [OURS, *others]
    rows = [(table, row) for table in tables for row in read_table(table)]
    words = arguments.rows
    requested = [(table, row) for table, row in rows if not words or any(map(row.matches, words))]
    if not requested:
        names = ", ".join(row.name for _, row in rows)
        raise ArgumentError(f"no row of {' '.join(arguments.rows)}; allowed: words of {names}")
    shown, wrong = [row for _, row in requested], 0
    if arguments.run:
        shown, wrong = _repeat(requested, arguments.workers)
    _print(shown, details=bool(arguments.rows))
    if arguments.out:
        _write(shown, Path(arguments.out))
    return wrong


def _print(rows: list[Row], details: bool) -> None:
    """Print the table; details: also the source of each number, and the files to repeat it."""
    from sweep.report.tables.comparison_sheet import comparison_sheet

    print_sheets([comparison_sheet(row.comparison for row in rows)])
    for row in rows if details else []:
        measure = f"{row.measure}, ratio over {row.over}" if row.over else row.measure
        where = f", {row.where}" if row.where else ""
        say(f"{row.name}: {row.config}{where}: {measure}; {row.cases or 'no'} cases")
        place = f", {row.place}" if row.place else ""
        say_all([f"  measured: {row.measured}{place}"] if row.measured else [])


def _write(rows: list[Row], folder: Path) -> None:
    """Write the table and the picture into a folder."""
    from sweep.report.figures.case_plots import blank, save
    from sweep.report.figures.prediction_bars import prediction_bars, size
    from sweep.report.tables.comparison_sheet import comparison_sheet
    from sweep.report.tables.markdown import markdown

    comparisons = [row.comparison for row in rows]
    with writing(folder):
        table = markdown([comparison_sheet(comparisons)])
        text = write_whole(folder / "published.md", table)
        figure = blank(*size(comparisons))
        prediction_bars(figure.subplots(), comparisons)
        say_all([text, save(figure, folder / "published.png")])


def _repeat(rows: list[tuple[Path, Row]], workers: int | None) -> tuple[list[Row], int]:
    """Predict rows anew; return them, and how many failed or differ from the stored predictions.

    A row of a table without a prediction gets this one.
    """
    from sweep.published.predict import NotConvergedError, is_repeated
    from sweep.published.table import read_table, with_row, write_table

    after, wrong = [], 0
    for table, row in rows:
        after.append(row)
        try:
            again, _ = _predicted(row, table, workers)
        except NotConvergedError as error:
            hint([str(error)])
            wrong += 1
            continue
        if not row.low:
            after[-1] = again
            with writing(table.parent, table):
                write_table(table, with_row(read_table(table), again))
            say(f"{row.name}: {again.low} to {again.high}, stored")
        elif not is_repeated(row, again):
            hint([f"{row.name}: now {again.low} to {again.high}, stored {row.low} to {row.high}"])
            wrong += 1
    say(f"{len(rows) - wrong} of {len(rows)} predictions as stored")
    return after, wrong


def _predicted(row: Row, table: Path, workers: int | None) -> tuple[Row, DataFrame]:
    """A row with its prediction, and the results of its cases; missing cases are run."""
    from sweep.published.predict import cases_of, predicted
    from sweep.running.sweep import run_sweep
    from sweep.running.threads import usual_workers
    from sweep.store.read import read_summary

    cases = cases_of(row, table)
    out = f"{RESULTS}/{Path(row.config).stem}.h5"
    run_sweep(cases, out, workers or usual_workers())
    summary = read_summary(out)
    return predicted(row, cases, summary), summary


def _add(arguments: Namespace, mine: Path) -> None:
    """Write a row of the user's table: first its prediction, then its measured value."""
    from sweep.published.table import read_table, with_row, write_table

    rows = read_table(mine) if mine.exists() else []
    text = arguments.measured or ""
    row, number = _question(arguments, mine, "" if text.endswith(".csv") else text)
    row, summary = _predicted(row, mine, arguments.workers)
    if any(old.name == row.name and old.measured and old.ids != row.ids for old in rows):
        hint([f"{row.name}: {AFTERWARDS}"])
    with writing(mine.parent, mine):
        write_table(mine, rows := with_row(rows, row))
    say(f"{mine}: {row.name}: predicted {row.low} to {row.high}")
    if text:
        value = replace(row, measured=number) if number else _of_curve(row, text, summary)
        with writing(mine.parent, mine):
            write_table(mine, with_row(rows, value))


def _question(arguments: Namespace, mine: Path, text: str) -> tuple[Row, str]:
    """The requested row, and the number of a measured value; the row uses the unit of this
    value.
    """
    from sweep.columns import describe_column, in_words, is_column
    from sweep.published.predict import cases_of
    from sweep.published.quantity import split_quantity
    from sweep.published.table import Row

    measure = arguments.measure or USUAL
    if not is_column(measure):
        raise ArgumentError(f"--measure {measure}; allowed: a column of results ({COLUMN_LIST})")
    units = describe_column(measure).units
    number, unit, per = split_quantity(text, units) if text else ("", units, 1.0)
    noun = in_words(measure).removesuffix(f", in {units}")
    name = f"{Path(arguments.add).stem} {measure}"
    row = Row(name, arguments.source or "own", "", "", arguments.add, measure=measure)
    axes = cases_of(row, mine)[0].axes
    varied = dict.fromkeys(key.rpartition(".")[2].replace("_", " ") for key in axes)
    quantity = f"{noun}, {unit}" if unit != "1" else noun
    return replace(row, quantity=quantity, per=f"{per:g}", open=", ".join(varied)), number


def _of_curve(row: Row, file: str, summary: DataFrame) -> Row:
    """The row with the value from a measured curve."""
    from sweep.published.curve import measure_of

    value = measure_of(Path(file), row.measure, summary.iloc[0])
    return replace(row, measured=f"{value:.4g}", place=file)
