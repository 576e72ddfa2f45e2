"""The error of all modules that read and write results files."""


class StoreError(Exception):
    """A results file that cannot be read or written; the text is one line."""
