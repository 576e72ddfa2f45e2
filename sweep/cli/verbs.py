"""The verbs of the command line: each prints text and returns an exit status."""

from __future__ import annotations

import json
import re
import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING, Any

from sweep.cli.terminal import (
    nearest_commands,
    next_commands,
    print_ranking,
    print_sheets,
    say,
    say_all,
    version_counts,
    warnings,
)

if TYPE_CHECKING:
    from argparse import Namespace

    from pandas import DataFrame, Series

    from sweep.config.grid import Config
    from sweep.ranking.ranking import Ranking

DONE, SOME_FAILED = 0, 1
WORKERS = 2
TOP, TOP_OF_A_BUDGET = 10, 3
SCREENED = "--screen runs one cell of each design first, and only the best of each infill in full"
NO_COLUMNS = (
    "--screen estimates crushes along equal cells without an outline by one cell each, and no case "
    'of this config is one; allowed: cases with loading.direction = "out_of_plane"'
)
UNKNOWN_BEST = "--spread runs more cases, of designs that are known only after the sweep"
IDS = 3  # shown for each kind of failure
NUMBERED = "--scene, --budget and --allowed-force"
NUMBER = re.compile(r"(?:(?<!\w)-)?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
HOME = __name__.removesuffix(".cli.verbs")
REFUSALS = {
    f"{HOME}.config.grid": "ConfigError",
    f"{HOME}.config.materials.material_file": "RecordError",
    f"{HOME}.coupon.record": "CouponError",
    f"{HOME}.cli.materials": "MaterialsError",
    f"{HOME}.cli.optimize": "OptimizeError",
    f"{HOME}.cli.find_case": "CaseError",
    f"{HOME}.cli.new": "NewError",
    f"{HOME}.store.read": "StoreError",
    f"{HOME}.export.errors": "ExportError",
    f"{HOME}.running.dask_graph": "GraphError",
    f"{HOME}.ranking.rank": "RankError",
    f"{HOME}.ranking.accuracy": "AccuracyError",
    f"{HOME.rpartition('.')[0]}.kernels.compile.choice".lstrip("."): "CompilerError",
}


class ArgumentError(ValueError):
    """An argument that cannot be used."""


def refusals() -> tuple[type[Exception], ...]:
    """Error classes whose text says what is wrong with a config, a file or an argument.

    Only modules that are loaded are asked: no other module can have raised an error.
    """
    loaded = [(sys.modules[name], error) for name, error in REFUSALS.items() if name in sys.modules]
    ours = [getattr(module, error) for module, error in loaded]
    return (ArgumentError, ModuleNotFoundError, *ours)


def run(arguments: Namespace) -> int:
    """Simulate the missing cases, then rank; with --dry-run, only estimate.

    With --error-bars, a design without an error bar counts as a failure.
    """
    from sweep.store.read import Rerun, read_summary

    config = _config(arguments.config)
    _check_required(config)
    out = arguments.out or f"results/{config.name}.h5"
    workers = arguments.workers or WORKERS
    rerun = Rerun(failed=arguments.retry_failed, older=arguments.renew)
    if arguments.dry_run:
        from sweep.running.estimate import dry_run

        say(dry_run(config, out, workers, rerun, arguments.error_bars))
        say_all([UNKNOWN_BEST] if arguments.spread else [])
        say_all([SCREENED] if arguments.screen else [])
        return DONE
    from sweep.running.beside.error_bars import add_error_bars
    from sweep.running.sweep import run_sweep

    how = workers, arguments.scheduler, rerun
    question = _question(config.rank.budgets, config.rank.panel)
    question |= {"require": config.require.model_dump(), "per": config.rank.per}
    failed, estimates = 0, None
    if arguments.screen:
        config, estimates, failed = _screen(config, out, how, question, arguments.screen)
    failed += run_sweep(config, out, *how)
    failed += add_error_bars(config, out, *how) if arguments.error_bars else 0
    print_ranking(out, read_summary(out), question)
    if estimates is not None:
        from sweep.report.tables.screen_sheets import screen_sheets

        print_sheets(screen_sheets(estimates, read_summary(out), question))
    failed += _spread(config, out, how, question) if arguments.spread else 0
    _hint(next_commands(out, read_summary(out)))
    return SOME_FAILED if failed else DONE


def _check_required(config: Config) -> None:
    """Refuse a requirement that no case of a config can be asked for, before cases run."""
    from sweep.config.grid import expand
    from sweep.ranking.requirements import check_modes

    if required := [name for name, limit in config.require if limit is not None]:
        check_modes(required, {case.loading.mode for case in expand(config)})


def _screen(
    config: Config, out: str, how: tuple[Any, ...], question: dict[str, Any], count: int
) -> tuple[Config, DataFrame, int]:
    """Run the unit columns of a sweep; return the config of what is to run as a whole, the
    estimates, and how many designs have none.
    """
    from sweep.config.grid import chosen_of, expand
    from sweep.running.beside.run_beside import file_beside
    from sweep.running.beside.screen import best_of, has_column, run_columns

    cases, beside = expand(config), file_beside(out, "screen")
    screened = [case for case in cases if has_column(case)]
    if not screened:
        raise ArgumentError(NO_COLUMNS)
    estimates, why = run_columns(screened, out, *how), f"crumple status {beside} says why"
    missing = len(screened) - len(estimates)
    if missing:
        say(f"{missing} designs have no estimate: {why}")
    if estimates.empty:
        raise ArgumentError(f"no unit column converged: {why}")
    best = best_of(estimates, question, count)
    left_out = {case.case_id for case in screened} - {*best}
    return chosen_of(config, (c for c in cases if c.case_id not in left_out)), estimates, missing


def _spread(config: Config, out: str, how: tuple[Any, ...], question: dict[str, Any]) -> int:
    """Run the best designs with uncertain numbers and print their spread; return how many values
    are missing.
    """
    from sweep.ranking.rank import ranked
    from sweep.ranking.spread import spreads
    from sweep.report.tables.spread_sheets import spread_sheets
    from sweep.running.beside.run_beside import file_beside
    from sweep.running.beside.spread import BEST, corners_of, run_corners
    from sweep.store.read import read_summary

    summary = read_summary(out)
    ranking = ranked(summary, **question | {"top": BEST})
    corners = corners_of(config, ranking.table["case_id"])
    if not any(corners.values()):
        say("No number of the best designs is uncertain.")
        return 0
    run_corners(corners, out, *how)
    ids = {design: [(c.name, c.case_id) for c in found] for design, found in corners.items()}
    found = spreads(ranking, read_summary(file_beside(out, "spread")), ids, question)
    print_sheets(spread_sheets(found, summary))
    return sum(spread.failed for spread in found)


def optimize(arguments: Namespace) -> int:
    """Search for the best design, then simulate the best ones again."""
    from sweep.cli.optimize import optimize as search

    return SOME_FAILED if search(_config(arguments.config), arguments) else DONE


def accuracy(arguments: Namespace) -> int:
    """Simulate the missing cases of an accuracy study, then print errors and run times."""
    from sweep.config.grid import expand
    from sweep.ranking.accuracy import check_axes
    from sweep.report.publish import publish_accuracy
    from sweep.running.sweep import run_sweep

    config, folder = _config(arguments.config), Path(arguments.out)
    cases, out = expand(config), folder / f"{config.name}.h5"
    check_axes([case.axes for case in cases])
    failed = run_sweep(config, out, arguments.workers)
    with _writing(folder):
        sheets, files = publish_accuracy(out, [case.case_id for case in cases])
    print_sheets(sheets)
    say_all(files)
    return SOME_FAILED if failed else DONE


def warm(_: Namespace) -> int:
    """Compile the kernels ahead of the first run."""
    from kernels.compile.cache import is_cold, is_lasting
    from sweep.running.sweep import UNWRITABLE, real_simulate

    if not is_lasting():
        raise ArgumentError(UNWRITABLE)
    cold = is_cold("arcs") or is_cold("plates")
    done = "compiled the kernels" if cold else "found compiled kernels and loaded them"
    started = time.perf_counter()
    real_simulate(arcs=True, plates=True)
    say(f"{done} in {time.perf_counter() - started:.1f} s; later runs need not compile")
    return DONE


def status(arguments: Namespace) -> int:
    """Print counts, failures with their messages, run time and origin of a results file."""
    from sweep.cli.status_json import missing_cases, status_record
    from sweep.store.read import read_attributes, read_summary

    summary, about = read_summary(arguments.file), read_attributes(arguments.file)
    if arguments.json:
        say(json.dumps(status_record(arguments.file, summary, about), indent=2))
        return _exit_status(summary)
    counts = summary["status"].value_counts()
    missing = missing_cases(summary, about)
    more = f"; {missing} that the last run was asked for are missing" if missing else ""
    say(f"{arguments.file}: {len(summary)} cases{more}")
    say_all(f"{count:7d} {name}" for name, count in counts.items())
    say_all(_failures(arguments.file, summary))
    say_all(_bars(summary))
    say_all(_versions(summary))
    if others := about.get("other_cases", 0):
        say(f"{others} cases belong to other configs than that of the last run")
    say(f"{summary['cpu_s'].sum():.4g} s of processor time in all")
    known = {name.removeprefix("version_"): about[name] for name in about if "version_" in name}
    say(f"last run {about.get('created', '?')}, revision {about.get('git_revision', '?')}")
    say(", ".join(f"{name} {version}" for name, version in known.items()))
    if "compiler" in about:
        say(f"kernels: {about['compiler']} compiler")
    return _exit_status(summary)


def rank(arguments: Namespace) -> int:
    """Print the ranking as tables or as text for other programs, or write it into a folder."""
    from sweep.ranking.curves import with_allowed
    from sweep.ranking.rank import ranked
    from sweep.report.tables.markdown import markdown
    from sweep.report.tables.sheets import ranking_sheets
    from sweep.store.read import read_summary

    question, heights = _asked(arguments), _drop_heights(arguments)
    summary = with_allowed(arguments.file, read_summary(arguments.file), question)
    if arguments.out:
        from sweep.report.publish import publish_ranking

        folder, ranking = Path(arguments.out), ranked(summary, **question)
        if (ranking.table["loading_mode"] == "displacement").any():
            heights = heights or _heights_of(arguments.file)
        with _writing(folder):
            files = publish_ranking(arguments.file, summary, question, folder, heights)
        say_all(files)
        _warn(arguments.file, ranking, summary)
    elif arguments.csv or arguments.json or arguments.markdown:
        ranking = ranked(summary, **question)
        if arguments.csv:
            say(ranking.table.to_csv(index=False), end="")
        elif arguments.json:
            say(ranking.table.to_json(orient="records", indent=2, double_precision=15))
        else:
            say(markdown(ranking_sheets(ranking, summary)), end="")
        _warn(arguments.file, ranking, summary)
    else:
        print_ranking(arguments.file, summary, question)
    return _exit_status(summary)


def show(arguments: Namespace) -> int:
    """Draw one case, or list all cases."""
    from sweep.report.tables.sheets import about_direction, case_sheet, describe_case
    from sweep.store.read import read_summary

    summary = read_summary(arguments.file)
    if arguments.case is None and not _of_a_number(arguments):
        print_sheets([case_sheet(summary)])
        return DONE
    from sweep.report.publish import publish_case

    row, taken = _named(arguments, summary)
    say_all([taken] if taken else [])
    folder = Path(arguments.out or Path(arguments.file).with_suffix("") / row["case_id"])
    say(f"case {row['case_id']}, {describe_case(row, summary)}: {row['status']}")
    say_all([row["message"]] if row["message"] else [])
    say_all([f"printed by {row['slicer_settings']}"] if row["slicer_settings"] else [])
    say_all([f"does not print: {row['does_not_print']}"] if row["does_not_print"] else [])
    say_all(about_direction(row))
    with _writing(folder):
        pictures = publish_case(arguments.file, row, folder)
    say_all(pictures or ["nothing to draw: the case has no curves and no shapes"])
    return DONE


def export(arguments: Namespace) -> int:
    """Write one case as a file for another program."""
    from sweep.export.export import check_export, export_case
    from sweep.store.read import read_summary

    target = Path(arguments.to)
    check_export(target, arguments.panel, arguments.kind)
    row, taken = _named(arguments, read_summary(arguments.file))
    say_all([taken] if taken else [])
    replaced, is_new = target.exists(), not target.parent.exists()
    with _writing(target.parent):
        files, notes = export_case(
            arguments.file, target, row["case_id"], arguments.panel, arguments.kind
        )
    say(f"{files[-1]}{f' and {len(files) - 1} files beside' if files[1:] else ''}"
        f"{', replaced' if replaced else ', in a new folder' if is_new else ''}")  # fmt: skip
    say_all(notes)
    return DONE


def report(arguments: Namespace) -> int:
    """Write a results file as one HTML page."""
    from sweep.report.page.write import write_page
    from sweep.store.read import read_summary

    summary, stored = read_summary(arguments.file), _stored(arguments.file, "rank")
    question = {"budget": stored.get("budgets"), "panel": stored.get("panel")}
    question |= {"require": _stored(arguments.file, "require"), "per": stored.get("per")}
    out = Path(arguments.out or Path(arguments.file).with_suffix(".html"))
    with _writing(out.parent):
        page = write_page(arguments.file, summary, question, out)
    say(f"{page} ({page.stat().st_size / 1e6:.2g} MB)")
    return _exit_status(summary)


def materials(arguments: Namespace) -> int:
    """List, show, plot or fit materials."""
    from sweep.cli.materials import materials as answer

    answer(arguments)
    return DONE


def new(arguments: Namespace) -> int:
    """Write a first config."""
    from sweep.cli.new import new as write

    path = quote(str(write(arguments.name, arguments.kind, arguments.out)))
    say(f"{path}: change it, then: crumple run {path} --dry-run")
    return DONE


def completion(arguments: Namespace) -> int:
    """Print what a shell needs to complete words."""
    from sweep.cli.completion import script

    say(script(arguments.shell))
    return DONE


ALL = (
    *(run, optimize, accuracy, warm, status, rank, show, export, report),
    *(materials, new, completion),
)
VERBS = {verb.__name__: verb for verb in ALL}


def _config(name: str) -> Config:
    """The config of a file or of an example; for an example, print the path of its file."""
    from sweep.config.units import load_config

    config = load_config(name)
    if config.path != Path(name):
        _hint([f"example {name}: {config.path} (copy it to change it)"])
    if config.unprintable:
        left_out = f"{config.unprintable:,} combinations, which do not print"
        _hint([f"left out {left_out} (lattice.printable)"])
    return config


@contextmanager
def _writing(folder: Path) -> Iterator[None]:
    try:
        yield
    except (FileExistsError, NotADirectoryError) as error:
        raise ArgumentError(f"{folder} is or lies in a file; allowed: a folder") from error
    except OSError as error:
        raise ArgumentError(f"{folder} cannot be written: {error.strerror or error}") from error


def _warn(file: str, ranking: Ranking, summary: DataFrame) -> None:
    """Print the warnings of a ranking on stderr, so that stdout has only the ranking."""
    _hint(warnings(file, ranking))
    _hint(nearest_commands(file, ranking, summary))


def _hint(lines: Iterable[str]) -> None:
    """Print lines on stderr, after what is on stdout."""
    sys.stdout.flush()
    sys.stderr.writelines(f"{line}\n" for line in lines)


def _of_a_number(arguments: Namespace) -> bool:
    """Whether options say in which ranking a number is a place."""
    return bool(arguments.scene or arguments.budget or arguments.allowed_force)


def _named(arguments: Namespace, summary: DataFrame) -> tuple[Series, str]:
    """The row that CASE names, and a sentence about its place if CASE is a number."""
    from sweep.cli.find_case import by_id, by_number, is_number
    from sweep.ranking.curves import with_allowed

    if not (arguments.case and is_number(arguments.case)):
        if _of_a_number(arguments):
            raise ArgumentError(f"{NUMBERED} belong to a number in the ranking")
        return by_id(summary, arguments.case), ""
    question = _asked(arguments)
    summary = with_allowed(arguments.file, summary, question)
    return by_number(summary, int(arguments.case), arguments.scene, question)


def _asked(arguments: Namespace) -> dict[str, Any]:
    """Keyword arguments of `rank` from the command line, completed from the config.

    The budgets of the config are used unless --budget or --by is given; its panel is used unless
    --panel is given, or --by without --budget where nothing is asked of a panel.
    """
    stored = _stored(arguments.file, "rank")
    budgets, panel = stored.get("budgets"), stored.get("panel")
    per = arguments.per or stored.get("per") or "specimen"
    if arguments.by and not arguments.budget:
        budgets, panel = None, panel if per == "panel" else None
    question = _question(arguments.budget or budgets, arguments.panel or panel)
    question |= {"by": arguments.by, "allowed_force": arguments.allowed_force}
    question |= {"require": _required(arguments), "per": per}
    return question | ({"top": arguments.top} if arguments.top else {})


def _drop_heights(arguments: Namespace) -> list[float]:
    """The heights (m) that --drop-height gives."""
    from sweep.ranking.merit import in_si

    if arguments.drop_height and not arguments.out:
        raise ArgumentError("--drop-height draws cushion curves into a folder: it needs --out DIR")
    return [*dict.fromkeys(in_si(text, "m") for text in arguments.drop_height or ())]


def _heights_of(file: str) -> list[float]:
    """The heights (m) of cushion curves in the config of a results file."""
    return [*dict.fromkeys(_stored(file, "rank").get("drop_heights") or ())]


def _question(budgets: Iterable[Any] | None, panel: Iterable[Any] | None) -> dict[str, Any]:
    """Keyword arguments of `rank`; several budgets show fewer places each."""
    masses, sides = list(budgets or ()), list(panel or ())
    top = TOP_OF_A_BUDGET if len(masses) > 1 else TOP
    return {"budget": masses or None, "panel": sides or None, "top": top}


def _required(arguments: Namespace) -> dict[str, Any]:
    """The requirements of the config, each replaced or dropped by its option."""
    from sweep.ranking.requirements import MEASURES

    given = {name: getattr(arguments, name) for name in MEASURES}
    wished = _stored(arguments.file, "require") | {k: v for k, v in given.items() if v}
    return {name: value for name, value in wished.items() if value not in (None, "none")}


def _stored(file: str, table: str) -> dict[str, Any]:
    """The table [rank] or [require] of the config stored in a results file."""
    from sweep.store.read import read_attributes

    try:
        config: dict[str, Any] = json.loads(read_attributes(file).get("config") or "{}")
    except ValueError:
        raise ArgumentError(f"{file} is damaged: the config in it is no JSON") from None
    return config.get(table) or {}


def _failures(file: str, summary: DataFrame) -> Iterator[str]:
    """A line for each kind of failure with its first cases, and how to list the others."""
    failed = _failed(summary)
    kind = failed["message"].str.replace(NUMBER, "#", regex=True)
    for _, rows in failed.groupby([failed["status"], kind], sort=False):
        cases = ", ".join(rows["case_id"].head(IDS))
        more = f" and {len(rows) - IDS} more" if len(rows) > IDS else ""
        yield f"{len(rows)} x {_in_common(list(rows['message']))} (case {cases}{more})"
    if len(failed):
        yield f"crumple show {file} lists all ids with their status; with an id, it says why"


def _in_common(messages: list[str]) -> str:
    """One sentence for messages that differ only in their numbers, which become ranges."""
    columns = zip(*map(NUMBER.findall, messages), strict=True)
    ranges = (sorted({*figures}, key=float) for figures in columns)
    texts = (f"{found[0]} to {found[-1]}" if len(found) > 1 else found[0] for found in ranges)
    return NUMBER.sub(lambda _: next(texts), messages[0])


def _bars(summary: DataFrame) -> list[str]:
    """A line with the number of cases that have error bars, if there are such columns."""
    from sweep.columns import ERROR

    bars = summary.drop(index=_failed(summary).index).filter(regex=ERROR)
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


def _exit_status(summary: DataFrame) -> int:
    return DONE if _failed(summary).empty else SOME_FAILED


def _failed(summary: DataFrame) -> DataFrame:
    from sweep.result import Status

    return summary[summary["status"] != Status.CONVERGED]
