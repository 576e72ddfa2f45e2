"""All verbs and their arguments; the functions behind the verbs are in `cli.verbs`."""

from typing import Any

from sweep.cli import help_texts as texts
from sweep.cli.arguments import (
    Parser,
    Version,
    count,
    duration,
    folder,
    number,
    page_path,
    part,
    path,
    results_path,
    stored,
    table_path,
)
from sweep.cli.completion import SHELLS, cases, columns, configs, offer, results
from sweep.cli.completion import materials as material_words
from sweep.cli.new import KINDS
from sweep.config.reading.examples import examples
from sweep.ranking.requirement_table import MEASURES

BRIEF = "tables and warnings alone"
STORED = "results file; of a sweep also NAME or NAME.toml"
AREA = "area to fill with specimens"
THREADS = "threads (default: one per core, up to 8)"
PROCESSES = "processes in place of threads (default, beyond 8 cores: one per core)"


def parser() -> Parser:
    """All verbs and their options."""
    main = Parser(prog="crumple", description=texts.ABOUT, epilog=texts.EXAMPLES)
    main.add_argument("--version", action=Version, nargs=0, help="print the version and exit")
    verbs = main.add_subparsers(dest="verb", metavar="VERB", required=True)
    main.verbs = verbs.choices
    _add_run(verbs)
    _add_optimize(verbs)
    _add_accuracy(verbs)
    verbs.add_parser("warm", help="compile the kernels", description=texts.WARM)
    _add_status(verbs)
    _add_verify(verbs)
    _add_merge(verbs)
    _add_rank(verbs)
    _add_show(verbs)
    _add_export(verbs)
    _add_report(verbs)
    _add_materials(verbs)
    _add_card(verbs)
    _add_published(verbs)
    _add_helpers(verbs)
    return main


def _add_run(verbs: Any) -> None:
    epilog = f"examples that come with Crumple: {', '.join(examples())}"
    run = verbs.add_parser("run", help="simulate a sweep", description=texts.RUN, epilog=epilog)
    offer(run.add_argument("config", type=path, metavar="CONFIG", help=texts.CONFIG), configs)
    run.add_argument(
        "--out", type=results_path, metavar="F.h5", help="results file (default: results/NAME.h5)"
    )
    _add_place(run)
    run.add_argument(
        "--dry-run",
        action="store_true",
        help="estimate time and disk by running a few cases; write no results",
    )
    run.add_argument(
        "--error-bars", action="store_true", help="estimate the error of mesh and steps"
    )
    run.add_argument(
        "--spread", action="store_true", help="run the best designs with uncertain numbers"
    )
    run.add_argument(
        "--screen",
        type=count,
        metavar="N",
        help="along the cells: crush one cell of each, then the N best of each infill",
    )
    run.add_argument(
        "--part",
        type=part,
        metavar="K/N",
        help="run the Kth of N parts, into a file of its own (crumple merge)",
    )
    run.add_argument("--brief", action="store_true", help=BRIEF)
    run.add_argument("--retry-failed", action="store_true", help="compute failed cases again")
    run.add_argument(
        "--renew", action="store_true", help="compute damaged rows and rows of an older model again"
    )


def _add_optimize(verbs: Any) -> None:
    optimize = verbs.add_parser(
        "optimize", help="search for the best design", description=texts.OPTIMIZE
    )
    optimize.add_argument("config", type=path, metavar="CONFIG", help="TOML file with a [search]")
    optimize.add_argument("--budget", metavar="MASS", help='greatest mass: "25 g"')
    optimize.add_argument("--panel", nargs=2, metavar="LENGTH", help=f'{AREA}: "100 mm" "50 mm"')
    force = "of a crush, as --allowed-force; of an impact or a load, required"
    _add_limits(optimize, force)
    optimize.add_argument("--by", metavar="COLUMN", help="seek the best of this column")
    optimize.add_argument("--pareto", metavar="COLUMN", help="list the front of a second aim, too")
    optimize.add_argument(
        "--evaluations", type=count, default=150, metavar="N", help="designs, 150 by default"
    )
    optimize.add_argument("--seed", type=count, default=1, metavar="N", help="1 by default")
    optimize.add_argument(
        "--out", type=results_path, metavar="F.h5", help="results file (default: results/NAME.h5)"
    )
    _add_place(optimize)


def _add_place(verb: Any) -> None:
    """Add the options for where cases run: on threads or on a cluster."""
    where = verb.add_mutually_exclusive_group()
    where.add_argument("--workers", type=count, metavar="N", help=THREADS)
    where.add_argument("--processes", type=count, metavar="N", help=PROCESSES)
    where.add_argument(
        "--scheduler",
        type=path,
        metavar="WHERE",
        help="a Dask cluster in place of threads: tcp://host:8786, tls://host:8786, a scheduler "
        "file, or slurm (default: DASK_SCHEDULER_ADDRESS, if it is set)",
    )
    verb.add_argument(
        "--wait",
        type=duration,
        metavar="TIME",
        help='how long to wait while the cluster has no worker: "2 h" (default: "60 s")',
    )


