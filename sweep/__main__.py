"""The command line: `crumple VERB ...`, also `python -m crumple`. The verbs are in `cli/verbs.py`.

Exit status: 0 done, also if no design meets the requirements, as that is an answer; 1 some cases
failed, the run was interrupted, or its cluster failed; 2 the config, a file or an argument cannot
be used.
"""

import argparse
import os
import re
import sys
import warnings
from collections.abc import Mapping, Sequence
from contextlib import suppress
from difflib import get_close_matches
from functools import partial
from itertools import groupby
from pathlib import Path
from textwrap import fill
from typing import Any, NoReturn

from sweep.cli.completion import SHELLS, cases, columns, complete, configs, offer, results
from sweep.cli.completion import materials as material_words
from sweep.cli.new import KINDS
from sweep.config.reading.examples import examples
from sweep.plain_text import plain
from sweep.ranking.requirement_table import MEASURES

ABOUT = "Which printed infill absorbs the most energy per gram?"
EXAMPLES = """examples:
  crumple new bumper                            write bumper.toml, a config to be changed
  crumple run armor --dry-run                   how many cases, how long, how much disk
  crumple run armor                             simulate; after a stop, the same command continues
  crumple run armor --error-bars                also estimate the error of each number, and ties
  crumple run armor --part 2/16                 the second of sixteen parts, as of a job array
  crumple run armor --scheduler tcp://host:8786 --wait "2 h"    on a Dask cluster
  crumple run armor --spread                    also show what uncertain numbers change
  crumple run which_way --screen 1              crush one cell of each, then the best of each
  crumple optimize search --budget "1.2 g"      seek the best design within a budget
  crumple warm                                  compile the kernels before the first run
  crumple status results/armor.h5               what is done, what failed and why
  crumple verify results/armor.h5               is the file whole, do its numbers come out again?
  crumple merge all.h5 results/armor.1-of-2.h5 results/armor.2-of-2.h5    parts of a sweep
  crumple rank results/armor.h5 --budget "20 g" "2 oz" --panel "100 mm" "50 mm"
  crumple show results/armor.h5                 the ids of all cases
  crumple show results/armor.h5 1               pictures of the best design
  crumple show results/armor.h5 7a85            pictures of the case whose id begins with 7a85
  crumple export results/armor.h5 7a85 --to part.stl      to print; also .3mf .svg .dxf .csv .gif
  crumple report results/armor.h5               one page with sliders: results/armor.html
  crumple accuracy accuracy/impact              error against run time, method by method
  crumple materials                             the materials, their numbers and sources
  crumple card infills --to card.inp            the infills as materials for CalculiX, Abaqus
  crumple published                             predictions beside what was measured
  crumple schema > crumple.schema.json          for editors: all keys and their values
  crumple completion bash                       let the shell complete words: see its --help

armor, search and accuracy/impact are examples that come with Crumple; your own is a file: mine.toml

exit status: 0 done, also if no design meets the requirements; 1 some cases failed, or interrupted;
2 wrong config, file or arguments
"""
VERIFY = """Read everything that a results file holds against its checksums, compute the id of every
stored case anew, and simulate some of the cases again. The exit status is 1 if anything differs."""
CONFIG = "TOML file with the case and its [grid], or the name of an example"
RUN = """Simulate every case of CONFIG that the results file does not hold yet, then rank.
Finished cases are never lost and never computed twice: after a stop or a kill, or after an
extension of the grid, run the same command again. Rows of an older model stay until --renew
computes them again. With --error-bars every design runs again with half the elements and again with
half the steps: about twice the work. With --spread the five best designs of each ranking run again
with every uncertain number at both ends of its range (crumple materials lists them; friction from
0.2 to 0.9), and a table shows how far their values move and whether their order changes. With
--screen N a design that is pressed along its cells is first crushed as one cell, a tube, and only
the N best of each infill run as a whole; a table shows estimates beside results."""
OPTIMIZE = """Search for the best design among those that the table [search] of CONFIG allows:

  [search]
  "lattice.kind" = ["square", "hex"]                               one of a list
  "lattice.cells_x" = {from = 2, to = 8}                           whole numbers
  "lattice.wall_thickness" = {from = "0.4 mm", to = "1.6 mm"}      or lattice.mass

The best is what rank lists first: most energy until densification, or up to --allowed-force, or the
best of --by, among the designs that fulfil [require] or its options. If none does, the nearest are
listed. With a budget, walls are as thick as it allows at most. Every design is a row of the results
file; after a stop, the same command with the same seed continues, also with more --evaluations. Six
designs run at a time after the first sixteen: more workers do not help. The three best, without
near duplicates, are simulated again with twice the elements, with walls 5 % thinner and thicker,
and with other imperfections, in a results file of their own, and listed with their spread."""
ACCURACY = """Simulate a sweep over numerical settings, then print error against run time: a table,
the observed orders, the cheapest settings below 1 % and below 0.1 %, and a figure. The reference is
the limit to which the finest settings of the method of highest order converge. Cases that differ in
anything other than numerical settings are studied separately. A method is a choice of
solver.integrator, solver.element, contact.model and the like; solver.time_step, .load_steps,
.step_error and lattice.nodes_per_wall refine it."""
WARM = """Compile the kernels now, so that the next run starts at once; otherwise the first run
compiles them. It takes a minute or two, or three by the stock compiler (CRUMPLE_COMPILER),
and again after an update of Crumple or of its packages. The code is kept in CRUMPLE_CACHE_DIR, else
in the cache folder of the user, ~/.cache/crumple on Linux: one call serves all machines of a
cluster that share this folder and have the same processor."""
RANK = """List the designs that absorb the most energy, one table for each loading scene.
Budgets, panel and requirements are taken from [rank] and [require] in the config, unless they are
given here ("none" drops a requirement); --by alone ranks single specimens of any mass. Designs that
fail a requirement are not ranked; notes say how many within the budget fail which. If all
of them fail, the nearest one is named: the one whose worst miss, in percent of the limit, is the
smallest. The exit status is then 0, as the question is answered; it is 1 if some cases failed."""
RANK_EXAMPLES = """examples:
  crumple rank F.h5                                         as [rank] in the config says; else J/g
  crumple rank F.h5 --budget "25 g" "2 oz"                  two budgets
  crumple rank F.h5 --budget "1 oz" --panel "4 in" "2 in"   a panel of at most an ounce
  crumple rank F.h5 --allowed-force "50 N"                  energy until the force exceeds 50 N
  crumple rank F.h5 --max-force "60 N" --max-mass "2 g"      designs that fulfil both
  crumple rank F.h5 --allowed-force "2 kN" --per panel      force of the whole panel
  crumple rank F.h5 --by specific_absorption_J_per_g        most J/g, whatever the mass
  crumple rank F.h5 --by peak_force_N --top 3               least force first
  crumple rank F.h5 --csv > ranking.csv
  crumple rank F.h5 --out results/armor                     tables and figures in a folder
  crumple rank F.h5 --out results/armor --drop-height "1 m" cushion curves too
"""
NEW = """Write a config with comments that runs as it is: a crush, a drop of a rigid striker, or a
dead load. An existing file is not overwritten. Beside it is written crumple.schema.json, the JSON
schema of all keys, which its first line names: editors that know TOML complete and mark keys."""
SCHEMA = """Print the JSON schema of a config: all keys, what they mean, what is allowed. Editors
that know TOML complete and mark the keys of a config that begins with #:schema and the name of such
a file; crumple new writes both."""
COMPLETION = """Print what a shell needs to complete the words of crumple: verbs, options, examples,
results files, columns and ids. To use it:
  bash   eval "$(crumple completion bash)"             in ~/.bashrc
  zsh    eval "$(crumple completion zsh)"              in ~/.zshrc, after compinit
  fish   crumple completion fish > ~/.config/fish/completions/crumple.fish"""
