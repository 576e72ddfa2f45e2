"""The verb `completion`, and the words that a shell offers after `crumple`.

A shell runs `crumple` at each press of the tab key, with variables that argcomplete reads.
"""

import os
from argparse import Action, ArgumentParser, Namespace
from contextlib import suppress
from typing import Any

SHELLS = ("bash", "zsh", "fish")
ASKED = "_ARGCOMPLETE"  # variable that a shell sets
SOME = 1000  # ids that are offered


def script(shell: str) -> str:
    """The script that a shell reads at its start to complete `crumple`."""
    from argcomplete.shell_integration import shellcode

    return shellcode(["crumple"], shell=shell).strip()


def complete(parser: ArgumentParser, stores: type[Action]) -> None:
    """Answer a shell that asks, and exit; otherwise do nothing. stores: an action that has no other
    effect, whose values `words` may need.
    """
    if ASKED in os.environ:
        from argcomplete import autocomplete
        from argcomplete.finders import safe_actions

        safe_actions.add(stores)
        autocomplete(parser)


def offer(argument: Any, words: Any) -> None:
    """Let a shell offer `words(prefix, parsed_args)` for an argument, in addition to files."""
    argument.completer = words


def configs(prefix: str, **_: object) -> list[str]:
    """Examples, and the files and folders whose names start with ``prefix``."""
    from argcomplete.completers import FilesCompleter

    from sweep.config.reading.examples import examples

    return examples() + list(FilesCompleter(["toml"])(prefix))


def results(prefix: str, **_: object) -> list[str]:
    """Results files and folders whose names start with ``prefix``."""
    from argcomplete.completers import FilesCompleter

    return list(FilesCompleter(["h5"])(prefix))


def columns(parsed_args: Namespace, **_: object) -> list[str]:
    """The columns by which a ranking may be sorted."""
    from sweep.columns import COLUMNS

    return [name for name, column in COLUMNS.items() if column.better]


def cases(parsed_args: Namespace, **_: object) -> list[str]:
    """The ids of the cases in the results file that precedes them on the command line."""
    from sweep.store.read import StoreError, read_statuses

    with suppress(StoreError):
        return list(read_statuses(parsed_args.file))[:SOME]
    return []


def materials(prefix: str, **_: object) -> list[str]:
    """The materials that come with Crumple, and the words of the verb."""
    from sweep.config.materials.material_file import available

    return ["plot", "fit", *available()]
