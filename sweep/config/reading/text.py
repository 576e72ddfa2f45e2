"""Reads text and rows of a user's file; faults are reported in our own words."""

import csv
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Iterable
from pathlib import Path

from sweep.config.faults import MisfitError
from sweep.numbers import text_in

MOST_BYTES = 64_000_000  # most bytes of a file of another program
WORKBOOKS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")  # first bytes of Excel files, new and old


def text_of(path: Path, needed: str) -> str:
    """The text of a file in UTF-8. needed: the kind of file that is needed, in words."""
    try:
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise MisfitError(f"cannot be read ({error.strerror}); needed: {needed}") from None
    except UnicodeDecodeError:
        raise MisfitError(f"not UTF-8 text; needed: {needed}") from None
    except ValueError:  # a null character in the path
        raise MisfitError(f"not the path of a file; needed: {needed}") from None


def rows_of(lines: Iterable[str], separator: str = ",") -> list[list[str]]:
    """The values between separators in lines of a csv file."""
    try:
        return list(csv.reader(lines, delimiter=separator))
    except csv.Error:
        most = csv.field_size_limit()
        raise MisfitError(f"a value of more than {most:,} characters; needed: numbers") from None


def foreign_text(path: Path, needed: str) -> str:
    """The text of a file of another program: UTF-8 or UTF-16, marked or not, else Windows-1252."""
    try:
        with path.open("rb") as file:
            content = file.read(MOST_BYTES + 1)
    except OSError as error:
        raise MisfitError(f"cannot be read ({error.strerror}); needed: {needed}") from None
    except ValueError:  # a null character in the path
        raise MisfitError(f"not the path of a file; needed: {needed}") from None
    if len(content) > MOST_BYTES:
        raise MisfitError(f"larger than {text_in(MOST_BYTES, 'MB')}; needed: {needed}")
    if content.startswith(WORKBOOKS):
        raise MisfitError(f"a workbook; needed: {needed} (in the spreadsheet: save as CSV)")
    for coding in _codings(content):
        try:
            text = content.decode(coding)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            return text
    raise MisfitError(f"no text; needed: {needed}")


def _codings(content: bytes) -> tuple[str, ...]:
    """The encodings that the content may have. Latin letters in UTF-16 have an empty byte."""
    if content.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
        return ("utf-16",)
    start = content[:200]
    if start[1::2].count(0) > len(start) // 4:
        return ("utf-16-le",)
    if start[::2].count(0) > len(start) // 4:
        return ("utf-16-be",)
    return ("utf-8-sig", "cp1252")
