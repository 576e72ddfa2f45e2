"""Searches the designs of a config for the answer to a question, from Python or the command
line.
"""

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from math import inf, prod

from sweep.config.axis import Choice, Written
from sweep.config.case import Case
from sweep.config.faults import ReportedError
from sweep.config.grid import Config
from sweep.config.kinds.crush import Crush
from sweep.config.load import Source, load_config
from sweep.ranking.assessment import check_column, check_searched
from sweep.ranking.merit import SAME_AREA
from sweep.ranking.question import Quantity, Question, check_units, in_si
from sweep.ranking.requirements import limits
from sweep.results import Results
from sweep.running.applicable import check_required
from sweep.running.cluster import Scheduler
from sweep.running.place import chosen_place, open_place
from sweep.running.progress import announce
from sweep.running.searching.design_space import DesignSpace
from sweep.running.searching.search import MOST_TRIED, Search, Settings

FORCES = "loading.allowed_forces"
NEEDED = '"lattice.wall_thickness" = {from = "0.4 mm", to = "1.6 mm"} or the like'


class OptimizeError(ReportedError, ValueError):
    """A search that is not possible; the text is one sentence."""


def optimize(  # noqa: PLR0913  what, the parts of one question, where and how
    config: Config | Source,
    out: str | os.PathLike[str] | None = None,
    *,
    budget: Quantity | None = None,
    panel: Sequence[Quantity] | None = None,
    by: str | None = None,
    allowed_force: Quantity | None = None,
    require: Mapping[str, Quantity | None] | None = None,
    per: str | None = None,
    evaluations: int = 150,
    seed: int = 1,
    workers: int | None = None,
    scheduler: Scheduler = None,
) -> Results:
    """Search the designs of a config with a table [search] for the best one; return all tried.

    config, out, workers, scheduler: as in `run`. budget to per: the question, as in `rank`, with
    units; by default from [rank] and [require]. `require` adds to [require]. evaluations: the most
    designs that are simulated. seed: the same seed tries the same designs, so that a search that
    was stopped continues. `results.rank()` of the returned results answers the same question.
    """
    config = config if isinstance(config, Config) else load_config(config)
    for line in config.notes:
        announce(line)
    check_units({"budget": budget, "panel": panel, "allowed_force": allowed_force})
    check_units(require or {})
    question = question_of(
        config, budget=budget, panel=panel, by=by, require=require, per=per
    )._replace(allowed_force=allowed_force)
    for name, number in (("evaluations", evaluations), ("seed", seed)):
        if number < 1:
            raise OptimizeError(f"{name} = {number}; allowed: 1 or more")
    path = os.fspath(out or f"results/{config.name}.h5")
    count, where = chosen_place(workers, scheduler)
    with open_place(where) as place:
        how = Settings(evaluations, seed, count, place)
        search = search_of(config, question, path, how)
        search.run()
    check_found(search)
    return Results(path, [*search.cases], question._asdict())


def question_of(
    config: Config,
    *,
    budget: Quantity | None,
    panel: Sequence[Quantity] | None,
    by: str | None,
    require: Mapping[str, Quantity | None] | None,
    per: str | None,
) -> Question:
    """The given question, completed by the config. A requirement "none" drops the config's
    requirement.
    """
    check_searchable(config)
    if by:
        check_column(by)
    budgets = [budget] if budget else list(config.rank.budgets)
    if len(budgets) > 1:
        raise OptimizeError(f"[rank] has {len(budgets)} budgets; needed: one, as --budget")
    every = config.require.model_dump() | dict(require or {})
    kept = {name: value for name, value in every.items() if value not in (None, "none")}
    panel, per = panel or config.rank.panel, per or config.rank.per
    if per == "panel" and not panel:
        raise OptimizeError('per = "panel"; needed: a panel, as --panel or in [rank]')
    limits(kept)
    return Question(budget=budgets or None, panel=panel, by=by, require=kept, per=per)


