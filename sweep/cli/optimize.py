"""The verb `optimize`: searches for the best design, simulates the best ones again, and reports how
reliable they are.
"""

from argparse import Namespace
from collections.abc import Iterator, Sequence
from functools import partial

from sweep.cli.place import place_of
from sweep.cli.terminal import print_sheets, quoted, say, say_all
from sweep.config.case import Case
from sweep.config.grid import Config
from sweep.loading_modes import MODES
from sweep.numbers import text_in
from sweep.ranking.assessment import check_column, front, thinned
from sweep.ranking.question import Question, in_si
from sweep.ranking.rank import answer
from sweep.ranking.requirement_table import MEASURES
from sweep.ranking.requirements import check_modes
from sweep.report.tables.design_text import named_case
from sweep.report.tables.search_sheets import finalist_sheet, front_sheet, nearest_sheet
from sweep.report.tables.sheets import ranking_sheets
from sweep.report.tables.unfinished_notes import unfinished_notes
from sweep.running.beside.run_beside import How
from sweep.running.run import spreads_among
from sweep.running.searching.finalists import finalists, perturbed
from sweep.running.searching.optimize import (
    OptimizeError,
    check_found,
    check_searchable,
    question_of,
    search_of,
    start_of,
)
from sweep.running.searching.search import Search, Settings

SHORT = 8  # characters of an id in a command


def optimize(config: Config, arguments: Namespace) -> int:
    """Search for the best design of a config; return how many of the finalists' cases failed."""
    check_searchable(config)
    with place_of(arguments) as place:
        how = Settings(arguments.evaluations, arguments.seed, *place)
        return _search(config, arguments, how)


def _search(config: Config, arguments: Namespace, how: Settings) -> int:
    """Search, and print the best designs; return how many of the finalists' cases failed."""
    question = _question(config, arguments)
    out = arguments.out or f"results/{config.name}.h5"
    question = _with_max_force(question, arguments, start_of(config, question, out, how))
    search = search_of(config, question, out, how)
    search.run()
    failed = _show_best(search)
    if arguments.pareto and search.assessment.by_id:
        _show_front(search, arguments.pareto)
    say_all(_to_print(search))
    say(f"results: {out}; to rank them: {_next_command(out, question)}")
    return failed


def _question(config: Config, arguments: Namespace) -> Question:
    """The question of the options, completed by the config; without --max-force, except for
    "none".
    """
    if arguments.pareto:
        check_column(arguments.pareto)
    options = {name: getattr(arguments, name) for name in MEASURES}
    requirements = {name: value for name, value in options.items() if value}
    if requirements.get("max_force") != "none":
        requirements.pop("max_force", None)
    question = question_of(
        config,
        budget=arguments.budget,
        panel=arguments.panel,
        by=arguments.by,
        require=requirements,
        per=arguments.per,
    )
    return question._replace(allowed_force=arguments.allowed_force)


def _with_max_force(question: Question, arguments: Namespace, start: Sequence[Case]) -> Question:
    """The question with --max-force: the force up to which the energy of a crush counts, else a
    requirement. start: designs of the search, all of one loading; empty if none exists.
    """
    mode = start[0].loading.mode if start else ""
    if arguments.max_force in (None, "none"):
        return question
    if arguments.allowed_force is not None:
        raise OptimizeError("--max-force with --allowed-force; allowed: one of them")
    limit = in_si(arguments.max_force, "N")
    if not mode or MODES[mode].driven:
        return question._replace(allowed_force=arguments.max_force)
    check_modes({"max_force": limit}, [mode])
    required = {**(question.require or {}), "max_force": arguments.max_force}
    return question._replace(require=required)


def _show_best(search: Search) -> int:
    """Simulate the best designs again, and print them; return how many values are missing."""
    assessment, question = search.assessment, search.question
    check_found(search)
    if not (assessment.by_id or assessment.missed):
        say(_none_ranked(search))
        return max(1, len(search.cases))
    if assessment.doubtful:
        say(f"Excluded: {assessment.doubtful} designs whose results rank marks with ! or x.")
    if not assessment.by_id:
        _show_nearest(search)
        return 0
    best = finalists(search.cases[case_id] for case_id in assessment.by_id)
    again = {case.case_id: perturbed(case) for case in best}
    how, summary = How(search.settings.workers, search.settings.scheduler), search.rows()
    ranking = answer(summary, question._replace(top=None))
    parts = spreads_among(again, ranking, question, search.out, how)
    print_sheets([finalist_sheet(part, summary, several=len(parts) > 1) for part in parts])
    say_all(unfinished_notes(ranking.unfinished, partial(named_case, among=summary)))
    return sum(part.failed for part in parts)


def _none_ranked(search: Search) -> str:
    """That no design can be ranked, and why."""
    rows = search.rows()
    failed, doubtful = int((rows["loaded"] != 1).sum()), search.assessment.doubtful
    reasons = []
    if failed:
        reasons.append(f"{failed} failed: crumple status {quoted(str(search.out))} says why")
    if doubtful:
        reasons.append(f"rank marks {doubtful} with ! or x")
    why = f" ({'; '.join(reasons)})" if reasons else ""
    return f"None of {len(search.cases)} designs can be ranked{why}."


def _show_nearest(search: Search) -> None:
    """Print that no design fulfils all requirements, why, and which design comes nearest."""
    summary, question = search.rows(), search.question._replace(top=None)
    say(f"None of {len(search.cases)} designs fulfils all requirements.")
    print_sheets(ranking_sheets(answer(summary, question), summary))
    whole, missed = answer(summary, question._replace(require=None)), search.assessment.missed
    chosen = [case.case_id for case in finalists(search.cases[case_id] for case_id in missed)]
    print_sheets([nearest_sheet(whole, {one: missed[one] for one in chosen}, summary)])


def _show_front(search: Search, other: str) -> None:
    summary = search.rows()
    rows = thinned(front(summary, search.question, other), (other, search.assessment.column))
    print_sheets([front_sheet(rows, summary, other)])


def _to_print(search: Search) -> Iterator[str]:
    """The command that exports the first design, or the one that comes nearest."""
    assessment = search.assessment
    first = next(iter({**assessment.by_id, **assessment.missed}), None)
    if first is None:
        return
    lattice = search.cases[first].lattice
    if lattice.endless or lattice.tied_sides:
        return
    words = ["crumple", "export", str(search.out), first[:SHORT], "--to", "best.3mf"]
    panel = search.question.panel or ()
    if panel:
        words += ["--panel", *(p if isinstance(p, str) else text_in(p, "mm", 6) for p in panel)]
    which = "first" if assessment.by_id else "nearest"
    yield f"to print the {which}: {_in_shell(words)}"


def _next_command(out: str, question: Question) -> str:
    """The command that ranks the results as the search did."""
    words = ["crumple", "rank", str(out)]
    options = {name: getattr(question, name) for name in ("budget", "panel", "by", "allowed_force")}
    options |= {"per": question.per if question.per == "panel" else None}
    for name, given in (options | dict(question.require or {})).items():
        values = [given] if isinstance(given, str) else [] if given is None else given
        if not isinstance(values, float) and all(isinstance(value, str) for value in values):
            words += [f"--{name.replace('_', '-')}", *values] if values else []
    return _in_shell(words)


def _in_shell(words: Sequence[str]) -> str:
    return " ".join(map(quoted, words))
