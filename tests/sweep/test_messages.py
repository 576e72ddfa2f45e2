"""The sentences that people read, all in one file, by the occasion on which they appear.

`python -m tests.sweep.test_messages` writes them again: read the difference, then commit it. Other
tests assert keys, values and what is allowed.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest
from numpy import nan
from pandas import DataFrame

from kernels.solve import outcomes
from sweep.cli.find_case import by_number
from sweep.cli.refusals import ArgumentError
from sweep.cli.terminal import warnings
from sweep.config.case import Case
from sweep.config.kinds.solver import Arcs
from sweep.ranking.question import Question
from sweep.ranking.rank import answer, ranked
from sweep.ranking.spread import AS_GIVEN, FINE, Spread
from sweep.report.figures.design_style import budget_winners
from sweep.report.tables.design_text import about_direction
from sweep.report.tables.legend import legend
from sweep.report.tables.search_sheets import finalist_sheet
from sweep.report.tables.sheets import ranking_sheets
from sweep.report.tables.spread_sheets import spread_sheets
from sweep.simulation import failures
from tests.support.results.specimens import CRUSHES, HIT, IMPACTS, designs, summary

GOLDEN = Path(__file__).parents[1] / "golden" / "messages.txt"
LOAD = {"loading_mode": "force", "peak_strain": 0.2, "force_N": 5.0}
RISING = CRUSHES.assign(densification_strain=nan)
SUNK = IMPACTS.assign(stroke_left_m=[-1e-3, 0.0])
PANEL = {"panel": ("130 mm", "50 mm")}  # 50 specimens
RELAXING = {"material_memory": "relaxes", "material": "mine"}
YIELDING = {"material_memory": "yields"}
CASE = Case.of(loading=dict(mode="displacement"), solver=dict(load_steps=200))
PATH = CASE.model_copy(update={"solver": Arcs(arc_length=1e-3)})
TIMED = Case.of(loading=dict(mode="displacement", speed=1.0))
STRUCK = Case.of(loading=dict(mode="impact"), solver=dict(time_step=1e-3))
BARS = {"error_absorbed_energy_until_packed_J": 0.3, "error_peak_force_until_packed_N": 0.0}
BARS |= {"correction_absorbed_energy_until_packed_J": [0.3, 0.0, -0.3]}
BARS |= {"correction_peak_force_until_packed_N": 0.0}
FORCES = {"max_force": "10 N", "min_absorbed": "0.35 J"}


def required(table, question, **requirements):
    return table, question | {"require": requirements}


STOPPED = {
    "status": "stopped",
    "loaded": 0,
    "message": "the solution diverged while loading, at strain 0.2 after 80 steps; try smaller "
    "steps or a smaller load (tried without success: solver.load_steps = 800)",
}
RANKINGS = {
    "force that no impact meets": required(IMPACTS, {}, max_force="60 N"),
    "panel, several requirements": required(
        CRUSHES,
        PANEL | {"per": "panel"},
        max_force="1 kN",
        max_mass="0.2 kg",
        min_absorbed="6 J",
    ),
    "a design fails several": required(CRUSHES, {}, max_force="20 N", max_mass="1 g"),
    "all fulfil": required(CRUSHES, {}, max_mass="9 g"),
    "mass that none has": required(CRUSHES, {}, max_mass="0.5 g"),
    "energy that none absorbs": required(CRUSHES, {}, min_absorbed="1 J"),
    "stroke just missed": required(CRUSHES, {}, max_stroke="6.747 mm"),
    "two requirements missed": required(CRUSHES, {}, **FORCES),
    "nearest is not the best in energy": required(
        CRUSHES, {}, max_force="10 N", min_absorbed="0.5 J"
    ),
    "each budget": required(CRUSHES, {"budget": ["1 g", "2 g", "3 g"]}, min_absorbed="0.38 J"),
    "lightest above the budgets": required(
        CRUSHES, {"budget": ["1 g", "1.5 g", "2 g"]}, min_absorbed="0.38 J"
    ),
    "doubtful design passed over": required(SUNK, {}, max_force="60 N"),
    "doubtful design alone": required(SUNK[:1], {}, max_force="60 N"),
    "doubtful design fulfils": required(SUNK, {}, max_force="80 N"),
    "coarse steps fulfil": required(
        CRUSHES.assign(load_step_error=[0.004, 0.006, 0.02]), {}, max_force="1 kN"
    ),
    "limit within the uncertainty of values": required(
        CRUSHES.assign(peak_step_error=0.5), {}, max_force="70 N"
    ),
    "longer crush": required(RISING, {}, min_absorbed="0.42 J"),
    "longer crush up to a force": required(
        CRUSHES.assign(absorbed_energy_at_90N_J=0.1),
        {"allowed_force": "90 N"},
        min_absorbed="0.2 J",
    ),
    "stroke at an allowed force": required(
        CRUSHES.assign(absorbed_energy_at_10N_J=0.1),
        {"allowed_force": "10 N"},
        min_absorbed="5 J",
    ),
    "no filtered deceleration": required(IMPACTS, {}, max_deceleration="40 g0"),
    "what loadings set themselves": required(
        summary(*IMPACTS.to_dict("records"), {}, LOAD, LOAD | {"force_N": 9.0}),
        {},
        max_deceleration="60 g0",
        max_force="90 N",
        min_absorbed="1 mJ",
    ),
    "budget below all": (CRUSHES, {"budget": ["0.5 g", "0.7 g"]}),
    "not all shown": (CRUSHES, {"top": 1}),
    "walls that relax": (summary(RELAXING), {}),
    "walls that yield": (summary(YIELDING), {}),
    "walls of both kinds": (summary({}, RELAXING), {}),
    "few cells of several patterns": (
        summary(*({"lattice_kind": kind} for kind in ("square", "hex", "diamond", "circle"))),
        {},
    ),
    "second cycle": (summary({"second_cycle_share": 0.7}), {}),
    "no densification": (summary({"densification_strain": nan, "peak_strain": 0.5}), {}),
    "gradual densification": (summary({"packing_span": 0.21}), {}),
    "two maxima of the efficiency": (
        CRUSHES.assign(
            lowest_densification_strain=[0.5, 0.5, 0.34],
            highest_densification_strain=[0.5, 0.5, 0.52],
            lowest_absorbed_energy_at_densification_J=[0.1, 0.18, 0.15],
            highest_absorbed_energy_at_densification_J=[0.1, 0.18, 0.42],
        ),
        {"budget": "9 g"},
    ),
    "slicer, stretched, crossed, beyond": (
        summary(
            {"printed_mass_g": 1.1, "does_not_print": "walls of 1.5 lines of 0.4 mm"},
            {"stretch_over_curve": 1.2, "max_crossings": 1, "mass_g": 2.0},
            {"absorbed_energy_within_model_J": 0.01, "mass_g": 3.0, "absorbed_energy_J": 0.3},
        ),
        {},
    ),
    "stopped cases": (
        summary(
            *designs([1.0, 2.0], [0.1, 0.5]),
            {"absorbed_energy_J": 0.3, "wall_thickness_m": 6e-4} | STOPPED,
            STOPPED | {"absorbed_energy_J": 0.9, "loaded": 1, "returned_energy_J": nan},
            {"absorbed_energy_J": 0.2, "retry": "lattice.imperfection = 0.015"},
        ),
        {"budget": ["1 g", "3 g"]},
    ),
    "stopped impacts": (
        summary(
            *(HIT | {"peak_force_N": force} for force in (76.0, 90.0)),
            *(HIT | {"peak_force_N": 10.0 + k} | STOPPED for k in range(7)),
        ),
        {},
    ),
    "whole crush": (CRUSHES, {"by": "absorbed_energy_J"}),
    "strain of greatest efficiency": (CRUSHES, {"by": "absorbed_energy_at_densification_J"}),
    "error bars": (CRUSHES.assign(**BARS), {"budget": "9 g"}),
    "impacts on a panel": (IMPACTS, PANEL),
    "dead load": (summary(LOAD), {}),
    "coarse steps": (IMPACTS.assign(integrator_share=0.1), {}),
}
WINNERS = {
    "budgets": (CRUSHES, {"budget": ["1 g", "2.5 g"]}),
    "first of a panel under impact": (IMPACTS, PANEL),
    "first under a dead load": (summary(LOAD), {}),
    "first by another column": (CRUSHES, {"by": "peak_force_N"}),
    "first per gram, tied": (
        summary(*designs([1.0, 3.0, 2.0], [0.3, 0.6, 0.5])).assign(**BARS),
        {},
    ),
    "walls cross": (CRUSHES.assign(max_crossings=[0, 0, 1]), {}),
    "some errors unknown": (
        CRUSHES.assign(
            error_absorbed_energy_until_packed_J=[0.01, nan, 0.05],
            error_peak_force_until_packed_N=0.0,
        ),
        {"budget": ["1 g", "2 g", "9 g"]},
    ),
    "a tie, beyond the model": (
        CRUSHES.assign(**BARS, absorbed_energy_within_model_J=0.05),
        {"budget": "9 g"},
    ),
}
SPREADS = {
    "order stays": {"friction 0.9": (1.5, 2.0)},
    "order changes": {"friction 0.9": (3.0, 2.0)},
    "nothing uncertain": {},
    "narrow peak": {FINE: (0.9, 2.0), "walls +5 %": (0.1, 1.9)},
}


def of_ranking(table, question) -> Iterator[str]:
    ranking = ranked(table, **question)
    for sheet in ranking_sheets(ranking, table):
        yield from [sheet.title, " | ".join(sheet.heads), *sheet.notes]
    yield legend(ranking)


def of_winners(table, question) -> Iterator[str]:
    ranking = ranked(table, **question | {"top": None})
    for words, mass, merit in budget_winners(ranking.table, ranking):
        yield f"{words} (at {mass:g}, {merit:g})"


def of_spread(corners) -> Iterator[str]:
    own = summary(*designs([1.0, 2.0], [0.4, 0.3]))
    for column in ("mass_g", "absorbed_energy_J"):
        rows = ranked(own, by=column).table
        table = DataFrame({AS_GIVEN: [1.0, 2.0], **corners})
        spread = Spread(rows, column, table, table.rank(method="min"), 2, table, ())
        if FINE in corners:
            limits = ((1, FINE, "budget"), (1, FINE, "max_force"), (2, FINE, "max_force"))
            yield from finalist_sheet(spread._replace(missed=limits), own).notes
        else:
            yield from next(spread_sheets([spread], own)).notes


def of_failures() -> Iterator[str]:
    names = {value: name for name, value in vars(outcomes).items() if name.isupper()}
    for outcome in (outcomes.INTERRUPTED, *failures.ADVICE):
        for case, driven in ((CASE, True), (CASE, False), (TIMED, True)):
            status, message = failures.stopped(case, outcome, "while loading, here", driven)
            yield f"{names[outcome]}: {status}: {message}"
    for _, message in (
        failures.stopped(PATH, outcomes.ITERATIONS, "while loading, here", False),
        failures.timed_out(CASE, "while loading, here"),
        failures.energy_gained(CASE),
        failures.energy_gained(TIMED),
        failures.energy_gained(TIMED.changed(solver={"integrator": "bdf2"})),
        failures.stopped_as(failures.ADVICE[outcomes.UNBALANCED], "at the end"),
        failures.stopped_as(failures.MOVES_DOWN, "at the end"),
        failures.passed_lattice(STRUCK, "at the end"),
        failures.passed_lattice(STRUCK.changed(loading={"striker": "round"}), "at the end"),
        failures.stopped_as(failures.PUSHED_BACK, "at the end"),
        failures.energy_unresolved(STRUCK, 0.34),
        failures.energy_unresolved(STRUCK.changed(solver={"integrator": "backward_euler"}), 0.34),
        failures.momentum_unresolved(STRUCK, 0.96),
    ):
        yield message
    yield failures.break_message({"broke_at_strain": 0.123})
    yield failures.break_message({"broke_at_strain": nan, "greatest_fibre_strain": 0.4})


def of_finding() -> Iterator[str]:
    glued = designs([1.0, 2.0, 3.0], [0.1, 0.5, 0.4])
    loose = designs([1.0, 2.0], [0.1, 0.2], platen="contact")
    table = summary(*glued, *loose).assign(max_crossings=[0, 1, 0, 0, 0])
    for number, scene, budget in (
        (1, None, "1.5 g"), (1, "2", "9 g"), (3, None, "9 g"), (6, None, "9 g"),
        (1, "crushed", "9 g"), (1, "3", "9 g"), (1, "2", "0.8 g"),
    ):  # fmt: skip
        try:
            yield by_number(table, number, scene, Question(budget=budget))[1]
        except ArgumentError as error:
            yield f"refused: {error}"


def of_warnings(folder: Path) -> Iterator[str]:
    from tests.support.results.specimens import write

    ended = {"status": "stopped", "loaded": 1}
    table = summary(
        {}, {"status": "stopped"}, ended, {"solid_joint_share": 0.5, "model_version": 1}
    )
    file = write(folder / "trial.h5", table, {"other_cases": 2})
    for line in warnings(file, answer(table, Question())):
        yield line.replace(str(folder), "FOLDER")


def of_direction() -> Iterator[str]:
    along = {"direction": "out_of_plane", "solid_strain": 0.7, "peak_strain": 0.8}
    yield from about_direction(summary(along).iloc[0])


def sections(folder: Path) -> dict[str, str]:
    """The text of every section."""
    texts = {f"ranking: {name}": of_ranking(*each) for name, each in RANKINGS.items()}
    texts |= {f"winners: {name}": of_winners(*each) for name, each in WINNERS.items()}
    texts |= {f"spread: {name}": of_spread(corners) for name, corners in SPREADS.items()}
    texts |= {"failures": of_failures(), "numbers of a ranking": of_finding()}
    texts |= {"warnings": of_warnings(folder), "along the cells": of_direction()}
    return {name: "\n".join(filter(None, lines)) for name, lines in texts.items()}


def written(texts: dict[str, str]) -> str:
    return "".join(f"## {name}\n{text}\n\n" for name, text in texts.items())


@pytest.fixture(scope="module")
def now(tmp_path_factory):
    return sections(tmp_path_factory.mktemp("messages"))


def test_sentences_are_those_of_the_golden_file(now):
    """If the new ones are right: python -m tests.sweep.test_messages."""
    golden = dict(part.split("\n", 1) for part in GOLDEN.read_text("utf-8").split("## ")[1:])
    assert {name: text.strip() for name, text in golden.items()} == now


def test_sentences_fit_a_page(now):
    ours = [line for text in now.values() for line in text.splitlines()]
    assert max(map(len, (line for line in ours if " | " not in line))) <= 170


if __name__ == "__main__":
    from tempfile import TemporaryDirectory

    with TemporaryDirectory() as folder:
        GOLDEN.write_text(written(sections(Path(folder))), "utf-8")