SHOW = """Draw one case: force against strain, the parts of its energy, and six deformed shapes.
A CASE of at most three digits is a number in the ranking that rank prints with the same options: of
the first scene, or of --scene, within the first budget. Without CASE: list the ids and the designs
of all cases."""
SHOW_EXAMPLES = """examples:
  crumple show F.h5                                         the ids of all cases
  crumple show F.h5 a44d                                    the case whose id begins with a44d
  crumple show F.h5 1                                       the first that rank lists
  crumple show F.h5 2 --budget "25 g" --allowed-force "60 N"    the second of that ranking
"""
EXPORT = """Write one case as a file for another program, in the format that its ending names:
  .stl .3mf     the print as a closed body, as heavy as the ranking says
  .svg .dxf     its outline, in mm
  .csv          the curves: travel, force, strain, stress, energies
  .vtkhdf       the stored shapes as a grid that moves, for ParaView 5.12 and later
  .gif          the crush as a moving picture
A file of that name is replaced, and a folder that is missing is made. With --panel: the whole
specimens that rank counts for these two lengths, side by side along the first and one behind the
other along the second. A CASE of at most three digits is a number in the ranking that rank prints
with the same options; --panel is then both the panel that is ranked and the one that is written.
A .3mf has two kinds: "lattice", the walls themselves, to be printed with
100 % infill; "settings", a solid block with the pattern, the per cent and the line width with which
a slicer draws the lattice: one of lattice.slicer, or of regular square, diamond, triangle, kagome
or hex cells."""
EXPORT_EXAMPLES = """examples:
  crumple export F.h5 a44d --to part.stl
  crumple export F.h5 a44d --to bumper.3mf --panel "100 mm" "50 mm"
  crumple export F.h5 a44d --to block.3mf --kind settings
  crumple export F.h5 a44d --to crush.gif
  crumple export F.h5 1 --budget "25 g" --panel "100 mm" "50 mm" --to first.stl
"""
REPORT = """Write one HTML page that needs no network: the best design; sliders for budget, panel
and allowed force, which rank again; energy over mass, with drawings; curves, moving shapes and
energies of chosen designs; failures and origin. It starts with the budgets and the panel of [rank]
in the config. Without scripts it shows the tables of that ranking."""

