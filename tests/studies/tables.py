"""Tables of studies as Markdown: printed, and written to a file."""

import sys

from sweep.report.tables.markdown import markdown


def line(texts):
    """A row of a table."""
    return f"| {' | '.join(map(str, texts))} |"


def head(texts):
    """The first row of a table and its rule."""
    return [line(texts), "|---" * len(texts) + "|"]


def tell(lines, path):
    """Print the lines as they are found; write them to a file."""
    told = []
    for text in lines:
        told.append(text)
        sys.stdout.write(f"{text}\n")
        sys.stdout.flush()
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join([*told, ""]), "utf-8")


def publish(sheets, path):
    """Print sheets; write them to a file."""
    tell(markdown(sheets).splitlines(), path)
