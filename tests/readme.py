"""The README taken apart: its code blocks, its tables, what it quotes, its examples."""

import re
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
TEXT = (ROOT / "README.md").read_text("utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL)
QUOTED = set(re.findall(r"`([^`\n]+)`", TEXT))


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


def examples():
    """Rankings that the README shows, each with the command that prints it."""
    shown = [text.splitlines() for text in blocks("text") if text.startswith("$ crumple rank ")]
    return [Example(lines[0].removeprefix("$ "), lines[1], lines[1:]) for lines in shown]


def says(line):
    """True if the README has this line, however it is wrapped."""
    return " ".join(line.split()) in " ".join(TEXT.split())
