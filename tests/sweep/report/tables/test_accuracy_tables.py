"""Accuracy studies in words: recommended settings, unresolved measures, failed cases."""

import re

import pytest

from sweep.report.tables.accuracy_tables import (
    accuracy_sheets,
    answers,
    scene_title,
)
from tests.support.results.made_up_studies import all_steps, made_up, study


def test_answer_is_the_cheapest_setting(tmp_path):
    (found,) = study(tmp_path, all_steps("backward_euler", "bdf2"))
    text = " ".join(answers(found))
    assert "bdf2, 62.5 us: absorbed energy 50.0 mJ ± 0.16 %" in text
    assert re.search("below 1 % in absorbed energy, peak force and .* bdf2, 0.125 ms: 17.6 s", text)
    assert re.search("below 0.1 % in strain over .* bdf2, 62.5 us: 35.2 s", text)
    assert list(found.settings["front"]) == [*[True] * 4, *[False] * 3, *[True] * 3]


def test_what_finer_steps_do_not_settle_is_not_resolved(tmp_path):
    rows = all_steps("bdf2")
    for row, force in zip(rows, [20.0, 25.0, 30.0, 22.0, 27.0], strict=True):
        row["peak_force_N"] = force
    (found,) = study(tmp_path, rows)
    (sheet, orders) = accuracy_sheets(found, "made up")
    assert found.resolved == ("energy", "path")
    (unsettled,) = (line for line in answers(found) if line.startswith("Not resolved: "))
    assert re.search(r"peak force\b.* 30 %", unsettled)
    assert "below 1 % in absorbed energy and strain over time" in " ".join(answers(found))
    assert [row[sheet.heads.index("peak %")] for row in sheet.rows] == ["< 30"] * 5
    assert orders.rows[0][2:] == ["2.00", "–", "2.00"]


def test_scenes_are_studied_apart(tmp_path):
    rows = [row | {"loading.force": row["force_N"]} for row in all_steps("bdf2")]
    more = {"loading.force": 7.0, "force_N": 7.0}
    thrice = [row | more | {"absorbed_energy_J": 3.0 * row["absorbed_energy_J"]} for row in rows]
    found = study(tmp_path, rows + thrice)
    titles = [scene_title(one, "trial") for one in found]
    scene = "trial: dead load of {} N, glued platens, solver integrator bdf2"
    assert titles == [scene.format(force) for force in (5, 7)]
    energies = [one.references["energy"].value[0] for one in found]
    assert energies == pytest.approx([0.05, 0.15], rel=1e-4)


def test_failed_settings_keep_their_row(tmp_path):
    rows = all_steps("backward_euler", "bdf2")
    rows[0] |= {"status": "stopped", "message": "it diverged at once; why"}
    (found,) = study(tmp_path, rows)
    sheet, _ = accuracy_sheets(found, "made up")
    assert sheet.rows[0][2:5] == ["stopped"] * 3
    assert sheet.notes[-1] == "Failed: 1 setting; the first: it diverged at once; why."
    assert not found.settings["front"].iloc[0]
    assert study(tmp_path / "none", [row | {"status": "stopped"} for row in rows]) == []


def test_methods_of_one_size_have_no_limit(tmp_path):
    (found,) = study(tmp_path, [made_up("bdf2", 1e-3), made_up("newmark", 5e-4)])
    assert "Not resolved: peak force, whose limit is unknown." in answers(found)
    sheet, _ = accuracy_sheets(found, "made up")
    assert [row[sheet.heads.index("peak %")] for row in sheet.rows] == ["–"] * 2
