"""The verb `optimize`: search, simulate the best designs again, tell how far to trust them."""

from __future__ import annotations

import shlex
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING, Any

from sweep.cli.terminal import print_sheets, say

if TYPE_CHECKING:
    from argparse import Namespace

    from pandas import DataFrame

    from sweep.config.grid import Config
    from sweep.running.search import Search

FORCES = "loading.allowed_forces"


class OptimizeError(ValueError):
    """A search that cannot be made; the text is one sentence."""


def optimize(config: Config, arguments: Namespace) -> int:
    """Search for the best design of a config; return how many of the finalists' cases failed."""
    from sweep.ranking.worth import check_searched
    from sweep.running.design_space import DesignSpace
    from sweep.running.search import Search, Settings

    if not config.search:
        wrong = "has no [search] with the keys that may be chosen"
        needed = '"lattice.wall_thickness" = {from = "0.4 mm", to = "1.6 mm"} or the like'
        raise OptimizeError(f"{config.path} {wrong}; needed: {needed}")
    check_searched(config.search)
    question = _question(config, arguments)
    if arguments.max_force and config.rank.per == "panel":
        counted = "a search counts the force of a specimen"
        raise OptimizeError(
            f'rank.per = "panel": {counted}; allowed: "specimen", with such a force'
        )
    config, budget, panel = _with_force(config, question), *_limits(question)
    out = arguments.out or f"results/{config.name}.h5"
    how = Settings(arguments.evaluations, arguments.seed, arguments.workers, arguments.scheduler)
    search = Search(DesignSpace(config, budget, panel), question, out, how)
    search.run()
    failed = _tell_best(search, question)
    if arguments.pareto:
        _tell_front(search, question, arguments.pareto)
    if required := [name for name, value in config.require if value is not None]:
        say(f"A search does not look at [require] ({', '.join(required)}); crumple rank does.")
    say(f"results: {out}; to rank them: {_next_command(out, question)}")
    return failed


def _question(config: Config, arguments: Namespace) -> dict[str, Any]:
    """The arguments of `rank`: those given, else those of the config."""
    from sweep.ranking.worth import check_column

    for name in filter(None, (arguments.by, arguments.pareto)):
        check_column(name)
    budgets = [arguments.budget] if arguments.budget else list(config.rank.budgets)
    if len(budgets) > 1:
        raise OptimizeError(f"[rank] has {len(budgets)} budgets; needed: one, as --budget")
    return {
        "budget": budgets or None,
        "panel": arguments.panel or config.rank.panel,
        "by": arguments.by,
        "allowed_force": arguments.max_force,
    }


def _with_force(config: Config, question: dict[str, Any]) -> Config:
    """The config whose cases have the column of the greatest force that is allowed."""
    from sweep.config.axis import Written
    from sweep.ranking.merit import in_si

    if question["allowed_force"] is None:
        return config
    force = in_si(question["allowed_force"], "N")
    known = config.base[FORCES].value if FORCES in config.base else ()
    forces = tuple(dict.fromkeys([*known, force]))
    return replace(config, base=config.base | {FORCES: Written(forces, str(forces), FORCES)})


def _limits(question: dict[str, Any]) -> tuple[float, tuple[float, float] | None]:
    """Budget (kg) and panel (m)."""
    from sweep.ranking.merit import in_si

    budget = in_si(question["budget"][0], "kg") if question["budget"] else inf
    sides = [in_si(side, "m") for side in question["panel"] or ()]
    return budget, (sides[0], sides[1]) if sides else None


def _tell_best(search: Search, question: dict[str, Any]) -> int:
    """Simulate the best designs again, and print them; return how many values are missing."""
    from sweep.ranking.rank import ranked
    from sweep.ranking.spread import spreads
    from sweep.report.search_sheets import finalist_sheet
    from sweep.running.finalists import finalists, perturbed
    from sweep.running.spread import run_corners, spread_file
    from sweep.store.read import read_summary

    found = search.found
    if not search.cases:
        budget = f" within {question['budget'][0]}" if question["budget"] else ""
        raise OptimizeError(f"no design of [search] exists{budget}; allowed: a wider search")
    if found is None or not found.by_id:
        say(f"None of {len(search.cases)} designs can be ranked.")
        return max(1, len(search.cases))
    if found.doubtful:
        say(f"Left out: {found.doubtful} designs whose results rank marks with ! or x.")
    best = finalists(search.cases[case_id] for case_id in found.by_id)
    again = {case.case_id: perturbed(case) for case in best}
    run_corners(again, search.out, search.settings.workers, search.settings.scheduler)
    summary = _rows(search)
    ids = {design: [(c.name, c.case_id) for c in corners] for design, corners in again.items()}
    ranking = ranked(summary, **question | {"top": None})
    (spread,) = spreads(ranking, read_summary(spread_file(search.out)), ids, question)
    print_sheets([finalist_sheet(spread, summary)])
    return spread.failed


def _tell_front(search: Search, question: dict[str, Any], other: str) -> None:
    from sweep.ranking.worth import front
    from sweep.report.search_sheets import front_sheet

    summary = _rows(search)
    print_sheets([front_sheet(front(summary, question, other), summary, other)])


def _rows(search: Search) -> DataFrame:
    """The rows of a search, without others that the results file may hold."""
    from sweep.store.read import read_summary

    summary = read_summary(search.out)
    return summary[summary["case_id"].isin(search.cases)].reset_index(drop=True)


def _next_command(out: str, question: dict[str, Any]) -> str:
    """The command that ranks the results as the search did."""
    words = ["crumple", "rank", str(out)]
    for name in ("budget", "panel", "by", "allowed_force"):
        given = question[name]
        values = [given] if isinstance(given, str) else list(given or ())
        if values and all(isinstance(value, str) for value in values):
            words += [f"--{name.replace('_', '-')}", *values]
    return shlex.join(words)
