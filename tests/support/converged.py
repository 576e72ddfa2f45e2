"""Ends a study when one of its cases has not converged.

It ends with exit status 1, the case and its message.
"""

import sys

from sweep.running.sweep import run_sweep
from sweep.simulation.simulate import simulate
from sweep.store.read import read_summary


def demand(rows):
    """Exit unless all cases have converged. rows: their summaries, by name; `axes` if known."""
    stopped = [row for row in rows if row["status"] != "converged"]
    if stopped:
        sys.exit("\n".join(map(_sentence, stopped)))


def _sentence(row):
    axes = "".join(f", {key} = {value}" for key, value in row.get("axes", {}).items())
    return f"case {row['case_id']}{axes}: {row['message'] or row['status']}"


def converged(case):
    """The result of a case."""
    result = simulate(case)
    demand([{**result.summary, "axes": case.axes}])
    return result


def swept(cases, file, simulate=None):
    """The summary of all cases; only cases that the file lacks are run."""
    run_sweep(cases, file, simulate=simulate)
    rows = read_summary(file)
    rows = rows[rows["case_id"].isin({case.case_id for case in cases})]
    demand(rows.to_dict("records"))
    return rows
