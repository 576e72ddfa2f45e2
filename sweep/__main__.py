"""The command line: `crumple VERB ...`, also `python -m crumple`. The verbs are in `cli/verbs.py`.

Exit status: 0 done, also if no design meets the requirements, as that is an answer; 1 some cases
failed, the run was interrupted, or its cluster failed; 2 the config, a file or an argument cannot
be used.
"""

import os
import sys
import warnings
from collections.abc import Sequence

from sweep.cli.arguments import Once
from sweep.cli.completion import complete
from sweep.cli.parser import parser
from sweep.plain_text import plain


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
