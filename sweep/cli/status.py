"""The verb `status`: counts, failures and their messages, run time and origin of a results file."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from sweep.cli.terminal import say, say_all, version_counts

if TYPE_CHECKING:
    from pandas import DataFrame

NEEDED = ("case_id", "status", "message", "model_version", "git_revision", "cpu_s")
IDS = 3  # cases shown for each kind of failure
NUMBER = re.compile(r"(?:(?<!\w)-)?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def print_status(file: str, as_json: bool) -> bool:
    """Print the status of a results file; return whether all of its cases converged."""
    from sweep.cli.status_json import status_record
    from sweep.numbers import counted
    from sweep.report.tables.missing_notes import missing_cases
    from sweep.store.read import read_attributes, read_summary

    summary, about = read_summary(file, _is_needed), read_attributes(file)
    if as_json:
        say(json.dumps(status_record(file, summary, about), indent=2))
        return failed_cases(summary).empty
    counts = summary["status"].value_counts()
    missing = missing_cases(len(summary), about)
    more = f"; {missing} of the last run are missing" if missing else ""
    say(f"{file}: {counted(len(summary), 'case')}{more}")
    say_all(f"{count:7d} {name}" for name, count in counts.items())
    say_all(_failures(file, summary))
    say_all(_bars(summary))
    say_all(_versions(summary))
    if others := about["other_cases"]:
        say(f"{others} cases belong to other configs than the last run")
    say(f"{summary['cpu_s'].sum():.4g} s of processor time in all")
    versions = {name.removeprefix("version_"): about[name] for name in about if "version_" in name}
    say(f"last run {about.get('created', '?')}, revision {about.get('git_revision', '?')}")
    say(", ".join(f"{name} {version}" for name, version in versions.items()))
    if "compiler" in about:
        say(f"kernels: {about['compiler']} compiler")
    return failed_cases(summary).empty


def _is_needed(column: str) -> bool:
    """Whether the status of a file needs a column."""
    from sweep.columns import ERROR

    return column in NEEDED or bool(ERROR.fullmatch(column))


def _failures(file: str, summary: DataFrame) -> Iterator[str]:
    """A line for each kind of failure with its first cases, and the command that lists the
    others.
    """
    failed = failed_cases(summary)
    kind = failed["message"].str.replace(NUMBER, "#", regex=True)
    for _, rows in failed.groupby([failed["status"], kind], sort=False):
        cases = ", ".join(rows["case_id"].head(IDS))
        more = f" and {len(rows) - IDS} more" if len(rows) > IDS else ""
        yield f"{len(rows)} x {_in_common(list(rows['message']))} (case {cases}{more})"
    if len(failed):
        yield f"crumple show {file} lists all ids and statuses; with an id, it says why"


def _in_common(messages: list[str]) -> str:
    """One sentence for messages that differ only in their numbers, which become ranges."""
    columns = zip(*map(NUMBER.findall, messages), strict=True)
    ranges = (sorted({*figures}, key=float) for figures in columns)
    texts = (
        f"{figures[0]} to {figures[-1]}" if len(figures) > 1 else figures[0] for figures in ranges
    )
    return NUMBER.sub(lambda _: next(texts), messages[0])


def _bars(summary: DataFrame) -> list[str]:
    """A line with the number of cases that have error bars, if there are such columns."""
    from sweep.columns import ERROR

    bars = summary.drop(index=failed_cases(summary).index).filter(regex=ERROR)
    count = bars.notna().any(axis=1).sum()
    return [f"{count} of {len(bars)} finished cases have error bars"] if bars.columns.size else []


def _versions(summary: DataFrame) -> Iterator[str]:
    """Lines about rows of other versions of the model, and of several revisions of the source."""
    from sweep.ranking.rank import model_versions
    from sweep.result import HOW_TO_RENEW, MODEL_VERSION

    counts = model_versions(summary)
    if counts.keys() - {MODEL_VERSION}:
        older = f"; {HOW_TO_RENEW}" if min(counts) < MODEL_VERSION else ""
        yield f"{version_counts(counts)}{older}"
    revisions = summary["git_revision"].replace("", "a revision not recorded").value_counts()
    if len(revisions) > 1:
        yield "computed with " + ", ".join(f"{name} ({n})" for name, n in revisions.items())


def failed_cases(summary: DataFrame) -> DataFrame:
    """The rows of the cases that did not converge."""
    from sweep.result import Status

    return summary[summary["status"] != Status.CONVERGED]
