"""The verbs of the command line: each prints text and returns an exit status."""

from __future__ import annotations

import time
import webbrowser
from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING

from sweep.cli.question import drop_heights, full_question, stored_heights, stored_table
from sweep.cli.refusals import ArgumentError, writing
from sweep.cli.status import failed_cases, print_status
from sweep.cli.terminal import (
    hint,
    nearest_commands,
    print_ranking,
    print_sheets,
    quoted,
    say,
    say_all,
    warnings,
)
from sweep.numbers import text_in
from sweep.plain_text import csv_text
from sweep.report.tables.missing_notes import incomplete

if TYPE_CHECKING:
    from pandas import DataFrame, Series

    from sweep.config.grid import Config
    from sweep.ranking.ranking import Ranking

DONE, SOME_FAILED = 0, 1


def run(arguments: Namespace) -> int:
    """Simulate the missing cases, then rank; with --dry-run, only estimate."""
    config = _config(arguments.config)  # a wrong one is refused before the others are imported
    from sweep.cli.run import run as simulate

    return SOME_FAILED if simulate(config, arguments) else DONE


def optimize(arguments: Namespace) -> int:
    """Search for the best design, then simulate the best ones again."""
    config = _config(arguments.config)
    from sweep.cli.optimize import optimize as search

    return SOME_FAILED if search(config, arguments) else DONE


def accuracy(arguments: Namespace) -> int:
    """Simulate the missing cases of an accuracy study, then print errors and run times."""
    from sweep.config.grid import expand
    from sweep.ranking.accuracy import check_axes
    from sweep.report.publish import publish_accuracy
    from sweep.running.sweep import run_sweep
    from sweep.running.threads import usual_workers

    config, folder = _config(arguments.config), Path(arguments.out)
    cases, out = expand(config), folder / f"{config.name}.h5"
    check_axes([case.axes for case in cases])
    failed = run_sweep(config, out, arguments.workers or usual_workers())
    with writing(folder):
        sheets, files = publish_accuracy(out, [case.case_id for case in cases])
    print_sheets(sheets)
    say_all(files)
    return SOME_FAILED if failed else DONE


def warm(_: Namespace) -> int:
    """Compile the kernels before the first run, the kernels of shells in a process of their own."""
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    from kernels.compile.cache import is_lasting
    from sweep.running.warming import UNWRITABLE, cold_kernels, load

    if not is_lasting():
        raise ArgumentError(UNWRITABLE)
    plane, space = ["marches", "arcs"], ["plates"]
    cold = cold_kernels(plane + space)
    done = "compiled the kernels" if cold else "found compiled kernels and loaded them"
    started = time.perf_counter()
    with ProcessPoolExecutor(1, get_context("spawn")) as beside:
        shells = beside.submit(load, space)
        load(plane)
        shells.result()
    say(f"{done} in {time.perf_counter() - started:.1f} s; later runs need not compile")
    return DONE


def status(arguments: Namespace) -> int:
    """Print counts, failures with their messages, run time and origin of a results file."""
    return DONE if print_status(arguments.file, arguments.json) else SOME_FAILED


def verify(arguments: Namespace) -> int:
    """Check that a results file is undamaged, and that some of its cases can be reproduced."""
    from sweep.cli.verify import verify as is_sound

    return DONE if is_sound(arguments.file, arguments.again) else SOME_FAILED


def merge(arguments: Namespace) -> int:
    """Combine the results of several runs in one file."""
    from sweep.cli.merge import merge as bring_together

    bring_together(arguments.out, arguments.files)
    return DONE


def rank(arguments: Namespace) -> int:
    """Print the ranking as tables or as text for other programs, or write it into a folder."""
    from sweep.loading_modes import has
    from sweep.ranking.curves import with_allowed
    from sweep.ranking.rank import answer
    from sweep.report.tables.markdown import markdown
    from sweep.report.tables.sheets import ranking_sheets
    from sweep.report.tables.size_notes import narrow_note
    from sweep.store.read import read_summary

    question, heights = full_question(arguments), drop_heights(arguments)
    summary = with_allowed(arguments.file, read_summary(arguments.file), question)
    if arguments.out:
        from sweep.report.publish import publish_ranking

        folder, ranking = Path(arguments.out), answer(summary, question)
        if has(ranking.table, "driven").any():
            heights = heights or stored_heights(arguments.file)
        with writing(folder):
            files = publish_ranking(arguments.file, summary, question, folder, heights)
        say_all(files)
        _warn(arguments.file, ranking, summary)
    elif arguments.csv or arguments.json or arguments.markdown:
        ranking = answer(summary, question)
        if not arguments.markdown:
            hint(line for scene in ranking.scenes for line in narrow_note(ranking.narrow[scene]))
        if arguments.csv:
            say(csv_text(ranking.with_unfinished), end="")
        elif arguments.json:
            say(ranking.with_unfinished.to_json(orient="records", indent=2, double_precision=15))
        else:
            say(markdown(ranking_sheets(ranking, summary)), end="")
        _warn(arguments.file, ranking, summary)
    else:
        print_ranking(arguments.file, summary, question, arguments.brief)
    return _exit_status(summary)


