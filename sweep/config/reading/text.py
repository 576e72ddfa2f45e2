"""Text and rows of a user's file; what cannot be read is said in our own words."""

import csv
from collections.abc import Iterable
from pathlib import Path

from sweep.config.faults import MisfitError


def text_of(path: Path, needed: str) -> str:
    """The text of a file in UTF-8. needed: the file that would do, in words."""
    try:
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise MisfitError(f"cannot be read ({error.strerror}); needed: {needed}") from None
    except UnicodeDecodeError:
        raise MisfitError(f"not UTF-8 text; needed: {needed}") from None
    except ValueError:  # a null character in the path
        raise MisfitError(f"not the path of a file; needed: {needed}") from None


def rows_of(lines: Iterable[str]) -> list[list[str]]:
    """The values between commas in lines of a csv file."""
    try:
        return list(csv.reader(lines))
    except csv.Error:
        most = csv.field_size_limit()
        raise MisfitError(f"a value of more than {most:,} characters; needed: numbers") from None
