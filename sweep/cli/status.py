"""The verb `status`: counts, failures and their messages, run time and origin of a results file, as
text or as JSON for other programs.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from sweep.cli.terminal import say_all, version_counts
from sweep.columns import ERROR
from sweep.numbers import counted
from sweep.report.tables.missing_notes import missing_cases

if TYPE_CHECKING:
    from pandas import DataFrame

NEEDED = ("case_id", "status", "message", "model_version", "git_revision", "cpu_s")
IDS = 3  # cases shown for each kind of failure
NUMBER = re.compile(r"(?:(?<!\w)-)?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
OF_A_PACKAGE = "version_"  # begins the attribute with the version of a package


def print_status(file: str, as_json: bool) -> bool:
    """Print the status of a results file; return whether all of its cases converged."""
    from sweep.store.read import read_attributes, read_summary

    summary = read_summary(file, _is_needed)
    record = status_record(file, summary, read_attributes(file))
    say_all([json.dumps(record, indent=2)] if as_json else _lines(record, summary))
    return not record["failed"]


def _is_needed(column: str) -> bool:
    """Whether the status of a file needs a column."""
    return column in NEEDED or bool(ERROR.fullmatch(column))


def status_record(file: str, summary: DataFrame, about: Mapping[str, Any]) -> dict[str, Any]:
    """The status as a dict of plain values.

    about: the attributes of the file. `failures` has each message with its status and its cases.
    """
    from sweep.ranking.rank import model_versions

    failed = failed_cases(summary)
    done = summary.drop(index=failed.index)
    kinds = failed.groupby([failed["status"], failed["message"]], sort=False)["case_id"]
    counts = summary["status"].value_counts()
    return {
        "file": file,
        "cases": len(summary),
        "converged": len(done),
        "failed": len(failed),
        "by_status": {str(name): int(count) for name, count in counts.items()},
        "failures": [
            {"status": str(status), "message": str(message), "cases": list(map(str, ids))}
            for (status, message), ids in kinds
        ],
        "with_error_bars": int(done.filter(regex=ERROR).notna().any(axis=1).sum()),
        "model_versions": {str(key): n for key, n in model_versions(summary).items()},
        "other_cases": int(about["other_cases"]),
        "missing_cases": missing_cases(len(summary), about),
        "processor_time_s": float(summary["cpu_s"].sum()),
        "last_run": about.get("created"),
        "git_revision": about.get("git_revision"),
        "compiler": about.get("compiler"),
        "versions": {
            name.removeprefix(OF_A_PACKAGE): str(about[name])
            for name in about
            if name.startswith(OF_A_PACKAGE)
        },
    }


def _lines(record: Mapping[str, Any], summary: DataFrame) -> Iterator[str]:
    """The status as text."""
    missing = record["missing_cases"]
    more = f"; {missing} of the last run are missing" if missing else ""
    yield f"{record['file']}: {counted(record['cases'], 'case')}{more}"
    yield from (f"{count:7d} {name}" for name, count in record["by_status"].items())
    yield from _failures(record["file"], failed_cases(summary))
    if any(map(ERROR.fullmatch, summary)):
        finished = f"{record['converged']} finished cases"
        yield f"{record['with_error_bars']} of {finished} have error bars"
    yield from _versions(summary)
    if others := record["other_cases"]:
        yield f"{others} cases belong to other configs than the last run"
    yield f"{record['processor_time_s']:.4g} s of processor time in all"
    yield f"last run {record['last_run'] or '?'}, revision {record['git_revision'] or '?'}"
    yield ", ".join(f"{name} {version}" for name, version in record["versions"].items())
    if compiler := record["compiler"]:
        yield f"kernels: {compiler} compiler"


def _failures(file: str, failed: DataFrame) -> Iterator[str]:
    """A line for each kind of failure with its first cases, and the command that lists the
    others.
    """
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
