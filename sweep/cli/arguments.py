"""The parser of a command line, its actions, and the types of arguments."""

import argparse
import os
import re
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from difflib import get_close_matches
from functools import partial
from itertools import groupby
from pathlib import Path
from textwrap import fill
from typing import Any, NoReturn

WIDTH = 100  # most letters in a line of help


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
        if option := re.match(r"argument (--[\w-]+): expected", message):
            about = self._option_string_actions[option[1]].help or ""
            message = f"{message} ({about.replace('%%', '%')})"
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
            sys.stdout.write(f"crumple {__version__}\n")
        parser.exit()


def _whole(text: str, least: int) -> int:
    """A whole number."""
    if text.isdecimal() and len(text) < 19 and int(text) >= least:
        return int(text)
    raise argparse.ArgumentTypeError(f"{text!r}; allowed: a whole number, {least} or more")


count, number = partial(_whole, least=1), partial(_whole, least=0)


def part(text: str) -> tuple[int, int]:
    """A part of a sweep: "2/8" is the second of eight."""
    place, _, parts = text.partition("/")
    if place.isdecimal() and parts.isdecimal() and 0 < int(place) <= int(parts):
        return int(place), int(parts)
    raise argparse.ArgumentTypeError(f"{text!r}; allowed: K/N, such as 2/8 for the second of eight")


def duration(text: str) -> float:
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


def path(text: str) -> str:
    """A path that is not empty."""
    if text:
        return text
    raise argparse.ArgumentTypeError("an empty path; allowed: the name of a file or a folder")


def folder(text: str) -> str:
    """A path that does not exist or is a folder."""
    if os.path.exists(path(text)) and not os.path.isdir(text):  # these functions never raise
        raise argparse.ArgumentTypeError(f"{text!r} is a file; allowed: a folder")
    return text


def stored(text: str) -> str:
    """The path of a results file, for which the name or the config of a sweep may stand."""
    from sweep.cli.named_files import results_file

    return results_file(path(text))


def _named(text: str, end: str) -> str:
    """The path of a file, there or not, whose name has this ending."""
    is_no_file = os.path.exists(text) and not os.path.isfile(text)  # these functions never raise
    if Path(path(text)).suffix == end and not is_no_file:
        return text
    raise argparse.ArgumentTypeError(f"{text!r}; allowed: a file whose name ends in {end}")


results_path, table_path, page_path = (partial(_named, end=end) for end in (".h5", ".csv", ".html"))
