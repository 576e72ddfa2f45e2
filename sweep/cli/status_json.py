"""The status of a results file as JSON, for other programs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pandas import DataFrame


def status_record(file: str, summary: DataFrame, about: Mapping[str, Any]) -> dict[str, Any]:
    """The output of `crumple status`, as a dict of plain values.

    about: the attributes of the file. `failures` has each message with its status and its cases.
    """
    from sweep.columns import ERROR
    from sweep.ranking.rank import model_versions
    from sweep.report.tables.missing_notes import missing_cases
    from sweep.result import Status

    failed = summary[summary["status"] != Status.CONVERGED]
    done = summary.drop(index=failed.index)
    bars = done.filter(regex=ERROR).notna().any(axis=1)
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
        "with_error_bars": int(bars.sum()),
        "model_versions": {str(key): n for key, n in model_versions(summary).items()},
        "other_cases": int(about["other_cases"]),
        "missing_cases": missing_cases(len(summary), about),
        "processor_time_s": float(summary["cpu_s"].sum()),
        "last_run": _text(about, "created"),
        "git_revision": _text(about, "git_revision"),
        "compiler": _text(about, "compiler"),
        "versions": {
            name.removeprefix("version_"): str(about[name])
            for name in about
            if name.startswith("version_")
        },
    }


def _text(about: Mapping[str, Any], name: str) -> str | None:
    return str(about[name]) if name in about else None