def _add_accuracy(verbs: Any) -> None:
    accuracy = verbs.add_parser(
        "accuracy", help="error against run time", description=texts.ACCURACY
    )
    offer(accuracy.add_argument("config", type=path, metavar="CONFIG", help=texts.CONFIG), configs)
    accuracy.add_argument(
        "--out",
        type=folder,
        metavar="DIR",
        default="results/accuracy",
        help="results, tables and figure (default: results/accuracy)",
    )
    accuracy.add_argument("--workers", type=count, metavar="N", help=THREADS)


def _add_status(verbs: Any) -> None:
    status = verbs.add_parser("status", help="what is done, and what failed and why")
    offer(status.add_argument("file", type=stored, metavar="F.h5", help=STORED), results)
    status.add_argument("--json", action="store_true", help="as json on stdout")


def _add_verify(verbs: Any) -> None:
    verify = verbs.add_parser(
        "verify",
        help="whether a file is whole, and its numbers come out again",
        description=texts.VERIFY,
    )
    offer(verify.add_argument("file", type=stored, metavar="F.h5", help=STORED), results)
    verify.add_argument(
        "--again",
        type=number,
        default=3,
        metavar="N",
        help="cases drawn at random that are simulated again (default: 3)",
    )


def _add_merge(verbs: Any) -> None:
    merge = verbs.add_parser("merge", help="bring results files together", description=texts.MERGE)
    merge.add_argument(
        "out", type=results_path, metavar="OUT.h5", help="is made, or gets more rows"
    )
    offer(merge.add_argument("files", type=stored, nargs="+", metavar="F.h5", help=STORED), results)


def _add_rank(verbs: Any) -> None:
    rank = verbs.add_parser(
        "rank", help="the best designs", description=texts.RANK, epilog=texts.RANK_EXAMPLES
    )
    offer(rank.add_argument("file", type=stored, metavar="F.h5", help=STORED), results)
    _add_question(rank)
    rank.add_argument("--top", type=count, metavar="N", help="places shown: 10, or 3 per budget")
    shape = rank.add_mutually_exclusive_group()
    every = "these places, in all columns"
    for name, what in {"csv": every, "json": every, "markdown": "tables"}.items():
        shape.add_argument(f"--{name}", action="store_true", help=f"{what}, as {name} on stdout")
    shape.add_argument("--brief", action="store_true", help=BRIEF)
    shape.add_argument(
        "--out", type=folder, metavar="DIR", help="write tables and figures into a folder"
    )
    rank.add_argument(
        "--drop-height",
        nargs="+",
        action="extend",
        metavar="LENGTH",
        help='with --out: cushion curves of drops from "0.5 m" (default: as in [rank])',
    )


def _add_show(verbs: Any) -> None:
    show = verbs.add_parser(
        "show", help="draw a case", description=texts.SHOW, epilog=texts.SHOW_EXAMPLES
    )
    offer(show.add_argument("file", type=stored, metavar="F.h5", help=STORED), results)
    _add_case(show, nargs="?")
    show.add_argument(
        "--out", type=folder, metavar="DIR", help="folder of the pictures (default: beside F.h5)"
    )


def _add_export(verbs: Any) -> None:
    export = verbs.add_parser(
        "export",
        help="a part to print, curves, shapes",
        description=texts.EXPORT,
        epilog=texts.EXPORT_EXAMPLES,
    )
    offer(export.add_argument("file", type=stored, metavar="F.h5", help=STORED), results)
    _add_case(export, "area to fill with specimens, ranked by and written")
    export.add_argument(
        "--to",
        type=path,
        metavar="FILE",
        required=True,
        help="FILE.stl, .3mf, .svg, .dxf, .csv, .vtkhdf or .gif",
    )
    export.add_argument(
        "--kind", choices=["lattice", "settings"], help="of a .3mf (default: lattice)"
    )


def _add_report(verbs: Any) -> None:
    report = verbs.add_parser("report", help="one HTML page", description=texts.REPORT)
    report.add_argument("file", type=stored, metavar="F.h5", help=STORED)
    report.add_argument(
        "--out", type=page_path, metavar="F.html", help="the page (default: beside F.h5)"
    )
    report.add_argument("--open", action="store_true", help="open it in the browser")


