"""The status of a results file for other programs; its text: `test_verbs.py`."""

import json

from sweep.cli.status import status_record
from sweep.result import MODEL_VERSION
from tests.support.results.specimens import summary

COUNTS = {"other_cases": 0, "asked_cases": 1}


def test_record_counts_cases_and_gathers_failures():
    stopped = {"status": "stopped", "message": "too long"}
    table = summary({}, stopped, stopped | {"message": "too short"}, stopped)
    about = {"created": "today", "version_numpy": "9.9", "other_cases": 2, "asked_cases": 9}
    record = json.loads(json.dumps(status_record("a.h5", table, about)))
    assert record["by_status"] == {"stopped": 3, "converged": 1}
    assert record["failures"] == [
        {"status": "stopped", "message": "too long", "cases": [f"{1:016x}", f"{3:016x}"]},
        {"status": "stopped", "message": "too short", "cases": [f"{2:016x}"]},
    ]
    assert record["model_versions"] == {str(MODEL_VERSION): 4}
    assert record["processor_time_s"] == 8.0
    assert (record["other_cases"], record["last_run"]) == (2, "today")
    assert record["missing_cases"] == 9 - (4 - 2)
    assert (record["git_revision"], record["versions"]) == (None, {"numpy": "9.9"})


def test_error_bars_count_where_a_case_has_one():
    table = summary({"error_absorbed_energy_J": 0.1}, {"error_absorbed_energy_J": float("nan")})
    assert status_record("a.h5", table, COUNTS)["with_error_bars"] == 1
    assert status_record("a.h5", summary({}), COUNTS)["with_error_bars"] == 0
