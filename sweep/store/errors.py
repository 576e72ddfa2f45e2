"""The error of everything that reads and writes results files."""


class StoreError(Exception):
    """A results file that cannot be read or written; the text is one line."""