def show(arguments: Namespace) -> int:
    """Draw one case, or list all cases."""
    from sweep.report.tables.design_text import about_direction, describe_case
    from sweep.report.tables.sheets import case_sheet
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
    with writing(folder):
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
    with writing(target.parent, target):
        file, notes = export_case(
            arguments.file, target, row["case_id"], arguments.panel, arguments.kind
        )
    say(f"{file}{', replaced' if replaced else ', in a new folder' if is_new else ''}")
    say_all(notes)
    return DONE


def report(arguments: Namespace) -> int:
    """Write a results file as one HTML page."""
    from sweep.export.page import export_page
    from sweep.ranking.question import Question
    from sweep.store.read import read_attributes, read_summary

    summary, stored = read_summary(arguments.file), stored_table(arguments.file, "rank")
    question = Question(
        budget=stored.get("budgets"),
        panel=stored.get("panel"),
        require=stored_table(arguments.file, "require"),
        per=stored.get("per") or "specimen",
    )
    out = Path(arguments.out or Path(arguments.file).with_suffix(".html"))
    with writing(out.parent, out):
        page, notes = export_page(arguments.file, summary, question, out)
    say(f"{page} ({text_in(page.stat().st_size, 'MB', 2)})")
    say_all(notes)
    if arguments.open and not webbrowser.open(page.resolve().as_uri()):
        hint(["there is no browser to open it"])
    if failed := len(failed_cases(summary)):
        hint([f"{failed} of {len(summary)} cases failed: the page lists them"])
    hint(incomplete(len(summary), read_attributes(arguments.file)))
    return _exit_status(summary)


def materials(arguments: Namespace) -> int:
    """List, show, plot or fit materials."""
    from sweep.cli.materials import materials as answer

    answer(arguments)
    return DONE


def card(arguments: Namespace) -> int:
    """Print the effective materials of infills, and write them as cards."""
    config = _config(arguments.config)
    from sweep.cli.card import card as answer

    answer(config, arguments)
    return DONE


def published(arguments: Namespace) -> int:
    """Print predictions of crushes beside the measured values."""
    from sweep.cli.published import published as compare

    return SOME_FAILED if compare(arguments) else DONE


def new(arguments: Namespace) -> int:
    """Write a first config."""
    from sweep.cli.new import new as write
    from sweep.config.reading.examples import FOLDER

    path = quoted(str(write(arguments.name, arguments.kind, arguments.out)))
    say(f"{path}: change it, then: crumple run {path} --dry-run")
    editors = "crumple.schema.json, beside it, lets an editor complete and mark its keys"
    hint([editors, f"all keys: {FOLDER / 'README.md'}"])
    return DONE


def schema(_: Namespace) -> int:
    """Print the JSON schema of a config."""
    from sweep.cli.new import schema_text

    say(schema_text().rstrip())
    return DONE


def completion(arguments: Namespace) -> int:
    """Print the script with which a shell completes words."""
    from sweep.cli.completion import script

    say(script(arguments.shell))
    return DONE


ALL = (
    *(run, optimize, accuracy, warm, status, verify, merge, rank, show, export, report),
    *(materials, card, published, new, schema, completion),
)
VERBS = {verb.__name__: verb for verb in ALL}


def _config(name: str) -> Config:
    """The config of a file or of an example; for an example, print the path of its file."""
    from sweep.cli.lattice_notes import lattice_notes
    from sweep.config.faults import ConfigError
    from sweep.config.load import load_config
    from sweep.config.reading.examples import FOLDER as EXAMPLES

    try:
        config = load_config(name)
    except ConfigError as error:
        hint(error.notes)
        raise
    if config.path and config.path.is_relative_to(EXAMPLES):
        hint([f"example {name}: {config.path} (copy it to change it)"])
    hint(config.notes)
    if config.left_out.impossible:
        hint(["left out, as they are impossible:", *config.left_out.reasons])
    infill = config.recipe.base.get("lattice.infill")
    hint(lattice_notes(config.cases, infill.value if infill else None))
    return config


def _warn(file: str, ranking: Ranking, summary: DataFrame) -> None:
    """Print the warnings of a ranking on stderr, so that stdout has only the ranking."""
    hint(warnings(file, ranking))
    hint(nearest_commands(file, ranking, summary))


def _of_a_number(arguments: Namespace) -> list[str]:
    """The options that select the ranking in which a number is a place; an export has a panel
    anyway.
    """
    from sweep.ranking.requirement_table import MEASURES

    names = ["scene", "budget", "panel", "by", "allowed_force", "per", *MEASURES]
    if arguments.verb == "export":
        names.remove("panel")
    return [f"--{name.replace('_', '-')}" for name in names if getattr(arguments, name)]


def _named(arguments: Namespace, summary: DataFrame) -> tuple[Series, str]:
    """The row that CASE refers to, and a sentence about its place if CASE is a number."""
    from sweep.cli.find_case import by_id, by_number, is_number
    from sweep.ranking.curves import with_allowed
    from sweep.store.read import read_attributes

    if not (arguments.case and is_number(arguments.case)):
        if options := _of_a_number(arguments):
            raise ArgumentError(
                f"{', '.join(options)}: only with a number in the ranking, such as 1"
            )
        return by_id(summary, arguments.case), ""
    question = full_question(arguments)
    summary = with_allowed(arguments.file, summary, question)
    row_and_place = by_number(summary, int(arguments.case), arguments.scene, question)
    hint(incomplete(len(summary), read_attributes(arguments.file)))
    return row_and_place


def _exit_status(summary: DataFrame) -> int:
    return DONE if failed_cases(summary).empty else SOME_FAILED