MATERIALS = """Without WORD: a table of the materials that come with Crumple. With names, also of
your own .csv files: all that their files state, with sources. With the word plot: their curves of
stress over strain, in materials.png. With the word fit: the material of your own test of a printed
strip or puck, loaded, unloaded and loaded again, as a .csv file for material.name, with a picture.
The file is the export of a testing machine as it is: time, strain or displacement (with --gauge),
stress or force (with --area). Whatever is missing in it is requested, with the option to give it.
configs/materials/README.md says how to test."""
MATERIALS_EXAMPLES = """examples:
  crumple materials                                         all of them, as a table
  crumple materials cheetah                                 one in full
  crumple materials plot                                    all curves, in materials.png
  crumple materials plot cheetah mine.csv --out two.png     two of them
  crumple materials fit coupon.csv --out mine.csv           curve, loss and softening
  crumple materials fit pull.csv --gauge "33 mm" --area "8 mm^2" --density "1210 kg/m^3"
  crumple materials fit puck.csv --gauge "10 mm" --area "314 mm^2" --test pressed --units force=kN
"""

CARD = """Print the effective material of each infill of CONFIG, as if it had no end: moduli, shear
modulus and Poisson's ratio in its plane, the modulus along its walls, the stress at which its
walls buckle, and its density. Walls are linear; perimeters and solid layers are left out. --to
writes the nine elastic constants, the density and the axes as text that CalculiX and Abaqus read
(.inp: N, mm, t, MPa), or all of it as a table in SI (.csv)."""
PUBLISHED = """Print predictions of published crushes, and of your own, beside the measured values:
what is open, the predicted range over it, the measured value with its scatter, inside or not. The
predictions are stored; --run simulates them again, into results/published/, and says which do not
come out (exit status 1; also if a case has not converged). ROW: words of the rows to print, such as
the name of a source; then also the config and the measure of each row are printed.
With --add: put your own crush into a table of your own, published.csv. CONFIG varies in its [grid]
what you do not know, such as friction. Its prediction is stored first; the measured value, with a
unit, may be given now or by the same command later. Of a curve, a csv file with the columns
displacement_mm and force_N, the measure is taken up to the simulated stroke."""
PUBLISHED_EXAMPLES = """examples:
  crumple published                                         the table
  crumple published ding                                    one source
  crumple published --out results/published                 also as a picture and as Markdown
  crumple published --run square                            simulate some rows again
  crumple published --add mine.toml                         predict your own crush
  crumple published --add mine.toml --measured "0.12 +- 0.02 J" --source "my press"
  crumple published --add mine.toml --measure plateau_stress_iso_Pa --measured curve.csv
"""