def check_searchable(config: Config) -> None:
    """Refuse a config without a search, or with an impossible one."""
    if not config.recipe.search:
        wrong = "has no [search] with the keys that may be chosen"
        raise OptimizeError(f"{config.path or config.name} {wrong}; needed: {NEEDED}")
    check_searched(config.recipe.search)


def search_of(config: Config, question: Question, out: str, how: Settings) -> Search:
    """The search for the designs that answer a question, into the results file `out`."""
    check_start(question, start_of(config, question, out, how))
    for line in _like_ranges(config):
        announce(line)
    space = DesignSpace(_with_force(config, question), *_limits(question))
    return Search(space, question, out, how)


def _like_ranges(config: Config) -> Iterator[str]:
    """A line for each list of two numbers in a [search], which may be meant as a range."""
    for key, axis in config.recipe.search.items():
        values = axis.values if isinstance(axis, Choice) else ()
        if [type(written.value) in (int, float) for written in values] == [True, True]:
            low, high = (written.text for written in sorted(values, key=lambda w: w.value))
            between = f"{{from = {low}, to = {high}}}"
            yield f"[search] {key}: only {low} and {high}; for all between them: {between}"


def start_of(config: Config, question: Question, out: str, how: Settings) -> list[Case]:
    """The first designs of a search, all of one loading; empty if none exists."""
    return Search(DesignSpace(config, *_limits(question)), question, out, how).start


def check_start(question: Question, start: Sequence[Case]) -> None:
    """Refuse a requirement for which no design has a value, and designs that are no parts."""
    check_required(question.require, start)
    if sheet := next((case.lattice.sheet for case in start if case.lattice.sheet), ""):
        allowed = "lattices that are drawn with lines; sheets are compared in a [grid]"
        raise OptimizeError(f"{sheet} in [search]; allowed: {allowed}")
    loaded = [case for case in start if not isinstance(case.loading, Crush)]
    areas = [prod(case.footprint) if case.lattice.tied_sides else 0.0 for case in loaded]
    if max(areas, default=0.0) > (1.0 + SAME_AREA) * min(areas, default=0.0):
        allowed = "periods of one area alone, as the load or the striker acts on each of them"
        raise OptimizeError(f'lattice.sides = "periodic"; allowed in a search: {allowed}')


def check_found(search: Search) -> None:
    """Refuse a search without any design."""
    if search.cases:
        return
    budget = f" of at most {search.question.budgets[0]}" if search.question.budget else ""
    panel = " that fits the panel" if search.question.panel else ""
    tried = f"none of {MOST_TRIED:,} points of [search] gives a design{budget}{panel}"
    raise OptimizeError(f"{tried}; allowed: more mass, a larger panel, or a wider search")


def _with_force(config: Config, question: Question) -> Config:
    """The config whose cases have the column of the greatest allowed force."""
    if question.allowed_force is None or question.per == "panel":
        return config  # a force of the panel is looked up in the curves
    force = in_si(question.allowed_force, "N")
    recipe = config.recipe
    recipe_forces: Iterable[float] = recipe.base[FORCES].value if FORCES in recipe.base else ()
    forces = tuple(dict.fromkeys([*recipe_forces, force]))
    base = recipe.base | {FORCES: Written(forces, str(forces), FORCES)}
    return replace(config, recipe=replace(recipe, base=base))


def _limits(question: Question) -> tuple[float, tuple[float, float] | None]:
    """Greatest mass (kg) of a specimen, or of the panel if there is one; and the sides of the panel
    (m).
    """
    budget = in_si(question.budgets[0], "kg") if question.budgets else inf
    sides = [in_si(side, "m") for side in question.panel or ()]
    most = (question.require or {}).get("max_mass")
    if most is not None and bool(sides) == (question.per == "panel"):
        budget = min(budget, in_si(most, "kg"))
    return budget, (sides[0], sides[1]) if sides else None