def _add_materials(verbs: Any) -> None:
    materials = verbs.add_parser(
        "materials",
        help="list, plot and fit materials",
        description=texts.MATERIALS,
        epilog=texts.MATERIALS_EXAMPLES,
    )
    words = materials.add_argument(
        "words", type=path, metavar="WORD", nargs="*", help="NAME ..., plot [NAME ...], fit F.csv"
    )
    offer(words, material_words)
    materials.add_argument("--out", type=path, metavar="FILE", help="of plot: .png; of fit: .csv")
    fit = materials.add_argument_group("of fit", "what the file of the test does not say")
    fit.add_argument("--gauge", metavar="LENGTH", help="free length of a strip, height of a puck")
    fit.add_argument("--area", metavar="AREA", help='section of the specimen: "8 mm^2"')
    fit.add_argument("--density", metavar="DENSITY", help="assumed if not given")
    fit.add_argument("--speed", metavar="SPEED", help='of the travel, without times: "150 mm/min"')
    fit.add_argument("--test", choices=("pulled", "pressed"), help="whatever the signs in the file")
    fit.add_argument(
        "--zero",
        choices=("first", "line"),
        help="strain and stress begin at the first row, or where the first line meets zero stress",
    )
    fit.add_argument(
        "--units", nargs="+", action="extend", metavar="OF=UNIT", help="force=kN strain=%% time=s"
    )
    fit.add_argument(
        "--columns",
        nargs="+",
        action="extend",
        metavar="OF=HEAD",
        help='which column it is: force="Load 2", or its number: displacement=3',
    )


def _add_card(verbs: Any) -> None:
    card = verbs.add_parser(
        "card", help="infills as materials for finite elements", description=texts.CARD
    )
    config = card.add_argument("config", type=path, metavar="CONFIG", help=texts.CONFIG)
    offer(config, configs)
    card.add_argument("--to", type=path, metavar="FILE", help="also write them: .inp or .csv")


def _add_published(verbs: Any) -> None:
    published = verbs.add_parser(
        "published",
        help="predictions beside what was measured",
        description=texts.PUBLISHED,
        epilog=texts.PUBLISHED_EXAMPLES,
    )
    published.add_argument("rows", metavar="ROW", nargs="*", help="words of the rows to print")
    published.add_argument("--run", action="store_true", help="simulate the predictions again")
    add = published.add_argument("--add", type=path, metavar="CONFIG", help="your own crush")
    offer(add, configs)
    published.add_argument("--measured", metavar="VALUE", help='"0.12 +- 0.02 J", or curve.csv')
    published.add_argument("--measure", metavar="COLUMN", help="default: absorbed_energy_J")
    published.add_argument("--source", metavar="TEXT", help="of the measured value")
    published.add_argument(
        "--table", type=table_path, metavar="F.csv", default="published.csv", help="your own rows"
    )
    published.add_argument(
        "--out", type=folder, metavar="DIR", help="folder for a picture and the table"
    )
    published.add_argument("--workers", type=count, metavar="N", help=THREADS)


def _add_helpers(verbs: Any) -> None:
    """Add the verbs that write a first config and a script for completion in a shell."""
    new = verbs.add_parser("new", help="write a first config", description=texts.NEW)
    new.add_argument("name", metavar="NAME", help="of the sweep, such as bumper")
    new.add_argument("--kind", choices=KINDS, default="crush", help="of loading (default: crush)")
    new.add_argument("--out", type=path, metavar="FILE", help="file to write (default: NAME.toml)")
    verbs.add_parser("schema", help="the keys of a config, for editors", description=texts.SCHEMA)
    completion = verbs.add_parser(
        "completion", help="complete words in a shell", description=texts.COMPLETION
    )
    completion.add_argument("shell", choices=SHELLS)


def _add_case(verb: Any, panel: str = AREA, **options: Any) -> None:
    """Add the arguments that name a case; panel: help of the option of this name."""
    words = "number in the ranking, or beginning of an id"
    offer(verb.add_argument("case", metavar="CASE", help=words, **options), cases)
    ranking = verb.add_argument_group(
        "of a number in the ranking", "the question whose ranking it is in, as rank takes it"
    )
    ranking.add_argument("--scene", metavar="N", help="which table, or words of its title")
    _add_question(ranking, panel)
    verb.set_defaults(top=None)


def _add_question(verb: Any, panel: str = AREA) -> None:
    """Add the options that define a ranking; panel: help of the option of this name."""
    verb.add_argument(
        "--budget", nargs="+", action="extend", metavar="MASS", help='greatest mass: "25 g" "2 oz"'
    )
    verb.add_argument("--panel", nargs=2, metavar="LENGTH", help=f'{panel}: "100 mm" "50 mm"')
    by = verb.add_argument("--by", metavar="COLUMN", help="sort by this column of the summary")
    offer(by, columns)
    _add_limits(verb)


def _add_limits(verb: Any, max_force: str = MEASURES["max_force"].about) -> None:
    """Add the options that limit a design; max_force: help of the option of this name."""
    verb.add_argument(
        "--allowed-force", metavar="FORCE", help='count energy up to this force: "50 N"'
    )
    verb.add_argument(
        "--per", choices=("specimen", "panel"), help="what that force and requirements are of"
    )
    for name, measure in MEASURES.items():
        about = max_force if name == "max_force" else measure.about
        words = f'{about}: "{measure.example}"'
        verb.add_argument(f"--{name.replace('_', '-')}", metavar=measure.kind, help=words)