MERGE = """Bring the rows of results files into one, such as the files of the parts of a sweep that
ran as a job array (run --part K/N). Of two rows of a case, the one in the later file stays."""

WIDTH = 100  # most letters in a line of help
BRIEF = "tables and warnings alone"
STORED = "results file; of a sweep also NAME or NAME.toml"
AREA = "area to fill with specimens"
THREADS = "threads (default: one per core, up to 8)"
PROCESSES = "processes in place of threads (default, beyond 8 cores: one per core)"


class Filled(argparse.RawDescriptionHelpFormatter):
    """Paragraphs as wide as the terminal; lines that begin with a blank stay as they are."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        groups = groupby(text.splitlines(), key=lambda line: line[:1].strip() > "")
        texts = ((is_prose, list(lines)) for is_prose, lines in groups)
        return "\n".join(
            fill(" ".join(lines), min(width, WIDTH), break_on_hyphens=False)
            if is_prose
            else "\n".join(lines)
            for is_prose, lines in texts
        )


class Parser(argparse.ArgumentParser):
    """A parser that prints errors in two lines; it accepts no abbreviations, no option twice."""

    def __init__(self, **options: Any):
        super().__init__(**options, allow_abbrev=False, formatter_class=Filled)
        self.register("action", None, Once)
        self.verbs: Mapping[str, Parser] = {}

    def error(self, message: str) -> NoReturn:
        """Print the error, and how to get help."""
        shown = "examples" if self.epilog else "what it takes"
        self.exit(2, f"{self.prog}: {message}\n{self.prog} --help shows {shown}\n")

    def check_verb(self, word: str) -> None:
        """Refuse a word that is no verb, and name the nearest one."""
        if word.startswith("-") or word in self.verbs:
            return
        near = get_close_matches(word, self.verbs, 1)
        hint = f"; the nearest is {near[0]}" if near else ""
        self.error(f"{word}: no verb{hint}; allowed: {', '.join(self.verbs)}")

    def refuse(self, words: Sequence[str]) -> NoReturn:
        """Refuse words that the verb does not accept; for an option, name the nearest one."""
        options = re.findall(r"--[\w-]+", self.format_usage())
        unknown = next((word.partition("=")[0] for word in words if word.startswith("-")), "")
        near = get_close_matches(unknown, options, 1)
        if len(unknown) == 2:  # such as -o
            near = [option for option in options if option.startswith(f"-{unknown}")]
        hint = f"; the nearest is {' or '.join(near)}" if near else ""
        self.error(f"unrecognized arguments: {' '.join(words)}{hint}")


class Once(argparse.Action):
    """Stores the value of an argument, and refuses an option that is given again.

    A parser reads one command line.
    """

    is_given = False

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Store the value."""
        if option_string and self.is_given:
            raise argparse.ArgumentError(self, "given twice; allowed: once")
        self.is_given = True
        setattr(namespace, self.dest, values)


