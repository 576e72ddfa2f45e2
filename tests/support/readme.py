"""The README and its further pages taken apart: code blocks, tables, quotations, examples."""

import re
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
DOCS = ("questions", "rammed", "results", "accuracy", "published", "speed")
NAMES = (
    *("README.md", *(f"docs/{name}.md" for name in DOCS)),
    *("configs/README.md", "kernels/README.md", "GLOSSARY.md"),
)
PAGES = {name: (ROOT / name).read_text("utf-8") for name in NAMES}
TEXT = "\n".join(PAGES.values())
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL)
QUOTED = set(re.findall(r"`([^`\n]+)`", TEXT))


NUMBER = r"(?<![\w.])[-+]?\d[\d.]*(?:e[-+]?\d+)?(?![\w.])"


class Example(NamedTuple):
    """A command, and the table that it prints under this title."""

    command: str
    title: str
    lines: list[str]


def blocks(language):
    return [text for name, text in BLOCKS if name == language]


def tables():
    """Markdown tables as lists of rows, each a list of cells, without the rule below the head."""
    found = re.findall(r"(?:^\|.*\n)+", TEXT, re.MULTILINE)
    rows = [[line.strip("|").split("|") for line in table.splitlines()] for table in found]
    return [[[cell.strip() for cell in row] for row in [t[0], *t[2:]]] for t in rows]


def table(first):
    """The rows of the table whose head begins so, without the head."""
    (found,) = (rows[1:] for rows in tables() if rows[0][0] == first)
    return found


def numbers(row):
    """The numbers of a row, without its first cell."""
    return [float(number) for number in re.findall(NUMBER, " ".join(row[1:]))]


def words(row):
    """The cells of a row, # in place of numbers but in the first."""
    return [row[0], *(re.sub(NUMBER, "#", cell) for cell in row[1:])]


def examples():
    """Rankings that the README shows, each with the command that prints it."""
    shown = [text.splitlines() for text in blocks("text") if text.startswith("$ crumple rank ")]
    return [Example(lines[0].removeprefix("$ "), lines[1], lines[1:]) for lines in shown]


def says(line):
    """True if a page has this line, however it is wrapped."""
    return " ".join(line.split()) in " ".join(TEXT.split())
