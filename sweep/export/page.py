"""The page of a sweep, which hands out the first designs as files to print."""

from functools import partial
from pathlib import Path

from pandas import DataFrame

from sweep.export.export import Exported, printed
from sweep.ranking.question import Question
from sweep.report.page.write import write_page


def export_page(file: str, summary: DataFrame, question: Question, out: Path) -> Exported:
    """Write the page of a results file (`write_page`). Where what draws designs is not installed,
    it has no files to print, and a sentence says so.
    """
    try:
        from sweep.export import design, solid  # noqa: F401
    except ModuleNotFoundError as error:
        note = f"the page has no files to print: {error}"
        return Exported(write_page(file, summary, question, out), [note])
    return Exported(write_page(file, summary, question, out, partial(printed, file)), [])