class Version(argparse.Action):
    """Prints the version and exits; the version is looked up only here, since that takes long."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        """Print the version."""
        from sweep.version import __version__

        with suppress(OSError):  # as argparse does for --help
            print(f"crumple {__version__}")
        parser.exit()


def parser() -> Parser:
    """All verbs and their options."""
    main = Parser(prog="crumple", description=ABOUT, epilog=EXAMPLES)
    main.add_argument("--version", action=Version, nargs=0, help="print the version and exit")
    verbs = main.add_subparsers(dest="verb", metavar="VERB", required=True)
    main.verbs = verbs.choices
    _add_run(verbs)
    _add_optimize(verbs)
    _add_accuracy(verbs)
    verbs.add_parser("warm", help="compile the kernels", description=WARM)
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
    """Add the verb that simulates."""
    epilog = f"examples that come with Crumple: {', '.join(examples())}"
    run = verbs.add_parser("run", help="simulate a sweep", description=RUN, epilog=epilog)
    offer(run.add_argument("config", type=_path, metavar="CONFIG", help=CONFIG), configs)
    run.add_argument(
        "--out", type=_results, metavar="F.h5", help="results file (default: results/NAME.h5)"
    )
    _add_place(run)
    run.add_argument("--dry-run", action="store_true", help="estimate time and disk, write nothing")
    run.add_argument(
        "--error-bars", action="store_true", help="estimate the error of mesh and steps"
    )
    run.add_argument(
        "--spread", action="store_true", help="run the best designs with uncertain numbers"
    )
    run.add_argument(
        "--screen",
        type=_count,
        metavar="N",
        help="along the cells: crush one cell of each, then the N best of each infill",
    )
    run.add_argument(
        "--part",
        type=_part,
        metavar="K/N",
        help="run the Kth of N parts, into a file of its own (crumple merge)",
    )
    run.add_argument("--brief", action="store_true", help=BRIEF)
    run.add_argument("--retry-failed", action="store_true", help="compute failed cases again")
    run.add_argument(
        "--renew", action="store_true", help="compute damaged rows and rows of an older model again"
    )


def _add_optimize(verbs: Any) -> None:
    """Add the verb that searches."""
    optimize = verbs.add_parser("optimize", help="search for the best design", description=OPTIMIZE)
    optimize.add_argument("config", type=_path, metavar="CONFIG", help="TOML file with a [search]")
    optimize.add_argument("--budget", metavar="MASS", help='greatest mass: "25 g"')
    optimize.add_argument("--panel", nargs=2, metavar="LENGTH", help=f'{AREA}: "100 mm" "50 mm"')
    force = "of a crush, as --allowed-force; of an impact or a load, required"
    _add_limits(optimize, force)
    optimize.add_argument("--by", metavar="COLUMN", help="seek the best of this column")
    optimize.add_argument("--pareto", metavar="COLUMN", help="list the front of a second aim, too")
    optimize.add_argument(
        "--evaluations", type=_count, default=150, metavar="N", help="designs, 150 by default"
    )
    optimize.add_argument("--seed", type=_count, default=1, metavar="N", help="1 by default")
    optimize.add_argument(
        "--out", type=_results, metavar="F.h5", help="results file (default: results/NAME.h5)"
    )
    _add_place(optimize)


def _add_place(verb: Any) -> None:
    """Add the options for where cases run: on threads or on a cluster."""
    where = verb.add_mutually_exclusive_group()
    where.add_argument("--workers", type=_count, metavar="N", help=THREADS)
    where.add_argument("--processes", type=_count, metavar="N", help=PROCESSES)
    where.add_argument(
        "--scheduler",
        type=_path,
        metavar="WHERE",
        help="a Dask cluster in place of threads: tcp://host:8786, tls://host:8786, a scheduler "
        "file, or slurm (default: DASK_SCHEDULER_ADDRESS, if it is set)",
    )
    verb.add_argument(
        "--wait",
        type=_duration,
        metavar="TIME",
        help='how long to wait while the cluster has no worker: "2 h" (default: "60 s")',
    )


def _add_accuracy(verbs: Any) -> None:
    """Add the verb that compares numerical settings."""
    accuracy = verbs.add_parser("accuracy", help="error against run time", description=ACCURACY)
    offer(accuracy.add_argument("config", type=_path, metavar="CONFIG", help=CONFIG), configs)
    accuracy.add_argument(
        "--out",
        type=_folder,
        metavar="DIR",
        default="results/accuracy",
        help="results, tables and figure (default: results/accuracy)",
    )
    accuracy.add_argument("--workers", type=_count, metavar="N", help=THREADS)


def _add_status(verbs: Any) -> None:
    """Add the verb that counts cases and failures."""
    status = verbs.add_parser("status", help="what is done, and what failed and why")
    offer(status.add_argument("file", type=_stored, metavar="F.h5", help=STORED), results)
    status.add_argument("--json", action="store_true", help="as json on stdout")


def _add_verify(verbs: Any) -> None:
    """Add the verb that checks a results file."""
    verify = verbs.add_parser(
        "verify", help="whether a file is whole, and its numbers come out again", description=VERIFY
    )
    offer(verify.add_argument("file", type=_stored, metavar="F.h5", help=STORED), results)
    verify.add_argument(
        "--again",
        type=_number,
        default=3,
        metavar="N",
        help="cases drawn at random that are simulated again (default: 3)",
    )


def _add_merge(verbs: Any) -> None:
    """Add the verb that combines results files."""
    merge = verbs.add_parser("merge", help="bring results files together", description=MERGE)
    merge.add_argument("out", type=_results, metavar="OUT.h5", help="is made, or gets more rows")
    offer(
        merge.add_argument("files", type=_stored, nargs="+", metavar="F.h5", help=STORED), results
    )


def _add_rank(verbs: Any) -> None:
    """Add the verb that lists the best designs."""
    rank = verbs.add_parser("rank", help="the best designs", description=RANK, epilog=RANK_EXAMPLES)
    offer(rank.add_argument("file", type=_stored, metavar="F.h5", help=STORED), results)
    _add_question(rank)
    rank.add_argument("--top", type=_count, metavar="N", help="places shown: 10, or 3 per budget")
    shape = rank.add_mutually_exclusive_group()
    every = "these places, in all columns"
    for name, what in {"csv": every, "json": every, "markdown": "tables"}.items():
        shape.add_argument(f"--{name}", action="store_true", help=f"{what}, as {name} on stdout")
    shape.add_argument("--brief", action="store_true", help=BRIEF)
    shape.add_argument(
        "--out", type=_folder, metavar="DIR", help="write tables and figures into a folder"
    )
    rank.add_argument(
        "--drop-height",
        nargs="+",
        action="extend",
        metavar="LENGTH",
        help='with --out: cushion curves of drops from "0.5 m" (default: as in [rank])',
    )


def _add_show(verbs: Any) -> None:
    """Add the verb that draws a case."""
    show = verbs.add_parser("show", help="draw a case", description=SHOW, epilog=SHOW_EXAMPLES)
    offer(show.add_argument("file", type=_stored, metavar="F.h5", help=STORED), results)
    _add_case(show, nargs="?")
    show.add_argument(
        "--out", type=_folder, metavar="DIR", help="folder of the pictures (default: beside F.h5)"
    )


def _add_export(verbs: Any) -> None:
    """Add the verb that writes files for other programs."""
    export = verbs.add_parser(
        "export", help="a part to print, curves, shapes", description=EXPORT, epilog=EXPORT_EXAMPLES
    )
    offer(export.add_argument("file", type=_stored, metavar="F.h5", help=STORED), results)
    _add_case(export, "area to fill with specimens, ranked by and written")
    export.add_argument(
        "--to",
        type=_path,
        metavar="FILE",
        required=True,
        help="FILE.stl, .3mf, .svg, .dxf, .csv, .vtkhdf or .gif",
    )
    export.add_argument(
        "--kind", choices=["lattice", "settings"], help="of a .3mf (default: lattice)"
    )


def _add_report(verbs: Any) -> None:
    """Add the verb that writes a page."""
    report = verbs.add_parser("report", help="one HTML page", description=REPORT)
    report.add_argument("file", type=_stored, metavar="F.h5", help=STORED)
    report.add_argument(
        "--out", type=_page, metavar="F.html", help="the page (default: beside F.h5)"
    )
    report.add_argument("--open", action="store_true", help="open it in the browser")


def _add_materials(verbs: Any) -> None:
    """Add the verb that lists, shows, plots and fits materials."""
    materials = verbs.add_parser(
        "materials",
        help="list, plot and fit materials",
        description=MATERIALS,
        epilog=MATERIALS_EXAMPLES,
    )
    words = materials.add_argument(
        "words", type=_path, metavar="WORD", nargs="*", help="NAME ..., plot [NAME ...], fit F.csv"
    )
    offer(words, material_words)
    materials.add_argument("--out", type=_path, metavar="FILE", help="of plot: .png; of fit: .csv")
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
    """Add the verb that prints the effective materials of infills."""
    card = verbs.add_parser(
        "card", help="infills as materials for finite elements", description=CARD
    )
    config = card.add_argument("config", type=_path, metavar="CONFIG", help=CONFIG)
    offer(config, configs)
    card.add_argument("--to", type=_path, metavar="FILE", help="also write them: .inp or .csv")


def _add_published(verbs: Any) -> None:
    """Add the verb that compares predictions with measured values."""
    published = verbs.add_parser(
        "published",
        help="predictions beside what was measured",
        description=PUBLISHED,
        epilog=PUBLISHED_EXAMPLES,
    )
    published.add_argument("rows", metavar="ROW", nargs="*", help="words of the rows to print")
    published.add_argument("--run", action="store_true", help="simulate the predictions again")
    add = published.add_argument("--add", type=_path, metavar="CONFIG", help="your own crush")
    offer(add, configs)
    published.add_argument("--measured", metavar="VALUE", help='"0.12 +- 0.02 J", or curve.csv')
    published.add_argument("--measure", metavar="COLUMN", help="default: absorbed_energy_J")
    published.add_argument("--source", metavar="TEXT", help="of the measured value")
    published.add_argument(
        "--table", type=_table, metavar="F.csv", default="published.csv", help="your own rows"
    )
    published.add_argument(
        "--out", type=_folder, metavar="DIR", help="folder for a picture and the table"
    )
    published.add_argument("--workers", type=_count, metavar="N", help=THREADS)


def _add_helpers(verbs: Any) -> None:
    """Add the verbs that write a first config and a script for completion in a shell."""
    new = verbs.add_parser("new", help="write a first config", description=NEW)
    new.add_argument("name", metavar="NAME", help="of the sweep, such as bumper")
    new.add_argument("--kind", choices=KINDS, default="crush", help="of loading (default: crush)")
    new.add_argument("--out", type=_path, metavar="FILE", help="file to write (default: NAME.toml)")
    verbs.add_parser("schema", help="the keys of a config, for editors", description=SCHEMA)
    completion = verbs.add_parser(
        "completion", help="complete words in a shell", description=COMPLETION
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


def _count(text: str) -> int:
    """A whole number above zero."""
    if text.isdecimal() and int(text) > 0:
        return int(text)
    raise argparse.ArgumentTypeError(f"{text!r}; allowed: a whole number, 1 or more")


def _part(text: str) -> tuple[int, int]:
    """A part of a sweep: "2/8" is the second of eight."""
    number, _, count = text.partition("/")
    if number.isdecimal() and count.isdecimal() and 0 < int(number) <= int(count):
        return int(number), int(count)
    raise argparse.ArgumentTypeError(f"{text!r}; allowed: K/N, such as 2/8 for the second of eight")


def _duration(text: str) -> float:
    """A time in s."""
    from sweep.config.faults import ConfigError
    from sweep.config.units import quantity

    try:
        seconds = quantity(text, "s")
    except ConfigError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    if seconds < 0.0:
        raise argparse.ArgumentTypeError(f"{text!r}; allowed: a time of 0 s or more")
    return seconds


def _number(text: str) -> int:
    """A whole number, zero included."""
    if text.isdecimal():
        return int(text)
    raise argparse.ArgumentTypeError(f"{text!r}; allowed: a whole number, 0 or more")


def _path(text: str) -> str:
    """A path that is not empty."""
    if text:
        return text
    raise argparse.ArgumentTypeError("an empty path; allowed: the name of a file or a folder")


def _folder(text: str) -> str:
    """A path that does not exist or is a folder."""
    if os.path.exists(_path(text)) and not os.path.isdir(text):  # these functions never raise
        raise argparse.ArgumentTypeError(f"{text!r} is a file; allowed: a folder")
    return text


def _stored(text: str) -> str:
    """The path of a results file, for which the name or the config of a sweep may stand."""
    from sweep.cli.named_files import results_file

    return results_file(_path(text))


def _named(text: str, end: str) -> str:
    """The path of a file, there or not, whose name has this ending."""
    is_no_file = os.path.exists(text) and not os.path.isfile(text)  # these functions never raise
    if Path(_path(text)).suffix == end and not is_no_file:
        return text
    raise argparse.ArgumentTypeError(f"{text!r}; allowed: a file whose name ends in {end}")


_results, _table, _page = (partial(_named, end=end) for end in (".h5", ".csv", ".html"))


def main(argv: Sequence[str] | None = None) -> int:
    """Run one verb and return the exit status."""
    argument_parser = parser()
    complete(argument_parser, Once)
    words = sys.argv[1:] if argv is None else argv
    if not words:
        argument_parser.print_help()
        return 0
    argument_parser.check_verb(words[0])
    arguments, unknown = argument_parser.parse_known_args(words)
    if unknown:
        argument_parser.verbs[arguments.verb].refuse(unknown)
    from sweep.cli import verbs
    from sweep.cli.refusals import refusals
    from sweep.cli.terminal import flush, silence, write

    if arguments.verb not in verbs.VERBS:
        argument_parser.verbs[arguments.verb].error(
            "ALL of sweep/cli/verbs.py has no function for it"
        )
    warnings.formatwarning = lambda message, *_: f"crumple: {message}\n"  # has no place in our code
    sys.stdout = sys.stdout or os.fdopen(_nowhere(), "w")  # None if the caller closed it
    sys.stderr = sys.stderr or os.fdopen(_nowhere(), "w")
    sys.stdout.reconfigure(errors="replace")  # type: ignore[union-attr]  # ASCII has no dash
    try:
        status = verbs.VERBS[arguments.verb](arguments)
        flush()
    except KeyboardInterrupt as stop:
        write(sys.stderr, f"{str(stop) or 'interrupted'}\n")
        return 1
    except OSError as error:
        silence(sys.stdout)
        return _refuse(arguments.verb, error)
    except refusals() as refusal:
        return _refuse(arguments.verb, refusal)
    return status


def _refuse(verb: str, why: Exception) -> int:
    from sweep.cli.terminal import write

    write(sys.stderr, f"crumple {verb}: {plain(why)}\n")
    return getattr(why, "exit_status", 2)


def _nowhere() -> int:
    return os.open(os.devnull, os.O_WRONLY)


if __name__ == "__main__":
    sys.exit(main())
