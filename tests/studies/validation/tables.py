"""Markdown tables that are printed as they are found."""

import sys


def line(texts):
    """A row of a table."""
    return f"| {' | '.join(texts)} |"


def tell(lines, path):
    """Print the lines as they are found; write them to a file."""
    told = []
    for text in lines:
        told.append(text)
        sys.stdout.write(f"{text}\n")
        sys.stdout.flush()
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join([*told, ""]), "utf-8")
